//! Extremes: few leaves, tiny and huge radii and plants, parameters that are no numbers, neighbors.

use super::plants::{Quad, crown, in_ball, plant};
use crate::{AmbientTerm, Channels, Density, Foliage, Params, SelfLeaf, crown_depth, fast};
use foliar_bake::{Array, Baked, Baker, Facts, Inputs, Maps, Placed, Quiet, Request, Requirement, run};
use foliar_numerics::spearman;
use foliar_plant::{NO_LEAF, Plant};
use foliar_schema::{Ambient, Scene, names};
use glam::{DAffine3, DVec3};
use serde_json::{Map, Value, json};

fn bake(plant: &Plant, neighbors: &[Placed], given: Value) -> foliar_bake::Layer {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors };
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    run(&Density, &inputs, &request, &Quiet).unwrap().0
}

fn ambient(layer: &foliar_bake::Layer) -> Vec<f32> {
    let of = layer.attributes.iter().filter(|(key, _)| key.name == names::AMBIENT);
    of.flat_map(|(_, array)| array.as_f32().unwrap().to_vec()).collect()
}

fn leaf(center: DVec3) -> Quad {
    Quad { center, edge: 0.1, normal: DVec3::Z }
}

#[test]
fn one_leaf_alone_is_fully_lit() {
    let alone = plant(&[leaf(DVec3::ONE)], 0, DAffine3::IDENTITY);
    for term in ["luft", "sky"] {
        let layer = bake(&alone, &[], json!({"ambient": term}));
        assert!(ambient(&layer).iter().all(|k| (1.0 - k).abs() < 1e-6), "{term}: {:?}", ambient(&layer));
    }
    let included = bake(&alone, &[], json!({"ambient": "luft", "self": "include", "radius_m": 1.0}));
    assert!(ambient(&included).iter().all(|k| *k < 0.9), "a leaf that counts itself is darker");
}

#[test]
fn every_radius_gives_numbers_in_range() {
    let crown = crown(12, 2.0, 0.08, 20);
    for radius in [1e-30, 0.01, 1.0, 1e12] {
        for term in ["luft", "sky"] {
            let layer = bake(&crown, &[], json!({"ambient": term, "radius_m": radius}));
            assert_eq!(ambient(&layer).len(), 68, "{term} at {radius}");
        }
    }
    let apart = bake(&crown, &[], json!({"ambient": "luft", "radius_m": 1e-4}));
    assert!(ambient(&apart)[..48].iter().all(|k| *k >= 1.0), "leaves out of each other's reach are lit");
}

#[test]
fn numbers_that_are_none_are_refused_by_name() {
    let bad = [
        Params { radius_m: Some(f64::NAN), ..Params::default() },
        Params { radius_m: Some(0.0), ..Params::default() },
        Params { radius_m: Some(f64::INFINITY), ..Params::default() },
        Params { threshold: -0.1, ..Params::default() },
        Params { darkest_density: 0.0, ..Params::default() },
        Params { exponent: f64::NAN, ..Params::default() },
        Params { blend: 1.5, ..Params::default() },
    ];
    for params in bad {
        let message = params.check().unwrap_err().to_string();
        assert!(message.contains("density.") && message.contains("must be"), "{message}");
    }
    let crown = crown(20, 1.0, 0.1, 0);
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(&crown), maps: &maps, neighbors: &[] };
    for given in [json!({"radius_m": -1.0}), json!({"radius": 1.0}), json!({"ambient": "both"})] {
        let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
        assert!(run(&Density, &inputs, &request, &Quiet).is_err(), "{given}");
    }
}

#[test]
fn a_plant_without_leaves_gives_an_empty_layer_and_a_finding() {
    let bare = plant(&[], 30, DAffine3::IDENTITY);
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(&bare), maps: &maps, neighbors: &[] };
    let (layer, findings) = run(&Density, &inputs, &Request::default(), &Quiet).unwrap();
    assert!(layer.attributes.is_empty());
    assert_eq!(findings.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["LEAF-NONE"]);
}

#[test]
fn leaves_without_area_still_get_values() {
    let crown = crown(50, 1.0, 0.0, 5);
    let layer = bake(&crown, &[], json!({"ambient": "luft"}));
    assert!(ambient(&layer).iter().all(|k| *k >= 1.0));
}

#[test]
fn a_neighbor_darkens_and_leaves_the_reference_alone() {
    let (small, params) = (crown(400, 1.0, 0.05, 10), json!({"ambient": "luft", "radius_m": 0.4}));
    let neighbor =
        || Placed { plant: crown(800, 1.5, 0.05, 0).into(), transform: DAffine3::from_translation(DVec3::X * 1.0) };
    let (alone, beside) = (bake(&small, &[], params.clone()), bake(&small, &[neighbor()], params));
    assert_eq!(alone.record.facts["referenceDensity"], beside.record.facts["referenceDensity"]);
    let (a, b) = (ambient(&alone), ambient(&beside));
    assert!(a.iter().zip(&b).all(|(a, b)| b <= a) && a.iter().zip(&b).any(|(a, b)| *b < a - 0.1));
    let (a, b) = (ambient(&bake(&small, &[], json!({}))), ambient(&bake(&small, &[neighbor()], json!({}))));
    assert!(b.iter().sum::<f32>() < a.iter().sum::<f32>() * 0.99, "the sky sees the neighbor");
}

