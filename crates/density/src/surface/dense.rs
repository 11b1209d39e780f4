//! The sparse lattice's blocks, filled for a whole box: a dense array of densities.

use super::blocks::{Lattice, code};
use super::splat::EDGE;
use crate::{Generator, Isa};
use glam::{IVec3, USizeVec3};

/// Blocks that are filled at once: 2 MB.
const AT_ONCE: usize = 1024;

/// Density (Luft07 eq. 2) at points `cell` meters apart, x fastest: `size` of them along each axis, from the
/// multiple `first` of the cell on. The order of the balls does not matter, nor which instructions are used.
pub(crate) fn dense(
    balls: &[Generator],
    radius: f64,
    cell: f64,
    (first, size): (IVec3, USizeVec3),
    isa: Isa,
) -> Vec<f32> {
    let lattice = Lattice::new(balls, radius, cell, f64::INFINITY, isa);
    let edge = IVec3::splat(EDGE as i32);
    let (low, high) = (first.div_euclid(edge), (first + size.as_ivec3() - 1).div_euclid(edge));
    let rows = (low.z..=high.z).flat_map(|z| (low.y..=high.y).map(move |y| (y, z)));
    let blocks: Vec<IVec3> = rows.flat_map(|(y, z)| (low.x..=high.x).map(move |x| IVec3::new(x, y, z))).collect();
    let mut values = vec![0.0f32; size.element_product()];
    for blocks in blocks.chunks(AT_ONCE) {
        let codes: Vec<u64> = blocks.iter().map(|&block| code(block)).collect();
        for (block, corners) in blocks.iter().zip(lattice.densities(&codes)) {
            copy(&corners, *block * edge - first, size, &mut values);
        }
    }
    values
}

/// Copies what of a block lies inside the box; `at` is its first corner.
fn copy(corners: &[f32], at: IVec3, size: USizeVec3, values: &mut [f32]) {
    let range = |axis: usize| {
        let (low, high) = ((-at[axis]).max(0), (size[axis] as i32 - at[axis]).min(EDGE as i32));
        low as usize..high.max(low) as usize
    };
    let place = |i: usize, axis: usize| (at[axis] + i as i32) as usize;
    for (k, j) in range(2).flat_map(|k| range(1).map(move |j| (k, j))) {
        let (from, x) = ((k * EDGE + j) * EDGE, range(0));
        let to = (place(k, 2) * size.y + place(j, 1)) * size.x + place(x.start, 0);
        values[to..to + x.len()].copy_from_slice(&corners[from + x.start..from + x.end]);
    }
}
