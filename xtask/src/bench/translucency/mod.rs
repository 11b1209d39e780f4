//! The translucency room: time and memory, and what the bank of Gaussians costs against the direct gather.

pub mod oracle;

use super::surface::cpu_seconds;
use super::{Figure, allocations, least_seconds, missing};
use crate::repo;
use anyhow::{Context, Result};
use foliar_bake::{FloatRaster, Inputs, MapRaster, Maps, Quiet, Request, run};
use foliar_schema::names;
use foliar_translucency::map::by_rule::{LeafByRule, WIDTH_MM, leaf_by_rule};
use foliar_translucency::map::{LeafMap, Recipe, Tables, coefficient_map, reference};
use foliar_translucency::{Preset, Translucency};
use serde_json::{Value, json};
use std::process::Command;

const RUNS: u32 = 5;
const SMALL: usize = 1024;
const LARGE: usize = 4096;

/// Maps of both sides of the leaf by rule.
pub fn maps(leaf: LeafByRule) -> Maps {
    let raster = |channels: u32, data: Vec<f32>| {
        let side = (data.len() as f64 / f64::from(channels)).sqrt() as u32;
        MapRaster { raster: FloatRaster { width: side, height: side, channels, data }, bits: 32 }
    };
    Maps::from([
        (names::MAP_THICKNESS.into(), raster(1, leaf.front.thickness_mm)),
        (names::MAP_NORMAL_FRONT.into(), raster(3, leaf.front.normals.into_flattened())),
        (names::MAP_NORMAL_BACK.into(), raster(3, leaf.back.normals.into_flattened())),
    ])
}

/// Maps alone.
pub fn inputs_of(maps: &Maps) -> Inputs<'_> {
    Inputs { plant: None, maps, neighbors: &[] }
}

fn bake(maps: &Maps, given: &Value) -> Result<()> {
    let mut given = given.as_object().cloned().unwrap_or_default();
    given.insert("leaf_width_mm".into(), json!(WIDTH_MM));
    run(&Translucency, &inputs_of(maps), &Request { given, ..Request::default() }, &Quiet)?;
    Ok(())
}

fn timed(runs: u32, mut work: impl FnMut() -> Result<()>) -> Result<Figure> {
    let before = cpu_seconds()?;
    let seconds = least_seconds(runs as usize, &mut work)?;
    let cpu = (cpu_seconds()? - before) / f64::from(runs);
    Ok(Figure::new(seconds, format!("none; {cpu:.3} s of CPU")))
}

/// One side of a map of 1024 texels a side.
pub fn seconds() -> Result<Figure> {
    let maps = maps(leaf_by_rule(SMALL));
    timed(RUNS, || bake(&maps, &json!({"sides": "front"})))
}

/// Three bands of both sides.
pub fn rgb_seconds() -> Result<Figure> {
    let maps = maps(leaf_by_rule(SMALL));
    timed(RUNS, || bake(&maps, &json!({"bands": "rgb"})))
}

/// One side of a map of 4096 texels a side.
pub fn large_seconds() -> Result<Figure> {
    let maps = maps(leaf_by_rule(LARGE));
    timed(3, || bake(&maps, &json!({"sides": "front"})))
}

/// The same: peak of the room's allocations and the maps that it was given.
pub fn large_memory() -> Result<Figure> {
    let mut maps = Maps::new();
    let making = allocations::peak_bytes(|| maps = self::maps(leaf_by_rule(LARGE)));
    let given: usize = maps.values().map(|map| 4 * map.raster.data.len()).sum();
    let mut baked = Ok(());
    let room = allocations::peak_bytes(|| baked = bake(&maps, &json!({"sides": "front"})));
    baked?;
    let gib = |bytes: usize| bytes as f64 / 1024.0f64.powi(3);
    let text = format!(
        "none; {:.2} GiB of the room's own, {:.2} GiB of maps; making the leaf took {:.2} GiB",
        gib(room),
        gib(given),
        gib(making)
    );
    Ok(Figure::new(gib(room + given), text))
}

/// The typical leaf at 510 nm.
pub fn recipe(texel_mm: f64) -> Result<Recipe> {
    let preset = Preset::named("typical").and_then(|preset| preset.medium(510.0)).context("no preset")?;
    Ok(Recipe::new(preset, [texel_mm; 2]))
}

