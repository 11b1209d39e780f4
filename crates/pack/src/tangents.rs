//! Tangents of a normal that was replaced.

use glam::DVec3;

/// Below this sine the old tangent is along the new normal: the old bitangent then says where it goes.
const LEAST_SINE: f64 = 1e-3;

/// The tangent (glTF: xyz and the sign of the bitangent) that goes with `new`: the old one made
/// orthogonal to it. Where the new normal looks to the other side of the surface, the sign turns, so that
/// tangent and bitangent still follow the texture.
pub(crate) fn realigned(old: &[f32], own_normal: DVec3, new: DVec3) -> [f32; 4] {
    let tangent = DVec3::new(f64::from(old[0]), f64::from(old[1]), f64::from(old[2]));
    let bitangent = own_normal.cross(tangent) * f64::from(old[3]);
    let across = |v: DVec3| v - new * v.dot(new);
    let made = across(tangent);
    let made = if made.length() > LEAST_SINE * tangent.length() {
        made.normalize()
    } else {
        // Right-handed with the old bitangent, or anywhere where even that is of no use.
        across(bitangent).cross(new).normalize_or(new.any_orthonormal_vector())
    };
    let sign = if new.cross(made).dot(bitangent) < 0.0 { -1.0 } else { 1.0 };
    let made = made.as_vec3();
    [made.x, made.y, made.z, sign]
}
