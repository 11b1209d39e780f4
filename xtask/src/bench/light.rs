//! The light room: seconds of its engines over leaves alone, what they err, and memory.

use super::{Figure, allocations, least_seconds};
use anyhow::Result;
use foliar_bake::{Baker, Inputs, Maps, Quiet, Request, run};
use foliar_light::crown::{Crown, EXACT};
use foliar_light::leaves::{Foliage, NO_GROUP, Query};
use foliar_light::profile::Profile;
use foliar_light::{Light, rays_at};
use foliar_numerics::Isa;
use foliar_plant::{Plant, sample::Recipe};
use foliar_schema::Role;
use serde_json::json;

const RUNS: usize = 3;
/// Openings that keep the error of a depth at a hundredth and at a thousandth of it: `light-40k-tree-...-error`.
pub const PERCENT: f64 = 0.66;
pub const PER_MILLE: f64 = 0.18;

fn small() -> Recipe {
    Recipe { leaves: 1500, ..Recipe::linden() }
}

/// Seconds of the sums at all leaves, from the leaves on, their tree included.
fn sums(recipe: &Recipe, profile: Profile, opening: f64) -> Result<Figure> {
    let foliage = Foliage::new(&recipe.grow());
    let queries = foliage.queries();
    let seconds = least_seconds(RUNS, || {
        Crown::new(&foliage.sources, profile).depths(&queries, opening, Isa::best());
        Ok(())
    })?;
    let peer = match foliage.sources.len() {
        1500 => "Boulanger08: 2 s for 1,500 leaves in 2008",
        40_000 => "Boulanger08: 40 s for 40,000 leaves in 2008",
        _ => "none",
    };
    Ok(Figure::new(seconds, format!("{peer}; {:?}, profile {profile:?}, opening {opening}", Isa::best())))
}

/// A sapling, every pair.
pub fn sapling() -> Result<Figure> {
    sums(&small(), Profile::Cap, EXACT)
}

/// Every pair by the paper's profile.
pub fn paper() -> Result<Figure> {
    sums(&Recipe::bench_40k(), Profile::Paper, EXACT)
}

/// Every pair by the default profile.
pub fn exact() -> Result<Figure> {
    sums(&Recipe::bench_40k(), Profile::Cap, EXACT)
}

/// The tree at a hundredth.
pub fn percent() -> Result<Figure> {
    sums(&Recipe::bench_40k(), Profile::Cap, PERCENT)
}

/// The tree at a thousandth.
pub fn per_mille() -> Result<Figure> {
    sums(&Recipe::bench_40k(), Profile::Cap, PER_MILLE)
}

/// 200,000 leaves at a hundredth.
pub fn medium() -> Result<Figure> {
    sums(&Recipe::bench_200k(), Profile::Cap, PERCENT)
}

/// A million at a hundredth.
pub fn large() -> Result<Figure> {
    sums(&Recipe::bench_1m(), Profile::Cap, PERCENT)
}

/// Peak of allocations of the same, leaves as samples included.
pub fn large_memory() -> Result<Figure> {
    let plant = Recipe::bench_1m().grow();
    let peak = allocations::peak_bytes(|| {
        let foliage = Foliage::new(&plant);
        Crown::new(&foliage.sources, Profile::Cap).depths(&foliage.queries(), PERCENT, Isa::best());
    });
    Ok(Figure::new(peak as f64 / f64::from(1 << 30), "none".to_string()))
}

/// Error of the depths at an opening, over their sum, at every tenth leaf.
fn error(opening: f64) -> Result<Figure> {
    let foliage = Foliage::new(&Recipe::bench_40k().grow());
    let queries: Vec<Query> = foliage.queries().into_iter().step_by(10).collect();
    let crown = Crown::new(&foliage.sources, Profile::Cap);
    let [fast, exact] = [opening, EXACT].map(|opening| crown.depths(&queries, opening, Isa::best()));
    let pairs = fast.as_flattened().iter().zip(exact.as_flattened());
    let (off, all) = pairs.fold((0.0, 0.0), |(off, all), (a, b)| (off + f64::from((a - b).abs()), all + f64::from(*b)));
    Ok(Figure::new(off / all, format!("every pair, at {} leaves; opening {opening}", queries.len())))
}

/// See [`error`].
pub fn percent_error() -> Result<Figure> {
    error(PERCENT)
}

/// See [`error`].
pub fn per_mille_error() -> Result<Figure> {
    error(PER_MILLE)
}

/// Sixteen rays in each octant of every leaf, wood and alpha counted.
pub fn rays() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let all: Vec<usize> = (0..plant.leaves().len()).collect();
    let seconds = least_seconds(1, || Ok(rays_at(&plant, &all, 16).map(drop)?))?;
    Ok(Figure::new(seconds, "none; building the hierarchy included".to_string()))
}

/// What wood costs beside the leaves: the sums at its vertices, opening of a hundredth.
pub fn wood() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let foliage = Foliage::new(&plant);
    let queries = wood_queries(&plant, &foliage);
    let crown = Crown::new(&foliage.sources, Profile::Cap);
    let seconds = least_seconds(RUNS, || {
        crown.depths(&queries, PERCENT, Isa::best());
        Ok(())
    })?;
    Ok(Figure::new(seconds, format!("none; {} vertices", queries.len())))
}

fn wood_queries(plant: &Plant, foliage: &Foliage) -> Vec<Query> {
    let parts = plant.parts().iter().enumerate().filter(|(index, _)| plant.role(*index) == Role::Wood);
    let places = parts.flat_map(|(_, part)| (0..part.positions.len()).map(|v| part.rest_position(v)));
    places.map(|place| Query { position: foliage.place(place), skip: NO_GROUP }).collect()
}

/// The whole room as a bake runs it: choice by measured error, wood, extinction.
pub fn room() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let mut facts = json!(null);
    let seconds = least_seconds(RUNS, || {
        let (layer, _) = run(&Light, &inputs, &Request::default(), &Quiet)?;
        facts = json!([layer.record.facts["engine"], layer.record.facts["opening"], layer.record.errors[0].rms_steps]);
        Ok(())
    })?;
    Ok(Figure::new(
        seconds,
        format!("none; room version {}, engine, opening, error in steps: {facts}", Light.version()),
    ))
}
