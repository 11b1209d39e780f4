//! The eight directions of the model and their order (Boulanger08 eq. 26).

use glam::DVec3;

/// How many directions there are.
pub const OCTANTS: usize = 8;

/// Solid angle of an octant, steradians.
pub const SOLID_ANGLE: f64 = std::f64::consts::FRAC_PI_2;

/// Octant of a direction by its signs: `x > 0` is bit 0, `z > 0` bit 1, `y > 0` bit 2. So 0 to 3 look at the ground, 4 to 7
/// at the sky, and `7 - j` is opposite to `j`.
///
/// The middle of octant `j`, unit, Y up (Boulanger08 eq. 26).
pub fn direction(j: usize) -> DVec3 {
    let sign = |bit: usize| if j & bit == 0 { -1.0 } else { 1.0 };
    DVec3::new(sign(1), sign(4), sign(2)) / 3f64.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_octants_look_opposite_ways() {
        for j in 0..OCTANTS {
            assert_eq!(direction(j), -direction(7 - j));
            assert_eq!(direction(j).y > 0.0, j >= 4);
        }
    }
}
