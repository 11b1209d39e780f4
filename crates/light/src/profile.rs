//! What one leaf takes from an octant: its solid angle, its share of the bin, its occlusion (Boulanger08 section 6.1).

use crate::octants::SOLID_ANGLE;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Most that one leaf takes from an octant. The paper allows all of it, which no optical depth can say.
pub const MOST_OCCLUSION: f64 = 1.0 - 1.0 / 256.0;
/// Largest optical depth in transmittances and files: beyond it nothing is seen.
pub const MOST_DEPTH: f64 = 16.0;

/// What the rounding of corners may move a center, in units of the crown.
const ROUNDING: f64 = 1e-6;

/// How leaves are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// A leaf is a sphere cap, and lies in several octants where it crosses their borders.
    #[default]
    Cap,
    /// As the paper has it: half the leaf's area over the squared distance, all in the octant of its center.
    Paper,
}

impl Profile {
    /// Solid angle of a leaf of area `area` at distance vector `toward`, steradians; infinite for `Paper` at no distance.
    ///
    /// Half the area counts: the mean over orientations.
    pub fn solid_angle(self, area: f64, toward: DVec3) -> f64 {
        let square = toward.length_squared();
        match self {
            _ if area <= 0.0 => 0.0,
            Profile::Paper => area / (2.0 * square),
            Profile::Cap if square > 0.0 => {
                let q = area / (2.0 * PI * square);
                let root = (1.0 + q).sqrt();
                // Far beyond a leaf's own size both roots overflow no sooner than q itself; the limit is half a sphere.
                if q.is_finite() { 2.0 * PI * (q / root) / (root + 1.0) } else { 2.0 * PI }
            }
            Profile::Cap => 2.0 * PI,
        }
    }

    /// Half the width of the slab that a leaf fills about its center along each axis. A uniform slab of this half-width
    /// has the standard deviation of a disc that is turned at random. Where octants are hard it is what corners in f32
    /// may be off: leaves that were modeled on one plane are on it, whatever their corners were rounded to.
    pub fn half_width(self, area: f64) -> f64 {
        match self {
            Profile::Paper => ROUNDING,
            Profile::Cap => ROUNDING.max(0.5 * 3f64.sqrt() * (area / PI).sqrt()),
        }
    }
}

/// Share of a leaf that lies on the positive side of a plane, its center `offset` beyond it: a leaf on the plane counts
/// half on either side, so that mirrored trees bake alike.
pub fn positive_share(offset: f64, half_width: f64) -> f64 {
    (0.5 + offset / (2.0 * half_width)).clamp(0.0, 1.0)
}

/// Share of a leaf in each octant; they add up to 1.
pub fn shares(toward: DVec3, half_width: f64) -> [f64; 8] {
    let [x, y, z] = toward.to_array().map(|offset| positive_share(offset, half_width));
    std::array::from_fn(|j| {
        let side = |bit: usize, share: f64| if j & bit == 0 { 1.0 - share } else { share };
        side(1, x) * side(2, z) * side(4, y)
    })
}

/// Optical depth that a leaf of this solid angle and share adds to its octant.
pub fn depth(solid_angle: f64, share: f64) -> f64 {
    let occlusion = if share > 0.0 { (share * solid_angle / SOLID_ANGLE).min(MOST_OCCLUSION) } else { 0.0 };
    -libm::log1p(-occlusion)
}
