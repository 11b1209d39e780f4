//! A crown of opaque leaves that scatter on both sides, all alike, for measuring.

use super::{Met, Stream, Surroundings, Ways, World, irradiance_at};
use crate::model::Optics;
use crate::octants::{OCTANTS, direction};
use foliar_numerics::{r2_point, radical_inverse};
use foliar_plant::Plant;
use foliar_space::{Beam, RayError, Rays};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// A leaf as triangles, counter-clockwise seen from its front. Any unit, far from the origin or near.
pub type Shape = Vec<[DVec3; 3]>;

/// Where rays of a leaf start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// At its center.
    Center,
    /// All over it.
    Area,
}

/// Leaves to walk among. A leaf is not in its own way.
#[derive(Debug)]
pub struct Scene {
    rays: Rays,
    /// Which leaf a triangle of the rays is of.
    owners: Vec<u32>,
    leaves: Vec<Surface>,
    reflectance: [DVec3; 2],
    transmittance: [DVec3; 2],
}

/// Triangles of a leaf, and the area up to each.
#[derive(Debug)]
struct Surface {
    triangles: Shape,
    areas: Vec<f64>,
    center: DVec3,
}

impl Scene {
    /// Leaves of one kind.
    ///
    /// # Errors
    /// [`RayError`] where a corner is not finite.
    pub fn new(shapes: &[Shape], optics: &Optics) -> Result<Scene, RayError> {
        let (low, high) = shapes
            .iter()
            .flatten()
            .flatten()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        // Differences in f64, then f32: a crown far from the origin keeps its digits.
        let (middle, edge) = ((low + high) / 2.0, (high - low).max_element());
        let scale = if edge > 0.0 && edge.is_finite() { 1.0 / edge } else { 1.0 };
        let place = |p: DVec3| (p - middle) * scale;
        let leaves: Vec<Surface> =
            shapes.iter().map(|shape| Surface::new(shape.iter().map(|t| t.map(place)).collect())).collect();
        let corners: Vec<[glam::Vec3; 3]> =
            leaves.iter().flat_map(|leaf| leaf.triangles.iter().map(|t| t.map(|p| p.as_vec3()))).collect();
        let owner = |(index, leaf): (usize, &Surface)| vec![index as u32; leaf.triangles.len()];
        let (r, t) = (optics.reflectance(), optics.transmittance());
        Ok(Scene {
            rays: Rays::new(&corners)?,
            owners: leaves.iter().enumerate().flat_map(owner).collect(),
            leaves,
            reflectance: [DVec3::splat(r.front), DVec3::splat(r.back)],
            transmittance: [DVec3::splat(t.front), DVec3::splat(t.back)],
        })
    }

    /// Shapes of a plant's leaves, row = leaf id. Wood and alpha are left out: for plants made by rule.
    pub fn shapes(plant: &Plant) -> Vec<Shape> {
        let mut shapes = vec![Shape::new(); plant.leaves().len()];
        for (index, part) in plant.parts().iter().enumerate() {
            for corners in &part.triangles {
                if let Some(leaf) = plant.leaf_of(index, corners[0] as usize) {
                    shapes[leaf as usize].push(corners.map(|c| part.rest_position(c as usize)));
                }
            }
        }
        shapes
    }

    /// Irradiance of front and back of the leaves named, by `samples` paths each. In units of the surroundings.
    pub fn irradiance(&self, leaves: &[u32], around: &Surroundings, samples: u64, seed: u64) -> Vec<[Ways; 2]> {
        let side = |leaf: u32, side: u64| {
            let mut start = Stream::new(&[seed, u64::from(leaf), side]);
            let (turn, shift) = (start.point(), start.point());
            let mut sum = Ways::default();
            for index in 0..samples {
                let mut stream = Stream::new(&[seed, u64::from(leaf), side, index]);
                let at = (DVec2::new(radical_inverse(index, 2), radical_inverse(index, 3)) + shift).fract();
                let first = (r2_point(index) + turn).fract();
                let (place, normal) = self.leaves[leaf as usize].point(at, &mut stream);
                let normal = if side == 0 { normal } else { -normal };
                sum.add(&irradiance_at(self, around, (place, normal, leaf), first, &mut stream));
            }
            sum.times(1.0 / samples as f64)
        };
        leaves.par_iter().map(|&leaf| [side(leaf, 0), side(leaf, 1)]).collect()
    }

