//! The paper's run-time model as it stands there: profile `boulanger08` (Boulanger08 eq. 6 to 8, 11, 23 to 25).

use super::given::{Sides, light_amount};
use super::{Leaf, Light, ModelError, Optics, Sky, Slant, Sun, single_bounce};
use crate::octants::{OCTANTS, direction};
use glam::DVec3;
use std::f64::consts::PI;

/// What the paper's model knows of the whole tree. In eight depths per leaf there is no more than one number: how many
/// leaves it takes the crown to be made of, over how many it would take to be as dark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    crowding: f64,
}

impl Tree {
    /// As dark as its leaves make it: leaf density 2 tau / area.
    pub const CONSISTENT: Tree = Tree { crowding: 1.0 };

    /// The paper's own numbers: the mean attenuation `tau` per meter (eq. 26 to 30), leaves per cubic meter, and the
    /// mean area of a leaf in square meters. Where leaves stand in clumps the two disagree, and indirect light is off
    /// by a factor.
    ///
    /// # Errors
    /// [`ModelError::Number`] for one that is negative or not finite.
    pub fn new(tau: f64, density: f64, area: f64) -> Result<Tree, ModelError> {
        let tau = light_amount("tau", tau)?;
        let leaves = light_amount("leaf density", density)? * light_amount("mean leaf area", area)?;
        // Nothing attenuates: there are no depths either, and no light that bounces.
        Ok(Tree {
            crowding: if tau > 0.0 { light_amount("leaf density x area / tau", leaves / (2.0 * tau))? } else { 0.0 },
        })
    }
}

/// Light of a leaf by the paper's model: optical depth is interpolated for the sun, cosines stand at the octants' middles,
/// the sun's light bounces once, the sky's never.
pub fn boulanger08(leaf: &Leaf, optics: &Optics, tree: &Tree, sun: &Sun, sky: &Sky) -> Light {
    let transmittance = libm::exp(-Slant::new(sun.toward).mean(&leaf.depths));
    boulanger08_by(leaf, optics, tree, sun, sky, transmittance)
}

/// The same with a transmittance toward the sun that is known better: how much of the paper's error is eq. 7's.
pub fn boulanger08_by(leaf: &Leaf, optics: &Optics, tree: &Tree, sun: &Sun, sky: &Sky, transmittance: f64) -> Light {
    let slant = Slant::new(sun.toward);
    let bounced = single_bounce(leaf, &slant, optics, transmittance);
    let indirect = sun.irradiance * tree.crowding;
    Light {
        sun: Sides::of(leaf.normal, |n| sun.irradiance * transmittance * n.dot(sun.toward).max(0.0)),
        sun_indirect: Sides::of(leaf.normal, |n| indirect * over_octants(n, &bounced)),
        sky: cosine_sky(leaf, sky),
        sky_indirect: Sides::default(),
    }
}

/// Light of the sky with the cosine at each octant's middle (eq. 6).
fn cosine_sky(leaf: &Leaf, sky: &Sky) -> Sides {
    let seen: [f64; OCTANTS] = std::array::from_fn(|j| leaf.transmittances[j] * sky.radiance[j]);
    Sides::of(leaf.normal, |n| PI / 2.0 * over_octants(n, &seen))
}

/// Sum of values times the cosine at the middle of their octant.
fn over_octants(normal: DVec3, values: &[f64; OCTANTS]) -> f64 {
    values.iter().enumerate().map(|(octant, value)| normal.dot(direction(octant)).max(0.0) * value).sum()
}
