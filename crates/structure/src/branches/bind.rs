//! Which branch a leaf hangs on: the capsule nearest to its petiole or to the middle of one of its edges, never
//! the nearest vertex of the wood.

use crate::geometry::Geometry;
use foliar_plant::{Base, Branches, NO_LEAF, OnBranch, Spot, Structure};
use foliar_schema::Role;
use foliar_space::{Aabb, BoxTree};
use glam::DVec3;
use rayon::prelude::*;

/// How much of the way to a branch's axis counts beside the way to its bark: inside several, the nearer axis wins.
const AXIS: f64 = 0.01;
/// The middle of an edge must be so many times nearer than the petiole: leaves cross twigs that are not theirs.
const NEARER: f64 = 4.0;
/// Leaves of more triangles have vertices enough for `structure` to have found their petiole.
const FEW_TRIANGLES: usize = 16;

/// Branch and arc length of each leaf.
pub(super) fn leaves(branches: &Branches, base: &Base, structure: &Structure, geometry: &Geometry) -> Vec<OnBranch> {
    let capsules = Capsules::new(branches, geometry.center);
    let faces = Faces::new(base, structure);
    let of = |leaf: usize| {
        let petiole = structure.leaves[leaf].petiole.as_dvec3();
        let mut best = capsules.nearest(petiole, f64::INFINITY);
        let mut limit = best.map_or(0.0, |b| b.2 / NEARER);
        for place in faces.edge_middles(base, leaf) {
            if let Some(nearer) = capsules.nearest(place, limit) {
                limit = nearer.2;
                best = Some(nearer);
            }
        }
        best.map_or(OnBranch::NONE, |(branch, spot, _)| OnBranch { branch, arc: spot.arc as f32 })
    };
    (0..structure.leaves.len()).into_par_iter().map(of).collect()
}

/// All capsules of all branches.
struct Capsules<'a> {
    branches: &'a Branches,
    center: DVec3,
    /// Branch, and lower and upper arc length.
    owners: Vec<(u32, f64, f64)>,
    tree: BoxTree,
}

impl<'a> Capsules<'a> {
    fn new(branches: &'a Branches, center: DVec3) -> Capsules<'a> {
        let (mut owners, mut boxes) = (Vec::new(), Vec::new());
        for (branch, axis) in branches.axes.iter().enumerate() {
            for low in 0..axis.points.len().saturating_sub(1).max(1) {
                let high = (low + 1).min(axis.points.len() - 1);
                let ends = [low, high].map(|k| axis.points[k] - center);
                owners.push((branch as u32, axis.arcs[low], axis.arcs[high]));
                boxes.push(Aabb::around(ends).grown(axis.radii[low].max(axis.radii[high])));
            }
        }
        Capsules { branches, center, owners, tree: BoxTree::new(&boxes) }
    }

    fn spot(&self, entry: u32, place: DVec3) -> (u32, Spot) {
        let (branch, from, to) = self.owners[entry as usize];
        (branch, self.branches.axes[branch as usize].nearest_between(place, from, to))
    }

    /// Branch and place nearest to `place` below `limit`, and how far: to the bark, and a little of the way to the axis.
    fn nearest(&self, place: DVec3, limit: f64) -> Option<(u32, Spot, f64)> {
        let measure = |entry: u32| {
            let (_, spot) = self.spot(entry, place);
            (spot.distance - spot.radius).max(0.0) + AXIS * spot.distance
        };
        let (entry, distance) = self.tree.least(place - self.center, limit, measure)?;
        let (branch, spot) = self.spot(entry, place);
        Some((branch, spot, distance))
    }
}

/// Triangles of leaves, leaf by leaf.
struct Faces {
    starts: Vec<u32>,
    /// Part and triangle.
    faces: Vec<(u32, u32)>,
}

impl Faces {
    fn new(base: &Base, structure: &Structure) -> Faces {
        let leaf_parts = || (0..base.parts.len()).filter(|&p| structure.roles[p] == Role::Leaf);
        let leaf = |part: usize, triangle: &[u32; 3]| {
            let id = structure.leaf_ids[part].get(triangle[0] as usize).copied().unwrap_or(NO_LEAF);
            (id != NO_LEAF).then_some(id as usize)
        };
        let mut starts = vec![0u32; structure.leaves.len() + 1];
        for part in leaf_parts() {
            base.parts[part].triangles.iter().filter_map(|t| leaf(part, t)).for_each(|l| starts[l + 1] += 1);
        }
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let mut faces = vec![(0, 0); starts.last().copied().unwrap_or(0) as usize];
        for part in leaf_parts() {
            for (index, triangle) in base.parts[part].triangles.iter().enumerate() {
                if let Some(leaf) = leaf(part, triangle) {
                    faces[next[leaf] as usize] = (part as u32, index as u32);
                    next[leaf] += 1;
                }
            }
        }
        Faces { starts, faces }
    }

    /// Middles of the edges that only one face of a leaf of few triangles has, rest frame.
    fn edge_middles(&self, base: &Base, leaf: usize) -> Vec<DVec3> {
        let own = &self.faces[self.starts[leaf] as usize..self.starts[leaf + 1] as usize];
        if own.len() > FEW_TRIANGLES {
            return Vec::new();
        }
        let edges: Vec<(u32, u32, u32)> = own
            .iter()
            .flat_map(|&(part, triangle)| {
                let [a, b, c] = base.parts[part as usize].triangles[triangle as usize];
                [(part, a, b), (part, b, c), (part, c, a)]
            })
            .collect();
        let margin = edges.iter().filter(|(part, a, b)| !edges.contains(&(*part, *b, *a)));
        let place = |part: u32, vertex: u32| base.parts[part as usize].rest_position(vertex as usize);
        margin.map(|&(part, a, b)| place(part, a).midpoint(place(part, b))).collect()
    }
}
