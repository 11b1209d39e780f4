//! Frames, phases, the answer to a scene, bad input, and the statistics of a version.

use super::bark::bake;
use super::laws::branched;
use crate::{Params, Wind, frame};
use foliar_bake::{
    BakeError, Baker, BranchFacts, Facts, Inputs, Maps, Quiet, Request, Requirement, resolve_params, run,
};
use foliar_plant::sample::{Recipe, hard_tree};
use foliar_plant::{Base, Plant, Structure};
use foliar_schema::{Scene, Strength, names};
use glam::{DAffine3, DQuat, DVec2, DVec3};
use serde_json::{Map, Value, json};

#[test]
fn frames_are_right_handed_and_orthonormal() {
    let fans = (0..500).map(|i| foliar_numerics::fibonacci_sphere(i, 500));
    for along in fans.chain([DVec3::Y, -DVec3::Y, DVec3::X, DVec3::Z, DVec3::new(1e-9, 1.0, 0.0)]) {
        // As the file stores it.
        let q = frame(along).as_quat().to_array().map(f64::from);
        let [right, up, forward] = [DVec3::X, DVec3::Y, DVec3::Z].map(|v| DQuat::from_array(q) * v);
        // The gate: 1e-6, four roundings to f32.
        let off = [
            right.dot(up),
            up.dot(forward),
            right.length() - 1.0,
            up.length() - 1.0,
            right.cross(up).dot(forward) - 1.0,
        ];
        assert!(off.iter().all(|x| x.abs() <= 1e-6), "{along}: {off:?}");
        assert!(forward.distance(along.normalize()) <= 1e-6, "{along}");
        // Right lies level, up in the plane of the branch and the vertical.
        assert!(right.y.abs() <= 1e-6 && q[3] >= 0.0, "{along}");
    }
}

#[test]
fn turning_the_plant_about_up_turns_its_frames() {
    let turn = DQuat::from_rotation_y(1.1);
    for i in 0..200 {
        let along = foliar_numerics::fibonacci_sphere(i, 200);
        let (here, there) = (frame(along), frame(turn * along));
        assert!((turn * here * DVec3::X).distance(there * DVec3::X) < 1e-12, "{along}");
    }
}

fn column(plant: &Plant, name: &str) -> Vec<f32> {
    bake(plant).column(names::CLASS_WIND, name).unwrap().as_f32().unwrap().to_vec()
}

#[test]
fn phases_keep_their_distance() {
    let plant = hard_tree("dense", 1).unwrap().plant;
    let phases: Vec<DVec2> = column(&plant, "phase")
        .as_chunks::<2>()
        .0
        .iter()
        .map(|p| DVec2::new(f64::from(p[0]), f64::from(p[1])))
        .collect();
    let around = |d: DVec2| ((d + 0.5).fract_gl() - 0.5).length();
    let pairs = phases.iter().enumerate().flat_map(|(i, a)| phases[..i].iter().map(move |b| around(*a - *b)));
    let least = pairs.fold(f64::INFINITY, f64::min);
    // wind.md S14 measured .019 for 1,500; the least distance of a lattice falls with the root of their number.
    assert!(least > 0.019 * (1500.0 / phases.len() as f64).sqrt() * 0.9, "{least} of {}", phases.len());
}

#[test]
fn renumbering_keeps_phases() {
    let plant = hard_tree("clean", 1).unwrap().plant;
    let other = foliar_bake::reframe::permuted(&plant).unwrap();
    assert_eq!(column(&plant, "phase"), column(&other, "phase"));
}

fn scene(strength: Strength, nearest_m: f64) -> Scene {
    let mut scene = Scene::default();
    scene.wind.strength = strength;
    scene.camera.nearest_m = nearest_m;
    scene
}

fn facts(plant: &Plant) -> Facts {
    Facts::of(plant)
}

#[test]
fn a_level_under_half_a_pixel_is_left_out() {
    let plant = hard_tree("clean", 1).unwrap().plant;
    let facts = facts(&plant);
    let longest = BranchFacts::of(plant.branches().unwrap()).longest_m;
    let levels = |strength, nearest: f64| match Wind.require(&scene(strength, nearest), &facts) {
        Requirement::Required { params, .. } => params.get("levels").map_or(4, |v| v.as_u64().unwrap()),
        Requirement::NotRequired { .. } => 0,
    };
    assert_eq!(levels(Strength::None, 3.0), 0);
    assert_eq!(levels(Strength::Storm, 0.5), 4);
    assert_eq!(levels(Strength::Breeze, 1e5), 0);
    // Half a pixel at distance d is d tan 30 / 1080: level 1 alone is seen between where it ends and where level 2 does.
    let far = |level: usize| 0.02 * longest[level] * 1080.0 / libm::tan(30f64.to_radians());
    assert!(longest[2] < longest[1] && longest[1] < longest[0]);
    assert_eq!(levels(Strength::Breeze, 0.5 * (far(2) + far(1))), 2);
    assert_eq!(levels(Strength::Breeze, 0.5 * (far(1) + far(0))), 1);
}

