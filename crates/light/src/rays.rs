//! Transmittance by rays: from points on a leaf through each octant, past other leaves, their cut-outs, and wood.

use crate::alpha::Cover;
use crate::crown::order_of;
use crate::leaves::{Foliage, NO_GROUP, Query};
use crate::octants::OCTANTS;
use crate::profile::MOST_DEPTH;
use foliar_bake::BakeError;
use foliar_numerics::r2_point;
use foliar_plant::Plant;
use foliar_schema::{Role, names};
use foliar_space::{Beam, Rays};
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Coefficients of spherical harmonics of order 2.
pub const HARMONICS: usize = 9;
/// Places that a thread works off in a row.
const CHUNK: usize = 64;
/// A place on a leaf that its texture cuts away is no place: so many are tried.
const TRIES: u64 = 8;

/// A triangle that stops rays.
struct Stop {
    /// Of the leaf; [`NO_GROUP`] for wood.
    group: u32,
    /// Whose alpha it has; [`WHOLE`] for none.
    cover: u32,
    /// Corners in the texture.
    uvs: [Vec2; 3],
}

/// A triangle that is not cut out.
const WHOLE: u32 = u32::MAX;

/// What a plant's leaves are, for rays.
pub(crate) struct Scene<'a> {
    plant: &'a Plant,
    rays: Rays,
    stops: Vec<Stop>,
    corners: Vec<[Vec3; 3]>,
    covers: Vec<Cover<'a>>,
    /// Triangles of each leaf: start in `of_leaf`, one more than leaves.
    starts: Vec<u32>,
    of_leaf: Vec<u32>,
}

impl<'a> Scene<'a> {
    /// Leaves and wood of a plant, in the frame of its foliage. Leaves that were sampled from a crown volume are squares;
    /// the volume itself stops nothing.
    ///
    /// # Errors
    /// [`BakeError::Parameter`] where the triangles cannot be cast at.
    pub fn new(plant: &'a Plant, foliage: &Foliage) -> Result<Scene<'a>, BakeError> {
        let mut scene = Scene {
            plant,
            rays: Rays::default(),
            stops: Vec::new(),
            corners: Vec::new(),
            covers: plant.parts().iter().map(|part| Cover::new(plant, part)).collect(),
            starts: Vec::new(),
            of_leaf: Vec::new(),
        };
        let mut leaf_of = Vec::new();
        for (index, part) in plant.parts().iter().enumerate().filter(|(i, _)| plant.role(*i) != Role::Other) {
            for triangle in &part.triangles {
                let leaf = plant.leaf_of(index, triangle[0] as usize).map(|leaf| leaf as usize);
                let row = leaf.map(|leaf| &plant.leaves()[leaf]);
                if plant.role(index) == Role::Leaf && row.is_none_or(|row| row.crown_volume) {
                    continue;
                }
                let group = row.map_or(NO_GROUP, |row| row.group);
                let uvs = triangle.map(|v| part.uvs.get(v as usize).copied().unwrap_or_default());
                scene.stops.push(Stop { group, cover: index as u32, uvs });
                let place = |v: u32| foliage.place(part.rest_position(v as usize)).as_vec3();
                scene.corners.push(triangle.map(place));
                leaf_of.push(leaf);
            }
        }
        scene.add_crown(foliage, &mut leaf_of);
        scene.rays = Rays::new(&scene.corners).map_err(|error| BakeError::Parameter {
            room: names::ROOM_LIGHT.into(),
            place: "engine".into(),
            reason: format!("rays cannot be cast at this plant: {error}; use tree"),
        })?;
        scene.index(&leaf_of);
        Ok(scene)
    }

    /// Squares for leaves without triangles of their own.
    fn add_crown(&mut self, foliage: &Foliage, leaf_of: &mut Vec<Option<usize>>) {
        let leaves = self.plant.leaves().iter().zip(&foliage.sources).enumerate();
        for (leaf, (_, source)) in leaves.filter(|(_, (row, source))| row.crown_volume && source.area > 0.0) {
            let (across, along) = source.normal.normalize_or(DVec3::Y).any_orthonormal_pair();
            let half = 0.5 * source.area.sqrt();
            let [a, b, c, d] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(u, v)| (source.center + half * (u * across + v * along)).as_vec3());
            for corners in [[a, b, c], [a, c, d]] {
                self.stops.push(Stop { group: source.group, cover: WHOLE, uvs: [Vec2::ZERO; 3] });
                self.corners.push(corners);
                leaf_of.push(Some(leaf));
            }
        }
    }

