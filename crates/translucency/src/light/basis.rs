//! The basis of Habel07: three unit vectors at right angles about the normal of the lit side.
//!
//! Coefficients c_i stand for the linear function of the light's direction with the vector v = sum c_i b_i.

use glam::DVec3;

/// Rows b1, b2, b3 in the frame x right, y up, z out of the lit side.
pub const BASIS: [DVec3; 3] = [
    DVec3::new(SQRT_2_3, 0.0, SQRT_1_3),
    DVec3::new(-SQRT_1_6, std::f64::consts::FRAC_1_SQRT_2, SQRT_1_3),
    DVec3::new(-SQRT_1_6, -std::f64::consts::FRAC_1_SQRT_2, SQRT_1_3),
];

const SQRT_2_3: f64 = 0.816_496_580_927_726;
const SQRT_1_3: f64 = 0.577_350_269_189_625_8;
const SQRT_1_6: f64 = 0.408_248_290_463_863;

/// Coefficients of a vector.
pub fn coefficients(vector: DVec3) -> DVec3 {
    DVec3::new(BASIS[0].dot(vector), BASIS[1].dot(vector), BASIS[2].dot(vector))
}

/// Vector of coefficients.
pub fn vector(coefficients: DVec3) -> DVec3 {
    BASIS[0] * coefficients.x + BASIS[1] * coefficients.y + BASIS[2] * coefficients.z
}
