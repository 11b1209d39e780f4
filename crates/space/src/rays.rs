//! Rays against triangles, over an 8-wide compressed BVH (Ylitie 2017, by crate obvhs).

use glam::{Vec3, Vec3A};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::{Boundable, BvhBuildParams, aabb::Aabb};

/// Largest coordinate inside the BVH lies between half of this and this: its traversal drops boxes
/// that end nearer than an absolute 1e-4, which must stay small beside the plant.
const INNER_REACH: f32 = 64.0;

/// Why triangles cannot be cast at.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RayError {
    /// A corner is NaN or infinite, which the BVH's builder cannot bear.
    #[error("triangle {triangle}: corner {corner} must be finite")]
    Corner {
        /// Index of the triangle.
        triangle: usize,
        /// The corner.
        corner: Vec3,
    },
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the triangle, as it was given.
    pub triangle: u32,
    /// Distance from the origin, in the caller's unit (directions are unit vectors).
    pub distance: f32,
    /// Weight of the second corner.
    pub u: f32,
    /// Weight of the third corner; that of the first is 1 - u - v.
    pub v: f32,
}

/// A ray from `origin` along the unit vector `direction` that ends after `reach`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes, unit length.
    pub direction: Vec3,
    /// How far it goes; `f32::INFINITY` for ever.
    pub reach: f32,
}

/// Triangles to cast rays at. Both sides of a triangle are hit; triangles of no area never are.
#[derive(Debug, Default)]
pub struct Rays {
    bvh: CwBvh,
    /// In the order of the BVH's leaves, so that a traversal reads them one after the other.
    triangles: Vec<Indexed>,
    /// From the caller's unit to the BVH's: a power of two, so that no digit changes.
    scale: f32,
}

#[derive(Clone, Copy)]
struct Indexed {
    shape: RtTriangle,
    index: u32,
}

impl std::fmt::Debug for Indexed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "triangle {} at {}", self.index, self.shape.v0)
    }
}

impl Boundable for Indexed {
    fn aabb(&self) -> Aabb {
        self.shape.aabb()
    }
}

impl Rays {
    /// Builds the BVH. Corners in any unit, relative to a center near them (f32 is what there is).
    ///
    /// # Errors
    /// [`RayError::Corner`] names the first triangle that is not finite.
    pub fn new(triangles: &[[Vec3; 3]]) -> Result<Rays, RayError> {
        let mut reach = 0f32;
        for (triangle, corners) in triangles.iter().enumerate() {
            for &corner in corners {
                if !corner.is_finite() {
                    return Err(RayError::Corner { triangle, corner });
                }
                reach = reach.max(corner.abs().max_element());
            }
        }
        let scale = power_of_two_below(INNER_REACH, reach);
        let shapes: Vec<Indexed> = (0u32..)
            .zip(triangles)
            .map(|(index, corners)| {
                let [a, b, c] = corners.map(|corner| Vec3A::from(corner * scale));
                Indexed { shape: RtTriangle::new(a, b, c), index }
            })
            .filter(|triangle| triangle.shape.ng != Vec3A::ZERO)
            .collect();
        if shapes.is_empty() {
            return Ok(Rays { scale, ..Rays::default() });
        }
        let bvh = build_cwbvh(&shapes, BvhBuildParams::medium_build(), &mut std::time::Duration::default());
        let triangles = bvh.primitive_indices.iter().map(|&i| shapes[i as usize]).collect();
        Ok(Rays { bvh, triangles, scale })
    }

    /// The nearest hit that `accept` takes: an alpha test, or "not myself".
    pub fn nearest(&self, beam: &Beam, mut accept: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        let mut best = None;
        self.bvh.ray_traverse(self.inner(beam), &mut RayHit::none(), |ray, slot| {
            let hit = self.meet(ray, slot).filter(|(t, hit)| *t < ray.tmax && accept(hit));
            best = hit.map(|(_, hit)| hit).or(best);
            hit.map_or(f32::INFINITY, |(t, _)| t)
        });
        best
    }

    /// Whether anything that `accept` takes lies along the beam.
    pub fn blocked(&self, beam: &Beam, mut accept: impl FnMut(&Hit) -> bool) -> bool {
        !self.bvh.ray_traverse_miss(self.inner(beam), |ray, slot| {
            let hit = self.meet(ray, slot).filter(|(t, hit)| *t < ray.tmax && accept(hit));
            hit.map_or(f32::INFINITY, |(t, _)| t)
        })
    }

    /// Calls `visit` for every hit along the beam, in no particular order that means anything (but
    /// the same one every time).
    pub fn each(&self, beam: &Beam, mut visit: impl FnMut(&Hit)) {
        self.bvh.ray_traverse_anyhit(self.inner(beam), |ray, slot| {
            if let Some((_, hit)) = self.meet(ray, slot) {
                visit(&hit);
            }
        });
    }

    fn inner(&self, beam: &Beam) -> Ray {
        let reach = beam.reach * self.scale;
        Ray::new((beam.origin * self.scale).into(), beam.direction.into(), 0.0, reach)
    }

    /// Moeller and Trumbore's test (1997), with the distance in the BVH's unit beside the hit.
    #[inline(always)]
    fn meet(&self, ray: &Ray, slot: usize) -> Option<(f32, Hit)> {
        let Indexed { shape, index } = &self.triangles[slot];
        let to_corner = shape.v0 - ray.origin;
        let across = ray.direction.cross(to_corner);
        let inverse = 1.0 / shape.ng.dot(ray.direction);
        let u = across.dot(shape.e2) * inverse;
        let v = across.dot(shape.e1) * inverse;
        let t = shape.ng.dot(to_corner) * inverse;
        // A ray inside the triangle's plane gives NaN or infinity, which fail one comparison.
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= ray.tmax;
        inside.then(|| (t, Hit { triangle: *index, distance: t / self.scale, u, v }))
    }
}

/// The power of two that brings `reach` into (`limit` / 2, `limit`]; 1 for no reach, and never so
/// large that f32 could not hold a product with it.
fn power_of_two_below(limit: f32, reach: f32) -> f32 {
    const LARGEST_POWER: f32 = 100.0;
    let power = libm::floorf(libm::log2f(limit / reach));
    if reach > 0.0 { libm::exp2f(power.min(LARGEST_POWER)) } else { 1.0 }
}
