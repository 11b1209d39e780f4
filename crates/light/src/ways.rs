//! How far leaves reach in each octant, and the extinction that follows from it (Boulanger08 section 6.2).

use crate::crown::Crown;
use crate::leaves::Query;
use crate::octants::OCTANTS;
use crate::profile::{Profile, shares};
use crate::tree::{Node, Slots};
use foliar_numerics::CompensatedSum;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// An octant without a leaf.
const NONE: f64 = -1.0;

/// Extinction per unit of length, from what some leaves see: see [`crate::reference::extinction`].
pub fn extinction(crown: &Crown, queries: &[Query], depths: &[[f32; OCTANTS]], mean_area: f64) -> f64 {
    let least = (mean_area / PI).sqrt();
    let ways: Vec<[f64; OCTANTS]> = queries.par_iter().map(|query| crown.ways(query)).collect();
    let (mut total, mut count) = (CompensatedSum::default(), 0u32);
    let pairs = ways.as_flattened().iter().zip(depths.as_flattened());
    for (&way, &depth) in pairs.filter(|(way, _)| **way >= 0.0 && way.max(least) > 0.0) {
        total.add(f64::from(depth) / way.max(least));
        count += 1;
    }
    if count > 0 { total.value() / f64::from(count) } else { 0.0 }
}

impl Crown {
    /// Distance to the center of the farthest leaf of each octant; below 0 where there is none.
    pub(crate) fn ways(&self, query: &Query) -> [f64; OCTANTS] {
        std::array::from_fn(|octant| self.way(query, octant))
    }

    /// Depth first, the child that may reach farther first.
    fn way(&self, query: &Query, octant: usize) -> f64 {
        let (nodes, slots) = (&self.tree.nodes, &self.tree.slots);
        let bound = |index: usize| farthest(&nodes[index], query.position, octant);
        let mut best = NONE;
        let mut open: Vec<(f64, usize)> = (!nodes.is_empty()).then(|| (bound(0), 0)).into_iter().collect();
        while let Some((reach, index)) = open.pop() {
            // Squares: only what may be farther is worth a look, but the first leaf counts at no distance too.
            if reach < 0.0 || reach <= best {
                continue;
            }
            let node = &nodes[index];
            if node.is_block() {
                let block = node.first as usize..(node.first + node.count) as usize;
                best = block.fold(best, |best, slot| best.max(squared(slots, slot, query, octant)));
            } else {
                let (left, right) = (index + 1, nodes[index + 1].next as usize);
                let mut children = [(bound(left), left), (bound(right), right)];
                children.sort_by(|a, b| a.0.total_cmp(&b.0));
                open.extend(children);
            }
        }
        if best >= 0.0 { best.sqrt() } else { NONE }
    }
}

/// Most that the squared distance of a leaf of the node can be that lies in the octant in part; below 0 for none.
fn farthest(node: &Node, from: DVec3, octant: usize) -> f64 {
    // As wide as the widest leaf's slab may be.
    let width = Profile::Cap.half_width(PI * node.largest);
    let mut square = 0.0;
    for (axis, bit) in [1, 4, 2].into_iter().enumerate() {
        let (low, high) = (node.low[axis] - from[axis], node.high[axis] - from[axis]);
        let (inner, outer) = if octant & bit == 0 { (-high, -low) } else { (low, high) };
        if outer < -width {
            return NONE;
        }
        let reach = outer.abs().max(if inner < -width { width } else { inner.abs() });
        square += reach * reach;
    }
    square
}

/// Squared distance of a leaf that lies in the octant in part; below 0 for another.
fn squared(slots: &Slots, slot: usize, query: &Query, octant: usize) -> f64 {
    let toward = DVec3::from_array([0, 1, 2].map(|axis| slots.position[axis][slot])) - query.position;
    let per_width = f64::from(slots.per_width[slot]);
    let inside = shares(toward, 0.5 / per_width)[octant] > 0.0;
    if inside && slots.group[slot] != query.skip { toward.length_squared() } else { NONE }
}
