//! Balls in cubes, in rows along x, for the lattice: what may reach a block is nine runs of a list.

use super::splat::Spot;
use crate::Generator;
use foliar_numerics::MORTON_BITS;
use glam::{DVec3, IVec3};
use rayon::prelude::*;

/// A share of the balls near a block, spread over all of it: every `of`th, from the `index`th on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub index: usize,
    pub of: usize,
}

impl Part {
    /// All balls.
    pub const ALL: Part = Part { index: 0, of: 1 };
}

/// Balls, by cube.
#[derive(Clone, Debug)]
pub(super) struct Bins {
    /// Edge of a cube, in radii: 1 or above.
    edge: f64,
    /// Cubes that hold balls, in row order, and where their balls start; one past the last at the end.
    cubes: Vec<(u64, u32)>,
    /// Balls relative to the middle of their cube, in radii.
    spots: Vec<Spot>,
}

/// Balls of one or more neighboring cubes of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// Middle of their cube, in radii.
    middle: DVec3,
    first: u32,
    end: u32,
}

/// Place of a cube in the list: by z, then y, then x.
fn place(cube: IVec3) -> u64 {
    let [x, y, z] = (cube + (1 << (MORTON_BITS - 1))).to_array().map(|v| v as u64);
    z << (2 * MORTON_BITS) | y << MORTON_BITS | x
}

impl Bins {
    /// Sorts balls, in an order that depends on where they are, not on how they were listed.
    pub fn new(generators: &[Generator], radius: f64, edge: f64) -> Bins {
        let sort_key = |g: &Generator| {
            let position = g.position / radius;
            let cube = (position / edge).floor();
            let local = (position - (cube + 0.5) * edge).as_vec3();
            (place(cube.as_ivec3()), Spot { center: local.to_array(), root: g.weight.sqrt() })
        };
        let mut keyed: Vec<(u64, Spot)> = generators.par_iter().filter(|g| g.weight > 0.0).map(sort_key).collect();
        let numbers = |s: &Spot| [s.center[0], s.center[1], s.center[2], s.root].map(order_bits);
        keyed.par_sort_unstable_by(|a, b| a.0.cmp(&b.0).then_with(|| numbers(&a.1).cmp(&numbers(&b.1))));
        let mut cubes: Vec<(u64, u32)> = Vec::new();
        for (index, &(place, _)) in keyed.iter().enumerate() {
            if cubes.last().is_none_or(|last| last.0 != place) {
                cubes.push((place, index as u32));
            }
        }
        cubes.push((u64::MAX, keyed.len() as u32));
        Bins { edge, cubes, spots: keyed.into_iter().map(|(_, spot)| spot).collect() }
    }

    /// Runs of balls that may reach the box `low..high` (radii).
    pub fn near(&self, low: DVec3, high: DVec3, runs: &mut Vec<Run>) {
        runs.clear();
        let cube = |p: DVec3| (p / self.edge).floor().as_ivec3();
        let (from, to) = (cube(low - 1.0), cube(high + 1.0));
        for (z, y) in (from.z..=to.z).flat_map(|z| (from.y..=to.y).map(move |y| (z, y))) {
            let first = self.cubes.partition_point(|c| c.0 < place(IVec3::new(from.x, y, z)));
            for x in from.x..=to.x {
                let wanted = place(IVec3::new(x, y, z));
                let Some(at) = self.cubes[first..].iter().take((x - from.x + 1) as usize).position(|c| c.0 == wanted)
                else {
                    continue;
                };
                let middle = (IVec3::new(x, y, z).as_dvec3() + 0.5) * self.edge;
                let (first, end) = (self.cubes[first + at].1, self.cubes[first + at + 1].1);
                runs.push(Run { middle, first, end });
            }
        }
    }

    /// One part of the balls of the runs: those that reach a box about `middle`, relative to it.
    pub fn take(&self, runs: &[Run], part: Part, middle: DVec3, half: f32, spots: &mut Vec<Spot>) {
        spots.clear();
        for run in runs {
            let shift = (run.middle - middle).as_vec3().to_array();
            let skip = (part.index + part.of - run.first as usize % part.of) % part.of;
            for spot in self.spots[run.first as usize..run.end as usize].iter().skip(skip).step_by(part.of) {
                let center = std::array::from_fn(|k| spot.center[k] + shift[k]);
                let [x, y, z] = center.map(|v: f32| (v.abs() - half).max(0.0));
                if x * x + y * y + z * z < 1.0 {
                    spots.push(Spot { center, root: spot.root });
                }
            }
        }
    }
}

/// Bits that compare as the numbers do.
fn order_bits(value: f32) -> i32 {
    let bits = value.to_bits() as i32;
    bits ^ ((bits >> 31) as u32 >> 1) as i32
}
