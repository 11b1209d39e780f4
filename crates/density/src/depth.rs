//! How deep a leaf lies under the crown: geometry alone, no density, to judge ambient terms by.

use foliar_numerics::fibonacci_sphere;
use foliar_plant::Plant;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Directions over which depths are averaged.
const DIRECTIONS: usize = 64;
/// Edge of the cells that the crown is counted in, in radii of gyration of the leaves: a crown is some
/// twenty cells wide.
const CELL: f64 = 0.12;

/// Depth of each leaf under the crown, meters: the way through foliage from its center to the open, averaged
/// over 64 directions of the sphere. The way through foliage is counted in cubic cells (aligned with the
/// direction, 0.12 times the crown's radius of gyration wide): each cell that holds the center of any leaf
/// counts with its width, empty ones do not, so that bays between boughs are no depth.
pub fn crown_depth(plant: &Plant) -> Vec<f64> {
    let centers: Vec<DVec3> = plant.leaves().iter().map(|leaf| leaf.center.as_dvec3() - plant.center()).collect();
    let count = centers.len().max(1) as f64;
    let mean = centers.iter().sum::<DVec3>() / count;
    let gyration = (centers.iter().map(|c| (*c - mean).length_squared()).sum::<f64>() / count).sqrt();
    let width = CELL * gyration;
    if width <= 0.0 {
        return vec![0.0; centers.len()];
    }
    let arms: Vec<DVec3> = centers.iter().map(|center| (*center - mean) / width).collect();
    let cells: Vec<Vec<usize>> =
        (0..DIRECTIONS).into_par_iter().map(|i| cells_above(&arms, fibonacci_sphere(i, DIRECTIONS))).collect();
    let sum = |leaf: usize| cells.iter().map(|above| above[leaf]).sum::<usize>();
    (0..centers.len()).map(|leaf| width * sum(leaf) as f64 / DIRECTIONS as f64).collect()
}

/// Occupied cells between each place (in cells) and the open.
fn cells_above(arms: &[DVec3], toward: DVec3) -> Vec<usize> {
    let (u, v) = toward.any_orthonormal_pair();
    let cell = |arm: &DVec3| {
        let index = |axis: DVec3| arm.dot(axis).round() as i64;
        ([index(u), index(v)], index(toward))
    };
    let mut shafts: BTreeMap<[i64; 2], BTreeSet<i64>> = BTreeMap::new();
    for (shaft, along) in arms.iter().map(cell) {
        shafts.entry(shaft).or_default().insert(along);
    }
    let above = |(shaft, along): ([i64; 2], i64)| shafts[&shaft].range(along + 1..).count();
    arms.iter().map(cell).map(above).collect()
}
