//! Nodes of the tree, by their moments.

use super::formulas::{octant_shares, share};
use super::{Batch, Depths, LANES, lanes, pour};
use crate::tree::Node;

/// A node by its moments: of first order in the occlusion with the variance of its leaves, and of second.
#[inline(always)]
pub fn add_node<const W: usize>(node: &Node, batch: &Batch, total: &mut Depths) {
    let (half, moments) = (node.half, node.moments);
    let relative = (node.center - batch.middle).as_vec3();
    let (mut octant, mut open) = (0, [false; 3]);
    for (axis, bit) in [1, 4, 2].into_iter().enumerate() {
        let above = node.center[axis] - half[axis] > batch.high[axis];
        let below = node.center[axis] + half[axis] < batch.low[axis];
        octant |= if above { bit } else { 0 };
        open[axis] = !(above || below);
    }
    if open == [false; 3] {
        return add_whole_node::<W>(relative.to_array(), moments, batch, &mut total[octant]);
    }
    let per_width = half.to_array().map(|half| (0.5 / half) as f32);
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = [0, 1, 2].map(|axis| lanes::<W>(&batch.position[axis], start));
        let mut sums = [[0.0f32; W]; 8];
        for lane in 0..W {
            let (dx, dy, dz) = (relative.x - x[lane], relative.y - y[lane], relative.z - z[lane]);
            let inverse = 1.0 / (dx * dx + dy * dy + dz * dz);
            let first = inverse * (moments[0] + moments[1] * inverse);
            let second = moments[2] * inverse * inverse;
            let shares = octant_shares(share(dx, per_width[0]), share(dy, per_width[1]), share(dz, per_width[2]));
            for j in 0..8 {
                sums[j][lane] += shares[j] * (first + shares[j] * second);
            }
        }
        (0..8).for_each(|j| pour(&sums[j], start, &mut total[j]));
    }
}

#[inline(always)]
fn add_whole_node<const W: usize>(at: [f32; 3], moments: [f32; 3], batch: &Batch, total: &mut [f64; LANES]) {
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = [0, 1, 2].map(|axis| lanes::<W>(&batch.position[axis], start));
        let mut sums = [0.0f32; W];
        for lane in 0..W {
            let (dx, dy, dz) = (at[0] - x[lane], at[1] - y[lane], at[2] - z[lane]);
            let inverse = 1.0 / (dx * dx + dy * dy + dz * dz);
            sums[lane] += inverse * (moments[0] + (moments[1] + moments[2]) * inverse);
        }
        pour(&sums, start, total);
    }
}
