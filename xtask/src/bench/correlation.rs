//! Whether leaves deep in a crown are darker than those at its rim.
//! Depth under the crown is [`crown_depth`], which docs/ARCHITECTURE.md explains.

use super::{Figure, density};
use crate::shared_trees;
use anyhow::{Result, ensure};
use foliar_bake::Layer;
use foliar_density::crown_depth;
use foliar_numerics::spearman;
use foliar_plant::Plant;
use foliar_schema::names;
use serde_json::json;

/// Trees with fewer leaves say little about ranks.
const LEAST_LEAVES: usize = 500;
/// Trees with fewer leaves need not have an inside.
const LEAST_FOR_RIM: usize = 100;
/// Steps of k_a that an eye may see, in 1.
const STEPS: f64 = 255.0;

/// The worst (greatest) correlation over the trees of leaves, by default.
pub fn sky() -> Result<Figure> {
    worst_correlation(false, "sky")
}

/// The same by eq. 4.
pub fn luft() -> Result<Figure> {
    worst_correlation(false, "luft")
}

/// The same over the crown volumes, by default.
pub fn crown_volumes() -> Result<Figure> {
    worst_correlation(true, "sky")
}

/// The least that the inside of a crown is darker than its rim.
pub fn rim_less_inside() -> Result<Figure> {
    let steps = |plant: &Plant, layer: &Layer| {
        let (rim, inside) = rim_and_inside(plant, layer);
        (rim - inside) * STEPS
    };
    over_trees(false, LEAST_FOR_RIM, "sky", f64::min, steps)
}

fn worst_correlation(crown_volumes: bool, ambient: &str) -> Result<Figure> {
    let correlation = |plant: &Plant, layer: &Layer| of(plant, layer).unwrap_or(0.0);
    over_trees(crown_volumes, LEAST_LEAVES, ambient, f64::max, correlation)
}

/// The worst of a figure over all shared trees with so many leaves (or rows sampled from crown volumes: these
/// lie on one surface, and none deeper than another).
fn over_trees(
    crown_volumes: bool,
    least: usize,
    ambient: &str,
    worse: fn(f64, f64) -> f64,
    figure: impl Fn(&Plant, &Layer) -> f64,
) -> Result<Figure> {
    let (mut worst, mut at) = (f64::NAN, Vec::new());
    for tree in shared_trees::all()? {
        let plant = tree.read()?.plant;
        if plant.leaves().iter().filter(|leaf| leaf.crown_volume == crown_volumes).count() < least {
            continue;
        }
        let value = figure(&plant, &density::bake_as(&plant, json!({ "ambient": ambient }))?);
        ensure!(!value.is_nan(), "{}: nothing to judge", tree.name);
        worst = worse(worst, value);
        at.push(format!("{} {value:.2}", tree.name));
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
