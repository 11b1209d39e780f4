//! What a renderer does with a map at run time (Kusternig07 section 3.5): three dot products, weighted and summed.
//!
//! In f64, for tests and for pictures; the includes in `shaders/` do the same.

use crate::light::{Curve, coefficients};
use glam::DVec3;

/// Light in the frame of a map: x image right, y image up, z out of the lit side, which is the one that is not seen.
///
/// `light` points toward the light; `tangent` and `bitangent` go along the image on the leaf (right, up), whichever side
/// is seen; `seen_normal` points out of the side that shows the map. The frame is left-handed on one of the sides:
/// only dot products are taken in it. Unit vectors.
pub fn lit_direction(light: DVec3, tangent: DVec3, bitangent: DVec3, seen_normal: DVec3) -> DVec3 {
    DVec3::new(light.dot(tangent), light.dot(bitangent), -light.dot(seen_normal))
}

/// Coefficients of a stored texel: texel x scale + bias, channel by channel.
pub fn decoded(texel: DVec3, scale: DVec3, bias: DVec3) -> DVec3 {
    texel * scale + bias
}

/// The three dot products, which every texel and every band shares; zero for light on the side that is seen.
pub fn weights(light: DVec3) -> DVec3 {
    if light.z > 0.0 { coefficients(light) } else { DVec3::ZERO }
}

/// Light that comes through, over the irradiance of a plane that faces the light: max(0, sum of c_i (b_i . l)), bent
/// by the curve. Radiance is this times irradiance / pi, from every direction alike.
pub fn transmitted(coefficients: DVec3, light: DVec3, curve: Curve) -> f64 {
    coefficients.dot(weights(light)).max(0.0) * curve.at(light.z).max(0.0)
}

/// The same under even light from the whole hemisphere behind the leaf, over its irradiance: v_z (a0 + 2 a1 / 3).
pub fn transmitted_diffuse(coefficients: DVec3, curve: Curve) -> f64 {
    let axis = crate::light::vector(coefficients).z;
    (axis * (curve.offset + 2.0 * curve.slope / 3.0)).max(0.0)
}
