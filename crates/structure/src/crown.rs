//! Crown volumes: closed blobs that stand for foliage, sampled into virtual leaves.

use crate::geometry::{PartGeometry, double_area};
use crate::shape::PieceShape;
use foliar_numerics::r2_point;
use foliar_space::TriangleTree;
use glam::{DVec3, Vec3};

/// A virtual leaf.
pub(crate) struct Sample {
    pub center: DVec3,
    /// Unit, away from the inside.
    pub normal: DVec3,
    /// Coverage of the triangle that it lies on.
    pub coverage: f64,
}

/// How many virtual leaves a blob of this area gets.
pub(crate) fn sample_count(area: f64, spacing: f64) -> usize {
    // Counts beyond what ids can hold are refused later; the cast saturates.
    (area / (spacing * spacing)).round().max(1.0) as usize
}

/// Spreads `count` samples over a piece: the R2 sequence, whose first coordinate walks along the
/// triangles by area and whose second spreads across each, so that equal areas get equal numbers.
pub(crate) fn sample(
    part: &PartGeometry,
    piece: usize,
    shape: &PieceShape,
    coverage: &[f64],
    count: usize,
) -> Vec<Sample> {
    let triangles: Vec<u32> =
        part.pieces.triangles(piece).iter().copied().filter(|&t| part.has_area[t as usize]).collect();
    let mut sums = Vec::with_capacity(triangles.len());
    let mut sum = 0.0;
    for &triangle in &triangles {
        sum += double_area(part.corners(triangle)).length();
        sums.push(sum);
    }
    let side = if shape.volume < 0.0 { -1.0 } else { 1.0 };
    let place = |index: usize| {
        let point = r2_point(index as u64);
        let along = point.x * sum;
        let slot = sums.partition_point(|&s| s <= along).min(triangles.len() - 1);
        let before = if slot == 0 { 0.0 } else { sums[slot - 1] };
        let inside = ((along - before) / (sums[slot] - before)).clamp(0.0, 1.0);
        let corners = part.corners(triangles[slot]);
        Sample {
            center: on_triangle(corners, inside, point.y),
            normal: double_area(corners).normalize_or(DVec3::Y) * side,
            coverage: coverage[triangles[slot] as usize],
        }
    };
    (0..count).map(place).collect()
}

/// Maps the unit square to a triangle, equal areas to equal areas.
fn on_triangle([a, b, c]: [DVec3; 3], x: f64, y: f64) -> DVec3 {
    let root = x.sqrt();
    a * (1.0 - root) + b * (root * (1.0 - y)) + c * (root * y)
}

/// For each vertex of a piece (as listed) the sample nearest to it.
pub(crate) fn nearest_samples(
    samples: &[Sample],
    vertices: impl Iterator<Item = DVec3>,
    shape: &PieceShape,
) -> Vec<u32> {
    // A point is a triangle too. Coordinates relative to the piece and about 1 in size.
    let local = |p: DVec3| ((p - shape.center) / shape.spread).as_vec3();
    let points: Vec<[Vec3; 3]> = samples.iter().map(|s| [local(s.center); 3]).collect();
    let tree = TriangleTree::new(&points);
    vertices.map(|v| tree.closest(local(v)).map_or(0, |found| found.triangle)).collect()
}
