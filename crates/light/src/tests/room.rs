//! The room at its limits: few leaves, far away, tiny and huge, parameters that do not go together, what scenes need.

use super::{oracle, plants};
use crate::profile::MOST_DEPTH;
use crate::{Light, Params, rays_at};
use foliar_bake::{Array, Baker, ColumnKey, Facts, Inputs, Layer, Maps, Quiet, Request, Requirement, run};
use foliar_numerics::{fibonacci_sphere, radical_inverse};
use foliar_plant::{Plant, sample::odd_plants};
use foliar_schema::{Finding, Scene, Sky, Sun, names};
use glam::{DAffine3, DVec3};
use serde_json::{Value, json};

fn bake(plant: &Plant, given: &Value) -> (Layer, Vec<Finding>) {
    let inputs = Inputs { plant: Some(plant), maps: &Maps::new(), neighbors: &[] };
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    run(&Light, &inputs, &request, &Quiet).unwrap()
}

fn depths(layer: &Layer) -> Vec<f32> {
    layer.column(names::CLASS_LIGHT, names::OPTICAL_DEPTH).and_then(Array::as_f32).unwrap().to_vec()
}

fn in_ball(count: u64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| fibonacci_sphere(i as usize, count as usize) * libm::cbrt(radical_inverse(i + 1, 3)))
}

fn nearest(a: &[f32], b: &[f32]) -> f64 {
    let seen = |depth: f32| libm::exp(-f64::from(depth));
    a.iter().zip(b).map(|(a, b)| (seen(*a) - seen(*b)).abs()).fold(0.0, f64::max)
}

#[test]
fn every_engine_bakes_every_odd_plant() {
    for sample in odd_plants() {
        for given in
            [json!({"engine": "rays", "sun": "harmonics"}), json!({"engine": "tree", "opening": 0.9}), json!({})]
        {
            let (layer, findings) = bake(&sample.plant, &given);
            let leaves = sample.plant.leaves().len();
            let rows = layer.column(names::CLASS_LIGHT, names::OPTICAL_DEPTH).map_or(0, Array::rows);
            assert_eq!(rows, leaves, "{}", sample.name);
            assert_eq!(leaves == 0, findings.iter().any(|finding| finding.code == "LEAF-NONE"), "{}", sample.name);
            let wood = layer.attributes.len();
            let parts = (0..sample.plant.parts().len()).filter(|i| sample.plant.role(*i) == foliar_schema::Role::Wood);
            assert_eq!(wood, if leaves == 0 { 0 } else { 2 * parts.count() }, "{}", sample.name);
        }
    }
}

#[test]
fn one_leaf_is_fully_lit_and_leaves_at_one_place_are_not() {
    let one = plants::plant(&plants::squares([DVec3::ONE].into_iter(), 0.1), DAffine3::IDENTITY);
    for engine in ["exact", "tree", "rays"] {
        assert_eq!(depths(&bake(&one, &json!({"engine": engine})).0), [0.0; 8], "{engine}");
    }
    let mut two = plants::squares([DVec3::ONE; 2].into_iter(), 0.1);
    two.edges[1] = two.edges[0];
    let two = plants::plant(&two, DAffine3::IDENTITY);
    // Half of each octant is hidden: see the oracle's "two_coincident".
    let half = depths(&bake(&two, &json!({"engine": "exact"})).0);
    assert!(half.iter().all(|depth| (depth - std::f32::consts::LN_2).abs() < 1e-5), "{half:?}");
    let paper = depths(&bake(&two, &json!({"engine": "exact", "profile": "paper"})).0);
    assert!(paper.iter().all(|depth| (depth - libm::logf(256.0)).abs() < 1e-4), "{paper:?}");
    let zero = plants::plant(&plants::squares(in_ball(9), 0.0), DAffine3::IDENTITY);
    for engine in ["exact", "tree", "rays"] {
        let (layer, _) = bake(&zero, &json!({"engine": engine}));
        assert_eq!(depths(&layer), [0.0; 72], "leaves without area, {engine}");
        assert_eq!(layer.record.facts["extinctionPerM"], json!(0.0));
    }
}

