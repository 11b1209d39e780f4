//! Heights: two maps of them are a leaf; normals follow from one.

use super::Scan;
use glam::DVec3;
use rayon::prelude::*;

/// Leaf between two height maps in mm, each outward from one middle plane; there is no leaf where both together are not
/// above 0.
pub fn between_heights(front: &[f32], back: &[f32], width: usize, texel_mm: [f64; 2]) -> Scan {
    let mut scan = Scan::empty(width, front.len() / width.max(1), texel_mm);
    for (at, (front, back)) in front.iter().zip(back).enumerate() {
        let thickness = front + back;
        if thickness > 0.0 {
            scan.thickness_mm[at] = thickness;
            (scan.heights_mm[0][at], scan.heights_mm[1][at]) = (*front, *back);
        }
    }
    scan.with_normals()
}

/// Unit normals of heights, by differences that never leave the leaf: over two texels, at its rim over one.
pub fn normals_within(
    heights: &[f32],
    width: usize,
    texel_mm: [f64; 2],
    leaf: &(impl Fn(usize) -> bool + Sync),
) -> Vec<[f32; 3]> {
    let rows = heights.len() / width.max(1);
    // From `at` to its neighbors before and behind on one axis, where those are leaf.
    let slope = |at: usize, before: Option<usize>, behind: Option<usize>, texel: f64| {
        let low = before.filter(|i| leaf(*i)).map_or((at, 0.0), |i| (i, 1.0));
        let high = behind.filter(|i| leaf(*i)).map_or((at, 0.0), |i| (i, 1.0));
        let steps = low.1 + high.1;
        if steps > 0.0 { f64::from(heights[high.0] - heights[low.0]) / (steps * texel) } else { 0.0 }
    };
    let normal = |at: usize| {
        if !leaf(at) {
            return [0.0, 0.0, 1.0];
        }
        let (x, y) = (at % width, at / width);
        let right = slope(at, (x > 0).then(|| at - 1), (x + 1 < width).then(|| at + 1), texel_mm[0]);
        let down = slope(at, (y > 0).then(|| at - width), (y + 1 < rows).then(|| at + width), texel_mm[1]);
        // y is up, rows run down.
        DVec3::new(-right, down, 1.0).normalize().as_vec3().to_array()
    };
    (0..heights.len()).into_par_iter().map(normal).collect()
}