    fn index(&mut self, leaf_of: &[Option<usize>]) {
        let mut starts = vec![0u32; self.plant.leaves().len() + 1];
        leaf_of.iter().flatten().for_each(|leaf| starts[leaf + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        self.of_leaf = vec![0; *starts.last().unwrap_or(&0) as usize];
        for (triangle, leaf) in leaf_of.iter().enumerate().filter_map(|(t, leaf)| leaf.map(|leaf| (t, leaf))) {
            self.of_leaf[next[leaf] as usize] = triangle as u32;
            next[leaf] += 1;
        }
        self.starts = starts;
    }

    /// Optical depths of all places; the first of them are the leaves in their order. `order` is one in which places
    /// near each other come near.
    pub fn depths(&self, queries: &[Query], order: &[u32], rays: u32) -> Vec<[f32; OCTANTS]> {
        let depth = |through: f64| (-libm::log(through.max(libm::exp(-MOST_DEPTH)))) as f32;
        self.each(queries, order, |shot| {
            std::array::from_fn(|j| {
                let seen: f64 = (0..rays).map(|ray| self.pass(shot, j, ray, rays).1).sum();
                depth(seen / f64::from(rays))
            })
        })
    }

    /// Coefficients of the transmittance: projections onto real harmonics, in the order (0, 0), (1, -1), (1, 0), (1, 1),
    /// (2, -2) to (2, 2) with z up the polar axis of the textbooks: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
    pub fn harmonics(&self, queries: &[Query], order: &[u32], rays: u32) -> Vec<[f32; HARMONICS]> {
        let weight = 4.0 * PI / (f64::from(rays) * OCTANTS as f64);
        self.each(queries, order, |shot| {
            let mut sums = [0.0; HARMONICS];
            for (j, ray) in (0..OCTANTS).flat_map(|j| (0..rays).map(move |ray| (j, ray))) {
                let (direction, seen) = self.pass(shot, j, ray, rays);
                let basis = harmonics(direction);
                (0..HARMONICS).for_each(|k| sums[k] += weight * seen * basis[k]);
            }
            sums.map(|sum| sum as f32)
        })
    }

    /// Answers every place.
    fn each<T: Send + Copy + Default>(
        &self,
        queries: &[Query],
        order: &[u32],
        answer: impl Fn(&Shot) -> T + Sync,
    ) -> Vec<T> {
        let one = |(slot, &query): (usize, &u32)| {
            let at = queries[query as usize];
            let leaf = (query as usize) < self.plant.leaves().len();
            answer(&Shot { at, leaf: leaf.then_some(query as usize), shift: r2_point(slot as u64) })
        };
        let answers: Vec<T> = order.par_iter().enumerate().with_min_len(CHUNK).map(one).collect();
        let mut out = vec![T::default(); queries.len()];
        order.iter().zip(answers).for_each(|(&query, answer)| out[query as usize] = answer);
        out
    }

    /// Direction of a ray, and how much light comes along it.
    fn pass(&self, shot: &Shot, octant: usize, ray: u32, rays: u32) -> (DVec3, f64) {
        let number = u64::from(ray) + octant as u64 * u64::from(rays);
        let point = (r2_point(number) + shot.shift).fract();
        let direction = within(octant, point);
        let origin = shot.leaf.map_or(shot.at.position.as_vec3(), |leaf| self.point_on(leaf, number, shot));
        let beam = Beam { origin, direction: direction.as_vec3(), reach: f32::INFINITY };
        let blocked = self.rays.blocked(&beam, |hit| {
            let stop = &self.stops[hit.triangle as usize];
            // A place of the bark leaves out wood, which has no group either: its own half of the sky is a matter of its
            // normal, and the sums count leaves alone.
            stop.group != shot.at.skip && self.stops_at(hit.triangle, [hit.u, hit.v], number)
        });
        (direction, if blocked { 0.0 } else { 1.0 })
    }

    /// Whether the texture lets nothing through here.
    fn stops_at(&self, triangle: u32, weights: [f32; 2], chance: u64) -> bool {
        let stop = &self.stops[triangle as usize];
        let Some(cover) = self.covers.get(stop.cover as usize) else { return true };
        cover.stops(&stop.uvs, weights, chance ^ u64::from(triangle) << 32)
    }

    /// A point on a leaf where there is something of it.
    fn point_on(&self, leaf: usize, number: u64, shot: &Shot) -> Vec3 {
        let triangles = &self.of_leaf[self.starts[leaf] as usize..self.starts[leaf + 1] as usize];
        let double_area = |t: u32| {
            let [a, b, c] = self.corners[t as usize];
            (b - a).cross(c - a).length()
        };
        let total: f32 = triangles.iter().map(|t| double_area(*t)).sum();
        let turned = DVec2::new(shot.shift.y, shot.shift.x);
        for attempt in 0..TRIES {
            let point = (r2_point(number * TRIES + attempt) + turned).fract();
            let mut left = point.x as f32 * total;
            for &triangle in triangles {
                let area = double_area(triangle);
                if left < area {
                    // The rest of the first number, and the second, within the triangle.
                    let (u, v) = (left / area, point.y as f32);
                    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                    if self.stops_at(triangle, [u, v], number) {
                        let [a, b, c] = self.corners[triangle as usize];
                        return a + (b - a) * u + (c - a) * v;
                    }
                    break;
                }
                left -= area;
            }
        }
        shot.at.position.as_vec3()
    }
}

/// Optical depths of some leaves by so many rays in each octant.
///
/// # Errors
/// [`BakeError::Parameter`] where rays cannot be cast at the plant.
pub fn rays_at(plant: &Plant, leaves: &[usize], rays: u32) -> Result<Vec<[f32; OCTANTS]>, BakeError> {
    let foliage = Foliage::new(plant);
    let scene = Scene::new(plant, &foliage)?;
    let queries = foliage.queries();
    let some: Vec<Query> = leaves.iter().map(|leaf| queries[*leaf]).collect();
    let order: Vec<u32> = order_of(&some).into_iter().map(|at| leaves[at as usize] as u32).collect();
    let all = scene.depths(&queries, &order, rays);
    Ok(leaves.iter().map(|leaf| all[*leaf]).collect())
}

/// A place that rays start from.
struct Shot {
    at: Query,
    leaf: Option<usize>,
    /// Shift of the pattern, from the place's own number in the order of space.
    shift: DVec2,
}

/// Direction in an octant, uniform in solid angle over the unit square.
fn within(octant: usize, point: DVec2) -> DVec3 {
    let ring = (1.0 - point.x * point.x).max(0.0).sqrt();
    let (sine, cosine) = libm::sincos(point.y * FRAC_PI_2);
    let sign = |bit: usize| if octant & bit == 0 { -1.0 } else { 1.0 };
    DVec3::new(sign(1) * ring * cosine, sign(4) * point.x, sign(2) * ring * sine)
}

/// Real spherical harmonics of order 2, orthonormal over the sphere.
pub fn harmonics(direction: DVec3) -> [f64; HARMONICS] {
    let DVec3 { x, y, z } = direction;
    let (zero, one, two) = (0.5 / PI.sqrt(), (0.75 / PI).sqrt(), 0.5 * (15.0 / PI).sqrt());
    let polar = 0.25 * (5.0 / PI).sqrt();
    [
        zero,
        one * y,
        one * z,
        one * x,
        two * x * y,
        two * y * z,
        polar * (3.0 * z * z - 1.0),
        two * x * z,
        0.5 * two * (x * x - y * y),
    ]
}
