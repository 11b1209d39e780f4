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