#[test]
fn unit_and_place_change_nothing_but_rounding() {
    let set = plants::squares(in_ball(600), 0.12);
    for engine in [json!({"engine": "exact"}), json!({"engine": "tree", "opening": 0.5})] {
        let home = depths(&bake(&plants::plant(&set, DAffine3::IDENTITY), &engine).0);
        for power in [-40, -20, 20, 40] {
            let scale = libm::exp2(f64::from(power));
            let scaled = plants::plant(&set, DAffine3::from_scale(DVec3::splat(scale)));
            let (layer, _) = bake(&scaled, &engine);
            assert!(nearest(&depths(&layer), &home) < 1e-6, "2^{power}");
            let tau = layer.record.facts["extinctionPerM"].as_f64().unwrap() * scale;
            assert!((0.1..10.0).contains(&tau), "extinction is per meter: {tau} at 2^{power}");
        }
        let far = plants::plant(&set, DAffine3::from_translation(DVec3::new(1e6, -1e6, 3e5)));
        let off = nearest(&depths(&bake(&far, &engine).0), &home);
        assert!(off < 1e-4, "{off:e} at 1e6 m, where f64 holds a tenth of a nanometer");
    }
}

#[test]
fn what_does_not_go_together_is_refused_by_name() {
    let refused = |given: Value| Params::from_json(given.as_object().unwrap()).unwrap_err().to_string();
    for (given, words) in [
        (json!({"reflectance_front": [0.6], "transmittance_front": [0.5]}), "light.reflectance_front"),
        (json!({"transmittance_back": [0.1, 0.97, 0.1]}), "in green"),
        (json!({"reflectance_back": [0.1, 0.1]}), "must be one, or red, green, blue"),
        (json!({"reflectance_back": [-0.1]}), "at least 0"),
        (json!({"opening": 0.95}), "at most 0.9"),
        (json!({"opening": 0.0}), "above 0"),
        (json!({"quality": -1.0}), "above 0"),
        (json!({"rays": 0}), "at least 1"),
        (json!({"engine": "magic"}), "magic"),
        (json!({"tau": 1.0}), "tau"),
    ] {
        let message = refused(given.clone());
        assert!(message.contains(words), "{given}: {message}");
    }
    for params in [
        Params { quality: Some(f64::NAN), ..Params::default() },
        Params { opening: Some(f64::INFINITY), ..Params::default() },
        Params { reflectance_front: vec![f64::NAN], ..Params::default() },
    ] {
        assert!(params.check().unwrap_err().to_string().contains("light."), "{params:?}");
    }
}

#[test]
fn a_scene_gets_what_it_shows_and_pays_for_what_is_written() {
    let plant = foliar_plant::sample::Recipe::small().grow();
    let facts = Facts::of(&plant);
    let Requirement::Required { bytes, .. } = Light.require(&Scene::default(), &facts) else { panic!("sun and sky") };
    let layer = bake(&plant, &json!({})).0;
    let written: usize = layer.attributes.values().chain(layer.columns.values()).map(|array| array.bytes().len()).sum();
    assert_eq!(bytes, written as u64);
    let scene = |sun, sky| {
        let mut scene = Scene::default();
        (scene.light.sun, scene.light.sky) = (sun, sky);
        matches!(Light.require(&scene, &facts), Requirement::Required { .. })
    };
    assert!(scene(Sun::Fixed, Sky::None) && scene(Sun::None, Sky::Varying) && scene(Sun::Moving, Sky::Constant));
    assert!(!scene(Sun::None, Sky::None) && !scene(Sun::None, Sky::Constant));
}

#[test]
fn the_promise_is_measured_and_said_where_it_is_not_kept() {
    let plant = plants::plant(&plants::squares(in_ball(6000), 0.05), DAffine3::IDENTITY);
    let error = |given: Value| {
        let (layer, findings) = bake(&plant, &given);
        (layer.record.errors[0].rms_steps, findings.iter().any(|finding| finding.code == "QUALITY-MISSED"))
    };
    for quality in [4.0, 1.0, 0.25] {
        let (rms, missed) = error(json!({"quality": quality}));
        assert!(rms <= quality && !missed, "{rms} at {quality}");
    }
    let (rms, missed) = error(json!({"engine": "tree", "opening": 0.9, "quality": 0.05}));
    assert!(missed && rms > 0.05, "{rms}");
}

