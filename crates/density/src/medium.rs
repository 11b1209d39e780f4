//! The foliage as a medium that absorbs light (Beer-Lambert): what `sky` is, apart from how fast.
//!
//! Leaves of area A turned at random absorb A / 2 per volume. Spread over the ball of Luft07 eq. 2, whose
//! integral is 32 pi / 105 radii cubed, a leaf's extinction is A / 2 times that ball over that integral.

use crate::directions::DIRECTIONS;
use foliar_numerics::exp_of_negatives;
use glam::DVec3;

/// Integral of (1 - r^2)^2 over the unit ball.
pub const BALL_INTEGRAL: f64 = 32.0 * std::f64::consts::PI / 105.0;
/// Mean projected area of a flat leaf over its area, all orientations equally likely (Cauchy).
const PROJECTION: f64 = 0.5;
/// Shorter means of directions (of length 1) are no direction: an open place, or one in the middle.
const VANISHING: f64 = 1e-3;

/// Optical depth that a ball of weight 1 adds per radius of path where its own value is 1.
pub fn extinction(mean_area: f64, radius: f64) -> f64 {
    PROJECTION * mean_area / (BALL_INTEGRAL * radius * radius)
}

/// Integrals of (1 - r^2)^2 along the rays from `from` toward the unit vector `toward` and away from it, for
/// a ball of radius 1 about the origin: a polynomial of degree 5 between entry and exit.
pub fn chords(from: DVec3, toward: DVec3) -> [f64; 2] {
    let along = from.dot(toward);
    let inside = 1.0 - (from.length_squared() - along * along);
    if inside <= 0.0 {
        return [0.0; 2];
    }
    let half = inside.sqrt();
    let primitive = |t: f64| t * (inside * inside + t * t * (t * t / 5.0 - inside * (2.0 / 3.0)));
    let (whole, part) = (primitive(half), primitive(along.clamp(-half, half)));
    [whole - part, whole + part]
}

/// The first of [`chords`].
pub fn chord(from: DVec3, toward: DVec3) -> f64 {
    chords(from, toward)[0]
}

/// What a place sees of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkySample {
    /// Where the light comes from: mean of the directions, each weighted by its transmittance; unit.
    pub direction: DVec3,
    /// Transmittance, averaged over the sphere: 0 to 1.
    pub transmittance: f64,
}

/// The sky seen through optical depths, one for each of [`crate::sky_directions`]. Where no direction is better
/// than the rest: `outward`, and where that is nothing, up.
pub fn see(depths: &[f64; DIRECTIONS], directions: &[DVec3; DIRECTIONS], outward: DVec3) -> SkySample {
    let least = depths.iter().copied().fold(f64::INFINITY, f64::min);
    let (mut sum, mut mean) = (0.0, DVec3::ZERO);
    // Relative to the clearest direction nothing underflows, however deep inside.
    let mut weights = depths.map(|depth| least - depth);
    exp_of_negatives(&mut weights);
    for (weight, direction) in weights.into_iter().zip(directions) {
        sum += weight;
        mean += *direction * weight;
    }
    let mean = mean / sum;
    let direction =
        if mean.length() > VANISHING { mean.normalize() } else { outward.try_normalize().unwrap_or(DVec3::Y) };
    let transmittance = (libm::exp(-least) * sum / DIRECTIONS as f64).clamp(0.0, 1.0);
    SkySample { direction, transmittance }
}
