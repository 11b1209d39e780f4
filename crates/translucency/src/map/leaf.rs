//! What a leaf is, texel by texel.

use glam::DVec3;
use rayon::prelude::*;

/// A leaf is nowhere thinner than this, mm: quantized maps say 0 where they mean thin.
pub const LEAST_THICKNESS_MM: f64 = 1e-4;

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
        let leaf = self.thickness_mm.iter().filter(|d| **d > 0.0);
        let (least, greatest) = leaf.fold((f32::MAX, 0.0f32), |(a, b), d| (a.min(*d), b.max(*d)));
        (greatest > 0.0)
            .then(|| (f64::from(least).max(LEAST_THICKNESS_MM), f64::from(greatest).max(LEAST_THICKNESS_MM)))
    }

    /// Median thickness over the leaf, mm.
    pub fn median_mm(&self) -> Option<f64> {
        let mut leaf: Vec<f32> = self.thickness_mm.iter().copied().filter(|d| *d > 0.0).collect();
        let middle = leaf.len() / 2;
        (!leaf.is_empty()).then(|| f64::from(*leaf.select_nth_unstable_by(middle, f32::total_cmp).1))
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
