//! The sparse lattice: blocks of 8^3 corners wherever a ball reaches, and what each block is.

use super::bins::{Bins, Part, Run};
use super::splat::{CORNERS, EDGE, Spot, add};
use crate::{Generator, Isa};
use foliar_numerics::{MORTON_BITS, morton3, morton3_inverse};
use glam::{DVec3, IVec3};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Parts in which a block takes the balls near it: inside a crown the first one or two fill the block, and
/// the rest need not be looked at.
const PARTS: usize = 8;
/// Blocks this far from the origin still have distinct Morton codes.
const FARTHEST_BLOCK: i32 = (1 << (MORTON_BITS - 1)) - 4;
/// Bytes of a block without corners of its own.
const BLOCK_BYTES: usize = size_of::<u64>() + size_of::<Block>();

/// What a block is.
#[derive(Clone, Debug)]
pub(super) enum Block {
    /// No corner is inside the surface.
    Outside,
    /// Every corner is.
    Inside,
    /// Some are.
    Mixed(Box<Corners>),
}

/// Corners of a block.
#[derive(Clone, Debug)]
pub(super) struct Corners {
    /// Density at each, x fastest.
    pub density: [f32; CORNERS],
    /// Per layer of z: which corners are inside, bit x + 8 y.
    pub inside: [u64; EDGE],
}

/// More memory would be needed than is allowed.
#[derive(Clone, Copy, Debug)]
pub(super) struct TooMuch;

/// A sparse lattice over balls.
pub(super) struct Lattice {
    bins: Bins,
    radius: f64,
    cell: f64,
    tau: f32,
    isa: Isa,
}

/// Buffers of one thread.
#[derive(Default)]
pub(super) struct Scratch {
    runs: Vec<Run>,
    spots: Vec<Spot>,
}

/// Bytes of a list of blocks with its codes.
pub(super) fn bytes(blocks: &[Block]) -> usize {
    let mixed = blocks.iter().filter(|block| matches!(block, Block::Mixed(_))).count();
    blocks.len() * BLOCK_BYTES + mixed * size_of::<Corners>()
}

/// Half of the range of Morton codes: block 0 is in the middle.
const MIDDLE: i32 = 1 << (MORTON_BITS - 1);

/// Morton code of a block. Lists of blocks are lists of codes in rising order.
pub(super) fn code(block: IVec3) -> u64 {
    let [x, y, z] = (block + MIDDLE).to_array().map(|v| v as u32);
    morton3(x, y, z)
}

/// The block of a code.
pub(super) fn block(code: u64) -> IVec3 {
    IVec3::from_array(morton3_inverse(code).map(|v| v as i32)) - MIDDLE
}

/// Blocks that a ball may reach, in Morton order; at most `most` of them.
pub(super) fn touched(generators: &[Generator], radius: f64, cell: f64, most: usize) -> Result<Vec<u64>, TooMuch> {
    let edge = cell * EDGE as f64;
    let reach = (radius / edge).ceil();
    let in_range = |p: &DVec3| (*p / edge).abs().max_element() + reach < f64::from(FARTHEST_BLOCK);
    // A single ball already fills most of the cube that is inscribed in it.
    if (reach - 1.0).max(1.0).powi(3) > most as f64 || !generators.iter().all(|g| in_range(&g.position)) {
        return Err(TooMuch);
    }
    let home = |g: &Generator| code((g.position / edge).floor().as_ivec3());
    let mut blocks: Vec<u64> = generators.par_iter().filter(|g| g.weight > 0.0).map(home).collect();
    sort(&mut blocks);
    for axis in IVec3::AXES {
        let reach = reach as i32;
        if blocks.len().saturating_mul(2 * reach as usize + 1) > most.saturating_mul(4) {
            return Err(TooMuch);
        }
        let around = |&home: &u64| (-reach..=reach).map(move |step| code(block(home) + axis * step));
        blocks = blocks.par_iter().flat_map_iter(around).collect();
        sort(&mut blocks);
    }
    if blocks.len() > most { Err(TooMuch) } else { Ok(blocks) }
}

/// Sorts blocks, each once.
pub(super) fn sort(blocks: &mut Vec<u64>) {
    blocks.par_sort_unstable();
    blocks.dedup();
}

impl Lattice {
    /// A lattice with corners at multiples of `cell`, over balls that lie relative to its origin.
    pub fn new(generators: &[Generator], radius: f64, cell: f64, tau: f64, isa: Isa) -> Self {
        Lattice { bins: Bins::new(generators, radius, bin_edge(radius, cell)), radius, cell, tau: tau as f32, isa }
    }

