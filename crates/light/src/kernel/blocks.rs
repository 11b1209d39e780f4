//! Blocks of leaves, one leaf after the other.

use super::formulas::{any_depth, far_depth, far_occlusion, far_whole_depth, octant_shares, share};
use super::{Batch, Depths, LANES, half_width, lanes, pour, rounded_off, sides};
use crate::profile::MOST_OCCLUSION;
use crate::tree::{BLOCK, Node, Tree};

/// Least squared distance: a pair that coincides is as dark as one at this.
const NEAREST: f32 = 1e-24;
/// Least squared distance, in areas over pi, from which occlusions are so small that a short series has all of their
/// digits: o at most 1/32, whose fifth power is below one in f32.
const FAR: f64 = 32.0;

/// Leaves of a block, relative to a batch.
struct Local {
    position: [[f32; BLOCK]; 3],
    /// What f32 rounds off these.
    rest: [[f32; BLOCK]; 3],
    count: usize,
}

#[inline(always)]
fn local(tree: &Tree, node: &Node, batch: &Batch) -> Local {
    let zero = [[0.0; BLOCK]; 3];
    let mut local = Local { position: zero, rest: zero, count: node.count as usize };
    let first = node.first as usize;
    for axis in 0..3 {
        let middle = batch.middle[axis];
        let slots = &tree.slots.position[axis][first..first + local.count];
        for (k, at) in slots.iter().enumerate() {
            local.position[axis][k] = (at - middle) as f32;
            local.rest[axis][k] = rounded_off(at - middle);
        }
    }
    local
}

#[inline(always)]
pub fn add_block<const CAP: bool, const W: usize>(
    tree: &Tree,
    node: &Node,
    near: f64,
    batch: &Batch,
    total: &mut Depths,
) {
    let leaves = local(tree, node, batch);
    let first = node.first as usize;
    let end = first + leaves.count;
    let areas = &tree.slots.area[first..end];
    let per_width = &tree.slots.per_width[first..end];
    if near < FAR * node.largest || near <= 0.0 {
        let groups = &tree.slots.group[first..end];
        return add_near::<CAP, W>(&leaves, areas, per_width, groups, batch, total);
    }
    let (octant, open, axis) = sides(node.low, node.high, half_width::<CAP>(node.largest), batch);
    match open {
        0 => add_far::<CAP, W>(&leaves, areas, batch, &mut total[octant]),
        1 => add_far_across::<CAP, W>(&leaves, areas, per_width, batch, axis, octant, total),
        _ => add_far_around::<CAP, W>(&leaves, areas, per_width, batch, total),
    }
}

/// A block that lies wholly in one octant of every place, and far.
#[inline(always)]
fn add_far<const CAP: bool, const W: usize>(leaves: &Local, areas: &[f32], batch: &Batch, total: &mut [f64; LANES]) {
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = [0, 1, 2].map(|axis| lanes::<W>(&batch.position[axis], start));
        let mut sums = [0.0f32; W];
        for (k, area) in areas.iter().enumerate() {
            let [px, py, pz] = [0, 1, 2].map(|axis| leaves.position[axis][k]);
            for lane in 0..W {
                let (dx, dy, dz) = (px - x[lane], py - y[lane], pz - z[lane]);
                sums[lane] += far_whole_depth::<CAP>(area / (dx * dx + dy * dy + dz * dz));
            }
        }
        pour(&sums, start, total);
    }
}

/// How far a leaf's center lies beyond a plane. Where octants are hard, all digits count: near the plane the difference
/// of what was rounded is exact, and what was rounded off follows.
#[inline(always)]
fn beyond<const CAP: bool>(difference: f32, rest_of_leaf: f32, rest_of_place: f32) -> f32 {
    if CAP { difference } else { difference + (rest_of_leaf - rest_of_place) }
}

