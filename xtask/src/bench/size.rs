//! The density room at size: hundreds of thousands of leaves, millions, and a neighbor.

use super::surface::cpu_seconds;
use super::{Figure, density, least_seconds};
use anyhow::{Context, Result};
use foliar_bake::{Inputs, Layer, Maps, Placed, Placement, Quiet, Request, run};
use foliar_density::{Coarse, Density, Foliage, NO_GROUP, Params, Query, reference};
use foliar_plant::{Plant, sample::Recipe};
use glam::DVec3;
use rayon::prelude::*;
use serde_json::{Value, json};

const RUNS: usize = 3;
/// A quality that no lattice keeps: every ball is summed.
const EXACT: f64 = 1e-4;

/// k_a alone, as good as a default bake makes it.
fn k_a() -> Value {
    json!({"ambient": "luft", "channels": "ambient"})
}

/// Seconds of k_a and normals of the sky, 200,000 leaves.
pub fn medium() -> Result<Figure> {
    seconds(&Recipe::bench_200k_leafy(), &json!({"ambient": "luft"}), RUNS)
}

/// The same, a million leaves.
pub fn large() -> Result<Figure> {
    seconds(&Recipe::bench_1m(), &json!({"ambient": "luft"}), RUNS)
}

/// Seconds of k_a, a million leaves.
pub fn large_field() -> Result<Figure> {
    seconds(&Recipe::bench_1m(), &k_a(), RUNS)
}

/// The same with every ball summed.
pub fn large_exact() -> Result<Figure> {
    let mut given = k_a();
    given["quality"] = json!(EXACT);
    seconds(&Recipe::bench_1m(), &given, 1)
}

/// The same with a radius larger than the tree: every ball counts everywhere.
pub fn large_radius() -> Result<Figure> {
    let mut given = k_a();
    (given["quality"], given["radius_m"]) = (json!(EXACT), json!(80.0));
    seconds(&Recipe::bench_1m(), &given, 1)
}

/// Error of the density that k_a of a million leaves is made of, relative to itself: rms over every thousandth vertex
/// of those where it is above a fifth of its median.
pub fn large_error() -> Result<Figure> {
    const EVERY: usize = 1000;
    let plant = Recipe::bench_1m().grow();
    let facts = density::bake_as(&plant, k_a())?.record.facts;
    let points = facts["fieldPointsPerRadius"].as_f64().context("no fieldPointsPerRadius in the record")?;
    let foliage = Foliage::new(&plant, &[], &Params::default());
    let all = density::queries(&plant);
    let some: Vec<Query> = all.iter().step_by(EVERY).map(|query| Query { skip: NO_GROUP, ..*query }).collect();
    let fast = Coarse::new(foliage.own(), foliage.radius, points, all.len()).densities(&some);
    let exact = |query: &Query| reference::field(foliage.own(), foliage.radius, query).density as f32;
    let exact: Vec<f32> = some.par_iter().map(exact).collect();
    let text = format!(
        "f64 sums over all pairs at {} vertices; {points} points per radius, record: {}",
        some.len(),
        facts["fieldError"]
    );
    Ok(Figure::new(super::fft::relative(&fast, &exact), text))
}

/// Peak of allocations over what is allowed, 200,000 leaves.
pub fn medium_memory() -> Result<Figure> {
    density::memory_of(&Recipe::bench_200k_leafy(), json!({"ambient": "luft"}))
}

/// The same, a million.
pub fn large_memory() -> Result<Figure> {
    density::memory_of(&Recipe::bench_1m(), json!({"ambient": "luft"}))
}

/// The same, five million.
pub fn huge_memory() -> Result<Figure> {
    density::memory_of(&Recipe::bench_5m(), json!({"ambient": "luft"}))
}

/// Time of a default bake of 40,000 leaves beside the same tree over the time of it alone.
pub fn neighbor() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let place = Placement { offset_m: DVec3::X * 6.0, yaw_deg: 0.0, scale: 1.0 };
    let neighbors = [Placed::new(Recipe::bench_40k().grow(), &place)];
    let alone = least_seconds(RUNS, || bake(&plant, &[], &json!({})).map(drop))?;
    let beside = least_seconds(RUNS, || bake(&plant, &neighbors, &json!({})).map(drop))?;
    Ok(Figure::new(beside / alone, format!("the same tree alone: {alone:.3} s; with a neighbor {beside:.3} s")))
}

fn bake(plant: &Plant, neighbors: &[Placed], given: &Value) -> Result<Layer> {
    let inputs = Inputs { plant: Some(plant), maps: &Maps::new(), neighbors };
    let given = given.as_object().cloned().unwrap_or_default();
    Ok(run(&Density, &inputs, &Request { given, ..Request::default() }, &Quiet)?.0)
}

fn seconds(recipe: &Recipe, given: &Value, runs: usize) -> Result<Figure> {
    let plant = recipe.grow();
    let vertices: usize = plant.parts().iter().map(|part| part.positions.len()).sum();
    let (before, mut facts) = (cpu_seconds()?, Value::Null);
    let seconds = least_seconds(runs, || {
        facts = json!(bake(&plant, &[], given)?.record.facts);
        Ok(())
    })?;
    let cpu = (cpu_seconds()? - before) / runs as f64;
    let chosen =
        format!("field {}, sky {} points per radius", facts["fieldPointsPerRadius"], facts["skyPointsPerRadius"]);
    Ok(Figure::new(seconds, format!("none; {vertices} vertices, {cpu:.2} s of CPU, {chosen}")))
}
