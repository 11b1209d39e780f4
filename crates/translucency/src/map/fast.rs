//! The bank of Gaussians over a whole map: rows are independent, so any number of threads gives the same bytes.

use super::pyramid::Image;
use super::{LeafMap, Tables};
use crate::light::BASIS;
use foliar_numerics::Isa;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

/// Rows that one task takes.
const ROWS: usize = 8;

/// Coefficients of every texel (three, interleaved), row by row; zero where there is no leaf.
pub fn coefficient_map(map: &LeafMap, tables: &Tables) -> Vec<f32> {
    coefficient_map_on(map, tables, Isa::best())
}

/// The same on chosen instructions: the same bits.
pub(crate) fn coefficient_map_on(map: &LeafMap, tables: &Tables, isa: Isa) -> Vec<f32> {
    let mut levels = vec![entered(map, tables)];
    let deepest = tables.bank.filters.iter().map(|filter| filter.level).max().unwrap_or(0);
    for level in 0..deepest {
        let next = levels[level].halved();
        levels.push(next);
    }
    // Filters of halved images run first: they are small. Those of the full image run row by row.
    let wide: Vec<Option<Image>> = tables
        .bank
        .filters
        .iter()
        .map(|filter| (filter.level > 0).then(|| levels[filter.level].filtered((&filter.x, &filter.y), isa)))
        .collect();
    levels.truncate(1);
    let full = &levels[0];
    let mut out = vec![0.0; map.width * map.height * 3];
    out.par_chunks_mut(map.width.max(1) * 3 * ROWS).enumerate().for_each_init(Rows::default, |rows, (block, out)| {
        for (i, out) in out.chunks_exact_mut(map.width * 3).enumerate() {
            isa.dispatch(Mix { map, tables, full, wide: &wide, y: block * ROWS + i, rows, out });
        }
    });
    out
}

/// What every texel takes in, as coefficients over the transmittance from straight ahead.
fn entered(map: &LeafMap, tables: &Tables) -> Image {
    let basis = BASIS.map(|b| b.as_vec3());
    let mut data = vec![0.0f32; map.width * map.height * 3];
    data.par_chunks_mut(map.width.max(1) * 3).enumerate().for_each(|(y, row)| {
        for (x, texel) in row.chunks_exact_mut(3).enumerate() {
            let at = y * map.width + x;
            let d = map.thickness_mm[at];
            if d > 0.0 {
                let [nx, ny, nz] = map.normal(at);
                let [tilt, axis] = tables.source(d, nz);
                (0..3).for_each(|c| texel[c] = tilt * (basis[c].x * nx + basis[c].y * ny) + axis * basis[c].z);
            }
        }
    });
    Image::new(map.width, map.height, data)
}

/// Room for the rows of one task.
#[derive(Default)]
struct Rows {
    padded: Vec<f32>,
    filters: Vec<Vec<f32>>,
}

/// One row of the map.
struct Mix<'a> {
    map: &'a LeafMap,
    tables: &'a Tables,
    full: &'a Image,
    wide: &'a [Option<Image>],
    y: usize,
    rows: &'a mut Rows,
    out: &'a mut [f32],
}

impl WithSimd for Mix<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Mix { map, tables, full, wide, y, rows, out } = self;
        let thickness = &map.thickness_mm[y * map.width..(y + 1) * map.width];
        let Some(first) = thickness.iter().position(|d| *d > 0.0) else { return };
        let last = thickness.iter().rposition(|d| *d > 0.0).unwrap_or(first);
        // Beside the leaf nothing leaves.
        let columns = first..last + 1;
        rows.filters.resize_with(wide.len(), Vec::new);
        for ((row, filter), wide) in rows.filters.iter_mut().zip(&tables.bank.filters).zip(wide) {
            // A texel's three numbers are read as four.
            row.resize(out.len() + 1, 0.0);
            match wide {
                Some(image) => image.drawn_up(y, &mut rows.padded, &mut row[..out.len()]),
                None => full.filtered_row(y, (&filter.x, &filter.y), &columns, &mut rows.padded, row),
            }
        }
        for (x, d) in thickness.iter().enumerate().filter(|(_, d)| **d > 0.0) {
            let weights = tables.mix(*d);
            let mut sum = [0.0f32; 4];
            for (row, weight) in rows.filters.iter().zip(weights) {
                let texel = &row[3 * x..3 * x + 4];
                (0..4).for_each(|c| sum[c] += weight * texel[c]);
            }
            out[3 * x..3 * x + 3].copy_from_slice(&sum[..3]);
        }
    }
}
