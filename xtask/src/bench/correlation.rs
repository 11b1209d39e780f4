//! Whether leaves deep in a crown are darker than those at its rim.
//!
//! Depth under the crown of a leaf, as docs/ARCHITECTURE.md defines it: from the leaf's center look along
//! 32 directions spread over the sphere; along each, the crown ends at the last leaf whose center is
//! within a twentieth of the crown's size of the ray; the depth is the mean of these 32 distances. It
//! knows the outline of the crown alone, not how many leaves are on the way.

use super::{Figure, density};
use crate::shared_trees;
use anyhow::Result;
use foliar_bake::Layer;
use foliar_numerics::{fibonacci_sphere, spearman};
use foliar_plant::Plant;
use foliar_schema::names;
use glam::DVec3;
use rayon::prelude::*;

/// Trees with fewer leaves say little about ranks.
const LEAST_LEAVES: usize = 500;
/// Leaves that are asked, evenly over the ids.
const ASKED: usize = 512;
const DIRECTIONS: usize = 32;
/// Reach beside a ray, of the crown's size.
const REACH: f64 = 0.05;

/// The worst (greatest) correlation over all shared trees.
pub fn worst() -> Result<Figure> {
    let (mut worst, mut at) = (-1.0, Vec::new());
    for tree in shared_trees::all()? {
        let plant = tree.read()?.plant;
        if plant.leaves().len() < LEAST_LEAVES {
            continue;
        }
        let correlation = of(&plant, &density::bake(&plant)?).unwrap_or(0.0);
        worst = f64::max(worst, correlation);
        at.push(format!("{} {correlation:.2}", tree.name));
    }
    Ok(Figure::new(worst, format!("none; {}", at.join(", "))))
}

/// Correlation of the ambient coefficient with depth over a plant's leaves.
pub fn of(plant: &Plant, layer: &Layer) -> Option<f64> {
    let (depths, ambients): (Vec<f64>, Vec<f64>) = by_depth(plant, layer).into_iter().unzip();
    spearman(&ambients, &depths)
}

/// Mean ambient coefficient of the quarter of the leaves nearest to the rim, and of the deepest quarter.
pub fn rim_and_inside(plant: &Plant, layer: &Layer) -> (f64, f64) {
    let leaves = by_depth(plant, layer);
    let quarter = leaves.len().div_ceil(4);
    let mean = |leaves: &[(f64, f64)]| leaves.iter().map(|l| l.1).sum::<f64>() / leaves.len() as f64;
    (mean(&leaves[..quarter]), mean(&leaves[leaves.len() - quarter..]))
}

/// Depth and ambient coefficient of the leaves that are asked, by depth.
fn by_depth(plant: &Plant, layer: &Layer) -> Vec<(f64, f64)> {
    let ambient = ambient_of_leaves(plant, layer);
    let count = plant.leaves().len();
    let asked: Vec<usize> = (0..ASKED.min(count)).map(|i| i * count / ASKED.min(count)).collect();
    let asked: Vec<usize> = asked.into_iter().filter(|&leaf| ambient[leaf].is_finite()).collect();
    let mut leaves: Vec<(f64, f64)> =
        depths(plant, &asked).into_iter().zip(asked.iter().map(|&leaf| ambient[leaf])).collect();
    leaves.sort_by(|a, b| a.0.total_cmp(&b.0));
    leaves
}

/// Mean over each leaf's vertices; NaN for leaves without vertices.
fn ambient_of_leaves(plant: &Plant, layer: &Layer) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); plant.leaves().len()];
    for (index, part) in plant.parts().iter().enumerate() {
        let values = layer.attribute(part.place, names::AMBIENT).and_then(|array| array.as_f32()).unwrap_or_default();
        for (vertex, value) in values.iter().enumerate() {
            if let Some(leaf) = plant.leaf_of(index, vertex) {
                let sum: &mut (f64, f64) = &mut sums[leaf as usize];
                *sum = (sum.0 + f64::from(*value), sum.1 + 1.0);
            }
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

fn depths(plant: &Plant, asked: &[usize]) -> Vec<f64> {
    let centers: Vec<DVec3> = plant.leaves().iter().map(|leaf| leaf.center.as_dvec3() - plant.center()).collect();
    let low = centers.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = centers.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let reach = (REACH * (high - low).max_element()).powi(2);
    let rays: Vec<DVec3> = (0..DIRECTIONS).map(|i| fibonacci_sphere(i, DIRECTIONS)).collect();
    let depth = |&leaf: &usize| {
        let mut ends = [0.0f64; DIRECTIONS];
        for arm in centers.iter().map(|c| *c - centers[leaf]) {
            for (end, ray) in ends.iter_mut().zip(&rays) {
                let along = arm.dot(*ray);
                if along > *end && arm.length_squared() - along * along < reach {
                    *end = along;
                }
            }
        }
        ends.iter().sum::<f64>() / DIRECTIONS as f64
    };
    asked.par_iter().map(depth).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_ball_is_deepest() {
        let plants = foliar_plant::sample::odd_plants();
        let plant = &plants.iter().find(|s| s.name == "small-tree").unwrap().plant;
        let all: Vec<usize> = (0..plant.leaves().len()).collect();
        let depths = depths(plant, &all);
        let middle = plant.leaves().iter().map(|l| l.center.as_dvec3()).sum::<DVec3>() / all.len() as f64;
        let from_middle: Vec<f64> = plant.leaves().iter().map(|l| l.center.as_dvec3().distance(middle)).collect();
        assert!(spearman(&from_middle, &depths).unwrap() < -0.5);
    }
}
