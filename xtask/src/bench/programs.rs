//! Whole programs, and pictures.

use super::{Figure, density, least_seconds};
use crate::repo;
use anyhow::Result;
use foliar_plant::sample::Recipe;
use foliar_view::{Shading, ViewParams};
use std::process::Command;

/// Wall time of `foliar bake` on a tree of 12,000 leaves.
pub fn bake() -> Result<Figure> {
    repo::run(repo::cargo().args([
        "build",
        "--release",
        "--quiet",
        "--package",
        "foliar-programs",
        "--bin",
        "foliar",
    ]))?;
    let tree = repo::shared().join("trees/sapling_birch_12k/tree.obj");
    let output = repo::root().join("target/bench/birch.glb");
    std::fs::create_dir_all(repo::root().join("target/bench"))?;
    let seconds = least_seconds(3, || {
        // An output that is there already would be left untouched, which costs less.
        let _ = std::fs::remove_file(&output);
        let mut foliar = Command::new(repo::build_folder().join("release/foliar"));
        foliar.args(["bake", "--quiet", "--unit", "m", "--up", "y"]).arg(&tree).arg("-o").arg(&output);
        repo::run(&mut foliar)
    })?;
    Ok(Figure::new(seconds, "none"))
}

/// Seconds of tracing the benchmark tree, as baked, with its textures.
pub fn picture() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let layer = density::bake(&plant)?;
    let params = ViewParams { width_px: 960, height_px: 720, samples: 16, ..ViewParams::default() };
    let seconds = least_seconds(3, || Ok(foliar_view::render(&plant, &[&layer], &Shading::Baked, &params).map(drop)?))?;
    Ok(Figure::new(seconds, "none"))
}
