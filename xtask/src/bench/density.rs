//! The density room: time, memory, error.

use super::{Figure, allocations, least_seconds};
use crate::shared_trees;
use anyhow::Result;
use foliar_bake::{Inputs, Layer, Maps, Quiet, Request, run};
use foliar_density::{Density, Field, Foliage, NO_GROUP, Params, Query, reference};
use foliar_plant::{Plant, sample::Recipe};
use rayon::prelude::*;
use serde_json::{Value, json};

/// Bakes a plant by default parameters.
pub fn bake(plant: &Plant) -> Result<Layer> {
    bake_as(plant, json!({}))
}

/// Bakes a plant by these parameters, an object.
pub fn bake_as(plant: &Plant, given: Value) -> Result<Layer> {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    let given = given.as_object().cloned().unwrap_or_default();
    Ok(run(&Density, &inputs, &Request { given, ..Request::default() }, &Quiet)?.0)
}

/// Seconds of a whole bake of the benchmark tree.
pub fn seconds() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let seconds = least_seconds(5, || bake(&plant).map(drop))?;
    Ok(Figure::new(seconds, "none"))
}

/// Peak of allocations over what is allowed.
pub fn memory() -> Result<Figure> {
    memory_of(&Recipe::bench_40k(), json!({}))
}

/// Peak of allocations of a bake over what is allowed: eight times the vertex data and 64 MB.
pub(super) fn memory_of(recipe: &Recipe, given: Value) -> Result<Figure> {
    const BYTES_PER_VERTEX: usize = 32;
    let plant = recipe.grow();
    let vertices: usize = plant.parts().iter().map(|p| p.positions.len()).sum();
    let mut result = Ok(());
    let peak = allocations::peak_bytes(|| result = bake_as(&plant, given).map(drop));
    result?;
    let allowed = 8 * BYTES_PER_VERTEX * vertices + 64_000_000;
    let text = format!("none; {vertices} vertices, {:.1} of {:.1} MB", mega(peak), mega(allowed));
    Ok(Figure::new(peak as f64 / allowed as f64, text))
}

fn mega(bytes: usize) -> f64 {
    bytes as f64 / 1e6
}

/// Largest error of the density over all shared trees.
pub fn field_error() -> Result<Figure> {
    worst(|error, _| error.0)
}

/// Largest error of the gradient over all shared trees.
pub fn gradient_error() -> Result<Figure> {
    worst(|error, radius| error.1 * radius / 4.0)
}

fn worst(pick: fn((f64, f64), f64) -> f64) -> Result<Figure> {
    let (mut worst, mut at, mut places) = (0.0, String::from("no tree"), 0);
    for tree in shared_trees::all()? {
        let plant = tree.read()?.plant;
        if plant.leaves().is_empty() {
            continue;
        }
        let foliage = Foliage::new(&plant, &[], &Params::default());
        let queries = queries(&plant);
        let error = largest_errors(&foliage, &queries, pick);
        places += queries.len();
        if error > worst {
            (worst, at) = (error, tree.name);
        }
    }
    Ok(Figure::new(worst, format!("f64 sums over all pairs at {places} vertices; worst is {at}")))
}

pub(super) fn queries(plant: &Plant) -> Vec<Query> {
    let place = |part: &foliar_plant::Part, v| part.rest_position(v) - plant.center();
    let parts = plant.parts().iter();
    let places = parts.flat_map(|part| (0..part.positions.len()).map(move |v| place(part, v)));
    places.map(|position| Query { position, skip: NO_GROUP }).collect()
}

/// Errors relative to the weights in reach; places that no ball reaches must be exactly zero.
fn largest_errors(foliage: &Foliage, queries: &[Query], pick: fn((f64, f64), f64) -> f64) -> f64 {
    let fast = Field::new(&foliage.generators, foliage.radius).samples(queries);
    let errors = queries.par_iter().zip(&fast).map(|(query, fast)| {
        let exact = reference::field(&foliage.generators, foliage.radius, query);
        let density = (f64::from(fast.density) - exact.density).abs();
        let gradient = (fast.gradient.as_dvec3() - exact.gradient).length();
        match exact.weight > 0.0 {
            true => pick((density / exact.weight, gradient / exact.weight), foliage.radius),
            false if density > 0.0 || gradient > 0.0 => f64::INFINITY,
            false => 0.0,
        }
    });
    errors.reduce(|| 0.0, f64::max)
}
