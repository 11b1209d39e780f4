//! Rays against triangles, over an 8-wide compressed BVH (Ylitie 2017, by crate obvhs).

use glam::{Vec3, Vec3A};
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::{CwBvh, bvh2_to_cwbvh::bvh2_to_cwbvh};
use obvhs::ploc::PlocBuilder;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::{Boundable, BvhBuildParams, aabb::Aabb};

/// Largest coordinate inside the BVH lies between half of this and this: its traversal drops boxes
/// that end nearer than an absolute 1e-4, which must stay small beside the plant.
const INNER_REACH: f32 = 64.0;

/// Widest hair by which a box is larger than its triangle, in the BVH's unit: a millionth of the scene.
const HAIR: f32 = INNER_REACH * 1e-6;

/// Levels that a traversal of obvhs keeps track of: what lies deeper would be lost without a word.
const DEEPEST: usize = 31;

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
    /// The triangles lie inside each other in more sizes than a traversal can follow.
    #[error("triangles nest {levels} levels deep, at most {DEEPEST} can be cast at: remove the ones too small to see")]
    Nested {
        /// Levels of the BVH.
        levels: usize,
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
    /// Where the triangle stands in the BVH.
    slot: u32,
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
    /// Wider than the triangle by a hair that differs from triangle to triangle: the builder joins
    /// thousands of coincident boxes, whose costs all tie, into one chain.
    fn aabb(&self) -> Aabb {
        let hair = |side: u32| {
            Vec3A::from_array(std::array::from_fn(|axis| hair(self.index.wrapping_mul(8) + side + axis as u32)))
        };
        let exact = self.shape.aabb();
        Aabb::new(exact.min - hair(0), exact.max + hair(4))
    }
}

/// A length in [0, [`HAIR`]), without pattern from index to index (the mixing of MurmurHash3).
fn hair(index: u32) -> f32 {
    let mixed = (index ^ (index >> 16)).wrapping_mul(0x85eb_ca6b);
    let mixed = (mixed ^ (mixed >> 13)).wrapping_mul(0xc2b2_ae35);
    ((mixed ^ (mixed >> 16)) >> 8) as f32 * (HAIR / (1 << 24) as f32)
}

