//! The density of many balls and its gradient at many places (Luft07 eq. 2), exact up to f32 rounding:
//! within 1e-6 of the sum of the weights in reach (the gradient: times 4 / radius).

use crate::Isa;
use crate::generators::Generator;
use crate::grid::{Grid, Near};
use crate::kernel::{Batch, Block, LANES, Sums};
use crate::moments::Moments;
use crate::order;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// A place to evaluate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Meters, relative to the plant's center.
    pub position: DVec3,
    /// Group whose balls do not count, or [`crate::NO_GROUP`].
    pub skip: u32,
}

/// The density at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// S, the sum of Luft07 eq. 2 with weights.
    pub density: f32,
    /// Its gradient, 1/m; zero where it was not asked for.
    pub gradient: Vec3,
}

/// Parts of a radius that a Morton code tells apart: 2^3 along each axis.
const FINE_BITS: u32 = 3;
/// Queries of one task: enough work to be worth a thread's while.
const TASK: usize = 2048;

/// Balls, ready to be asked.
#[derive(Clone, Debug)]
pub struct Field {
    grid: Grid,
    /// For places that all balls reach, where the radius is as large as the plant.
    moments: Option<Moments>,
    radius: f64,
    /// Radii per meter. A power of two times it is exact, so that block and fine cell of a place agree.
    inverse: f64,
    isa: Isa,
}

impl Field {
    /// Sorts the balls. `radius` in meters, above 0 and at least 2^-17 of the extent of balls and queries.
    pub fn new(generators: &[Generator], radius: f64) -> Field {
        let inverse = 1.0 / radius;
        let (grid, moments) = (Grid::new(generators, inverse), Moments::new(generators, inverse));
        Field { grid, moments, radius, inverse, isa: Isa::best() }
    }

    /// The same field on chosen instructions (plain where the processor lacks them): same bits.
    pub fn on(mut self, isa: Isa) -> Field {
        self.isa = isa;
        self
    }

    /// Radius of influence, meters.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Density and gradient at each query.
    pub fn samples(&self, queries: &[Query]) -> Vec<Sample> {
        self.evaluate::<true>(queries)
    }

    /// Density alone at each query.
    pub fn densities(&self, queries: &[Query]) -> Vec<f32> {
        self.evaluate::<false>(queries).iter().map(|s| s.density).collect()
    }

    /// Density at one place in f64, over the same balls, and how many balls were looked at.
    pub(crate) fn exact(&self, query: &Query) -> (f64, usize) {
        match self.all(query) {
            Some((density, _)) => (density, 0),
            None => self.grid.exact(query.position * self.inverse, query.skip),
        }
    }

    fn evaluate<const GRADIENT: bool>(&self, queries: &[Query]) -> Vec<Sample> {
        let mut results: Vec<Sample> = queries.par_iter().map(|query| self.at_once(query)).collect();
        let order = self.order(queries);
        // Chunks, since all queries may lie in one block: where a radius is larger than the plant.
        let blocks = order.chunk_by(|a, b| block_of(a.0) == block_of(b.0));
        let blocks: Vec<&[(u64, u32)]> = blocks.flat_map(|block| block.chunks(TASK)).collect();
        let parts: Vec<Vec<Sample>> = tasks(&blocks)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, task| {
                task.iter().flat_map(|block| self.block::<GRADIENT>(queries, block, scratch)).collect()
            })
            .collect();
        for (&(_, index), sample) in order.iter().zip(parts.into_iter().flatten()) {
            results[index as usize] = sample;
        }
        results
    }

    /// Density and gradient (in units of one over the radius) by moments, at a place that all balls reach.
    fn all(&self, query: &Query) -> Option<(f64, DVec3)> {
        self.moments.as_ref()?.sum(query)
    }

    /// The same as a sample; nothing elsewhere.
    fn at_once(&self, query: &Query) -> Sample {
        let (density, gradient) = self.all(query).unwrap_or_default();
        Sample { density: density as f32, gradient: (gradient * self.inverse).as_vec3() }
    }

    /// Queries that are summed ball by ball, in Morton order, ties by index.
    fn order(&self, queries: &[Query]) -> Vec<(u64, u32)> {
        let scale = f64::from(1u32 << FINE_BITS) * self.inverse;
        let summed = |place: DVec3| !self.moments.as_ref().is_some_and(|moments| moments.reach(place));
        order::in_space(queries.len(), |at| Some(queries[at].position).filter(|p| summed(*p)).map(|p| p * scale))
    }

    /// Evaluates the queries of one block, a cube of one radius.
    fn block<const GRADIENT: bool>(
        &self,
        queries: &[Query],
        block: &[(u64, u32)],
        scratch: &mut Scratch,
    ) -> Vec<Sample> {
        let places = || block.iter().map(|&(_, index)| queries[index as usize].position * self.inverse);
        let (low, high) =
            places().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        // The block's own center, not that of its queries: a query's bits must not depend on its company.
        let origin = low.floor() + 0.5;
        self.grid.near(low, high, origin, &mut scratch.near);
        scratch.batches.clear();
        scratch.batches.extend(block.chunks(LANES).map(|chunk| batch(queries, chunk, origin, self.inverse)));
        let Scratch { near, batches, sums, .. } = scratch;
        self.isa.dispatch(Block::<GRADIENT> { near, batches, sums });
        let slope = -4.0 * self.inverse;
        (0..block.len())
            .map(|i| {
                let sums = &scratch.sums[i / LANES];
                let gradient = DVec3::from_array(sums.gradient.map(|g| f64::from(g[i % LANES])));
                Sample { density: sums.density[i % LANES], gradient: (gradient * slope).as_vec3() }
            })
            .collect()
    }
}

/// The block of a place.
fn block_of(code: u64) -> u64 {
    code >> (3 * FINE_BITS)
}

/// Buffers of one thread.
#[derive(Default)]
struct Scratch {
    near: Near,
    batches: Vec<Batch>,
    sums: Vec<Sums>,
}

/// Joins blocks to tasks of similar size.
fn tasks<'a, 'b>(blocks: &'b [&'a [(u64, u32)]]) -> Vec<&'b [&'a [(u64, u32)]]> {
    let (mut tasks, mut start, mut size) = (Vec::new(), 0, 0);
    for (index, block) in blocks.iter().enumerate() {
        size += block.len();
        if size >= TASK || index + 1 == blocks.len() {
            tasks.push(&blocks[start..=index]);
            (start, size) = (index + 1, 0);
        }
    }
    tasks
}

/// Up to sixteen queries in lanes.
fn batch(queries: &[Query], chunk: &[(u64, u32)], origin: DVec3, inverse: f64) -> Batch {
    let lane = |l: usize| &queries[chunk[l.min(chunk.len() - 1)].1 as usize];
    let mut batch = Batch { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES], skip: [0; LANES] };
    for l in 0..LANES {
        let query = lane(l);
        let p = (query.position * inverse - origin).as_vec3();
        (batch.x[l], batch.y[l], batch.z[l], batch.skip[l]) = (p.x, p.y, p.z, query.skip);
    }
    batch
}
