//! Whole programs, and pictures.

use super::{Figure, density, least_seconds, translucency};
use crate::repo;
use anyhow::{Context, Result};
use foliar_plant::sample::Recipe;
use foliar_schema::names;
use foliar_translucency::map::by_rule::leaf_by_rule;
use foliar_view::{Shading, ViewParams};
use image::{ImageBuffer, Luma, Rgb};
use std::path::PathBuf;
use std::process::Command;

/// Builds a program in release; its path.
fn built(program: &str) -> Result<PathBuf> {
    let arguments = ["build", "--release", "--quiet", "--package", "foliar-programs", "--bin", program];
    repo::run(repo::cargo().args(arguments))?;
    Ok(repo::build_folder().join("release").join(program))
}

/// The folder of what is baked here.
fn folder() -> Result<PathBuf> {
    let folder = repo::root().join("target/bench");
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// Wall time of `foliar bake` on a tree of 12,000 leaves.
pub fn bake() -> Result<Figure> {
    let foliar = built("foliar")?;
    let tree = repo::shared().join("trees/sapling_birch_12k/tree.obj");
    let output = folder()?.join("birch.glb");
    let seconds = least_seconds(3, || {
        // An output that is there already would be left untouched, which costs less.
        let _ = std::fs::remove_file(&output);
        let mut foliar = Command::new(&foliar);
        foliar.args(["bake", "--quiet", "--unit", "m", "--up", "y"]).arg(&tree).arg("-o").arg(&output);
        repo::run(&mut foliar)
    })?;
    Ok(Figure::new(seconds, "none"))
}

/// Wall time of `foliar-translucency` from pictures of 16 bits to a map in EXR and PNG, 1024 texels a side.
fn leaf(arguments: &[&str]) -> Result<Figure> {
    const SIZE: usize = 1024;
    let program = built("foliar-translucency")?;
    let folder = folder()?;
    let thickest = 2.0;
    for (name, map) in translucency::maps(leaf_by_rule(SIZE)) {
        let (offset, scale) = if name == names::MAP_THICKNESS { (0.0, thickest) } else { (-1.0, 2.0) };
        let word = |value: &f32| ((f64::from(*value) - offset) / scale * 65_535.0).round() as u16;
        let words: Vec<u16> = map.raster.data.iter().map(word).collect();
        let path = folder.join(format!("{name}.png"));
        let size = SIZE as u32;
        match map.raster.channels {
            1 => ImageBuffer::<Luma<u16>, _>::from_raw(size, size, words).context("no picture")?.save(&path)?,
            _ => ImageBuffer::<Rgb<u16>, _>::from_raw(size, size, words).context("no picture")?.save(&path)?,
        }
    }
    let output = folder.join("leaf.exr");
    let seconds = least_seconds(5, || {
        let _ = std::fs::remove_file(&output);
        let mut program = Command::new(&program);
        program.args(["--quiet", "--leaf-width-mm", "80", "--thickness-scale-mm", "2"]);
        for (flag, name) in [
            ("--thickness", names::MAP_THICKNESS),
            ("--normal-front", names::MAP_NORMAL_FRONT),
            ("--normal-back", names::MAP_NORMAL_BACK),
        ] {
            program.arg(flag).arg(folder.join(format!("{name}.png")));
        }
        repo::run(program.args(arguments).arg("-o").arg(&output))
    })?;
    Ok(Figure::new(seconds, "none; maps read, baked, EXR and PNG written"))
}

/// Three coefficients of one side.
pub fn leaf_side() -> Result<Figure> {
    leaf(&["--sides", "front"])
}

/// Three bands of both sides.
pub fn leaf_rgb() -> Result<Figure> {
    leaf(&["--bands", "rgb"])
}

/// Seconds of tracing the benchmark tree, as baked, with its textures.
pub fn picture() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let layer = density::bake(&plant)?;
    let params = ViewParams { width_px: 960, height_px: 720, samples: 16, ..ViewParams::default() };
    let seconds = least_seconds(3, || Ok(foliar_view::render(&plant, &[&layer], &Shading::Baked, &params).map(drop)?))?;
    Ok(Figure::new(seconds, "none"))
}
