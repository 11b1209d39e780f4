//! Reference values of an independent program (exact rationals): field, gradient, k_a, and eq. 4.

use crate::{Field, Generator, Isa, NO_GROUP, Query, ambient_coefficient, reference};
use glam::DVec3;
use serde_json::Value;

/// The oracle's own tolerance for f32: relative to the sum of the weights in reach.
const EPS: f64 = 1e-6;

fn oracle() -> Option<Value> {
    let root = std::env::var("FOLIAR_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let Ok(text) = std::fs::read_to_string(format!("{root}/oracles/density.json")) else {
        eprintln!("skipped: {root}/oracles/density.json: no shared data");
        return None;
    };
    Some(serde_json::from_str(&text).unwrap())
}

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|i| value[i].as_f64().unwrap()))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

struct Set {
    name: String,
    radius: f64,
    generators: Vec<Generator>,
    queries: Vec<Query>,
    value: Value,
}

fn sets(oracle: &Value) -> Vec<Set> {
    let set = |set: &Value| Set {
        name: set["name"].as_str().unwrap().into(),
        radius: number(&set["rho"]),
        generators: set["generators"]
            .as_array()
            .unwrap()
            .iter()
            .enumerate()
            .map(|(i, p)| Generator {
                position: vector(p),
                weight: set["weights"].get(i).map_or(1.0, number) as f32,
                group: i as u32,
            })
            .collect(),
        queries: set["queries"]
            .as_array()
            .unwrap()
            .iter()
            .map(|q| Query { position: vector(&q["q"]), skip: NO_GROUP })
            .collect(),
        value: set.clone(),
    };
    oracle["sets"].as_array().unwrap().iter().map(set).collect()
}

#[test]
fn field_and_gradient_meet_the_oracle_on_every_path() {
    let Some(oracle) = oracle() else { return };
    let mut checked = 0;
    for set in sets(&oracle) {
        for isa in Isa::available() {
            let samples = Field::new(&set.generators, set.radius).on(isa).samples(&set.queries);
            for (sample, expected) in samples.iter().zip(set.value["queries"].as_array().unwrap()) {
                let weight = number(&expected["weight_sum"]);
                let error = (f64::from(sample.density) - number(&expected["S"])).abs();
                let slope = (sample.gradient.as_dvec3() - vector(&expected["grad_S"])).abs().max_element();
                assert!(error <= EPS * weight, "{} {isa:?} at {}: S off by {error:e}", set.name, expected["q"]);
                assert!(
                    slope <= EPS * weight * 4.0 / set.radius,
                    "{} {isa:?} at {}: gradient off by {slope:e}",
                    set.name,
                    expected["q"]
                );
                checked += 1;
            }
        }
    }
    assert!(checked > 300, "{checked}");
}

#[test]
fn the_reference_meets_the_oracle_in_f64() {
    let Some(oracle) = oracle() else { return };
    // Sums of at most 300 terms in f64, and coordinates near 1e4 squared relative to a radius of .4.
    const TOLERANCE: f64 = 1e-12;
    for set in sets(&oracle) {
        for (query, expected) in set.queries.iter().zip(set.value["queries"].as_array().unwrap()) {
            let sample = reference::field(&set.generators, set.radius, query);
            let weight = number(&expected["weight_sum"]);
            assert!((sample.density - number(&expected["S"])).abs() <= TOLERANCE * weight, "{}", set.name);
            let slope = (sample.gradient - vector(&expected["grad_S"])).abs().max_element();
            assert!(slope <= TOLERANCE * weight * 4.0 / set.radius, "{}: {slope:e}", set.name);
        }
    }
}

#[test]
fn k_a_meets_the_oracle_through_the_fast_field() {
    let Some(oracle) = oracle() else { return };
    for set in sets(&oracle) {
        let densities = Field::new(&set.generators, set.radius).densities(&set.queries);
        let tau = number(&set.value["tau"]);
        for (density, expected) in densities.iter().zip(set.value["queries"].as_array().unwrap()) {
            for (params, ka) in
                set.value["ka_params"].as_array().unwrap().iter().zip(expected["ka"].as_array().unwrap())
            {
                let (darkest, at, n) = (number(&params["ka_min"]), number(&params["d_min"]), number(&params["n"]));
                let found = ambient_coefficient(f64::from(*density) - tau, at, darkest, n);
                // A relative step e of d moves k_a by at most n e, and for n < 1 near d_min by e^n.
                let step = EPS * number(&expected["weight_sum"]) / at;
                let tolerance = (1.0 - darkest) * (n * step).max(libm::pow(step, n)).max(step);
                assert!(
                    (found - number(ka)).abs() <= tolerance,
                    "{} at {}: k_a {found}, must be {ka} within {tolerance:e}",
                    set.name,
                    expected["q"]
                );
            }
        }
    }
}

#[test]
fn equation_4_meets_its_table_and_its_edges() {
    let Some(oracle) = oracle() else { return };
    // One pow, one product, one sum, each within an ulp; n up to 1000 magnifies the ulp of the base.
    let tolerance = |n: f64| 4e-16 * (2.0 + n);
    for row in oracle["eq4_table"].as_array().unwrap() {
        let [d, darkest, at, n, ka] = [0, 1, 2, 3, 4].map(|i| number(&row[i]));
        let found = ambient_coefficient(d, at, darkest, n);
        assert!((found - ka).abs() <= tolerance(n), "{row}: {found}");
    }
    for edge in oracle["eq4_edges"].as_array().unwrap() {
        let [d, darkest, at, n, ka] = ["d", "ka_min", "d_min", "n", "ka"].map(|key| number(&edge[key]));
        let found = ambient_coefficient(d, at, darkest, n);
        assert!((found - ka).abs() <= tolerance(n), "{edge}: {found}");
    }
}
