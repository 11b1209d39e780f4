//! A leaf by rule, at any resolution: blade, midrib, side veins, a net of small ones, thin rim, relief on both sides.
//!
//! For tests, benchmarks and pictures: nobody's photograph, so nobody's license.

use super::LeafMap;
use super::normals_from_heights;

/// Width of the leaf's picture, mm.
pub const WIDTH_MM: f64 = 80.0;
/// Share of the relief that stands out on the front; the rest stands out on the back.
const FRONT_SHARE: f64 = 0.3;

/// Both sides of a leaf: the front as lit, and the back as lit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafByRule {
    /// The front is lit.
    pub front: LeafMap,
    /// The back is lit, its maps on the front's texture coordinates.
    pub back: LeafMap,
    /// Edge of a texel, mm.
    pub texel_mm: f64,
}

/// A leaf on `size` x `size` texels.
pub fn leaf_by_rule(size: usize) -> LeafByRule {
    let texel_mm = WIDTH_MM / size as f64;
    let place = |at: usize| {
        let across = ((at % size) as f64 + 0.5) / size as f64 * 2.0 - 1.0;
        (across, 1.0 - ((at / size) as f64 + 0.5) / size as f64)
    };
    let thickness_mm: Vec<f32> = (0..size * size).map(|at| thickness(place(at)) as f32).collect();
    let relief = |share: f64| thickness_mm.iter().map(|d| d * share as f32).collect::<Vec<f32>>();
    let side = |share| LeafMap {
        width: size,
        height: size,
        thickness_mm: thickness_mm.clone(),
        normals: normals_from_heights(&relief(share), size, [texel_mm; 2]),
    };
    LeafByRule { front: side(FRONT_SHARE), back: side(1.0 - FRONT_SHARE), texel_mm }
}

/// A hill of height 1.
fn hill(distance: f64, width: f64) -> f64 {
    libm::exp(-distance * distance / (width * width))
}

/// Thickness, mm, at a place: from -1 to 1 across, from stalk 0 to tip 1 along.
fn thickness((across, along): (f64, f64)) -> f64 {
    let (stalk, tip) = (0.04, 0.96);
    let share = (along - stalk) / (tip - stalk);
    if !(0.0..=1.0).contains(&share) {
        return 0.0;
    }
    // Widest below the middle; small teeth on the rim.
    let outline = 0.62 * libm::sin(std::f64::consts::PI * libm::pow(share, 0.8)) + 0.006 * libm::sin(share * 160.0);
    let inside = outline - across.abs();
    if inside <= 0.0 {
        return 0.0;
    }
    let rim = 1.0 - libm::exp(-inside / 0.02);
    let midrib = hill(across, 0.012 + 0.02 * (1.0 - share));
    // Side veins leave the midrib at an angle and bend toward the tip.
    let rise = along - 0.45 * across.abs() - 0.25 * across * across;
    let from_vein = (rise * 13.0).rem_euclid(1.0) - 0.5;
    let side = hill(from_vein, 0.08) * (1.0 - across.abs() / 0.8).max(0.0);
    let net = (libm::sin(across * 140.0 + 9.0 * rise) * libm::sin(rise * 150.0)).abs();
    (0.11 + 0.06 * rim + 0.05 * (0.3 - net).max(0.0) + 0.09 * side + 0.2 * midrib) * (0.5 + 0.5 * rim)
}