/// A block that is far, and across one plane of some place.
#[inline(always)]
fn add_far_across<const CAP: bool, const W: usize>(
    leaves: &Local,
    areas: &[f32],
    per_width: &[f32],
    batch: &Batch,
    axis: usize,
    octant: usize,
    total: &mut Depths,
) {
    let order = [axis, (axis + 1) % 3, (axis + 2) % 3];
    let above = octant | [1, 4, 2][axis];
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = order.map(|axis| lanes::<W>(&batch.position[axis], start));
        let rest = lanes::<W>(&batch.rest[axis], start);
        let mut sums = [[0.0f32; W]; 2];
        for (k, area) in areas.iter().enumerate() {
            let [px, py, pz] = order.map(|axis| leaves.position[axis][k]);
            for lane in 0..W {
                let (dx, dy, dz) = (px - x[lane], py - y[lane], pz - z[lane]);
                let o = far_occlusion::<CAP>(area / (dx * dx + dy * dy + dz * dz));
                let upper = share(beyond::<CAP>(dx, leaves.rest[axis][k], rest[lane]), per_width[k]);
                sums[0][lane] += far_depth((1.0 - upper) * o);
                sums[1][lane] += far_depth(upper * o);
            }
        }
        pour(&sums[0], start, &mut total[octant]);
        pour(&sums[1], start, &mut total[above]);
    }
}

/// A block that is far, and across several planes.
#[inline(always)]
fn add_far_around<const CAP: bool, const W: usize>(
    leaves: &Local,
    areas: &[f32],
    per_width: &[f32],
    batch: &Batch,
    total: &mut Depths,
) {
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = [0, 1, 2].map(|axis| lanes::<W>(&batch.position[axis], start));
        let [rx, ry, rz] = [0, 1, 2].map(|axis| lanes::<W>(&batch.rest[axis], start));
        let mut sums = [[0.0f32; W]; 8];
        for (k, area) in areas.iter().enumerate() {
            let [px, py, pz] = [0, 1, 2].map(|axis| leaves.position[axis][k]);
            for lane in 0..W {
                let (dx, dy, dz) = (px - x[lane], py - y[lane], pz - z[lane]);
                let o = far_occlusion::<CAP>(area / (dx * dx + dy * dy + dz * dz));
                let by = per_width[k];
                let [lx, ly, lz] = [0, 1, 2].map(|axis| leaves.rest[axis][k]);
                let shares = octant_shares(
                    share(beyond::<CAP>(dx, lx, rx[lane]), by),
                    share(beyond::<CAP>(dy, ly, ry[lane]), by),
                    share(beyond::<CAP>(dz, lz, rz[lane]), by),
                );
                for j in 0..8 {
                    sums[j][lane] += far_depth(shares[j] * o);
                }
            }
        }
        (0..8).for_each(|j| pour(&sums[j], start, &mut total[j]));
    }
}

/// A block that is near: occlusion may be anything, and leaves of a place's own group are there.
#[inline(always)]
fn add_near<const CAP: bool, const W: usize>(
    leaves: &Local,
    areas: &[f32],
    per_width: &[f32],
    groups: &[u32],
    batch: &Batch,
    total: &mut Depths,
) {
    const MOST: f32 = MOST_OCCLUSION as f32;
    for start in (0..LANES).step_by(W) {
        let [x, y, z] = [0, 1, 2].map(|axis| lanes::<W>(&batch.position[axis], start));
        let [rx, ry, rz] = [0, 1, 2].map(|axis| lanes::<W>(&batch.rest[axis], start));
        let skip: [u32; W] = std::array::from_fn(|lane| batch.skip[start + lane]);
        let mut sums = [[0.0f32; W]; 8];
        for (k, area) in areas.iter().enumerate() {
            let [px, py, pz] = [0, 1, 2].map(|axis| leaves.position[axis][k]);
            for lane in 0..W {
                let (dx, dy, dz) = (px - x[lane], py - y[lane], pz - z[lane]);
                let square = dx * dx + dy * dy + dz * dz;
                let area = if skip[lane] == groups[k] { 0.0 } else { *area };
                let x = area / if square > NEAREST { square } else { NEAREST };
                let o = if CAP {
                    let q = 0.5 * x;
                    let root = (1.0 + q).sqrt();
                    4.0 * (q / root) / (root + 1.0)
                } else {
                    x
                };
                let by = per_width[k];
                let [lx, ly, lz] = [0, 1, 2].map(|axis| leaves.rest[axis][k]);
                let shares = octant_shares(
                    share(beyond::<CAP>(dx, lx, rx[lane]), by),
                    share(beyond::<CAP>(dy, ly, ry[lane]), by),
                    share(beyond::<CAP>(dz, lz, rz[lane]), by),
                );
                for j in 0..8 {
                    let part = shares[j] * o;
                    sums[j][lane] += any_depth(if part < MOST { part } else { MOST });
                }
            }
        }
        (0..8).for_each(|j| pour(&sums[j], start, &mut total[j]));
    }
}
