//! Whether leaves deep in a crown are darker than those at its rim.
//! Depth under the crown is [`crown_depth`], which docs/ARCHITECTURE.md explains.

use super::{Figure, density};
use crate::shared_trees;
use anyhow::Result;
use foliar_bake::Layer;
use foliar_density::crown_depth;
use foliar_numerics::spearman;
use foliar_plant::Plant;
use foliar_schema::names;

/// Trees with fewer leaves say little about ranks.
const LEAST_LEAVES: usize = 500;

/// The worst (greatest) correlation over all shared trees.
pub fn worst() -> Result<Figure> {
    let (mut worst, mut at) = (-1.0, Vec::new());
    for tree in shared_trees::all()? {
        let plant = tree.read()?.plant;
        // Rows of a crown volume are samples of one surface: none lies deeper than another.
        if plant.leaves().iter().filter(|leaf| !leaf.crown_volume).count() < LEAST_LEAVES {
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

/// Depth and ambient coefficient of every leaf that has vertices, by depth.
fn by_depth(plant: &Plant, layer: &Layer) -> Vec<(f64, f64)> {
    let leaves = crown_depth(plant).into_iter().zip(ambient_of_leaves(plant, layer));
    let mut leaves: Vec<(f64, f64)> = leaves.filter(|(_, ambient)| ambient.is_finite()).collect();
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