    /// Whether each of `per_octant` rays leaves the crown, with its direction, octant by octant.
    pub fn openings(&self, leaf: u32, origin: Origin, per_octant: u64, seed: u64) -> Vec<(DVec3, f64)> {
        let surface = &self.leaves[leaf as usize];
        let ray = |octant: u64, index: u64, turn: DVec2| {
            let mut stream = Stream::new(&[seed, u64::from(leaf), octant, index]);
            let at = (r2_point(index) + turn).fract();
            let (ring, angle) = ((1.0 - at.x * at.x).max(0.0).sqrt(), FRAC_PI_2 * at.y);
            let first = DVec3::new(ring * libm::cos(angle), at.x, ring * libm::sin(angle));
            let toward = first * direction(octant as usize).signum();
            let place = match origin {
                Origin::Center => surface.center,
                Origin::Area => surface.point(stream.point(), &mut stream.clone()).0,
            };
            let beam = Beam { origin: place.as_vec3(), direction: toward.as_vec3(), reach: f32::INFINITY };
            (toward, f64::from(u8::from(self.is_open(&beam, Some(leaf), &mut stream))))
        };
        let octant = |octant: u64| {
            let turn = Stream::new(&[seed, u64::from(leaf), octant]).point();
            (0..per_octant).map(move |index| ray(octant, index, turn))
        };
        (0..OCTANTS as u64).flat_map(octant).collect()
    }

    /// Transmittance of each octant by so many rays.
    pub fn transmittance(&self, leaves: &[u32], origin: Origin, per_octant: u64, seed: u64) -> Vec<[f64; OCTANTS]> {
        let of = |&leaf: &u32| {
            let open = self.openings(leaf, origin, per_octant, seed);
            std::array::from_fn(|octant| {
                let rays = &open[octant * per_octant as usize..][..per_octant as usize];
                rays.iter().map(|(_, open)| open).sum::<f64>() / per_octant as f64
            })
        };
        leaves.par_iter().map(of).collect()
    }
}

impl Surface {
    fn new(triangles: Shape) -> Surface {
        let mut sum = 0.0;
        let area = |[a, b, c]: &[DVec3; 3]| {
            sum += (b - a).cross(c - a).length() / 2.0;
            sum
        };
        let areas: Vec<f64> = triangles.iter().map(area).collect();
        let middle = |[a, b, c]: &[DVec3; 3]| (*a + *b + *c) * ((b - a).cross(c - a).length() / 6.0);
        let weighted: DVec3 = triangles.iter().map(middle).sum();
        let corner = triangles.first().map_or(DVec3::ZERO, |t| t[0]);
        let center = if sum > 0.0 { weighted / sum } else { corner };
        Surface { triangles, areas, center }
    }

    /// A place on it from a point of the unit square, and the normal there.
    fn point(&self, at: DVec2, stream: &mut Stream) -> (DVec3, DVec3) {
        let chosen = stream.unit() * self.areas.last().copied().unwrap_or_default();
        let index = self.areas.partition_point(|area| *area <= chosen).min(self.areas.len().saturating_sub(1));
        let Some([a, b, c]) = self.triangles.get(index).copied() else { return (self.center, DVec3::Y) };
        let root = at.x.sqrt();
        let place = a * (1.0 - root) + b * (root * (1.0 - at.y)) + c * (root * at.y);
        (place, (b - a).cross(c - a).normalize_or(DVec3::Y))
    }
}

impl World for Scene {
    type Mark = u32;

    fn meet(&self, beam: &Beam, from: Option<u32>, _: &mut Stream) -> Option<Met<u32>> {
        let owner = |triangle: u32| self.owners[triangle as usize];
        let hit = self.rays.nearest(beam, None, |hit| Some(owner(hit.triangle)) != from)?;
        let mark = owner(hit.triangle);
        let leaf = &self.leaves[mark as usize];
        let first = self.owners.partition_point(|&other| other < mark);
        let [a, b, c] = leaf.triangles[hit.triangle as usize - first];
        Some(Met {
            place: a * f64::from(1.0 - hit.u - hit.v) + b * f64::from(hit.u) + c * f64::from(hit.v),
            front: (b - a).cross(c - a).normalize_or(DVec3::Y),
            reflectance: self.reflectance,
            transmittance: self.transmittance,
            mark,
        })
    }

    fn is_open(&self, beam: &Beam, from: Option<u32>, _: &mut Stream) -> bool {
        !self.rays.blocked(beam, |hit| Some(self.owners[hit.triangle as usize]) != from)
    }
}
