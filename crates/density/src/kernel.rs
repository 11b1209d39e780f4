//! Density and gradient of a block of queries (Luft07 eq. 2), sixteen queries at a time, on whatever
//! vector instructions the processor has.
//!
//! Each query has a lane of its own and meets the balls in the grid's order, one by one: a lane's sum is
//! the same sequence of IEEE additions and multiplications whatever the width of the registers. Nothing
//! is fused (rustc never contracts a * b + c), so all paths give the same bits.

use crate::grid::{Ball, Near, ROW_EDGE, Run, gap, half_reach};
use pulp::{Simd, WithSimd};

/// Queries side by side.
pub(crate) const LANES: usize = 16;

/// Sixteen queries relative to their block's origin, in radii; short batches repeat their last query.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Batch {
    pub x: [f32; LANES],
    pub y: [f32; LANES],
    pub z: [f32; LANES],
    /// Group whose balls do not count.
    pub skip: [u32; LANES],
}

/// Sums of sixteen queries; the gradient in units of 1 / radius, before the factor -4.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    pub density: [f32; LANES],
    pub gradient: [[f32; LANES]; 3],
}

/// Sums all batches of a block; `GRADIENT` false leaves the gradients at zero.
pub(crate) struct Block<'a, const GRADIENT: bool> {
    /// Balls near it.
    pub near: &'a Near,
    /// Its queries.
    pub batches: &'a [Batch],
    /// What is found, a sum per batch.
    pub sums: &'a mut Vec<Sums>,
}

impl<const GRADIENT: bool> WithSimd for Block<'_, GRADIENT> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        sum_block::<GRADIENT>(self.near, self.batches, self.sums);
    }
}

#[inline(always)]
fn sum_block<const GRADIENT: bool>(near: &Near, batches: &[Batch], sums: &mut Vec<Sums>) {
    sums.clear();
    for batch in batches {
        let bounds = [bounds(&batch.x), bounds(&batch.y), bounds(&batch.z)];
        let mut total = Sums::default();
        for run in &near.runs {
            let balls = within_reach(run, near, &bounds);
            if !balls.is_empty() {
                add_run::<GRADIENT>(balls, batch, &mut total);
            }
        }
        sums.push(total);
    }
}

/// Least and greatest of the lanes.
#[inline(always)]
fn bounds(lanes: &[f32; LANES]) -> [f64; 2] {
    let (mut low, mut high) = (lanes[0], lanes[0]);
    for &v in lanes {
        low = if v < low { v } else { low };
        high = if v > high { v } else { high };
    }
    [f64::from(low), f64::from(high)]
}

/// The part of a run that a batch can touch.
#[inline(always)]
fn within_reach<'a>(run: &Run, near: &'a Near, bounds: &[[f64; 2]; 3]) -> &'a [Ball] {
    let [x, y, z] = bounds;
    let across = [gap(f64::from(run.low[0]), ROW_EDGE, y[0], y[1]), gap(f64::from(run.low[1]), ROW_EDGE, z[0], z[1])];
    let Some(half) = half_reach(across) else { return &[] };
    let balls = &near.balls[run.start..run.end];
    let (low, high) = ((x[0] - half) as f32, (x[1] + half) as f32);
    let from = balls.partition_point(|b| b.x < low);
    let count = balls[from..].partition_point(|b| b.x <= high);
    &balls[from..from + count]
}

/// Adds one run. It is summed by itself first: the rounding of a long sum then grows with the root of
/// the number of runs, not of balls.
#[inline(always)]
fn add_run<const GRADIENT: bool>(balls: &[Ball], batch: &Batch, total: &mut Sums) {
    let mut run = Sums::default();
    for ball in balls {
        for lane in 0..LANES {
            // A mask of bits: a choice between two weights kept compilers from vectors, and cost seven times the time.
            let counts = 0u32.wrapping_sub(u32::from(batch.skip[lane] != ball.group));
            let weight = f32::from_bits(ball.weight.to_bits() & counts);
            let (dx, dy, dz) = (batch.x[lane] - ball.x, batch.y[lane] - ball.y, batch.z[lane] - ball.z);
            let inside = 1.0 - (dx * dx + dy * dy + dz * dz);
            let inside = if inside > 0.0 { inside } else { 0.0 };
            let slope = weight * inside;
            run.density[lane] += slope * inside;
            if GRADIENT {
                run.gradient[0][lane] += slope * dx;
                run.gradient[1][lane] += slope * dy;
                run.gradient[2][lane] += slope * dz;
            }
        }
    }
    for lane in 0..LANES {
        total.density[lane] += run.density[lane];
        for axis in 0..3 {
            total.gradient[axis][lane] += run.gradient[axis][lane];
        }
    }
}
