//! Nodes of the tree, by their moments.

use super::formulas::{parts, share, square};
use super::lanes::Lanes;
use super::{Batch, Depths, LANES};
use crate::tree::Node;
use pulp::Simd;

/// A node by its moments: of first order in the occlusion with the variance of its leaves, and of second.
#[inline(always)]
pub fn add_node<S: Simd>(simd: S, node: &Node, batch: &Batch, total: &mut Depths) {
    let (half, [first, spread, second]) = (node.half, node.moments);
    let relative = (node.center - batch.middle).as_vec3().to_array();
    let (mut octant, mut open) = (0, false);
    for (axis, bit) in [1, 4, 2].into_iter().enumerate() {
        let above = node.center[axis] - half[axis] > batch.high[axis];
        let below = node.center[axis] + half[axis] < batch.low[axis];
        octant |= if above { bit } else { 0 };
        open |= !(above || below);
    }
    if !open {
        return add_whole_node(simd, relative, node.moments, batch, &mut total[octant]);
    }
    let per_width = half.to_array().map(|half| (0.5 / half) as f32);
    for start in (0..LANES).step_by(S::F32_LANES) {
        let away = Lanes::away(simd, relative, &batch.position, start);
        let inverse = 1.0 / square(away);
        let [x, y, z] = away;
        let upper = [share(x, per_width[0]), share(y, per_width[1]), share(z, per_width[2])];
        let shares = parts(Lanes::splat(simd, 1.0), upper);
        let (first, second) = (inverse * (first + spread * inverse), second * inverse * inverse);
        for j in 0..8 {
            (shares[j] * (first + shares[j] * second)).pour(start, &mut total[j]);
        }
    }
}

#[inline(always)]
fn add_whole_node<S: Simd>(simd: S, at: [f32; 3], moments: [f32; 3], batch: &Batch, total: &mut [f64; LANES]) {
    for start in (0..LANES).step_by(S::F32_LANES) {
        let away = Lanes::away(simd, at, &batch.position, start);
        let inverse = 1.0 / square(away);
        (inverse * (moments[0] + (moments[1] + moments[2]) * inverse)).pour(start, total);
    }
}
