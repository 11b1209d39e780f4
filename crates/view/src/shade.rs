//! Light: a sun with a small disc, one even sky, and leaves that let some of the sun through.

use crate::scene::Surface;
use glam::Vec3;

/// Light of the sun on a surface that faces it, over pi: a white Lambert surface returns so much.
pub(crate) const SUN: Vec3 = Vec3::new(2.0, 1.9, 1.72);
/// Light of the open sky, over pi, the same on every surface: the ambient coefficient scales it.
pub(crate) const SKY: Vec3 = Vec3::new(0.82, 0.9, 1.0);
/// Share of the sun's light on a leaf's far side that comes out on the near one, beside what the near
/// side reflects of its own: thin leaves pass about as much as they reflect, seen whole somewhat less.
const PASSES: f32 = 0.5;
/// Half the angle of the sun's disc as tangent: 0.5 degrees, twice the real sun's, softens shadows a touch.
pub(crate) const SUN_RADIUS: f32 = 0.0087;
/// Share of the background that the ground's shadow takes away.
pub(crate) const GROUND_SHADOW: f32 = 0.55;

/// Share of the sun's light that a surface returns, shadows left out.
pub(crate) fn sunlit(surface: &Surface, sun: Vec3) -> f32 {
    let cosine = surface.normal.dot(sun);
    if cosine >= 0.0 {
        cosine
    } else if surface.leaf {
        -cosine * PASSES
    } else {
        0.0
    }
}

/// Light that leaves a surface: `sun` is its share of sunlight, shadow included.
pub(crate) fn light(surface: &Surface, sun: f32) -> Vec3 {
    surface.color * (SUN * sun + SKY * surface.ambient)
}

/// Least cosine between a triangle and the normals at its corners for which they are taken for those of a curved body: leaves
/// whose normals say how a crown stands lean farther.
const ROUND: f32 = 0.7;

/// A place on a triangle, moved off it toward `side` (its unit normal there) to the surface that the normals at its corners
/// promise (Hanika 2021, Ray Tracing Gems II, chapter 4). `None` where they promise none.
pub(crate) fn rounded(
    place: Vec3,
    (corners, normals): ([Vec3; 3], [Vec3; 3]),
    weights: [f32; 3],
    side: Vec3,
) -> Option<Vec3> {
    let toward = if normals[0].dot(side) < 0.0 { -1.0 } else { 1.0 };
    if normals.iter().any(|normal| toward * normal.dot(side) < ROUND) {
        return None;
    }
    Some((0..3).fold(place, |moved, i| {
        let normal = toward * normals[i];
        moved - weights[i] * (place - corners[i]).dot(normal).min(0.0) * normal
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a coarse sphere the place comes nearer to the sphere and never into the triangle; a flat leaf stays where it is.
    #[test]
    fn places_move_to_the_body_that_the_normals_promise() {
        let corners = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| (axis * 0.5 + Vec3::ONE).normalize());
        let side = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let weights = [0.3, 0.3, 0.4];
        let place: Vec3 = (0..3).map(|i| corners[i] * weights[i]).sum();
        let moved = rounded(place, (corners, corners), weights, side).unwrap();
        let depth = |p: Vec3| (1.0 - p.length()).abs();
        assert!((moved - place).dot(side) > 0.0 && depth(moved) < depth(place), "{place} {moved}");
        // Seen from inside, the body lies on the other side: the hollow is never filled.
        let inside = rounded(place, (corners, corners), weights, -side).unwrap();
        assert!((inside - place).dot(-side) >= -1e-6, "{inside}");
        assert!(rounded(place, (corners, [side; 3]), weights, side).unwrap().distance(place) < 1e-6);
        let leaning = [Vec3::X; 3];
        assert_eq!(rounded(place, (corners, leaning), weights, side), None);
        assert_eq!(rounded(place, (corners, [Vec3::ZERO; 3]), weights, side), None);
    }
}