impl Rays {
    /// Builds the BVH. Corners in any unit, relative to a center near them (f32 is what there is).
    ///
    /// # Errors
    /// [`RayError::Corner`] names the first triangle that is not finite; [`RayError::Nested`] where
    /// triangles hide inside each other by the thousand.
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
        let bvh = build(&shapes)?;
        let triangles = bvh.primitive_indices.iter().map(|&i| shapes[i as usize]).collect();
        Ok(Rays { bvh, triangles, scale })
    }

    /// The nearest hit that `accept` takes: an alpha test, or "not myself". The triangle of `last`, the
    /// hit of a ray nearby, is tried first: where rays are coherent most of them meet the same one, and
    /// the rest of the search is short.
    pub fn nearest(&self, beam: &Beam, last: Option<&Hit>, mut accept: impl FnMut(&Hit) -> bool) -> Option<Hit> {
        let mut inner = self.inner(beam);
        let first = last.and_then(|last| self.meet(&inner, last.slot as usize));
        let first = first.filter(|(_, hit)| accept(hit));
        inner.tmax = first.map_or(inner.tmax, |(t, _)| t);
        let mut best = first.map(|(_, hit)| hit);
        self.bvh.ray_traverse(inner, &mut RayHit::none(), |ray, slot| {
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
        // A component of -0 is positive to one half of the traversal and negative to the other, and all is missed.
        Ray::new((beam.origin * self.scale).into(), (beam.direction + Vec3::ZERO).into(), 0.0, reach)
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
        inside.then(|| (t, Hit { triangle: *index, distance: t / self.scale, u, v, slot: slot as u32 }))
    }
}

/// obvhs' medium preset, without the self-check that its own helper adds to debug builds.
fn build(shapes: &[Indexed]) -> Result<CwBvh, RayError> {
    let preset = BvhBuildParams::medium_build();
    let mut binary = PlocBuilder::with_capacity(shapes.len()).build(
        preset.ploc_search_distance,
        shapes,
        (0..shapes.len() as u32).collect(),
        preset.sort_precision,
        preset.search_depth_threshold,
    );
    ReinsertionOptimizer::default().run(&mut binary, preset.reinsertion_batch_ratio, None);
    const MOST_PER_LEAF: u32 = 3;
    let bvh = bvh2_to_cwbvh(&binary, MOST_PER_LEAF, true, false);
    let levels = levels(&bvh);
    if levels > DEEPEST { Err(RayError::Nested { levels }) } else { Ok(bvh) }
}

/// Levels of inner nodes.
fn levels(bvh: &CwBvh) -> usize {
    let children = |&node: &u32| {
        let node = &bvh.nodes[node as usize];
        node.child_base_idx..node.child_base_idx + node.imask.count_ones()
    };
    let below = |level: &Vec<u32>| Some(level.iter().flat_map(children).collect()).filter(|l: &Vec<u32>| !l.is_empty());
    std::iter::successors(Some(vec![0]), below).count()
}

/// The power of two that brings `reach` into (`limit` / 2, `limit`]; 1 for no reach, and never so
/// large that f32 could not hold a product with it.
fn power_of_two_below(limit: f32, reach: f32) -> f32 {
    const LARGEST_POWER: f32 = 100.0;
    let power = libm::floorf(libm::log2f(limit / reach));
    if reach > 0.0 { libm::exp2f(power.min(LARGEST_POWER)) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::{fibonacci_sphere, radical_inverse};

    /// Small triangles scattered through the cube of +-1, by low-discrepancy points.
    fn soup(count: u64) -> Vec<[Vec3; 3]> {
        let coordinate = |i, base| radical_inverse(i, base) as f32 * 2.0 - 1.0;
        let point = |i, bases: [u64; 3]| Vec3::from_array(bases.map(|base| coordinate(i, base)));
        let triangle = |i| {
            let center = point(i, [2, 3, 5]);
            [[7, 11, 13], [17, 19, 23], [29, 31, 37]].map(|bases| center + 0.2 * point(i, bases))
        };
        (1..=count).map(triangle).collect()
    }

    fn beams() -> impl Iterator<Item = Beam> {
        (0..500).map(|i| {
            let outward = fibonacci_sphere(i, 500).as_vec3();
            let target = fibonacci_sphere((i * 7) % 500, 500).as_vec3() * 0.7;
            let origin = outward * 3.0;
            Beam { origin, direction: (target - origin).normalize(), reach: f32::INFINITY }
        })
    }

    /// Cramer's rule in f64: distance of the hit, and how far inside the triangle it is.
    fn exact(beam: &Beam, corners: &[Vec3; 3]) -> Option<(f64, f64)> {
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let (o, d) = (beam.origin.as_dvec3(), beam.direction.as_dvec3());
        let system = glam::DMat3::from_cols(b - a, c - a, -d);
        let solution = system.inverse() * (o - a);
        let inside = solution.x.min(solution.y).min(1.0 - solution.x - solution.y);
        (inside >= 0.0 && solution.z >= 0.0).then_some((solution.z, inside))
    }

    #[test]
    fn the_nearest_hit_is_that_of_trying_every_triangle() {
        let soup = soup(400);
        let rays = Rays::new(&soup).unwrap();
        let mut found = 0;
        for beam in beams() {
            let all = soup.iter().enumerate().filter_map(|(i, t)| exact(&beam, t).map(|(d, inside)| (i, d, inside)));
            let best = all.min_by(|a, b| a.1.total_cmp(&b.1));
            let hit = rays.nearest(&beam, None, |_| true);
            // Within 1e-5 of an edge f32 may decide either way.
            match (best, hit) {
                (Some((_, _, inside)), _) if inside < 1e-5 => {}
                (Some((index, distance, _)), Some(hit)) => {
                    found += 1;
                    assert_eq!(hit.triangle as usize, index);
                    assert!((f64::from(hit.distance) - distance).abs() < 1e-5 * distance, "{hit:?} {distance}");
                    let [a, b, c] = soup[index];
                    let by_weights = a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v;
                    let by_distance = beam.origin + beam.direction * hit.distance;
                    assert!(by_weights.distance(by_distance) < 1e-5, "{by_weights} {by_distance}");
                }
                (None, None) => {}
                other => panic!("{other:?}"),
            }
        }
        assert!(found > 250, "only {found} rays met anything: no test");
    }

    #[test]
    fn a_hint_changes_nothing() {
        let rays = Rays::new(&soup(400)).unwrap();
        let mut last = None;
        for beam in beams() {
            let alone = rays.nearest(&beam, None, |_| true);
            assert_eq!(rays.nearest(&beam, last.as_ref(), |_| true), alone);
            last = alone.or(last);
        }
    }

    #[test]
    fn plants_of_any_size_are_hit_alike() {
        // Without scaling, obvhs loses every hit on a scene of 1e-6 units.
        let soup = soup(200);
        let own = Rays::new(&soup).unwrap();
        for factor in [1e-6f32, 1e-3, 1e6, 1e30] {
            let scaled: Vec<[Vec3; 3]> = soup.iter().map(|t| t.map(|p| p * factor)).collect();
            let rays = Rays::new(&scaled).unwrap();
            let hits = |rays: &Rays, factor: f32| {
                let scale = |b: Beam| Beam { origin: b.origin * factor, ..b };
                beams().map(|b| rays.nearest(&scale(b), None, |_| true).map(|h| h.triangle)).collect::<Vec<_>>()
            };
            let (a, b) = (hits(&own, 1.0), hits(&rays, factor));
            let different = a.iter().zip(&b).filter(|(a, b)| a != b).count();
            // The factor is no power of two: a ray that grazes an edge may go either way.
            assert!(different <= 2, "{different} of 500 rays differ at {factor:e}");
        }
    }

    #[test]
    fn what_is_not_accepted_is_passed_through() {
        let wall = |z: f32| [Vec3::new(-9.0, -9.0, z), Vec3::new(9.0, -9.0, z), Vec3::new(0.0, 9.0, z)];
        let rays = Rays::new(&[wall(-1.0), wall(-2.0), wall(-3.0)]).unwrap();
        let beam = Beam { origin: Vec3::ZERO, direction: Vec3::NEG_Z, reach: 2.5 };
        let nearest = |skip: u32| rays.nearest(&beam, None, |hit| hit.triangle != skip).map(|hit| hit.triangle);
        assert_eq!((nearest(9), nearest(0), nearest(1)), (Some(0), Some(1), Some(0)));
        assert!(rays.blocked(&beam, |hit| hit.triangle == 1));
        assert!(!rays.blocked(&beam, |hit| hit.triangle == 2), "beyond the beam's reach");
        let mut seen = Vec::new();
        rays.each(&beam, |hit| seen.push(hit.triangle));
        seen.sort_unstable();
        assert_eq!(seen, [0, 1]);
        let back = Beam { origin: Vec3::Z * -9.0, direction: Vec3::Z, ..beam };
        assert!(rays.nearest(&Beam { reach: 9.0, ..back }, None, |_| true).is_some_and(|hit| hit.triangle == 2));
    }

    #[test]
    fn zeros_of_either_sign_are_one_direction() {
        let rays = Rays::new(&soup(400)).unwrap();
        let mut met = 0;
        for start in beams().map(|b| b.origin) {
            let hit = |direction| rays.nearest(&Beam { origin: start, direction, reach: 9.0 }, None, |_| true);
            for (plus, minus) in [(Vec3::NEG_Z, Vec3::new(-0.0, -0.0, -1.0)), (Vec3::X, Vec3::new(1.0, 0.0, -0.0))] {
                assert_eq!(hit(plus), hit(minus));
                met += usize::from(hit(plus).is_some());
            }
        }
        assert!(met > 20, "{met}");
    }

    #[test]
    fn corners_that_are_not_finite_are_refused_by_number() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let error = Rays::new(&[[Vec3::X; 3], [Vec3::X, Vec3::Y, Vec3::splat(bad)]]).unwrap_err();
            assert!(matches!(error, RayError::Corner { triangle: 1, .. }), "{error}");
        }
    }

    #[test]
    fn thousands_of_sizes_inside_each_other_are_refused_rather_than_lost() {
        let nested: Vec<[Vec3; 3]> =
            (0..20_000).map(|i| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * libm::exp2f(-i as f32 * 0.005))).collect();
        let beam = Beam { origin: Vec3::new(0.2, 0.2, 5.0), direction: Vec3::NEG_Z, reach: f32::INFINITY };
        match Rays::new(&nested) {
            Ok(rays) => assert!(rays.nearest(&beam, None, |_| true).is_some()),
            Err(error) => assert!(matches!(error, RayError::Nested { .. }), "{error}"),
        }
    }

    #[test]
    fn degenerate_scenes_are_cast_at() {
        let beam = Beam { origin: Vec3::new(0.2, 0.2, 5.0), direction: Vec3::NEG_Z, reach: f32::INFINITY };
        let flat = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let needle = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
        let shrinking = |i: i32| flat.map(|p| p * libm::exp2f(-i as f32 * 0.5));
        let scenes: [(Vec<[Vec3; 3]>, bool); 6] = [
            (vec![], false),
            (vec![[Vec3::ONE; 3]], false),
            (vec![needle; 7], false),
            (vec![flat], true),
            (vec![flat; 20_000], true),
            ((0..200).map(shrinking).collect(), true),
        ];
        for (triangles, is_hit) in scenes {
            let rays = Rays::new(&triangles).unwrap();
            let what = format!("{} triangles, first {:?}", triangles.len(), triangles.first());
            assert_eq!(rays.nearest(&beam, None, |_| true).is_some(), is_hit, "{what}");
            assert_eq!(rays.blocked(&beam, |_| true), is_hit, "{what}");
        }
    }
}