#[test]
fn rays_see_what_the_oracle_traced() {
    let Some(oracle) = oracle::oracle() else { return };
    for scene in oracle["monte_carlo"].as_array().unwrap() {
        let set = oracle::set(scene);
        let leaves: Vec<usize> = oracle::numbers(&scene["leaf_index"]).into_iter().map(|i| i as usize).collect();
        let seen = rays_at(&plants::plant(&set, DAffine3::IDENTITY), &leaves, 512).unwrap();
        let (mut sum, mut square, mut count) = (0.0, 0.0, 0.0);
        for (row, seen) in seen.iter().enumerate() {
            for (j, truth) in oracle::numbers(&scene["T_area"][row]).into_iter().enumerate() {
                let seen = libm::exp(-f64::from(seen[j]));
                (sum, square, count) = (sum + seen - truth, square + (seen - truth).powi(2), count + 1.0);
            }
        }
        let (bias, rms): (f64, f64) = (sum / count, libm::sqrt(square / count));
        // The oracle's own noise is .016 per entry; ours at 512 rays at most .022.
        assert!(bias.abs() < 0.004 && rms < 0.028, "{}: bias {bias}, rms {rms}", scene["name"]);
    }
}

#[test]
fn rays_meet_wood_and_pass_through_what_a_texture_cuts_away() {
    let plant = foliar_plant::sample::Recipe::small().grow();
    let baked = depths(&bake(&plant, &json!({"engine": "rays", "rays": 64})).0);
    let opaque = {
        let mut base = plant.base().clone();
        base.materials.iter_mut().for_each(|m| m.alpha_mode = foliar_plant::AlphaMode::Opaque);
        Plant::new(base, plant.structure().clone()).unwrap()
    };
    let bare = {
        let mut structure = plant.structure().clone();
        let is_wood = |role: &foliar_schema::Role| *role == foliar_schema::Role::Wood;
        structure.roles.iter_mut().filter(|r| is_wood(r)).for_each(|role| *role = foliar_schema::Role::Other);
        Plant::new(plant.base().clone(), structure).unwrap()
    };
    let mean = |plant: &Plant| {
        let list = depths(&bake(plant, &json!({"engine": "rays", "rays": 64})).0);
        list.iter().map(|depth| libm::exp(-f64::from(*depth))).sum::<f64>() / list.len() as f64
    };
    let seen = baked.iter().map(|depth| libm::exp(-f64::from(*depth))).sum::<f64>() / baked.len() as f64;
    assert!(mean(&opaque) < seen - 0.02, "cards without holes are darker");
    assert!(mean(&bare) > seen + 0.002, "wood casts shadows");
    assert!(baked.iter().all(|depth| *depth <= MOST_DEPTH as f32));
}

#[test]
fn harmonics_hold_the_transmittance() {
    let plant = plants::plant(&plants::squares(in_ball(300), 0.15), DAffine3::IDENTITY);
    let (layer, _) = bake(&plant, &json!({"engine": "rays", "sun": "harmonics", "rays": 64}));
    let key = ColumnKey { class: names::CLASS_LIGHT.into(), property: names::SUN_HARMONICS.into() };
    let harmonics = layer.columns[&key].as_f32().unwrap();
    for (row, depths) in harmonics.chunks(9).zip(depths(&layer).chunks(8)) {
        // The mean over the sphere, from either.
        let mean = depths.iter().map(|depth| libm::exp(-f64::from(*depth))).sum::<f64>() / 8.0;
        let first = f64::from(row[0]) / (2.0 * std::f64::consts::PI.sqrt());
        assert!((first - mean).abs() < 1e-4, "{first} {mean}");
    }
}

#[test]
fn kinds_of_leaves_are_those_of_the_shared_table() {
    let root = std::env::var("FOLIAR_SHARED").unwrap_or(format!("{}/../../../shared", env!("CARGO_MANIFEST_DIR")));
    let Ok(text) = std::fs::read_to_string(format!("{root}/oracles/translucency/leaf_params.json")) else {
        eprintln!("skipped: {root}/oracles/translucency/leaf_params.json: no shared data");
        return;
    };
    let table: Vec<Value> = serde_json::from_str(&text).unwrap();
    use crate::optics::OpticsKind;
    let names = [OpticsKind::Typical, OpticsKind::Young, OpticsKind::Dark, OpticsKind::Senescent];
    for (kind, name) in names.into_iter().zip(["typical", "young-thin", "dark-thick", "senescent"]) {
        let optics = kind.optics();
        for (band, wavelength) in [610, 550, 450].into_iter().enumerate() {
            let row = table.iter().find(|row| row["case"] == name && row["wl"] == wavelength).unwrap();
            for (found, key) in [(optics.reflectance_front, "R"), (optics.transmittance_back, "T")] {
                assert!((found[band] - row[key].as_f64().unwrap()).abs() < 1e-4, "{name} {wavelength} {key}");
            }
        }
        optics.check().unwrap();
    }
}