    /// What each block is, within `budget` bytes.
    pub fn classify(&self, blocks: &[u64], budget: usize) -> Result<Vec<Block>, TooMuch> {
        let used = AtomicUsize::new(blocks.len() * BLOCK_BYTES);
        blocks
            .par_iter()
            .map_init(Scratch::default, |scratch, &code| {
                if used.load(Ordering::Relaxed) > budget {
                    return Err(TooMuch);
                }
                let state = self.state(block(code), scratch);
                if matches!(state, Block::Mixed(_)) {
                    used.fetch_add(size_of::<Corners>(), Ordering::Relaxed);
                }
                Ok(state)
            })
            .collect()
    }

    /// Densities of blocks, whatever they are.
    pub fn densities(&self, blocks: &[u64]) -> Vec<[f32; CORNERS]> {
        let density = |scratch: &mut Scratch, &code: &u64| {
            let mut sums = [0.0; CORNERS];
            self.fill(block(code), f32::INFINITY, scratch, &mut sums);
            sums
        };
        blocks.par_iter().map_init(Scratch::default, density).collect()
    }

    fn state(&self, block: IVec3, scratch: &mut Scratch) -> Block {
        let mut density = [0.0; CORNERS];
        if self.fill(block, self.tau, scratch, &mut density) {
            return Block::Inside;
        }
        let mut inside = [0u64; EDGE];
        for (layer, inside) in density.chunks_exact(EDGE * EDGE).zip(&mut inside) {
            *inside = (0..).zip(layer).fold(0, |bits, (k, d)| bits | u64::from(*d >= self.tau) << k);
        }
        if inside == [0; EDGE] { Block::Outside } else { Block::Mixed(Box::new(Corners { density, inside })) }
    }

    /// Distance of corners in radii.
    fn spacing(&self) -> f32 {
        (self.cell / self.radius) as f32
    }

    /// Sums the balls at a block's corners; stops, true, when none is below `full`.
    fn fill(&self, block: IVec3, full: f32, scratch: &mut Scratch, sums: &mut [f32; CORNERS]) -> bool {
        let scale = self.cell / self.radius;
        let half = (EDGE as f64 - 1.0) / 2.0 * scale;
        let middle = block.as_dvec3() * EDGE as f64 * scale + half;
        self.bins.near(middle - half, middle + half, &mut scratch.runs);
        (0..PARTS).any(|index| {
            let part = Part { index, of: PARTS };
            self.bins.take(&scratch.runs, part, middle, half as f32, &mut scratch.spots);
            add(self.isa, &scratch.spots, self.spacing(), full, sums)
        })
    }

    /// The balls that reach a block's cells, relative to the middle (radii) of them that is returned.
    pub fn around(&self, block: IVec3, runs: &mut Vec<Run>, spots: &mut Vec<Spot>) -> DVec3 {
        let scale = self.cell / self.radius;
        let half = EDGE as f64 / 2.0 * scale;
        let middle = block.as_dvec3() * EDGE as f64 * scale + half;
        self.bins.near(middle - half, middle + half, runs);
        self.bins.take(runs, Part::ALL, middle, half as f32, spots);
        middle
    }

    /// Radius of the balls, meters.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// What sums are made with.
    pub fn isa(&self) -> Isa {
        self.isa
    }
}

/// Cubes of a radius or a little more that fit into blocks evenly, or blocks into them: their faces then
/// fall together, and few cubes are near a block.
fn bin_edge(radius: f64, cell: f64) -> f64 {
    let blocks = cell * EDGE as f64 / radius;
    if blocks >= 1.0 { blocks / blocks.floor() } else { blocks * (1.0 / blocks).ceil() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_touch_the_blocks_around_them() {
        let ball = |x| Generator { position: DVec3::new(x, 0.5, 0.5), weight: 1.0, group: 0 };
        // Blocks of edge 1, balls of radius 1: 27 about each; the two share 9.
        let blocks = touched(&[ball(0.5), ball(2.5), ball(2.5)], 1.0, 0.125, 1000).unwrap();
        assert_eq!(blocks.len(), 2 * 27 - 9);
        assert!(blocks.windows(2).all(|w| w[0] < w[1]));
        assert!(blocks.iter().all(|&c| code(block(c)) == c));
        assert!(touched(&[ball(0.5)], 1.0, 0.125, 26).is_err());
        assert!(touched(&[ball(0.5)], 1.0, 1e-9, usize::MAX).is_err());
    }
}
