//! The true branches of a sample, gathered while it is built.

use crate::{Axis, Base, Branches, NO_BRANCH, OnBranch, Stalk, Structure};
use glam::{DAffine3, Vec3};

/// Branches so far.
#[derive(Debug, Default)]
pub struct Hierarchy {
    stalks: Vec<Stalk>,
    /// Part, first vertex, and ring of each vertex of a stalk.
    tubes: Vec<(usize, usize, Vec<u32>)>,
    /// Petiole and place of each leaf.
    leaves: Vec<(Vec3, OnBranch)>,
}

impl Hierarchy {
    /// Adds a branch whose vertices follow each other in a part; its number.
    pub fn add(
        &mut self,
        part: usize,
        first: usize,
        rings: &[u32],
        axis: &Axis,
        transform: &DAffine3,
        parent: Option<u32>,
    ) -> u32 {
        let points = axis.points.iter().map(|&p| transform.transform_point3(p)).collect();
        let scale = libm::cbrt(transform.matrix3.determinant().abs());
        let axis = Axis::new(points, axis.radii.iter().map(|r| r * scale).collect());
        let first_vertex = (part as u64) << 32 | first as u64;
        self.stalks.push(Stalk { parent, axis, margin: f64::INFINITY, first_vertex });
        self.tubes.push((part, first, rings.to_vec()));
        self.stalks.len() as u32 - 1
    }

    /// First vertex of each branch in its part, in their order.
    pub fn starts(&self) -> Vec<usize> {
        self.tubes.iter().map(|tube| tube.1).collect()
    }

    /// Adds a leaf.
    pub fn leaf(&mut self, petiole: Vec3, on: OnBranch) {
        self.leaves.push((petiole, on));
    }

    /// The branches of the finished plant. Leaf rows that were added by hand hang on none.
    pub fn finish(self, base: &Base, structure: &Structure) -> Branches {
        let (mut branches, ids) = Branches::grow(self.stalks);
        branches.vertices = vec![Vec::new(); base.parts.len()];
        for ((part, first, rings), &branch) in self.tubes.iter().zip(&ids) {
            let list = &mut branches.vertices[*part];
            list.resize(base.parts[*part].positions.len(), OnBranch::NONE);
            let arcs = &branches.axes[branch as usize].arcs;
            for (place, &ring) in list[*first..].iter_mut().zip(rings) {
                *place = OnBranch { branch, arc: arcs[ring as usize] as f32 };
            }
        }
        let axes = &branches.axes;
        let placed = self.leaves.iter().map(|&(petiole, on)| match ids.get(on.branch as usize) {
            Some(&branch) => OnBranch { branch, ..on },
            None => nearest(axes, petiole),
        });
        branches.leaves = placed.collect();
        branches.leaves.resize(structure.leaves.len(), OnBranch::NONE);
        branches
    }
}

/// The place nearest to a petiole, on any axis.
fn nearest(axes: &[Axis], petiole: Vec3) -> OnBranch {
    let spots = axes.iter().enumerate().map(|(branch, axis)| (branch as u32, axis.nearest(petiole.as_dvec3())));
    let best = spots.min_by(|a, b| (a.1.distance - a.1.radius).total_cmp(&(b.1.distance - b.1.radius)));
    best.map_or(OnBranch { branch: NO_BRANCH, arc: 0.0 }, |(branch, spot)| OnBranch { branch, arc: spot.arc as f32 })
}
