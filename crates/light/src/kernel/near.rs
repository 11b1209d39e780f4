//! Blocks of leaves that may hide anything of any octant, the place's own group among them.
//!
//! What a block lets through is a product, and one logarithm at its end is the sum of its leaves' depths.

use super::blocks::{Block, beyond};
use super::formulas::{depth_of_product, parts, share, square};
use super::lanes::{Lanes, equal};
use super::{Batch, Depths, LANES};
use crate::profile::MOST_OCCLUSION;
use pulp::Simd;

/// Least squared distance: a pair that coincides is as dark as one at this.
const NEAREST: f32 = 1e-24;
/// What squares are scaled by, so that the product of two stays a number in f32, from the nearest pair to the largest leaf.
const SCALE: f32 = (1u32 << 30) as f32;
/// Where a product begins: sixteen leaves that hide the most leave 2^-120 of it, which still has all digits.
pub const WHOLE: f32 = 256.0;
/// Power of two of the whole.
pub const POWER: f32 = 8.0;

/// A block that is near, or lies about the places: occlusion may be anything, and leaves of a place's own group are
/// there.
#[inline(always)]
pub fn add_near<const CAP: bool, S: Simd>(simd: S, block: &Block, batch: &Batch, total: &mut Depths) {
    for start in (0..LANES).step_by(S::F32_LANES) {
        // What passes and what is stopped, octant by octant: of little stopped, the first has lost digits that the
        // second still has, and the other way round.
        let mut passed = [Lanes::splat(simd, WHOLE); 8];
        let mut stopped = [Lanes::splat(simd, 0.0); 8];
        for (k, &area) in block.areas.iter().enumerate() {
            let away = Lanes::away(simd, block.at(k), &batch.position, start);
            let own = equal(simd, &batch.skip, start, block.groups[k]);
            let occlusion = own.choose(Lanes::splat(simd, 0.0), occlusion::<CAP, S>(square(away), area));
            let per_width = block.per_width[k];
            let x = share(beyond::<CAP, S>(away[0], block, (0, k), batch, start), per_width);
            let y = share(beyond::<CAP, S>(away[1], block, (1, k), batch, start), per_width);
            let z = share(beyond::<CAP, S>(away[2], block, (2, k), batch, start), per_width);
            let parts = parts(occlusion, [x, y, z]);
            for j in 0..8 {
                let part = parts[j].min(MOST_OCCLUSION as f32);
                let rest = 1.0 - part;
                passed[j] = passed[j] * rest;
                stopped[j] = part + stopped[j] * rest;
            }
        }
        for j in 0..8 {
            depth_of_product(passed[j], stopped[j]).pour(start, &mut total[j]);
        }
    }
}

/// Occlusion of a whole leaf.
#[inline(always)]
fn occlusion<const CAP: bool, S: Simd>(square: Lanes<S>, area: f32) -> Lanes<S> {
    let square = square.max(NEAREST);
    if CAP {
        // 4 q / (r (r + 1)) with q = area / (2 square) and r = sqrt(1 + q), with one division.
        let (square, area) = (square * SCALE, area * SCALE);
        let wide = square + 0.5 * area;
        2.0 * area / (wide + (square * wide).sqrt())
    } else {
        area / square
    }
}
