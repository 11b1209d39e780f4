//! The order in which places are worked on: near ones one after another.

use foliar_numerics::{MORTON_BITS, morton3};
use glam::DVec3;
use rayon::prelude::*;

/// Cell 0 in the middle of what a code can tell apart.
const MIDDLE: i64 = 1 << (MORTON_BITS - 1);

/// Morton codes and indices of those of `count` places that are somewhere, in Morton order of their cells, ties by index.
/// `place` in cells, which are 1 wide.
pub(crate) fn in_space(count: usize, place: impl Fn(usize) -> Option<DVec3> + Sync) -> Vec<(u64, u32)> {
    let code = |index: usize| {
        let [x, y, z] = place(index)?.to_array().map(|v| (v.floor() as i64 + MIDDLE) as u32);
        Some((morton3(x, y, z), index as u32))
    };
    let mut order: Vec<(u64, u32)> = (0..count).into_par_iter().filter_map(code).collect();
    order.par_sort_unstable();
    order
}
