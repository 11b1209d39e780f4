//! The color of light that came through, from the color that a leaf shows by day.
//!
//! Absorption is what makes the leaf as bright as the picture says, in each band; scattering is what its preset has where it
//! absorbs as much. Across the spectrum of one leaf the two go together: where tissue swallows most of the light, less of it
//! looks scattered. The same leaf then lets through what it lets through.

use crate::presets::Preset;
use crate::transport::{AddingDoubling, Medium, fresnel_outside};
use rayon::prelude::*;

/// Red, green and blue stand for light of these wavelengths, nm, as the bands of the room do.
const WAVELENGTHS_NM: [f64; 3] = [610.0, 550.0, 450.0];
/// Wavelengths of a leaf's spectrum, nm: from where it absorbs least to where it absorbs most.
const SPECTRUM_NM: [f64; 5] = [450.0, 510.0, 550.0, 610.0, 680.0];
/// Absorptions that are solved, and their range, 1/mm: from glass to soot.
const SOLVED: usize = 48;
const RANGE: (f64, f64) = (1e-4, 300.0);
const NODES: usize = 16;

/// A leaf of one kind and thickness, solved for all colors.
#[derive(Clone, Debug)]
pub struct ColorEstimate {
    /// Per band, (albedo, transmission) by rising albedo.
    bands: [Vec<(f64, f64)>; 3],
    /// Transmission of the kind of leaf itself.
    kind: [f64; 3],
}

impl ColorEstimate {
    /// Solves a leaf of this kind and thickness, mm. `None` for a preset that ends within the visible.
    pub fn new(preset: &Preset, thickness_mm: f64) -> Option<ColorEstimate> {
        let mut spectrum = SPECTRUM_NM.map(|nm| preset.medium(nm)).into_iter().collect::<Option<Vec<Medium>>>()?;
        spectrum.sort_by(|a, b| a.absorption.total_cmp(&b.absorption));
        let mut bands = [const { Vec::new() }; 3];
        let mut kind = [0.0; 3];
        for ((band, own), wavelength) in bands.iter_mut().zip(&mut kind).zip(WAVELENGTHS_NM) {
            let medium = preset.medium(wavelength)?;
            *band = solved(&medium, &spectrum, thickness_mm);
            *own = AddingDoubling::one(&medium, thickness_mm, 1.0, NODES).transmittance;
        }
        Some(ColorEstimate { bands, kind })
    }

    /// Linear color of light that comes through a leaf of this kind whose own color nobody knows.
    pub fn of_its_kind(&self) -> [f64; 3] {
        self.kind
    }

    /// Linear color of light that came through a place of this albedo (linear base color): below 1, rising with it. What is
    /// brighter than a leaf without any absorption is taken for one.
    pub fn of(&self, albedo: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|c| between(&self.bands[c], f64::from(albedo[c])) as f32)
    }
}

fn solved(medium: &Medium, spectrum: &[Medium], thickness_mm: f64) -> Vec<(f64, f64)> {
    let (low, high) = (libm::log(RANGE.0), libm::log(RANGE.1));
    let row = |i: usize| {
        // From soot to glass: albedo rises.
        let absorption = libm::exp(high + (low - high) * i as f64 / (SOLVED - 1) as f64);
        let scattering = scattering(spectrum, absorption);
        let totals = AddingDoubling::one(&Medium { absorption, scattering, ..*medium }, thickness_mm, 1.0, NODES);
        // The mirror of the surface is no part of a base color.
        ((totals.reflectance - fresnel_outside(1.0, medium.index)).max(0.0), totals.transmittance)
    };
    (0..SOLVED).into_par_iter().map(row).collect()
}

/// Scattering where a leaf absorbs as much, by straight lines over the logarithm of absorption.
fn scattering(spectrum: &[Medium], absorption: f64) -> f64 {
    let row = |medium: &Medium| (libm::log(medium.absorption.max(RANGE.0)), medium.scattering);
    between(&spectrum.iter().map(row).collect::<Vec<_>>(), libm::log(absorption))
}

/// What stands at a place in rows of (place, value) by rising place.
fn between(rows: &[(f64, f64)], place: f64) -> f64 {
    let at = rows.partition_point(|row| row.0 <= place);
    match (at.checked_sub(1).and_then(|i| rows.get(i)), rows.get(at)) {
        (Some(low), Some(high)) => {
            let share = (place - low.0) / (high.0 - low.0).max(f64::MIN_POSITIVE);
            low.1 + share * (high.1 - low.1)
        }
        (Some(one), None) | (None, Some(one)) => one.1,
        (None, None) => 0.0,
    }
}
