//! What a leaf is, texel by texel.

use glam::DVec3;
use rayon::prelude::*;

/// A leaf is nowhere thinner than this, mm: quantized maps say 0 where they mean thin.
pub const LEAST_THICKNESS_MM: f64 = 1e-4;
/// Texels that one task looks at.
const CHUNK: usize = 1 << 17;
/// The range of nothing.
const NONE: (f32, f32) = (f32::MAX, 0.0);

/// Maps of one side that light falls on. Rows run from the top; in normals x is right, y is up, z is out of the lit side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafMap {
    /// Texels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Thickness, mm; 0 where there is no leaf.
    pub thickness_mm: Vec<f32>,
    /// Unit normals of the lit side; empty for a flat one.
    pub normals: Vec<[f32; 3]>,
}

impl LeafMap {
    /// Least and greatest thickness; `None` where there is no leaf at all.
    pub fn range_mm(&self) -> Option<(f64, f64)> {
        let wider = |(a, b): (f32, f32), (c, d): (f32, f32)| (a.min(c), b.max(d));
        let of = |row: &[f32]| row.iter().filter(|d| **d > 0.0).fold(NONE, |range, d| wider(range, (*d, *d)));
        let (least, greatest) = self.thickness_mm.par_chunks(CHUNK).map(of).reduce(|| NONE, wider);
        (greatest > 0.0)
            .then(|| (f64::from(least).max(LEAST_THICKNESS_MM), f64::from(greatest).max(LEAST_THICKNESS_MM)))
    }

    /// Median thickness over the leaf, mm.
    pub fn median_mm(&self) -> Option<f64> {
        // Bits of numbers above 0 are ordered as they are: first those of a bin of the upper half are counted.
        let bin = |d: f32| (d.to_bits() >> 16) as usize;
        let count = |mut bins: Vec<usize>, row: &[f32]| {
            row.iter().filter(|d| **d > 0.0).for_each(|d| bins[bin(*d)] += 1);
            bins
        };
        let none = || vec![0usize; 1 << 15];
        let bins = self.thickness_mm.par_chunks(CHUNK).fold(none, count);
        let bins: Vec<usize> = bins.reduce(none, |a, b| a.iter().zip(b).map(|(a, b)| a + b).collect());
        let mut left = bins.iter().sum::<usize>() / 2;
        let at = bins.iter().position(|count| {
            let is_here = left < *count;
            left -= if is_here { 0 } else { *count };
            is_here
        })?;
        let here = |row: &[f32]| row.iter().copied().filter(|d| *d > 0.0 && bin(*d) == at).collect::<Vec<f32>>();
        let mut same: Vec<f32> = self.thickness_mm.par_chunks(CHUNK).flat_map_iter(here).collect();
        Some(f64::from(*same.select_nth_unstable_by(left, f32::total_cmp).1))
    }

    /// Normal of a texel.
    pub fn normal(&self, at: usize) -> [f32; 3] {
        self.normals.get(at).copied().unwrap_or([0.0, 0.0, 1.0])
    }
}

/// Unit normals of a height map (mm, rows from the top), by differences over two texels; at the rim of the map over one.
pub fn normals_from_heights(heights: &[f32], width: usize, texel_mm: [f64; 2]) -> Vec<[f32; 3]> {
    let rows = heights.len() / width.max(1);
    let slope = |low: usize, high: usize, steps: usize, texel: f64| {
        if steps == 0 { 0.0 } else { f64::from(heights[high] - heights[low]) / (steps as f64 * texel) }
    };
    let normal = |at: usize| {
        let (x, y) = (at % width, at / width);
        let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
        let (above, below) = (y.saturating_sub(1), (y + 1).min(rows - 1));
        let right_slope = slope(y * width + left, y * width + right, right - left, texel_mm[0]);
        let down_slope = slope(above * width + x, below * width + x, below - above, texel_mm[1]);
        // y is up, rows run down.
        DVec3::new(-right_slope, down_slope, 1.0).normalize().as_vec3().to_array()
    };
    (0..heights.len()).into_par_iter().map(normal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::radical_inverse;

    #[test]
    fn range_and_median_are_those_of_a_sorted_leaf() {
        for count in [1, 2, 7, 1000, 2 * CHUNK + 3] {
            let value = |at: u64| if at % 3 == 1 { 0.0 } else { 0.1 + 0.2 * radical_inverse(at, 2) as f32 };
            let map = LeafMap { thickness_mm: (0..count as u64).map(value).collect(), ..LeafMap::default() };
            let mut sorted: Vec<f32> = map.thickness_mm.iter().copied().filter(|d| *d > 0.0).collect();
            sorted.sort_unstable_by(f32::total_cmp);
            let at = |i: usize| f64::from(sorted[i]);
            assert_eq!(map.median_mm(), Some(at(sorted.len() / 2)), "{count}");
            assert_eq!(map.range_mm(), Some((at(0), at(sorted.len() - 1))), "{count}");
        }
        let none = LeafMap { thickness_mm: vec![0.0; 5], ..LeafMap::default() };
        assert_eq!((none.median_mm(), none.range_mm()), (None, None));
    }
}
