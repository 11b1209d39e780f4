//! Which branch a leaf hangs on: the capsule nearest to its petiole, never the nearest vertex.

use crate::geometry::Geometry;
use foliar_plant::{Branches, OnBranch, Structure};
use foliar_space::{Aabb, BoxTree};
use glam::DVec3;
use rayon::prelude::*;

/// How much of the way to a branch's axis counts beside the way to its bark: inside several, the nearer axis wins.
const AXIS: f64 = 0.01;

/// Branch and arc length of each leaf.
pub(super) fn leaves(branches: &Branches, structure: &Structure, geometry: &Geometry) -> Vec<OnBranch> {
    let (mut owners, mut boxes) = (Vec::new(), Vec::new());
    for (branch, axis) in branches.axes.iter().enumerate() {
        for low in 0..axis.points.len().saturating_sub(1).max(1) {
            let high = (low + 1).min(axis.points.len() - 1);
            let ends = [low, high].map(|k| axis.points[k] - geometry.center);
            owners.push((branch as u32, axis.arcs[low], axis.arcs[high]));
            boxes.push(Aabb::around(ends).grown(axis.radii[low].max(axis.radii[high])));
        }
    }
    let tree = BoxTree::new(&boxes);
    let of = |petiole: DVec3| {
        let spot = |entry: u32| {
            let (branch, from, to) = owners[entry as usize];
            (branch, branches.axes[branch as usize].nearest_between(petiole, from, to))
        };
        let measure = |entry: u32| {
            let (_, spot) = spot(entry);
            (spot.distance - spot.radius).max(0.0) + AXIS * spot.distance
        };
        let nearest = tree.least(petiole - geometry.center, measure);
        nearest.map_or(OnBranch::NONE, |(entry, _)| {
            let (branch, spot) = spot(entry);
            OnBranch { branch, arc: spot.arc as f32 }
        })
    };
    structure.leaves.par_iter().map(|leaf| of(leaf.petiole.as_dvec3())).collect()
}
