//! The promise of `quality`: kept as measured against independent sums, whatever the radius, with every setting.

use super::plants::{crown, halton, in_ball};
use crate::{Coarse, Density, Field, Foliage, Generator, Isa, NO_GROUP, Params, Query, Sky, choose, fast, reference};
use foliar_bake::{Baker, Inputs, Maps, Quiet, resolve_params};
use foliar_numerics::ErrorStats;
use foliar_plant::Plant;
use glam::DVec3;
use serde_json::{Map, Value, json};

fn params(given: &Value) -> Params {
    Params::from_json(&resolve_params(&Density, &Map::new(), given.as_object().unwrap()).unwrap()).unwrap()
}

/// Rms error of the chosen sky's transmittance and directions, in steps, over every 97th query, against f64; and
/// the lattice points per radius that were chosen.
fn sky_error(plant: &Plant, given: &Value) -> (f64, f64) {
    let params = params(given);
    let foliage = Foliage::new(plant, &[], &params);
    let places = fast::Places::new(plant, &params);
    let queries = fast::SkyPlan::new(plant, &foliage, &places, &params).queries;
    let chosen = choose::sky(&foliage, &queries, &params, 1 << 20);
    let errors = |error: &dyn Fn(usize) -> f64| ErrorStats::of((0..queries.len()).step_by(97).map(error)).rms;
    let exact = |at: usize| reference::sky(&foliage.generators, foliage.radius, foliage.mean_area, &queries[at]);
    let ambient = errors(&|at| 229.5 * (chosen.samples[at].transmittance - exact(at).transmittance));
    let angle = errors(&|at| (chosen.samples[at].direction - exact(at).direction).length().to_degrees());
    (ambient.max(angle), chosen.points)
}

#[test]
fn the_sky_keeps_its_promise_at_any_radius() {
    // Ten thousand queries: more than the sample, so that something is chosen. A subsample of a hundred of them
    // differs from the rms of the sample by some tenth of it; normals have long tails.
    const SLACK: f64 = 1.5;
    let plant = crown(6000, 2.0, 0.02, 4000);
    let mut seen = Vec::new();
    for (radius, quality) in [(1e-3, 1.0), (0.05, 1.0), (0.4, 4.0), (0.4, 1.0), (0.4, 0.25), (5.0, 1.0), (1e5, 1.0)] {
        let (error, points) = sky_error(&plant, &json!({"radius_m": radius, "quality": quality}));
        assert!(error <= SLACK * quality, "radius {radius}, quality {quality}: {error} steps at {points} points");
        seen.push(points);
    }
    assert!(seen.iter().any(|points| *points <= 0.0), "chords where balls are few or no lattice is fine enough");
    assert!(seen[2] > 0.0 && seen[2] < seen[4], "finer lattices for more quality: {seen:?}");
}

#[test]
fn k_a_keeps_its_promise_and_is_exact_on_request() {
    let plant = crown(20_000, 2.0, 0.02, 1000);
    let foliage = Foliage::new(&plant, &[], &params(&json!({"radius_m": 0.4})));
    let mut seen = Vec::new();
    for quality in [4.0, 1.0, 0.25, 1e-3] {
        let params = params(&json!({"radius_m": 0.4, "quality": quality, "ambient": "luft"}));
        let queries = fast::Places::new(&plant, &params).queries;
        let chosen = choose::field(&foliage, &queries, &params, 1 << 20);
        let error = |at: usize| {
            let exact = reference::field(&foliage.generators, foliage.radius, &queries[at]).density;
            let ambient = |density: f64| fast::luft_ambient(density, chosen.unit, &params);
            255.0 * (ambient(f64::from(chosen.densities[at])) - ambient(exact))
        };
        let rms = ErrorStats::of((0..queries.len()).step_by(397).map(error)).rms;
        // Two hundred of the places: their rms is within a fifth of that of all.
        assert!(rms <= 1.2 * quality, "quality {quality}: {rms} steps at {} points", chosen.points);
        assert!(chosen.relative <= 0.005 * quality, "quality {quality}: the density is off by {}", chosen.relative);
        seen.push(chosen.points);
    }
    assert!(seen[0] > 0.0 && seen[0] <= seen[1] && seen[3] <= 0.0, "{seen:?}");
}