/// Tables of a map.
pub fn tables_of(map: &LeafMap, recipe: &Recipe) -> Result<Tables> {
    let (range, median) = (map.range_mm().context("no leaf")?, map.median_mm().context("no leaf")?);
    Ok(Tables::new(recipe, range, median))
}

/// What depends on thickness and tilt alone.
pub fn tables() -> Result<Figure> {
    let leaf = leaf_by_rule(SMALL);
    let recipe = recipe(leaf.texel_mm)?;
    timed(RUNS, || tables_of(&leaf.back, &recipe).map(drop))
}

/// A square piece of a map, the middle of its top edge at a place of the whole (shares of its width).
pub fn piece(map: &LeafMap, side: usize, [x, y]: [f64; 2]) -> LeafMap {
    let start = [x, y].map(|share| (share * map.width as f64) as usize);
    let cells = || (0..side * side).map(|at| (start[1] + at / side) * map.width + start[0] - side / 2 + at % side);
    LeafMap {
        width: side,
        height: side,
        thickness_mm: cells().map(|at| map.thickness_mm[at]).collect(),
        normals: cells().map(|at| map.normals[at]).collect(),
    }
}

/// Rms difference of bank and direct gather over the mean, on pieces of the leaf: midrib, blade, rim.
pub fn bank_error() -> Result<Figure> {
    const SIDE: usize = 64;
    let mut worst = 0.0f64;
    let mut each = Vec::new();
    for size in [SMALL, LARGE] {
        let leaf = leaf_by_rule(size);
        let recipe = recipe(leaf.texel_mm)?;
        let tables = tables_of(&leaf.back, &recipe)?;
        for (name, place) in [("midrib", [0.5, 0.55]), ("blade", [0.62, 0.5]), ("rim", [0.79, 0.6])] {
            let map = piece(&leaf.back, SIDE, place);
            let error = rms(&coefficient_map(&map, &tables), &reference::coefficient_map(&map, &recipe));
            worst = worst.max(error);
            each.push(format!("{size} {name} {:.3} %", 100.0 * error));
        }
    }
    Ok(Figure::new(100.0 * worst, format!("none; {}", each.join(", "))))
}

/// Rms difference over the mean length, leaf only.
pub fn rms(fast: &[f32], exact: &[glam::DVec3]) -> f64 {
    let pairs = fast.chunks_exact(3).zip(exact).filter(|(_, exact)| exact.length() > 0.0);
    let (mut squares, mut sum, mut count) = (0.0, 0.0, 0.0);
    for (fast, exact) in pairs {
        let fast = glam::DVec3::new(f64::from(fast[0]), f64::from(fast[1]), f64::from(fast[2]));
        squares += (fast - *exact).length_squared();
        sum += exact.length();
        count += 1.0;
    }
    (squares / count).sqrt() / (sum / count)
}

/// Time of one side over that of scipy's FFT convolution of three channels with a single kernel of 129 texels a side.
pub fn fft_ratio() -> Result<Figure> {
    const PEER: &str = "import time, json, numpy as n, scipy.signal as s\n\
        r = n.random.default_rng(0); k = n.ones((129, 129), 'f4'); v = r.random((3, 1024, 1024), 'f4')\n\
        def once():\n t = time.perf_counter(); [s.fftconvolve(c, k, 'same') for c in v]; return time.perf_counter() - t\n\
        print(json.dumps(min(once() for _ in range(5))))";
    let mut python = Command::new("python3");
    let Ok(printed) = repo::output(python.args(["-c", PEER])) else { return Ok(Figure::absent(missing("scipy"))) };
    let peer: f64 = serde_json::from_str(printed.trim()).context("scipy printed no number")?;
    let leaf = leaf_by_rule(SMALL);
    let recipe = recipe(leaf.texel_mm)?;
    let ours = least_seconds(RUNS as usize, || {
        std::hint::black_box(coefficient_map(&leaf.back, &tables_of(&leaf.back, &recipe)?));
        Ok(())
    })?;
    Ok(Figure::new(
        ours / peer,
        format!("scipy.signal.fftconvolve: {peer:.3} s for one kernel; {ours:.3} s here for all"),
    ))
}