#[test]
fn normals_point_out_of_a_round_crown() {
    let crown = crown(2000, 2.0, 0.1, 0);
    let layer = bake(&crown, &[], json!({"channels": "normals"}));
    let normals = layer.attribute(crown.parts()[0].place, names::SOFT_NORMAL).and_then(Array::as_f32).unwrap();
    let outward = |i: &usize| {
        let n = DVec3::from_array([0, 1, 2].map(|axis| f64::from(normals[i * 3 + axis])));
        let p = crown.parts()[0].rest_position(*i) - crown.center();
        p.length() < 1.2 || n.dot(p.normalize()) > 0.3
    };
    let share = (0..8000).filter(outward).count();
    assert!(share > 7900, "{share} of 8000");
    // A leaf's corners agree.
    assert!(normals.chunks_exact(12).all(|leaf| leaf[..3] == leaf[9..]));
}

#[test]
fn a_blend_of_one_gives_the_original_normal() {
    let crown = crown(200, 1.0, 0.05, 0);
    let layer = bake(&crown, &[], json!({"blend": 1.0}));
    let normals = layer.attribute(crown.parts()[0].place, names::SOFT_NORMAL).and_then(Array::as_f32).unwrap();
    let own = crown.parts()[0].normals.iter().flat_map(|n| n.to_array());
    assert!(normals.iter().zip(own).all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn opposite_normals_mix_to_the_realigned_one() {
    assert_eq!(crate::normals::mix(DVec3::X, -DVec3::X, 0.5), DVec3::X);
}

#[test]
fn sky_and_k_a_fall_with_the_depth_under_a_crown() {
    // Boughs blur what density says of depth, so k_a is asked of a crown without them, and with a radius that
    // averages over many leaves.
    let even: Vec<Quad> = in_ball(2000).map(|p| Quad { edge: 0.12, ..leaf(p * 2.0) }).collect();
    let boughs = (AmbientTerm::Sky, crown(2000, 2.0, 0.12, 0), None);
    let even = (AmbientTerm::Luft, plant(&even, 0, DAffine3::IDENTITY), Some(1.0));
    for (term, crown, radius_m) in [boughs, even] {
        let depth = crown_depth(&crown);
        let params = Params { radius_m, ambient: term, channels: Channels::Ambient, ..Params::default() };
        let foliage = Foliage::new(&crown, &[], &params);
        let values = fast::values(&crown, &foliage, &fast::Places::new(&crown, &params), &params).unwrap();
        let leaves: Vec<f64> = values.ambient.iter().step_by(4).map(|k| f64::from(*k)).collect();
        let rank = spearman(&leaves, &depth).unwrap();
        assert!(rank < -0.5, "{term:?}: {rank}");
    }
}

#[test]
fn scenes_get_what_they_ask_for_and_bytes_are_exact() {
    let crown = crown(100, 1.0, 0.05, 7);
    let mut scene = Scene::default();
    let written = |layer: &foliar_bake::Layer| layer.attributes.values().map(|a| a.bytes().len() as u64).sum::<u64>();
    for (wanted, soft) in
        [(Ambient::Auto, true), (Ambient::Auto, false), (Ambient::Traced, true), (Ambient::None, false)]
    {
        (scene.light.ambient, scene.light.soft_normals) = (wanted, soft);
        match Density.require(&scene, &Facts::of(&crown)) {
            Requirement::Required { params, bytes, .. } => {
                assert_eq!(bytes, written(&bake(&crown, &[], Value::Object(params))), "{wanted:?} {soft}");
            }
            Requirement::NotRequired { .. } => assert!(!soft && wanted == Ambient::None),
        }
    }
}

#[test]
fn wood_gets_an_ambient_term_and_keeps_its_normals() {
    let crown = crown(100, 1.0, 0.05, 40);
    let layer = bake(&crown, &[], json!({"self": SelfLeaf::Include}));
    let wood = crown.parts()[1].place;
    assert!(crown.structure().leaf_ids[1].iter().all(|id| *id == NO_LEAF));
    assert_eq!(layer.attribute(wood, names::AMBIENT).map(Array::rows), Some(40));
    assert_eq!(layer.attribute(wood, names::SOFT_NORMAL), None);
    let baked: Baked =
        Density.reference(&Inputs { plant: None, maps: &Maps::new(), neighbors: &[] }, &Map::new()).unwrap();
    assert!(baked.attributes.is_empty());
}
