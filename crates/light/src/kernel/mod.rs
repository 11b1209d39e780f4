//! Optical depths of sixteen places at a time from blocks of leaves and from nodes of the tree, on whatever vector
//! instructions the processor has (Boulanger08 section 6.1).
//!
//! Each place has a lane of its own and meets leaves and nodes in the order of the tree, one by one: a lane's sum is
//! the same sequence of IEEE operations whatever the width of the registers. Nothing is fused, so all paths give the
//! same bits.

mod blocks;
mod formulas;
mod lanes;
mod near;
mod nodes;

use crate::profile::Profile;
use crate::tree::{BLOCK, Node, Tree};
use blocks::add_block;
use foliar_numerics::Isa;
use glam::DVec3;
use nodes::add_node;
use pulp::{Simd, WithSimd};

/// Places side by side.
pub(crate) const LANES: usize = BLOCK;

/// Sums of sixteen places.
pub(crate) type Depths = [[f64; LANES]; 8];

/// Sixteen places, short batches repeat their last.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    /// Middle of the places: what the kernel's coordinates start from.
    pub middle: DVec3,
    /// Places less the middle.
    pub position: [[f32; LANES]; 3],
    /// What f32 rounds off these.
    pub rest: [[f32; LANES]; 3],
    /// Group that is left out.
    pub skip: [u32; LANES],
    /// Box of the places.
    pub low: DVec3,
    pub high: DVec3,
    /// Box of the places and of every leaf that one of them leaves out.
    pub reach: [DVec3; 2],
}

/// Depths of a batch on some instructions, or on plain ones where the processor lacks them; nodes wider than `opening`
/// times their distance are opened, 0 opens all.
pub(crate) fn sum(isa: Isa, tree: &Tree, batch: &Batch, opening: f64) -> Depths {
    isa.dispatch(Work { tree, batch, opening })
}

/// What one batch asks.
#[derive(Clone, Copy)]
struct Work<'a> {
    tree: &'a Tree,
    batch: &'a Batch,
    opening: f64,
}

impl WithSimd for Work<'_> {
    type Output = Depths;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Depths {
        match self.tree.profile {
            Profile::Cap => self.sum::<true, S>(simd),
            Profile::Paper => self.sum::<false, S>(simd),
        }
    }
}

impl Work<'_> {
    #[inline(always)]
    fn sum<const CAP: bool, S: Simd>(&self, simd: S) -> Depths {
        let &Work { tree, batch, opening } = self;
        let mut total = [[0.0; LANES]; 8];
        let mut index = 0;
        while let Some(node) = tree.nodes.get(index) {
            let near = gap_squared(node.low, node.high, &batch.reach);
            let to_center = node.center.clamp(batch.reach[0], batch.reach[1]).distance_squared(node.center);
            if node.stands_for_all(near, to_center * opening * opening) {
                add_node(simd, node, batch, &mut total);
            } else if node.is_block() {
                add_block::<CAP, S>(simd, (tree, node), near, batch, &mut total);
            } else {
                index += 1;
                continue;
            }
            index = node.next as usize;
        }
        total
    }
}

/// Squared distance between two boxes.
#[inline(always)]
fn gap_squared(low: DVec3, high: DVec3, [from, to]: &[DVec3; 2]) -> f64 {
    (low - *to).max(*from - high).max(DVec3::ZERO).length_squared()
}

/// On which side of the places a box lies that is `half_width` wider, axis by axis: the octant of the axes that are
/// decided, and the axes that are not.
#[inline(always)]
fn sides(low: DVec3, high: DVec3, half_width: f64, batch: &Batch) -> (usize, usize, usize) {
    /// Bit of an axis in an octant's index.
    const BIT: [usize; 3] = [1, 4, 2];
    let (mut octant, mut open, mut axis) = (0, 0, 0);
    for k in 0..3 {
        // Never both: a box that touches a plane lies on it.
        let above = low[k] - half_width > batch.high[k];
        let below = high[k] + half_width < batch.low[k];
        octant |= if above { BIT[k] } else { 0 };
        if !(above || below) {
            (open, axis) = (open + 1, k);
        }
    }
    (octant, open, axis)
}

/// Half the width of the widest leaf's slab: see [`Profile::half_width`].
#[inline(always)]
fn half_width<const CAP: bool>(largest: f64) -> f64 {
    let rounding = Profile::Paper.half_width(0.0);
    if CAP { rounding.max(0.5 * (3.0 * largest).sqrt()) } else { rounding }
}

impl Node {
    /// Whether its moments may stand for it: seen small enough, and no leaf so near that occlusion is not small.
    #[inline(always)]
    fn stands_for_all(&self, near: f64, opens: f64) -> bool {
        /// Least squared distance in areas over pi: the third power of occlusion is left out.
        const SMALL: f64 = 8.0;
        self.radius_squared < opens && near >= SMALL * self.largest && near > 0.0
    }
}

/// What f32 rounds off a number.
#[inline(always)]
pub(crate) fn rounded_off(exact: f64) -> f32 {
    (exact - f64::from(exact as f32)) as f32
}
