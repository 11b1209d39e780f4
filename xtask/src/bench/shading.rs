//! The default bake against traced light: `cargo xtask tradeoff density` says the same and more.

use super::Figure;
use crate::tradeoff::{judged::of_default, light::Light, trees};
use anyhow::{Context, Result};
use foliar_density::crown_depth;
use foliar_numerics::spearman;

/// Correlation of realigned normals with traced shading on the first tree.
pub fn correlation() -> Result<Figure> {
    let tree = trees::first();
    let [_, correlation] = of_default(&tree.plant)?;
    Ok(Figure::new(correlation, format!("none; rays on {}", tree.name)))
}

/// Variance of traced light that the ambient term explains: third best of the four trees.
pub fn third_best() -> Result<Figure> {
    explained(2)
}

/// The same on the worst.
pub fn worst() -> Result<Figure> {
    explained(3)
}

/// Rank correlation of traced light itself with depth under the crown, on the tree where it is greatest: what a
/// term that explained all of the light would have.
pub fn traced_depth() -> Result<Figure> {
    let (mut worst, mut list) = (f64::NEG_INFINITY, Vec::new());
    for tree in trees::all()? {
        let traced = Light::trace(&tree.plant)?.ambient();
        let rank = spearman(&traced, &crown_depth(&tree.plant)).with_context(|| format!("{}: no ranks", tree.name))?;
        worst = worst.max(rank);
        list.push(format!("{} {rank:.3}", tree.name));
    }
    Ok(Figure::new(worst, format!("none; rays on {}", list.join(", "))))
}

fn explained(rank: usize) -> Result<Figure> {
    let mut shares = Vec::new();
    for tree in trees::all()? {
        shares.push((of_default(&tree.plant)?[0], tree.name));
    }
    shares.sort_by(|a, b| b.0.total_cmp(&a.0));
    let list: Vec<String> = shares.iter().map(|(share, name)| format!("{name} {share:.3}")).collect();
    Ok(Figure::new(shares[rank].0, format!("none; rays on {}", list.join(", "))))
}
