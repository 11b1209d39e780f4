//! Reference values of an independent program: depths, ways and extinction in four ways of counting.

use crate::leaves::{Foliage, Query, Source};
use crate::profile::{MOST_DEPTH, Profile};
use crate::reference::{Sum, extinction, mean_area, sum_with, transmittance};
use glam::DVec3;
use serde_json::Value;

/// Of the oracle, absolute on depths in f64.
const TOLERANCE: f64 = 1e-9;

pub(super) fn oracle() -> Option<Value> {
    let root = std::env::var("FOLIAR_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let Ok(text) = std::fs::read_to_string(format!("{root}/oracles/light.json")) else {
        eprintln!("skipped: {root}/oracles/light.json: no shared data");
        return None;
    };
    Some(serde_json::from_str(&text).unwrap())
}

pub(super) fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Leaves of a set: center and half-edges each.
pub(super) struct Set {
    pub name: String,
    pub sources: Vec<Source>,
    pub edges: Vec<[DVec3; 2]>,
    /// What a length of 1 stands for.
    pub unit: f64,
}

impl Set {
    /// In the frame of the foliage, as the room works.
    pub fn normalized(self) -> Set {
        let Foliage { sources, unit_m, .. } = Foliage::of(self.sources);
        let edges = self.edges.iter().map(|pair| pair.map(|edge| edge / unit_m)).collect();
        Set { sources, edges, unit: self.unit * unit_m, ..self }
    }
}

pub(super) fn set(value: &Value) -> Set {
    let rows: Vec<Vec<f64>> = value["leaves"].as_array().unwrap().iter().map(numbers).collect();
    let edges: Vec<[DVec3; 2]> =
        rows.iter().map(|r| [DVec3::from_slice(&r[3..]), DVec3::from_slice(&r[6..])]).collect();
    let source = |(index, row): (usize, &Vec<f64>)| {
        let cross = edges[index][0].cross(edges[index][1]);
        Source {
            center: DVec3::from_slice(row),
            normal: cross.normalize_or_zero(),
            area: 4.0 * cross.length(),
            group: index as u32,
        }
    };
    let sources = rows.iter().enumerate().map(source).collect();
    Set { name: value["name"].as_str().unwrap().into(), sources, edges, unit: 1.0 }
}

/// A leaf seen along its own normal only.
fn projected(source: &Source, toward: DVec3) -> f64 {
    let square = toward.length_squared();
    match source.area > 0.0 {
        false => 0.0,
        true if square > 0.0 => source.area * source.normal.dot(toward).abs() / (square * square.sqrt()),
        true => f64::INFINITY,
    }
}

/// Exact solid angle of a parallelogram (Van Oosterom and Strackee 1983, two triangles).
fn polygon([u, v]: [DVec3; 2], toward: DVec3) -> f64 {
    let corners = [-u - v, u - v, u + v, v - u].map(|corner| toward + corner);
    let triangle = |a: DVec3, b: DVec3, c: DVec3| {
        let (x, y, z) = (a.length(), b.length(), c.length());
        let sine = a.dot(b.cross(c));
        let cosine = x * y * z + a.dot(b) * z + a.dot(c) * y + b.dot(c) * x;
        2.0 * libm::atan2(sine, cosine)
    };
    (triangle(corners[0], corners[1], corners[2]) + triangle(corners[0], corners[2], corners[3])).abs()
}

fn sums(set: &Set, mode: &str) -> Vec<Sum> {
    let Set { sources, edges, .. } = set;
    let angle = |index: usize, toward: DVec3| match mode {
        "iso_hard" => Profile::Paper.solid_angle(sources[index].area, toward),
        "cap_soft" => Profile::Cap.solid_angle(sources[index].area, toward),
        "proj_hard" => projected(&sources[index], toward),
        "poly_hard" => polygon(edges[index], toward),
        other => panic!("{other}"),
    };
    let profile = if mode.ends_with("soft") { Profile::Cap } else { Profile::Paper };
    let query = |source: &Source| Query { position: source.center, skip: source.group };
    sources.iter().map(|s| sum_with(sources, &query(s), |area| profile.half_width(area), angle)).collect()
}

#[test]
fn depths_ways_and_extinction_meet_the_oracle_in_every_mode() {
    let Some(oracle) = oracle() else { return };
    let mut checked = 0;
    let sets = ["bake_small", "bake_degenerate"].map(|key| oracle[key].as_array().unwrap().clone()).concat();
    for value in &sets {
        let set = set(value).normalized();
        let unit = set.unit;
        for (mode, expected) in value["modes"].as_object().unwrap() {
            let sums = sums(&set, mode);
            let tau = extinction(&sums, mean_area(&set.sources)) / unit;
            let place = format!("{} {mode}", set.name);
            let guarded = expected["tau"]["mean_guarded"].as_f64().unwrap();
            assert!((tau - guarded).abs() <= TOLERANCE * guarded.max(1.0), "{place}: tau {tau}, must be {guarded}");
            for (index, sum) in sums.iter().enumerate() {
                let near = |key: &str, found: &dyn Fn(usize) -> f64, scale: f64| {
                    for (j, number) in numbers(&expected[key][index]).into_iter().enumerate() {
                        let off = (found(j) - number).abs();
                        assert!(
                            off <= TOLERANCE * scale.max(number),
                            "{place}: {key} of {index}, {j}: {number}, {off:e}"
                        );
                    }
                };
                near("D", &|j| sum.depth[j], 1.0);
                near("far", &|j| sum.far[j] * unit, 1.0);
                near("cnt", &|j| f64::from(sum.count[j]), 0.0);
                near("T", &|j| transmittance(sum.depth[j]), 1.0);
                near("smax_guarded", &|j| if tau > 0.0 { sum.depth[j].min(MOST_DEPTH) / tau } else { 0.0 }, 1.0);
                checked += 1;
            }
        }
    }
    assert!(checked > 1500, "{checked}");
}
