//! The default model: the same eight numbers per leaf, without the paper's losses in dense crowns.
//!
//! Transmittance is interpolated for the sun, where the paper interpolates optical depth: the mean of exp(-D) is not exp of the
//! mean (Jensen). Cosines are integrated over octants. All bounces count, of the sun's light and of the sky's, by the leaf's own
//! chance of recollision.

use super::given::Sides;
use super::{Leaf, Light, Optics, Sky, Slant, Sun, octant_cosines, sh, single_bounce};
use crate::HARMONICS;
use crate::octants::{OCTANTS, SOLID_ANGLE};

/// Light of a leaf from its eight optical depths.
pub fn light(leaf: &Leaf, optics: &Optics, sun: &Sun, sky: &Sky) -> Light {
    let slant = Slant::new(sun.toward);
    let transmittance = slant.mean(&leaf.transmittances);
    lit(leaf, optics, sun, sky, &slant, transmittance)
}

/// The same with the sun's transmittance from nine coefficients (column `sunSh`): sharper shadows inside the crown.
pub fn light_sh(leaf: &Leaf, sun_sh: &[f64; HARMONICS], optics: &Optics, sun: &Sun, sky: &Sky) -> Light {
    lit(leaf, optics, sun, sky, &Slant::new(sun.toward), sh::transmittance(sun_sh, sun.toward))
}

fn lit(leaf: &Leaf, optics: &Optics, sun: &Sun, sky: &Sky, slant: &Slant, transmittance: f64) -> Light {
    let albedo = optics.albedo();
    let all = leaf.all_bounces(albedo);
    let bounced = single_bounce(leaf, slant, optics, transmittance);
    let seen: [f64; OCTANTS] = std::array::from_fn(|j| leaf.transmittances[j] * sky.radiance[j]);
    let sky_direct = Sides::of(leaf.normal, |n| over_octants(&octant_cosines(n), &seen));
    Light {
        sun: Sides::of(leaf.normal, |n| sun.irradiance * transmittance * n.dot(sun.toward).max(0.0)),
        sun_indirect: Sides::of(leaf.normal, |n| {
            sun.irradiance * all / SOLID_ANGLE * over_octants(&octant_cosines(n), &bounced)
        }),
        sky: sky_direct,
        sky_indirect: sky_direct * (albedo * leaf.recollision() * all),
    }
}

fn over_octants(cosines: &[f64; OCTANTS], values: &[f64; OCTANTS]) -> f64 {
    cosines.iter().zip(values).map(|(cosine, value)| cosine * value).sum()
}
