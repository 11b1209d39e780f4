//! Laws of the house over odd plants, closed forms, and the statistics of a version.

use crate::reference::weight;
use crate::{Params, __Room__, fast};
use foliar_bake::{Baker, Inputs, Maps, Quiet, Request, run};
use foliar_plant::sample::{Recipe, odd_plants};
use foliar_schema::names;
use glam::DVec3;
use serde_json::json;

foliar_bake::law_tests!(__Room__, odd_plants());

/// The version that the statistic is of, and the mean share of the plant.
const GOLDEN: (u32, f64) = (1, 0.001_944_567_693_230_234);

#[test]
fn a_leaf_counts_whole_at_its_center_and_not_at_all_beyond_the_radius() {
    let at = |share: f64| weight(DVec3::X * share * 3.0, 3.0);
    assert!((at(0.0) - 1.0).abs() < f64::EPSILON);
    // (1 - 1/2)^2 where the square of the distance is half that of the radius.
    assert!((at(0.5f64.sqrt()) - 0.25).abs() < 4.0 * f64::EPSILON);
    assert!(at(1.0).abs() + at(2.0).abs() < f64::EPSILON);
}

#[test]
fn a_radius_beyond_everything_gives_every_place_nearly_all() {
    let plant = Recipe::small().grow();
    let radius = 1e3 * plant.size().length();
    // (1 - 1e-6)^2: no two places are farther apart than the diagonal.
    let least = fast::shares(&plant, radius).into_iter().flatten().fold(1.0, f32::min);
    assert!(f64::from(least) > 1.0 - 2.1e-6, "{least}");
}

#[test]
fn out_of_range_and_unknown_parameters_are_refused_by_name() {
    let refused = |params: serde_json::Value| {
        let params = params.as_object().cloned().unwrap_or_default();
        Params::from_json(&params).unwrap_err().to_string()
    };
    assert!(refused(json!({"reach": 2.0})).contains("reach = 2: must be at most 1"));
    assert!(refused(json!({"rich": 0.5})).contains("rich"));
}

#[test]
fn who_moves_results_raises_the_version() {
    let plant = Recipe { leaves: 300, ..Recipe::small() }.grow();
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let (layer, _) = run(&__Room__, &inputs, &Request::default(), &Quiet).unwrap();
    let shares: Vec<f64> = layer.attributes.iter().flat_map(|(key, array)| {
        assert_eq!(key.name, names::__ROOM___SHARE);
        array.as_f32().unwrap().iter().map(|share| f64::from(*share)).collect::<Vec<_>>()
    }).collect();
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let (version, golden) = GOLDEN;
    assert_eq!(__Room__.version(), version, "new version: take its statistic over");
    assert!((mean - golden).abs() < 1e-9, "the mean is {mean}: raise the version and take it over");
}
