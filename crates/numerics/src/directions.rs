//! Direction sets and low-discrepancy points, the same bits on every machine (crate libm).

use glam::{DVec2, DVec3};

/// Direction `index` of `count` spread evenly over the sphere (Fibonacci lattice with half-step
/// offset, Gonzalez 2010), unit length; Y is the axis.
pub fn fibonacci_sphere(index: usize, count: usize) -> DVec3 {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let y = 1.0 - (2 * index + 1) as f64 / count as f64;
    let radius = (1.0 - y * y).max(0.0).sqrt();
    let angle = GOLDEN_ANGLE * index as f64;
    DVec3::new(radius * libm::cos(angle), y, radius * libm::sin(angle))
}

/// Point `index` of the R2 sequence in the unit square (Roberts 2018).
pub fn r2_point(index: u64) -> DVec2 {
    // Powers of the plastic number's inverse, as fractions of 2^64: integer steps keep the sequence
    // exact however far it runs.
    const STEP_X: u64 = 0xC13F_A9A9_02A6_328F;
    const STEP_Y: u64 = 0x91E1_0DA5_C79E_7B1D;
    const HALF: u64 = 1 << 63;
    let scale = |bits: u64| (bits >> 11) as f64 * (1.0 / (1u64 << 53) as f64);
    DVec2::new(
        scale(HALF.wrapping_add(STEP_X.wrapping_mul(index + 1))),
        scale(HALF.wrapping_add(STEP_Y.wrapping_mul(index + 1))),
    )
}

/// Van der Corput radical inverse of `index` in `base` (2 or above), in [0, 1).
pub fn radical_inverse(mut index: u64, base: u64) -> f64 {
    let (mut inverse, mut digit) = (0.0, 1.0 / base as f64);
    while index > 0 {
        inverse += (index % base) as f64 * digit;
        index /= base;
        digit /= base as f64;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fibonacci_directions_are_unit_and_balanced() {
        let mean = (0..32).map(|i| fibonacci_sphere(i, 32)).sum::<DVec3>() / 32.0;
        assert!((0..32).all(|i| (fibonacci_sphere(i, 32).length() - 1.0).abs() < 1e-15));
        assert!(mean.length() < 0.02, "{mean}");
    }

    #[test]
    fn r2_fills_the_square_evenly() {
        let inside = (0..4096).map(r2_point).filter(|p| p.x < 0.5 && p.y < 0.5).count();
        assert!((1000..1048).contains(&inside), "{inside}");
    }

    #[test]
    fn radical_inverse_mirrors_digits() {
        assert!((radical_inverse(6, 2) - 0.375).abs() < 1e-15);
    }
}
