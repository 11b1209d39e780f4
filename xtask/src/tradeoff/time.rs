//! The README's table: what a tree costs to bake at several accuracies, and how far off it is then.

use super::{replaced, rungs, tables, trees};
use crate::repo;
use anyhow::{Context, Result};

const README: &str = "README.md";
/// Rungs of the room's default, coarse to fine: `quality` 4, 1 and 0.25.
const RUNGS: [&str; 3] = ["sky-4", "sky", "sky-0.25"];

/// Measures, prints, and writes the README's table.
pub fn run() -> Result<()> {
    let mut rows = Vec::new();
    for tree in trees::all()? {
        eprintln!("{}", tree.name);
        for rung in rungs::climb(&tree.plant, |name| RUNGS.contains(&name))? {
            rows.push((tree.name, tree.plant.leaves().len(), rung));
        }
    }
    let table = tables::times(&rows);
    println!("{table}");
    std::fs::write(repo::root().join(README), replaced("time", &repo::text(README)?, &table)?).context(README)
}
