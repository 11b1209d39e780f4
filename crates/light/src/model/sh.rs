//! A leaf's transmittance over all directions in nine numbers: real spherical harmonics of order 2 (Ramamoorthi 2001).

use crate::{HARMONICS, harmonics};
use glam::DVec3;

/// Transmittance toward a unit vector, cut to [0, 1]: nine functions overshoot near a gap.
pub fn transmittance(coefficients: &[f64; HARMONICS], toward: DVec3) -> f64 {
    harmonics(toward).iter().zip(coefficients).map(|(b, c)| b * c).sum::<f64>().clamp(0.0, 1.0)
}
