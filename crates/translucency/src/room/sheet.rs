//! Which maps are made: bands of light, tissue of each, seen from each side.

use super::finding;
use super::input::Sheet;
use super::params::{Bands, Mirror, Params, Side, refuse};
use crate::map::{Recipe, Tables, Tissue};
use crate::presets::Preset;
use crate::transport::Medium;
use crate::{Measured, fit_rt};
use foliar_bake::BakeError;
use foliar_schema::{Finding, code, names};
use serde_json::{Value, json};

/// Wavelengths of red, green and blue, and what their rasters are called after the side. Green is the one that is shown
/// where there is room for one.
const RGB: [(f64, &str); 3] = [(610.0, names::BAND_RED), (550.0, ""), (450.0, names::BAND_BLUE)];

/// One band of light.
#[derive(Clone, Debug)]
pub struct Band {
    /// What its raster is called after the side.
    pub suffix: &'static str,
    wavelength_nm: f64,
    /// Layers from the front.
    recipe: Recipe,
}

/// The bands that parameters ask for.
///
/// # Errors
/// [`BakeError::Parameter`] for tissue that cannot be.
pub fn recipes(params: &Params, sheet: &Sheet) -> Result<Vec<Band>, BakeError> {
    let one = [(params.wavelength_nm, "")];
    let bands: &[(f64, &str)] = if params.bands == Bands::Rgb { &RGB } else { &one };
    if bands.len() > 1 && (params.absorption.is_some() || !params.layer.is_empty()) {
        return Err(refuse(
            "bands",
            "rgb takes its tissue from `preset` or from three pairs of fit_rt: absorption and layer say one wavelength",
        ));
    }
    let measured = measured(params, bands.len())?;
    let band = |(at, &(wavelength_nm, suffix)): (usize, &(f64, &'static str))| {
        let tissues = tissues(params, sheet, wavelength_nm, measured.get(at))?;
        let recipe = Recipe {
            tissues,
            model: params.model,
            entry: params.entry,
            fit: params.fit,
            curve: params.curve == super::AngularCurve::Fitted,
            spreading: params.spread,
            filters: params.filters.map(|count| count as usize),
            texel_mm: sheet.texel_mm,
        };
        Ok(Band { suffix, wavelength_nm, recipe })
    };
    bands.iter().enumerate().map(band).collect()
}

/// What was measured of each band; nothing where tissue is said otherwise.
fn measured(params: &Params, bands: usize) -> Result<Vec<Measured>, BakeError> {
    let Some(text) = &params.fit_rt else { return Ok(Vec::new()) };
    let form = if bands > 1 { "R,T;R,T;R,T, of red, green and blue" } else { "R,T" };
    let pair = |text: &str| {
        let [reflectance, transmittance] = numbers(text, "fit_rt", form)?;
        Ok(Measured { reflectance, transmittance, with_mirror: params.mirror == Mirror::Included })
    };
    let pairs = text.split(';').map(pair).collect::<Result<Vec<_>, BakeError>>()?;
    if pairs.len() == bands { Ok(pairs) } else { Err(refuse("fit_rt", format!("{text:?}: must be {form}"))) }
}

fn tissues(
    params: &Params,
    sheet: &Sheet,
    wavelength_nm: f64,
    measured: Option<&Measured>,
) -> Result<Vec<Tissue>, BakeError> {
    let preset = Preset::named(params.preset.name()).and_then(|preset| preset.medium(wavelength_nm));
    let preset =
        preset.ok_or_else(|| refuse("wavelength_nm", format!("is {wavelength_nm}: must be from 450 to 680")))?;
    let index = params.index.unwrap_or(preset.index);
    if !params.layer.is_empty() {
        return layers(params, index);
    }
    if let Some(measured) = measured {
        let medium = fit_rt(*measured, sheet.median_mm, params.anisotropy, index);
        return Ok(vec![Tissue { medium: medium.map_err(|e| refuse("fit_rt", e.to_string()))?, share: 1.0 }]);
    }
    let medium = Medium::reduced(
        params.absorption.unwrap_or(preset.absorption),
        params.reduced_scattering.unwrap_or(preset.reduced_scattering()),
        params.anisotropy,
        index,
    );
    Ok(vec![Tissue { medium: medium.map_err(|e| refuse(e.name, e.to_string()))?, share: 1.0 }])
}

fn layers(params: &Params, index: f64) -> Result<Vec<Tissue>, BakeError> {
    let read = |text: &String| {
        let [absorption, reduced, anisotropy, share] = numbers(text, "layer", "ABSORPTION,REDUCED,ANISOTROPY,SHARE")?;
        let medium = Medium::reduced(absorption, reduced, anisotropy, index);
        if share.is_nan() || share <= 0.0 {
            return Err(refuse("layer", format!("{text}: a share must be above 0")));
        }
        Ok(Tissue { medium: medium.map_err(|e| refuse("layer", format!("{text}: {e}")))?, share })
    };
    let mut tissues = params.layer.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let total: f64 = tissues.iter().map(|tissue| tissue.share).sum();
    tissues.iter_mut().for_each(|tissue| tissue.share /= total);
    Ok(tissues)
}

fn numbers<const N: usize>(text: &str, place: &str, form: &str) -> Result<[f64; N], BakeError> {
    let parts: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    let parts = parts.and_then(|parts| <[f64; N]>::try_from(parts).ok());
    parts.ok_or_else(|| refuse(place, format!("{text:?}: must be {form}")))
}

/// What was found from measured reflectances and transmittances.
pub fn fitted_tissue(params: &Params, bands: &[Band]) -> Option<Finding> {
    let text = params.fit_rt.as_ref()?;
    let found = |band: &Band| {
        let medium = band.recipe.tissues.first()?.medium;
        let of = if bands.len() > 1 { format!(" at {} nm", band.wavelength_nm) } else { String::new() };
        Some(format!(
            "absorption {:.4} and reduced scattering {:.4} per mm{of}",
            medium.absorption,
            medium.reduced_scattering()
        ))
    };
    let found: Vec<String> = bands.iter().filter_map(found).collect();
    let message = format!("R,T = {text} are those of {}", found.join("; "));
    Some(finding(&code::MAP_FITTED, names::MAP_THICKNESS, message))
}

impl Band {
    /// The recipe as light meets it whose map is shown on `side`.
    pub fn seen_from(&self, side: Side) -> Recipe {
        let mut recipe = self.recipe.clone();
        if side == Side::Front {
            recipe.tissues.reverse();
        }
        recipe
    }

    /// What a record says of one map.
    pub fn facts(&self, tables: &Tables, recipe: &Recipe, mean: f64) -> Value {
        let tissue = |t: &Tissue| {
            json!({
                "absorption": t.medium.absorption,
                "reducedScattering": t.medium.reduced_scattering(),
                "anisotropy": t.medium.anisotropy,
                "share": t.share,
            })
        };
        json!({
            "wavelengthNm": self.wavelength_nm,
            "index": recipe.index(),
            "tissues": recipe.tissues.iter().map(tissue).collect::<Vec<_>>(),
            "curve": [tables.curve.offset, tables.curve.slope],
            "meanTransmission": mean,
            "spreadMiss": tables.bank.miss,
        })
    }
}
