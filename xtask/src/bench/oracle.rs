//! The density room against oracles/density.json: numbers of an independent program, with their tolerances.

use super::Figure;
use crate::repo;
use anyhow::{Context, Result};
use foliar_density::{Field, Generator, NO_GROUP, Query, ambient_coefficient};
use glam::DVec3;
use serde_json::Value;

/// The oracle's own tolerance for f32: relative to the sum of the weights in reach.
const EPS: f64 = 1e-6;

/// The worst error over its tolerance, of the density, its gradient and k_a.
pub fn worst() -> Result<Figure> {
    let path = repo::shared().join("oracles/density.json");
    let text = std::fs::read_to_string(&path).with_context(|| format!("{}: no shared data", path.display()))?;
    let oracle: Value = serde_json::from_str(&text)?;
    let mut worst = [0.0; 3];
    let mut queries = 0;
    for set in list(&oracle["sets"]) {
        for errors in errors(set) {
            worst = [0, 1, 2].map(|kind| larger(worst[kind], errors[kind]));
            queries += 1;
        }
    }
    let [density, gradient, ambient] = worst;
    let peer = format!("exact sums at {queries} queries: S {density:.3}, gradient {gradient:.3}, k_a {ambient:.3}");
    Ok(Figure::new(density.max(gradient).max(ambient), peer))
}

/// Errors of density, gradient and k_a over their tolerances at each query of a set.
fn errors(set: &Value) -> Vec<[f64; 3]> {
    let radius = number(&set["rho"]);
    let weight = |i: usize| set["weights"].get(i).map_or(1.0, number) as f32;
    let points = list(&set["generators"]).iter().enumerate();
    let generators: Vec<Generator> =
        points.map(|(i, p)| Generator { position: vector(p), weight: weight(i), group: i as u32 }).collect();
    let answers = list(&set["queries"]);
    let queries: Vec<Query> = answers.iter().map(|q| Query { position: vector(&q["q"]), skip: NO_GROUP }).collect();
    let samples = Field::new(&generators, radius).samples(&queries);
    let error = |(sample, answer): (&foliar_density::Sample, &Value)| {
        let tolerance = EPS * number(&answer["weight_sum"]);
        let density = (f64::from(sample.density) - number(&answer["S"])).abs();
        let gradient = (sample.gradient.as_dvec3() - vector(&answer["grad_S"])).abs().max_element();
        let excess = f64::from(sample.density) - number(&set["tau"]);
        let ambient = list(&set["ka_params"]).iter().zip(list(&answer["ka"]));
        let ambient = ambient.map(|(params, exact)| ambient_error(params, excess, number(exact), tolerance));
        [over(density, tolerance), over(gradient, tolerance * 4.0 / radius), ambient.fold(0.0, larger)]
    };
    samples.iter().zip(answers).map(error).collect()
}

/// A relative step e of the density moves k_a by at most n e, and for n < 1 near the darkest by e^n.
#[expect(clippy::disallowed_methods, reason = "a tolerance, printed and compared with nothing stored")]
fn ambient_error(params: &Value, excess: f64, exact: f64, tolerance: f64) -> f64 {
    let (darkest, at, n) = (number(&params["ka_min"]), number(&params["d_min"]), number(&params["n"]));
    let step = tolerance / at;
    let error = (ambient_coefficient(excess, at, darkest, n) - exact).abs();
    over(error, (1.0 - darkest) * (n * step).max(step.powf(n)).max(step))
}

/// Out of reach of every ball the tolerance is zero, and so must the error be.
fn over(error: f64, tolerance: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / tolerance }
}

/// The larger of two errors; not-a-number is larger than all.
fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|i| number(&value[i])))
}

/// Not-a-number where the oracle says none: no comparison passes then.
fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}
