//! Chords of runs of balls, on the widest registers that the processor has.
//!
//! Sixteen sums run side by side; each is the same sequence of IEEE operations whatever the width of the registers, and
//! nothing is fused: all widths give the same bits.

use pulp::{Simd, WithSimd};
use std::ops::Range;

/// Balls side by side.
pub(crate) const LANES: usize = 16;

/// Balls along one axis, in radii; each list has [`LANES`] more numbers than balls.
#[derive(Default)]
pub(crate) struct Balls {
    pub across: [Vec<f32>; 2],
    pub along: Vec<f32>,
    pub weight: Vec<f32>,
    pub group: Vec<u32>,
}

/// Half the chords of balls that a place may reach, and what lies between their middles and the place.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    pub whole: [f32; LANES],
    pub part: [f32; LANES],
}

/// Adds runs of balls to the sums of a place.
pub(crate) struct Runs<'a> {
    pub balls: &'a Balls,
    pub runs: &'a [Range<usize>],
    /// Across twice, and along.
    pub place: [f32; 3],
    /// Group whose balls do not count.
    pub skip: u32,
}

impl WithSimd for Runs<'_> {
    type Output = Sums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Sums {
        let mut sums = Sums::default();
        let place = Place {
            x: simd.splat_f32s(self.place[0]),
            y: simd.splat_f32s(self.place[1]),
            z: simd.splat_f32s(self.place[2]),
            skip: simd.splat_u32s(self.skip),
        };
        for start in (0..LANES).step_by(S::F32_LANES) {
            let mut both = [simd.splat_f32s(0.0); 2];
            for run in self.runs {
                let mut base = run.start;
                while base + LANES <= run.end {
                    add(simd, &place, self.balls, base, &self.balls.weight[base..], start, &mut both);
                    base += LANES;
                }
                if base < run.end {
                    let mut weights = [0.0f32; LANES];
                    weights[..run.end - base].copy_from_slice(&self.balls.weight[base..run.end]);
                    add(simd, &place, self.balls, base, &weights, start, &mut both);
                }
            }
            store::<S>(both[0], &mut sums.whole, start);
            store::<S>(both[1], &mut sums.part, start);
        }
        sums
    }
}

/// A place in every lane.
struct Place<S: Simd> {
    x: S::f32s,
    y: S::f32s,
    z: S::f32s,
    skip: S::u32s,
}

/// The register from `start` on of sixteen numbers from `base` on.
#[inline(always)]
fn load<S: Simd>(from: &[f32], base: usize, start: usize) -> S::f32s {
    S::as_simd_f32s(&from[base + start..base + start + S::F32_LANES]).0[0]
}

#[inline(always)]
fn store<S: Simd>(value: S::f32s, to: &mut [f32; LANES], start: usize) {
    S::as_mut_simd_f32s(&mut to[start..start + S::F32_LANES]).0[0] = value;
}

/// Adds the balls of one register.
#[inline(always)]
fn add<S: Simd>(
    simd: S,
    place: &Place<S>,
    balls: &Balls,
    base: usize,
    weights: &[f32],
    start: usize,
    sums: &mut [S::f32s; 2],
) {
    let (zero, one) = (simd.splat_f32s(0.0), simd.splat_f32s(1.0));
    let dx = simd.sub_f32s(place.x, load::<S>(&balls.across[0], base, start));
    let dy = simd.sub_f32s(place.y, load::<S>(&balls.across[1], base, start));
    let from = simd.sub_f32s(place.z, load::<S>(&balls.along, base, start));
    let away = simd.add_f32s(simd.mul_f32s(dx, dx), simd.mul_f32s(dy, dy));
    let inside = simd.max_f32s(simd.sub_f32s(one, away), zero);
    let half = simd.sqrt_f32s(inside);
    let from = simd.max_f32s(simd.min_f32s(from, half), simd.sub_f32s(zero, half));
    let group = &balls.group[base + start..base + start + S::F32_LANES];
    let is_own = simd.equal_u32s(S::as_simd_u32s(group).0[0], place.skip);
    let weight = simd.select_f32s(is_own, zero, load::<S>(weights, 0, start));
    // The integral of (1 - r^2)^2 along the chord, from its middle on.
    let (squared, square) = (simd.mul_f32s(inside, inside), simd.mul_f32s(from, from));
    let whole = simd.mul_f32s(simd.mul_f32s(half, squared), simd.splat_f32s(8.0 / 15.0));
    let fifth = simd.mul_f32s(square, simd.splat_f32s(0.2));
    let rest = simd.sub_f32s(fifth, simd.mul_f32s(inside, simd.splat_f32s(2.0 / 3.0)));
    let part = simd.mul_f32s(from, simd.add_f32s(squared, simd.mul_f32s(square, rest)));
    sums[0] = simd.add_f32s(sums[0], simd.mul_f32s(weight, whole));
    sums[1] = simd.add_f32s(sums[1], simd.mul_f32s(weight, part));
}
