//! The four trees that density is judged on. They and their seeds were chosen before anything was measured
//! on them, and stay: see docs/tradeoff/density.md.

use crate::shared_trees;
use anyhow::{Context, Result};
use foliar_plant::{Plant, sample::Recipe};

/// A tree of the comparison.
pub struct Tree {
    /// What tables call it.
    pub name: &'static str,
    /// What it is like.
    pub what: &'static str,
    /// The plant.
    pub plant: Plant,
}

/// The first generated tree.
pub const FIRST: &str = "bench_40k";

/// Two trees by rule, two of other people's generators: single leaves and sprays, crossed cards, strands.
pub fn all() -> Result<Vec<Tree>> {
    Ok(vec![
        first(),
        Tree { name: "linden", what: "by rule, seed 7: sprays on a young tree", plant: Recipe::linden().grow() },
        shared("ez_ash_large_12k", "crossed cards, each a whole twig; dense boughs")?,
        shared("sapling_birch_12k", "single small leaves on hanging strands, much air")?,
    ])
}

/// The first tree alone.
pub fn first() -> Tree {
    Tree { name: FIRST, what: "by rule, seed 3: 40,000 flat sprays", plant: Recipe::bench_40k().grow() }
}

fn shared(name: &'static str, what: &'static str) -> Result<Tree> {
    let file = format!("{name}/tree.obj");
    let tree = shared_trees::all()?.into_iter().find(|tree| tree.name == file);
    let tree = tree.with_context(|| format!("expected.json does not list {file}"))?;
    Ok(Tree { name, what, plant: tree.read()?.plant })
}
