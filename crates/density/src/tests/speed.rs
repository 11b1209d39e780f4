//! Times of the parts of a bake; run by hand: `cargo test --release -p foliar-density speed -- --ignored --nocapture`.

use crate::{Density, Field, Foliage, Isa, NO_GROUP, Params, Query, Sky, reference};
use foliar_bake::{Baker, Inputs, Maps, Quiet, resolve_params};
use foliar_numerics::ErrorStats;
use foliar_plant::sample::Recipe;
use std::time::Instant;

/// Processor seconds of all threads so far (Linux).
fn processor_seconds() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    let nanoseconds = |task: std::fs::DirEntry| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).unwrap_or_default();
        text.split(' ').next().and_then(|n| n.parse::<f64>().ok()).unwrap_or(0.0)
    };
    tasks.flatten().map(nanoseconds).sum::<f64>() * 1e-9
}

/// Processor seconds of this thread, which hands parallel work to others.
fn own_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|n| n.parse::<f64>().ok()).unwrap_or(0.0) * 1e-9
}

fn best<T>(name: &str, mut run: impl FnMut() -> T) {
    let mut times: Vec<(f64, f64)> = (0..5)
        .map(|_| {
            let (start, processor) = (Instant::now(), processor_seconds());
            std::hint::black_box(run());
            (start.elapsed().as_secs_f64(), processor_seconds() - processor)
        })
        .collect();
    times.sort_by(|a, b| a.1.total_cmp(&b.1));
    println!("{name:34} {:.4} s, {:.4} processor s", times[0].0, times[0].1);
}

#[test]
#[ignore = "a benchmark"]
fn forty_thousand_leaves() {
    let plant = super::plants::crown(40_000, 4.0, 0.1, 65_000);
    let params = Params { radius_m: Some(0.4), ..Params::default() };
    let foliage = Foliage::new(&plant, &[], &params);
    let queries: Vec<Query> = (0..2)
        .flat_map(|part| {
            let (plant, part) = (&plant, &plant.parts()[part]);
            (0..part.positions.len())
                .map(move |v| Query { position: part.rest_position(v) - plant.center(), skip: NO_GROUP })
        })
        .collect();
    println!("{} vertices, {} balls", queries.len(), foliage.generators.len());
    best("foliage", || Foliage::new(&plant, &[], &params));
    best("field build", || Field::new(&foliage.generators, 0.4));
    for isa in Isa::available() {
        let field = Field::new(&foliage.generators, 0.4).on(isa);
        best(&format!("density {isa:?}"), || field.densities(&queries));
        best(&format!("density and gradient {isa:?}"), || field.samples(&queries));
    }
    let plan: Vec<Query> =
        foliage.own().iter().map(|ball| Query { position: ball.position, skip: ball.group }).collect();
    for points in [2.0, 3.0, 4.0] {
        best(&format!("sky at {points} points"), || Sky::on_lattices(&foliage, points, 1 << 20).samples(&plan));
    }
    for ambient in ["luft", "sky"] {
        let mut given = serde_json::Map::new();
        given.insert("radius_m".into(), 0.4.into());
        given.insert("ambient".into(), ambient.into());
        let params = resolve_params(&Density, &serde_json::Map::new(), &given).unwrap();
        let maps = Maps::new();
        let inputs = Inputs { plant: Some(&plant), maps: &maps, neighbors: &[] };
        best(&format!("bake, ambient {ambient}"), || Density.bake(&inputs, &params, &Quiet).unwrap());
    }
}

#[test]
#[ignore = "prints the error of the sky by lattice"]
fn sky_error() {
    for (name, recipe) in [("small", Recipe::small()), ("linden", Recipe::linden()), ("40k", Recipe::bench_40k())] {
        let plant = recipe.grow();
        let foliage = Foliage::new(&plant, &[], &Params::default());
        let all: Vec<Query> =
            foliage.own().iter().map(|ball| Query { position: ball.position, skip: ball.group }).collect();
        println!("{name}: radius {} of {}, {} balls", foliage.radius, plant.size(), all.len());
        for points in [2.0, 3.0, 4.0, 5.0, 6.0] {
            let fast = Sky::on_lattices(&foliage, points, 1 << 20).samples(&all);
            let (mut angles, mut terms) = (Vec::new(), Vec::new());
            for i in (0..all.len()).step_by(all.len() / 100) {
                let exact = reference::sky(&foliage.generators, foliage.radius, foliage.mean_area, &all[i]);
                angles.push((fast[i].direction - exact.direction).length().to_degrees());
                terms.push((fast[i].transmittance - exact.transmittance) * 255.0);
            }
            let (angle, term) = (ErrorStats::of(angles), ErrorStats::of(terms));
            println!(
                "  {points}: normal {:.2} deg (max {:.1}), ambient {:.2} steps (max {:.1})",
                angle.rms, angle.max, term.rms, term.max
            );
        }
    }
}

#[test]
#[ignore = "times of large trees, stage by stage"]
fn large_trees() {
    let million = Recipe {
        leaves: 1_000_000,
        height_m: 25.0,
        crown_width_m: 20.0,
        leaf_size_m: 0.06,
        leaves_per_branchlet: 40.0,
        ..Recipe::bench_40k()
    };
    for (name, recipe) in [
        ("40k", Recipe::bench_40k()),
        ("200k", Recipe { leaves_per_branchlet: 12.0, ..Recipe::bench_200k() }),
        ("1m", million),
    ] {
        let start = Instant::now();
        let plant = recipe.grow();
        println!("{name}: grown in {:.1} s", start.elapsed().as_secs_f64());
        let vertices: usize = plant.parts().iter().map(|p| p.positions.len()).sum();
        let params = Params::default();
        let foliage = Foliage::new(&plant, &[], &params);
        println!(
            "{vertices} vertices, {} balls, radius {} of {}",
            foliage.generators.len(),
            foliage.radius,
            plant.size()
        );
        for (ambient, quality) in [("sky", 1.0), ("luft", 1.0), ("luft", 0.01)] {
            let wanted = std::env::var("WANTED").unwrap_or_default();
            if !format!("{name} {ambient} {quality}").contains(&wanted) {
                continue;
            }
            let mut given = serde_json::Map::new();
            given.insert("ambient".into(), ambient.into());
            given.insert("quality".into(), quality.into());
            let params = resolve_params(&Density, &serde_json::Map::new(), &given).unwrap();
            let maps = Maps::new();
            let inputs = Inputs { plant: Some(&plant), maps: &maps, neighbors: &[] };
            let (start, processor, own) = (Instant::now(), processor_seconds(), own_seconds());
            let baked = Density.bake(&inputs, &params, &Quiet).unwrap();
            let (processor, own) = (processor_seconds() - processor, own_seconds() - own);
            println!(
                "  {ambient} {quality}: {:.2} s, {processor:.2} processor s, {own:.2} of them alone: {:.2} s on two, {:?}",
                start.elapsed().as_secs_f64(),
                own + (processor - own) / 2.0,
                (&baked.facts["skyPointsPerRadius"], baked.facts.get("fieldPointsPerRadius"), baked.errors)
            );
        }
    }
}