#[test]
fn a_promise_that_f32_cannot_keep_is_said_to_be_missed() {
    let plant = crown(300, 1.0, 0.05, 10);
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let codes = |quality: f64| {
        let given = json!({"quality": quality});
        let given = resolve_params(&Density, &Map::new(), given.as_object().unwrap()).unwrap();
        let baked = Density.bake(&inputs, &given, &Quiet).unwrap();
        baked.findings.into_iter().map(|finding| finding.code).collect::<Vec<_>>()
    };
    assert!(codes(0.01).is_empty());
    assert!(codes(1e-9).iter().all(|code| code == "QUALITY-MISSED") && !codes(1e-9).is_empty());
}

fn balls() -> Vec<Generator> {
    let ball = |(i, position)| Generator { position, weight: 0.5 + (i % 5) as f32 / 4.0, group: i as u32 / 2 };
    in_ball(3000).enumerate().map(ball).collect()
}

fn queries() -> Vec<Query> {
    (0..500).map(|i| Query { position: halton(i * 5 + 2) * 1.4, skip: i as u32 }).collect()
}

#[test]
fn all_instructions_give_the_same_sky_and_lattice() {
    let plant = crown(1500, 1.0, 0.05, 0);
    let foliage = Foliage::new(&plant, &[], &Params::default());
    let queries = queries();
    let skies = |isa: Isa| {
        let by_chords = Sky::by_chords(&foliage).on(isa).samples(&queries);
        let coarse = Coarse::on(&balls(), 0.3, 3.0, 1 << 20, isa).densities(&queries);
        (by_chords, coarse.into_iter().map(f32::to_bits).collect::<Vec<_>>())
    };
    let plain = skies(Isa::Plain);
    for isa in Isa::available() {
        assert!(skies(isa) == plain, "{isa:?}");
    }
}

#[test]
fn chords_meet_the_reference() {
    let plant = crown(1500, 1.0, 0.05, 0);
    for radius in [0.01, 0.3, 3.0] {
        let foliage = Foliage::new(&plant, &[], &Params { radius_m: Some(radius), ..Params::default() });
        let queries = queries();
        for (found, query) in Sky::by_chords(&foliage).samples(&queries).iter().zip(&queries) {
            let exact = reference::sky(&foliage.generators, foliage.radius, foliage.mean_area, query);
            // Depths are sums of f32 of positions that are at most some hundred radii from the center.
            assert!((found.transmittance - exact.transmittance).abs() < 1e-4, "{radius}: {found:?} {exact:?}");
        }
    }
}

#[test]
fn lattices_converge_to_the_density() {
    let (balls, queries) = (balls(), queries());
    let error = |points: f64| {
        let fast = Coarse::new(&balls, 0.3, points, 1 << 22).densities(&queries);
        let exact = queries.iter().map(|query| reference::field(&balls, 0.3, query).density);
        ErrorStats::of(fast.iter().zip(exact).map(|(fast, exact)| f64::from(*fast) - exact)).rms
    };
    let errors = [2.0, 4.0, 8.0].map(error);
    // The second derivative of a ball jumps at its edge: order two at least, and a half more over many balls.
    assert!(errors[1] < errors[0] / 4.0 && errors[2] < errors[1] / 4.0, "{errors:?}");
}

#[test]
fn a_lattice_gives_back_the_density_at_its_own_points() {
    let balls = balls();
    let radius = 0.3;
    for points in [2.0, 3.0, 5.0] {
        let point = |i: u64| (halton(i) * 4.0 * points).round() * (radius / points);
        let places: Vec<Query> = (0..200).map(|i| Query { position: point(i), skip: NO_GROUP }).collect();
        let found = Coarse::new(&balls, radius, points, 1 << 22).densities(&places);
        for (found, query) in found.iter().zip(&places) {
            let exact = reference::field(&balls, radius, query);
            // Rounding of f32 in sums and in a filter of gain 27. The filter's tails, a quarter from point to point, are cut
            // off beyond the margin of two points, where what they carry is the outermost of the balls' slopes.
            assert!((f64::from(*found) - exact.density).abs() < 1e-3 + 1e-5 * exact.weight, "{found} {exact:?}");
        }
    }
}

#[test]
fn where_no_ball_reaches_there_is_nothing() {
    let coarse = Coarse::new(&balls(), 0.3, 4.0, 1 << 20);
    let far =
        [DVec3::X * 1.7, DVec3::splat(50.0), DVec3::splat(-1e6)].map(|position| Query { position, skip: NO_GROUP });
    assert!(coarse.densities(&far).iter().all(|density| *density <= 0.0));
    let nothing = Coarse::new(&[], 0.3, 4.0, 1 << 20);
    assert!(nothing.densities(&far).iter().all(|density| *density <= 0.0));
    assert!(Field::new(&[], 0.3).densities(&far).iter().all(|density| *density <= 0.0));
}
