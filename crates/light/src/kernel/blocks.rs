//! Blocks of leaves, one leaf after the other.

use super::formulas::{far_depth, far_occlusion, far_whole_depth, share, square};
use super::lanes::Lanes;
use super::near::add_near;
use super::{Batch, Depths, LANES, half_width, rounded_off, sides};
use crate::tree::{BLOCK, Node, Tree};
use pulp::Simd;

/// Least squared distance, in areas over pi, from which occlusions are so small that a short series has all of their
/// digits: o at most 1/32, whose fifth power is below one in f32.
const FAR: f64 = 32.0;

/// Leaves of a block, relative to a batch.
pub struct Block<'a> {
    pub position: [[f32; BLOCK]; 3],
    /// What f32 rounds off these.
    pub rest: [[f32; BLOCK]; 3],
    /// Over pi.
    pub areas: &'a [f32],
    pub per_width: &'a [f32],
    pub groups: &'a [u32],
}

impl<'a> Block<'a> {
    #[inline(always)]
    fn new(tree: &'a Tree, node: &Node, batch: &Batch) -> Block<'a> {
        let all = node.first as usize..(node.first + node.count) as usize;
        let mut block = Block {
            position: [[0.0; BLOCK]; 3],
            rest: [[0.0; BLOCK]; 3],
            areas: &tree.slots.area[all.clone()],
            per_width: &tree.slots.per_width[all.clone()],
            groups: &tree.slots.group[all.clone()],
        };
        for axis in 0..3 {
            let middle = batch.middle[axis];
            for (k, at) in tree.slots.position[axis][all.clone()].iter().enumerate() {
                block.position[axis][k] = (at - middle) as f32;
                block.rest[axis][k] = rounded_off(at - middle);
            }
        }
        block
    }

    /// Place of a leaf.
    #[inline(always)]
    pub fn at(&self, leaf: usize) -> [f32; 3] {
        [self.position[0][leaf], self.position[1][leaf], self.position[2][leaf]]
    }
}

#[inline(always)]
pub fn add_block<const CAP: bool, S: Simd>(
    simd: S,
    (tree, node): (&Tree, &Node),
    near: f64,
    batch: &Batch,
    total: &mut Depths,
) {
    let block = Block::new(tree, node, batch);
    if near < FAR * node.largest || near <= 0.0 {
        return add_near::<CAP, S>(simd, &block, batch, total);
    }
    let (octant, open, axis) = sides(node.low, node.high, half_width::<CAP>(node.largest), batch);
    match open {
        0 => add_far::<CAP, S>(simd, &block, batch, &mut total[octant]),
        1 => add_far_across::<CAP, S>(simd, &block, batch, (axis, octant), total),
        _ => add_near::<CAP, S>(simd, &block, batch, total),
    }
}

/// A block that lies wholly in one octant of every place, and far.
#[inline(always)]
fn add_far<const CAP: bool, S: Simd>(simd: S, block: &Block, batch: &Batch, total: &mut [f64; LANES]) {
    for start in (0..LANES).step_by(S::F32_LANES) {
        let mut sum = Lanes::splat(simd, 0.0);
        for (k, &area) in block.areas.iter().enumerate() {
            let away = Lanes::away(simd, block.at(k), &batch.position, start);
            sum = sum + far_whole_depth::<CAP, S>(area / square(away));
        }
        sum.pour(start, total);
    }
}

/// How far a leaf's center lies beyond a plane. Where octants are hard, all digits count: near the plane the difference
/// of what was rounded is exact, and what was rounded off follows.
#[inline(always)]
pub fn beyond<const CAP: bool, S: Simd>(
    difference: Lanes<S>,
    block: &Block,
    (axis, leaf): (usize, usize),
    batch: &Batch,
    start: usize,
) -> Lanes<S> {
    if CAP {
        difference
    } else {
        difference + (block.rest[axis][leaf] - Lanes::load(difference.simd, &batch.rest[axis], start))
    }
}

/// A block that is far, and across one plane of some place.
#[inline(always)]
fn add_far_across<const CAP: bool, S: Simd>(
    simd: S,
    block: &Block,
    batch: &Batch,
    (axis, octant): (usize, usize),
    total: &mut Depths,
) {
    let above = octant | [1, 4, 2][axis];
    for start in (0..LANES).step_by(S::F32_LANES) {
        let mut sums = [Lanes::splat(simd, 0.0); 2];
        for (k, &area) in block.areas.iter().enumerate() {
            let away = Lanes::away(simd, block.at(k), &batch.position, start);
            let o = far_occlusion::<CAP, S>(area / square(away));
            let upper = share(beyond::<CAP, S>(away[axis], block, (axis, k), batch, start), block.per_width[k]);
            sums[0] = sums[0] + far_depth((1.0 - upper) * o);
            sums[1] = sums[1] + far_depth(upper * o);
        }
        sums[0].pour(start, &mut total[octant]);
        sums[1].pour(start, &mut total[above]);
    }
}
