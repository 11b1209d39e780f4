//! Realigned normals by the surface (Luft07 section 4): of each place, the closest point of the mesh's
//! triangles and the field's normal there.

use super::refine::downhill;
use super::{DensityField, Surface};
use crate::order;
use foliar_space::{Closest, TriangleTree};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Where a place's normal comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Closest point of the mesh, meters from the surface's origin.
    pub point: Vec3,
    /// Unit outward normal there.
    pub normal: Vec3,
}

/// Cells within which the order of places does not matter.
const GRAIN: f64 = 0.5;
/// Relative margin of a bound on a distance: more than f32 rounds a squared distance.
const MARGIN: f32 = 1e-5;
/// Places of one task, near each other.
const TASK: usize = 256;

/// The foot of each place (meters, relative to the plant's center) on the surface; `None` where the
/// surface has no triangles. Give the surface without its cavities, or places inside get normals that point
/// into the crown.
pub fn nearest(surface: &Surface, field: &impl DensityField, places: &[DVec3]) -> Option<Vec<Foot>> {
    let corners: Vec<[Vec3; 3]> =
        surface.triangles.par_iter().map(|t| t.map(|v| surface.positions[v as usize])).collect();
    // Triangles are listed block by block in Morton order.
    let tree = TriangleTree::in_order(&corners);
    let closest = closest(&tree, places, surface)?;
    let points: Vec<DVec3> = closest.par_iter().map(|c| c.point.as_dvec3() + surface.origin).collect();
    let probes = field.probe(&points);
    let foot = |(found, probe): (&Closest, &super::Probe)| {
        let normal = downhill(probe.gradient).unwrap_or_else(|| face_normal(surface, found.triangle));
        Foot { point: found.point, normal }
    };
    Some(closest.par_iter().zip(&probes).map(foot).collect())
}

/// Closest points of all places, searched in Morton order.
fn closest(tree: &TriangleTree, places: &[DVec3], surface: &Surface) -> Option<Vec<Closest>> {
    let scale = 1.0 / (GRAIN * surface.cell_m);
    let order = order::in_space(places.len(), |at| Some((places[at] - surface.origin) * scale));
    let task = |task: &[(u64, u32)]| feet(tree, task, places, surface.origin);
    let found: Option<Vec<Closest>> = order.par_chunks(TASK).flat_map_iter(task).collect();
    let mut sorted: Vec<(u32, Closest)> = order.iter().map(|o| o.1).zip(found?).collect();
    sorted.par_sort_unstable_by_key(|s| s.0);
    Some(sorted.into_iter().map(|s| s.1).collect())
}

/// Closest points of places in a row: the foot of the one before bounds each one's distance.
fn feet(tree: &TriangleTree, task: &[(u64, u32)], places: &[DVec3], origin: DVec3) -> Vec<Option<Closest>> {
    let mut before: Option<Vec3> = None;
    let search = |&(_, index): &(u64, u32)| {
        let place = (places[index as usize] - origin).as_vec3();
        let bound = before.map(|foot| foot.distance_squared(place) * (1.0 + MARGIN));
        let near = bound.and_then(|bound| tree.closest_within(place, bound));
        let found = near.or_else(|| tree.closest(place))?;
        before = Some(found.point);
        Some(found)
    };
    task.iter().map(search).collect()
}

/// Normal of a triangle, or of a corner of one without area.
fn face_normal(surface: &Surface, triangle: u32) -> Vec3 {
    let corners = surface.triangles[triangle as usize];
    let [a, b, c] = corners.map(|v| surface.positions[v as usize].as_dvec3());
    let face = (b - a).cross(c - a);
    downhill(-face).unwrap_or(surface.normals[corners[0] as usize])
}
