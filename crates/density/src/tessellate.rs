//! Leaves as triangles: the paper's primitives, and leaves larger than the radius of influence, sampled by area: their triangles are cut into small
//! pieces, and the pieces that fall into one voxel make one ball. How the leaf is cut into triangles
//! matters only as far as a piece is wider than nothing.

use foliar_plant::Plant;
use glam::DVec3;
use std::collections::BTreeMap;

/// Voxels per radius of influence: balls at the centroids of such voxels move k_a by .017 rms at 2 and
/// .0035 at 4 on a tree of 40,000 leaves.
const VOXELS_PER_RADIUS: f64 = 2.0;
/// Pieces per voxel edge.
const PIECES_PER_VOXEL: f64 = 3.0;
/// Most pieces of one plant: pieces grow beyond it.
const MOST_PIECES: f64 = 1e6;

/// Balls of large leaves: places relative to the plant's center, and shares of the leaf that sum to 1.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    balls: Vec<(DVec3, f64)>,
    /// Leaf and first ball, by leaf.
    starts: Vec<(u32, usize)>,
}

impl Spread {
    /// Cuts the leaves of which `is_large` holds.
    pub fn new(plant: &Plant, is_large: &dyn Fn(usize) -> bool, radius: f64) -> Spread {
        let triangles = large_triangles(plant, is_large);
        let area: f64 = triangles.iter().map(|(_, t)| triangle_area(t)).sum();
        // A piece is a triangle with two legs of about `piece`: half a square.
        let fewest = (2.0 * area / MOST_PIECES).sqrt();
        let piece = (radius / (VOXELS_PER_RADIUS * PIECES_PER_VOXEL)).max(fewest);
        let voxel = (radius / VOXELS_PER_RADIUS).max(fewest * PIECES_PER_VOXEL);
        let mut spread = Spread::default();
        for leaf in triangles.chunk_by(|a, b| a.0 == b.0) {
            spread.push(leaf, piece, voxel);
        }
        spread
    }

    /// The balls of a leaf, where it has several.
    pub fn of(&self, leaf: u32) -> Option<&[(DVec3, f64)]> {
        let index = self.starts.binary_search_by_key(&leaf, |s| s.0).ok()?;
        let end = self.starts.get(index + 1).map_or(self.balls.len(), |next| next.1);
        Some(&self.balls[self.starts[index].1..end])
    }

    fn push(&mut self, leaf: &[(u32, [DVec3; 3])], piece: f64, voxel: f64) {
        let mut voxels: BTreeMap<[i64; 3], (f64, DVec3)> = BTreeMap::new();
        let mut total = 0.0;
        for (_, triangle) in leaf {
            cut(triangle, piece, &mut |centroid, area| {
                let key = (centroid / voxel).floor().to_array().map(|v| v as i64);
                let sum = voxels.entry(key).or_default();
                sum.0 += area;
                sum.1 += centroid * area;
                total += area;
            });
        }
        if total > 0.0 {
            self.starts.push((leaf[0].0, self.balls.len()));
            self.balls.extend(voxels.into_values().map(|(area, moment)| (moment / area, area / total)));
        }
    }
}

/// Centers of mass of all triangles with area that belong to a leaf, relative to the plant's center, and their
/// leaves (the generators of Luft07 section 3).
pub(crate) fn primitives(plant: &Plant) -> Vec<(DVec3, u32)> {
    let mut found = Vec::new();
    for (index, part) in plant.parts().iter().enumerate() {
        for corners in &part.triangles {
            if let Some(leaf) = plant.leaf_of(index, corners[0] as usize) {
                let place = corners.map(|c| part.rest_position(c as usize) - plant.center());
                if triangle_area(&place) > 0.0 {
                    found.push(((place[0] + place[1] + place[2]) / 3.0, leaf));
                }
            }
        }
    }
    found
}

/// Triangles with area of large leaves, by leaf.
fn large_triangles(plant: &Plant, is_large: &dyn Fn(usize) -> bool) -> Vec<(u32, [DVec3; 3])> {
    let mut triangles = Vec::new();
    for (index, part) in plant.parts().iter().enumerate() {
        for corners in &part.triangles {
            if let Some(leaf) = plant.leaf_of(index, corners[0] as usize)
                && !plant.leaves()[leaf as usize].crown_volume
                && is_large(leaf as usize)
            {
                let place = corners.map(|c| part.rest_position(c as usize) - plant.center());
                if triangle_area(&place) > 0.0 {
                    triangles.push((leaf, place));
                }
            }
        }
    }
    triangles.sort_by_key(|t| t.0);
    triangles
}

fn triangle_area([a, b, c]: &[DVec3; 3]) -> f64 {
    (*b - *a).cross(*c - *a).length() / 2.0
}

/// Calls `each` with centroid and area of the equal pieces that a regular grid of n by n makes.
fn cut([a, b, c]: &[DVec3; 3], piece: f64, each: &mut dyn FnMut(DVec3, f64)) {
    let longest = (*b - *a).length().max((*c - *b).length()).max((*a - *c).length());
    let n = (longest / piece).ceil().clamp(1.0, 4096.0) as u32;
    let (u, v) = ((*b - *a) / f64::from(n), (*c - *a) / f64::from(n));
    let area = triangle_area(&[*a, *b, *c]) / f64::from(n) / f64::from(n);
    for i in 0..n {
        for j in 0..n - i {
            let corner = *a + u * f64::from(i) + v * f64::from(j);
            each(corner + (u + v) / 3.0, area);
            if i + j + 1 < n {
                each(corner + (u + v) * (2.0 / 3.0), area);
            }
        }
    }
}