#[test]
fn the_bytes_of_the_plan_are_those_of_the_layer() {
    for plant in [hard_tree("palm", 1).unwrap().plant, Recipe::small().grow()] {
        let Requirement::Required { bytes, .. } = Wind.require(&scene(Strength::Storm, 1.0), &facts(&plant)) else {
            panic!("a storm asks for wind");
        };
        let layer = bake(&plant);
        let arrays = layer.attributes.values().chain(layer.columns.values());
        assert_eq!(bytes, arrays.map(|array| array.bytes().len() as u64).sum::<u64>());
    }
}

#[test]
fn fewer_levels_move_as_what_they_grow_from() {
    let plant = hard_tree("clean", 1).unwrap().plant;
    let given = json!({"levels": 2}).as_object().cloned().unwrap();
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let layer = run(&Wind, &inputs, &Request { given, ..Request::default() }, &Quiet).unwrap().0;
    let weights = layer.attribute(plant.parts()[0].place, names::WIND_WEIGHTS).unwrap().as_f32().unwrap();
    assert!(weights.chunks(4).all(|w| w[2] + w[3] <= 0.0) && weights.chunks(4).any(|w| w[1] > 0.5));
}

#[test]
fn no_wood_no_leaves_nothing_and_no_branches_are_said() {
    let leaf_only = foliar_plant::sample::odd_plants().into_iter().find(|s| s.name == "leaves-only").unwrap().plant;
    let layer = bake(&branched(leaf_only));
    assert!(layer.columns.is_empty() && layer.attributes.keys().all(|key| key.name == names::LEAF_WEIGHT));
    let nothing = Plant::new(Base::default(), Structure::default()).unwrap();
    let maps = Maps::new();
    let bake = |plant: &Plant| {
        let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
        run(&Wind, &inputs, &Request::default(), &Quiet)
    };
    let error = bake(&nothing).unwrap_err();
    assert!(matches!(error, BakeError::Needs { .. }), "{error}");
    let nothing = branched(nothing);
    let (layer, findings) = bake(&nothing).unwrap();
    assert!(layer.attributes.is_empty());
    assert_eq!(findings.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["WOOD-NONE"]);
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    for (given, word) in [
        (json!({"levels": 5}), "levels"),
        (json!({"levels": 0}), "levels"),
        (json!({"exponents": [2, 0.5, 1, 1]}), "exponents.1"),
    ] {
        let params = resolve_params(&Wind, &Map::new(), given.as_object().unwrap());
        let error = params.and_then(|params| Params::from_json(&params).map(drop)).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
    assert!(Params::from_json(json!({"exponents": [1, 2]}).as_object().unwrap()).is_err());
}

#[test]
fn what_moves_far_from_the_origin_or_is_mirrored_moves_alike() {
    let plant = hard_tree("palm", 1).unwrap().plant;
    let change = DAffine3::from_translation(DVec3::new(3e3, 0.0, 1e3)) * DAffine3::from_rotation_y(0.7);
    let mut base = plant.base().clone();
    base.parts.iter_mut().for_each(|part| part.transform = change * part.transform);
    let turned = plant.branches().unwrap().transformed(change);
    let other = Plant::new(base, plant.structure().clone()).unwrap().with_branches(turned).unwrap();
    let weights = |plant: &Plant| {
        bake(plant).attribute(plant.parts()[0].place, names::WIND_WEIGHTS).unwrap().as_f32().unwrap().to_vec()
    };
    let off = weights(&plant).iter().zip(weights(&other)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    // Branches are f64 here, so only arithmetic differs.
    assert!(off < 1e-6, "{off}");
}

/// Sum of every number of the layer, each weighted by its place, and how many there are.
fn statistics(plant: &Plant, given: &Value) -> (f64, usize) {
    let inputs = Inputs { plant: Some(plant), maps: &Maps::new(), neighbors: &[] };
    let request = Request { given: given.as_object().cloned().unwrap(), ..Request::default() };
    let layer = run(&Wind, &inputs, &request, &Quiet).unwrap().0;
    let all: Vec<f32> =
        layer.attributes.values().chain(layer.columns.values()).flat_map(|a| a.as_f32().unwrap().to_vec()).collect();
    let weighted = all.iter().enumerate().map(|(i, v)| f64::from(*v) * (1.0 + (i % 7) as f64));
    (weighted.sum::<f64>() / all.len() as f64, all.len())
}

#[test]
fn who_moves_results_raises_the_version() {
    assert_eq!(Wind.version(), 2, "new version: take its statistics over");
    const GOLDEN: [f64; 3] = [1.484_023_231_770_496, 1.054_705_173_603_004, 0.920_883_655_967_484_8];
    let clean = hard_tree("clean", 1).unwrap().plant;
    let found = [
        statistics(&clean, &json!({})).0,
        statistics(&clean, &json!({"levels": 2, "exponents": [1.0, 1.2, 1.0, 1.0]})).0,
        statistics(&Recipe::small().grow(), &json!({})).0,
    ];
    let moved = GOLDEN.iter().zip(&found).any(|(golden, found)| (golden - found).abs() > 1e-9);
    assert!(!moved, "statistics are {found:?}: raise Wind::version and take them over");
}
