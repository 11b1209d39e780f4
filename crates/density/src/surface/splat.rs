//! Density at the corners of a block of the lattice, and with its gradient at places in it: ball after ball
//! is added to all of them (Luft07 eq. 2), on whatever vector instructions the processor has.
//!
//! Each sum is the same sequence of IEEE operations whatever the width of the registers, and
//! rustc fuses nothing: all paths give the same bits.

use crate::Isa;
use pulp::{Simd, WithSimd};

/// Corners along an edge of a block.
pub(super) const EDGE: usize = 8;
/// Corners of one block, x fastest.
pub(super) const CORNERS: usize = EDGE * EDGE * EDGE;
/// Corners of one layer.
const LAYER: usize = EDGE * EDGE;
/// Balls that are summed by themselves first: keeps the rounding of long sums small, and is how often a
/// block is asked whether it is full.
const BATCH: usize = 16;

/// A ball relative to the middle of a block's corners, in radii.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub center: [f32; 3],
    /// Square root of its weight.
    pub root: f32,
}

/// Places side by side.
pub(super) const LANES: usize = 16;

/// Places relative to the middle that the balls are relative to, in radii.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lanes {
    pub place: [[f32; LANES]; 3],
}

/// Density at each of some places, and its gradient in units of 1 / radius before the factor -4.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub density: [f32; LANES],
    pub gradient: [[f32; LANES]; 3],
}

/// Adds balls to corners `spacing` radii apart. Stops, true, as soon as no corner is below `full`: nothing is ever
/// subtracted, so none would be in the end.
pub(super) fn add(isa: Isa, spots: &[Spot], spacing: f32, full: f32, sums: &mut [f32; CORNERS]) -> bool {
    isa.dispatch(Add { spots, spacing, full, sums })
}

/// Density and gradient at places.
pub(super) fn probe(isa: Isa, spots: &[Spot], lanes: &Lanes) -> Sums {
    isa.dispatch(Probe { spots, lanes })
}

struct Add<'a> {
    spots: &'a [Spot],
    spacing: f32,
    full: f32,
    sums: &'a mut [f32; CORNERS],
}

impl WithSimd for Add<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        add_all(self.spots, self.spacing, self.full, self.sums)
    }
}

struct Probe<'a> {
    spots: &'a [Spot],
    lanes: &'a Lanes,
}

impl WithSimd for Probe<'_> {
    type Output = Sums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Sums {
        probe_all(self.spots, self.lanes)
    }
}

#[inline(always)]
fn probe_all(spots: &[Spot], lanes: &Lanes) -> Sums {
    let (mut total, [x, y, z]) = (Sums::default(), lanes.place);
    for batch in spots.chunks(BATCH) {
        let mut sums = Sums::default();
        for &Spot { center, root } in batch {
            for lane in 0..LANES {
                let (dx, dy, dz) = (x[lane] - center[0], y[lane] - center[1], z[lane] - center[2]);
                let inside = 1.0 - (dx * dx + dy * dy + dz * dz);
                let inside = root * if inside > 0.0 { inside } else { 0.0 };
                let slope = root * inside;
                sums.density[lane] += inside * inside;
                sums.gradient[0][lane] += slope * dx;
                sums.gradient[1][lane] += slope * dy;
                sums.gradient[2][lane] += slope * dz;
            }
        }
        for lane in 0..LANES {
            total.density[lane] += sums.density[lane];
            for axis in 0..3 {
                total.gradient[axis][lane] += sums.gradient[axis][lane];
            }
        }
    }
    total
}

#[inline(always)]
fn add_all(spots: &[Spot], spacing: f32, full: f32, sums: &mut [f32; CORNERS]) -> bool {
    let steps: [f32; EDGE] = std::array::from_fn(|k| (k as f32 - (EDGE as f32 - 1.0) / 2.0) * spacing);
    for batch in spots.chunks(BATCH) {
        let mut part = [0.0f32; CORNERS];
        for spot in batch {
            add_spot(spot, &steps, &mut part);
        }
        let mut least = f32::INFINITY;
        for (sum, part) in sums.iter_mut().zip(&part) {
            *sum += part;
            least = if *sum < least { *sum } else { least };
        }
        if least >= full {
            return true;
        }
    }
    false
}

/// Adds w (1 - d^2)^2 as (root (1 - z^2) - root (x^2 + y^2))^2, clamped at the ball's edge.
#[inline(always)]
fn add_spot(spot: &Spot, steps: &[f32; EDGE], part: &mut [f32; CORNERS]) {
    let [x, y, z] = spot.center.map(|c| steps.map(|step| spot.root * ((step - c) * (step - c))));
    let mut across = [0.0f32; LAYER];
    for (row, y) in across.chunks_exact_mut(EDGE).zip(y) {
        for (across, x) in row.iter_mut().zip(x) {
            *across = x + y;
        }
    }
    for (layer, z) in part.chunks_exact_mut(LAYER).zip(z) {
        let rest = spot.root - z;
        if rest > 0.0 {
            for (sum, across) in layer.iter_mut().zip(&across) {
                let inside = rest - across;
                let inside = if inside > 0.0 { inside } else { 0.0 };
                *sum += inside * inside;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::{r2_point, radical_inverse};

    fn spots(count: u64) -> Vec<Spot> {
        let spot = |i| {
            let (p, z) = (r2_point(i), radical_inverse(i, 5));
            Spot { center: [p.x, p.y, z].map(|v| (v * 3.0 - 1.5) as f32), root: radical_inverse(i, 7) as f32 + 0.5 }
        };
        (0..count).map(spot).collect()
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let balls = spots(300);
        let run = |isa| {
            let mut sums = [0.0; CORNERS];
            add(isa, &balls, 0.125, f32::INFINITY, &mut sums);
            sums.map(f32::to_bits)
        };
        let plain = run(Isa::Plain);
        for isa in Isa::available() {
            assert!(run(isa) == plain, "{isa:?}");
        }
    }

    #[test]
    fn corners_hold_the_sum_of_the_balls() {
        let (balls, spacing) = (spots(300), 0.125f32);
        let mut sums = [0.0; CORNERS];
        assert!(!add(Isa::best(), &balls, spacing, f32::INFINITY, &mut sums));
        for (index, &sum) in sums.iter().enumerate() {
            let at = [index % EDGE, index / EDGE % EDGE, index / LAYER].map(|k| (k as f64 - 3.5) * f64::from(spacing));
            let (mut expected, mut weights) = (0.0, 0.0);
            for ball in &balls {
                let square: f64 = (0..3).map(|k| (at[k] - f64::from(ball.center[k])).powi(2)).sum();
                let weight = f64::from(ball.root).powi(2);
                expected += weight * (1.0 - square).max(0.0).powi(2);
                weights += if square < 1.0 { weight } else { 0.0 };
            }
            // A term is off by a few roundings (2^-24) of its weight; sums of sixteen add four more.
            assert!((f64::from(sum) - expected).abs() <= 1e-6 * weights, "corner {index}: {sum}, not {expected}");
        }
    }

    #[test]
    fn a_full_block_stops_early_and_is_full_in_the_end() {
        let balls = spots(2000);
        let (mut early, mut whole) = ([0.0; CORNERS], [0.0; CORNERS]);
        assert!(add(Isa::best(), &balls, 0.125, 5.0, &mut early));
        assert!(!add(Isa::best(), &balls, 0.125, f32::INFINITY, &mut whole));
        assert!(early.iter().zip(&whole).all(|(e, w)| 5.0 <= *e && e <= w));
        assert!(early.iter().zip(&whole).any(|(e, w)| e < w));
    }
}
