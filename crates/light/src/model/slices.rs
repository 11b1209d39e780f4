//! Light of the sun by way of one other leaf: the crown cut into slices along each octant (Boulanger08 section 5).

use super::{Leaf, Optics};
use crate::octants::{OCTANTS, direction};
use glam::DVec3;
use std::f64::consts::PI;

/// What the eight octants are to a direction of the sun; one per sun and frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slant {
    /// Share of each octant in what is interpolated for the sun: cosines to the octants' middles, together 1
    /// (Boulanger08 eq. 7). The sum of the cosines lies between 1.63 and 2.31 for any sun.
    pub weights: [f64; OCTANTS],
    /// Sum of the cosines.
    pub sum: f64,
    /// Angle between sun and each middle, radians.
    angles: [f64; OCTANTS],
    /// How fast the way to the sun changes as the slice moves away along each octant: 1 - c of eq. 24, in [1/3, 5/3].
    pub fading: [f64; OCTANTS],
}

impl Slant {
    /// For a unit vector to the sun.
    pub fn new(toward: DVec3) -> Slant {
        let middles: [DVec3; OCTANTS] = std::array::from_fn(direction);
        let cosines = middles.map(|middle| toward.dot(middle));
        let sum: f64 = cosines.iter().map(|c| c.max(0.0)).sum();
        let weights = cosines.map(|c| c.max(0.0) / sum);
        let mean: DVec3 = weights.iter().zip(&middles).map(|(w, m)| *m * *w).sum();
        Slant {
            weights,
            sum,
            // A cosine may pass 1 by a rounding.
            angles: cosines.map(|c| libm::acos(c.clamp(-1.0, 1.0))),
            fading: middles.map(|middle| 1.0 - middle.dot(mean)),
        }
    }

    /// Mean of eight values as the sun sees them (Boulanger08 eq. 7).
    pub fn mean(&self, values: &[f64; OCTANTS]) -> f64 {
        self.weights.iter().zip(values).map(|(w, v)| w * v).sum()
    }

    /// Share of the sun's light that leaves of an octant, half their area in the way, turn to this place: G1 of eq. 18 over
    /// half the leaf density. Leaves between here and the sun shine through, leaves behind reflect. Summed
    /// over octants it is about the leaves' albedo.
    pub fn phase(&self, optics: &Optics, octant: usize) -> f64 {
        let angle = self.angles[octant];
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let scattered = (optics.reflected() + optics.passed()) * (sine - angle * cosine);
        (scattered + PI * optics.passed() * cosine) * 4.0 / (3.0 * PI * OCTANTS as f64)
    }
}

/// Mean radiance times solid angle, over pi/2, that reaches a place from each octant by one bounce of a sun of irradiance 1: the
/// integral over slices in closed form (eq. 23 to 25), `transmittance` of it left on the way from the sun to here.
///
/// Written in optical depths: tau and the leaf density of the paper cancel where density = 2 tau / area. It cannot grow
/// without bound: every exponent is 0 or below.
pub fn single_bounce(leaf: &Leaf, slant: &Slant, optics: &Optics, transmittance: f64) -> [f64; OCTANTS] {
    std::array::from_fn(|octant| {
        let depth = leaf.depths[octant];
        slant.phase(optics, octant) * transmittance * depth * mean_decay(slant.fading[octant] * depth)
    })
}

/// Mean of exp(-t) for t from 0 to `x`, 0 or above: (1 - exp(-x)) / x, whose limit at 0 is 1.
fn mean_decay(x: f64) -> f64 {
    if x > 0.0 { -libm::expm1(-x) / x } else { 1.0 }
}
