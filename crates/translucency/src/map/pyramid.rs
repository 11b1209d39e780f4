//! Images of three channels, halved; rows filtered across and down.

use crate::kernel::Taps;
use foliar_numerics::Isa;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// Binomial halving: variance 1 texel squared, and nothing of the highest wave.
const HALVING: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// Cells that a halved image has before the first and after the last texel of the full one: light spreads beyond the
/// rim, and comes back from there when the image is drawn up.
const BEFORE: usize = 1;
const AFTER: usize = 2;

/// Three numbers per texel, row after row; outside is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    data: Vec<f32>,
    /// Size of the full image, and how often this one was halved.
    full: [usize; 2],
    level: usize,
}

impl Image {
    /// A full image.
    pub fn new(width: usize, height: usize, data: Vec<f32>) -> Image {
        Image { width, height, data, full: [width, height], level: 0 }
    }

    /// Three numbers of each texel.
    pub fn texels(&self) -> &[f32] {
        &self.data
    }

    #[inline(always)]
    pub fn row(&self, y: usize) -> &[f32] {
        &self.data[y * self.width * 3..(y + 1) * self.width * 3]
    }

    fn before(&self) -> usize {
        if self.level > 0 { BEFORE } else { 0 }
    }

    /// Every second texel of the image, smoothed; the first stays in place.
    pub fn halved(&self) -> Image {
        let level = self.level + 1;
        let [width, height] = self.full.map(|n| (n.saturating_sub(1) >> level) + 1 + BEFORE + AFTER);
        let mut data = vec![0.0; width * height * 3];
        // Cell c of the halved image lies at 2 (c - BEFORE) of this one; its taps start two before.
        let start = 2 * BEFORE + 2 - self.before();
        let length = (self.width + start).max(2 * width + 5) * 3;
        data.par_chunks_exact_mut(width * 3).enumerate().for_each_init(
            || vec![0.0; length],
            |padded, (y, out)| {
                padded.fill(0.0);
                let column = &mut padded[3 * start..3 * (start + self.width)];
                for (k, tap) in HALVING.iter().enumerate() {
                    if let Some(from) = (2 * y + k).checked_sub(start).filter(|from| *from < self.height) {
                        column.iter_mut().zip(self.row(from)).for_each(|(sum, v)| *sum += tap * v);
                    }
                }
                for (x, texel) in out.chunks_exact_mut(3).enumerate() {
                    for (c, value) in texel.iter_mut().enumerate() {
                        *value = (0..5).map(|k| HALVING[k] * padded[(2 * x + k) * 3 + c]).sum();
                    }
                }
            },
        );
        Image { width, height, data, level, full: self.full }
    }

    /// The texels `columns` of a row filtered both ways, into the same place of `out`; `padded` is room for them and their
    /// surroundings.
    #[inline(always)]
    pub fn filtered_row(
        &self,
        y: usize,
        (across, down): (&Taps, &Taps),
        columns: &Range<usize>,
        padded: &mut Vec<f32>,
        out: &mut [f32],
    ) {
        let reach = across.radius();
        let sources = columns.start.saturating_sub(reach)..(columns.end + reach).min(self.width);
        let before = 3 * (sources.start + reach - columns.start);
        padded.clear();
        padded.resize(3 * (columns.len() + 2 * reach), 0.0);
        self.column(y, down, &sources, &mut padded[before..before + 3 * sources.len()]);
        let out = &mut out[3 * columns.start..3 * columns.end];
        let middle = &padded[3 * reach..];
        out.iter_mut().zip(middle).for_each(|(sum, v)| *sum = across.0[0] * v);
        for (k, tap) in across.0.iter().enumerate().skip(1) {
            let (left, right) = (&padded[3 * (reach - k)..], &padded[3 * (reach + k)..]);
            out.iter_mut().zip(left.iter().zip(right)).for_each(|(sum, (a, b))| *sum += tap * (a + b));
        }
    }

    #[inline(always)]
    fn column(&self, y: usize, down: &Taps, columns: &Range<usize>, out: &mut [f32]) {
        let row = |y: usize| &self.row(y)[3 * columns.start..3 * columns.end];
        out.iter_mut().zip(row(y)).for_each(|(sum, v)| *sum = down.0[0] * v);
        for (k, tap) in down.0.iter().enumerate().skip(1) {
            match (y.checked_sub(k), (y + k < self.height).then_some(y + k)) {
                (Some(above), Some(below)) => {
                    let pairs = row(above).iter().zip(row(below));
                    out.iter_mut().zip(pairs).for_each(|(sum, (a, b))| *sum += tap * (a + b));
                }
                (Some(one), None) | (None, Some(one)) => {
                    out.iter_mut().zip(row(one)).for_each(|(sum, v)| *sum += tap * v);
                }
                (None, None) => break,
            }
        }
    }

    /// The whole image filtered.
    pub fn filtered(&self, taps: (&Taps, &Taps), isa: Isa) -> Image {
        let mut data = vec![0.0; self.data.len()];
        data.par_chunks_exact_mut(self.width * 3).enumerate().for_each_init(Vec::new, |padded, (y, out)| {
            isa.dispatch(Filtered { image: self, y, taps, padded, out });
        });
        Image { data, ..*self }
    }

    /// Row `y` of the full image by straight lines between cells, into `out`.
    #[inline(always)]
    pub fn drawn_up(&self, y: usize, coarse: &mut Vec<f32>, out: &mut [f32]) {
        let span = 1usize << self.level;
        let (top, share) = ((y >> self.level) + self.before(), (y & (span - 1)) as f32 / span as f32);
        coarse.clear();
        let pairs = self.row(top).iter().zip(self.row(top + 1)).skip(3 * self.before());
        coarse.extend(pairs.map(|(a, b)| a + share * (b - a)));
        for (i, group) in out.chunks_mut(3 * span).enumerate() {
            let [a, b] = [&coarse[3 * i..3 * i + 3], &coarse[3 * i + 3..3 * i + 6]];
            for (step, texel) in group.chunks_exact_mut(3).enumerate() {
                let share = step as f32 / span as f32;
                (0..3).for_each(|c| texel[c] = a[c] + share * (b[c] - a[c]));
            }
        }
    }
}

/// One row of an image, filtered.
struct Filtered<'a> {
    image: &'a Image,
    y: usize,
    taps: (&'a Taps, &'a Taps),
    padded: &'a mut Vec<f32>,
    out: &'a mut [f32],
}

impl WithSimd for Filtered<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.image.filtered_row(self.y, self.taps, &(0..self.image.width), self.padded, self.out);
    }
}
