//! No twig slides on its parent: measured on triangles, on plants whose truth is known.

use crate::noise::{Field, Noise};
use crate::quality::{Quality, measure};
use crate::{Exit, Gust, Params, Player, Rule, Wind, fast};
use foliar_bake::{Inputs, Layer, Maps, Quiet, Request, run};
use foliar_plant::sample::hard_tree;
use foliar_plant::{Axis, Base, Branches, OnBranch, Part, Plant, Stalk, Structure};
use foliar_schema::Role;
use glam::{DVec2, DVec3};
use serde_json::json;

pub fn bake(plant: &Plant) -> Layer {
    let inputs = Inputs { plant: Some(plant), maps: &Maps::new(), neighbors: &[] };
    run(&Wind, &inputs, &Request::default(), &Quiet).unwrap().0
}

pub fn noise() -> Field {
    let inputs = Inputs { plant: None, maps: &Maps::new(), neighbors: &[] };
    let given = json!({"size": 64, "kmax": 16}).as_object().cloned().unwrap();
    let layer = run(&Noise, &inputs, &Request { given, ..Request::default() }, &Quiet).unwrap().0;
    Field::new(layer.rasters.values().next().unwrap()).unwrap()
}

fn quality(plant: &Plant) -> Quality {
    let (layer, noise) = (bake(plant), noise());
    let player = Player::new(plant, &layer).unwrap();
    let gusts: Vec<Gust> = (0..24).map(|i| player.gust(0.15, f64::from(i) * 1.7, DVec2::X, 0.0)).collect();
    measure(plant, &player, &gusts, &noise).unwrap()
}

/// Trees whose joints are those of tubes that cross or touch. Parents of three sides are far inside the circles that their
/// radii tell, and a branch twice as thick as its parent comes out over many of its rings: all the same.
const TREES: [&str; 9] = [
    "clean",
    "seam-doubled",
    "touching",
    "palm",
    "shrub-7-stems",
    "whorls",
    "coincident-rings",
    "fat-children",
    "three-sided-twigs",
];

#[test]
fn no_twig_slides_on_its_parent() {
    for name in TREES {
        let q = quality(&hard_tree(name, 1).unwrap().plant);
        // Gates of the issue: slip .08 and .15 radii, weights .02, leaves .01 of their size, normals 2 degrees.
        assert!(q.slip_p99 <= 0.08 && q.slip_max <= 0.15 && q.joints > 500, "{name}: {q:?}");
        assert!(q.step_max <= 0.02 && q.leaf_p99 <= 0.01 && q.normals_p99_deg <= 2.0, "{name}: {q:?}");
        assert!(q.uncorrected_p99_deg > 2.0 * q.normals_p99_deg, "{name}: {q:?}");
    }
}

#[test]
fn copies_of_a_place_keep_together() {
    for name in ["seam-doubled", "soup"] {
        let plant = hard_tree(name, 1).unwrap().plant;
        let branches = plant.branches().unwrap();
        let values = fast::values(&plant, branches, (&Params::default()).into());
        let mut list = Vec::new();
        for (part, places) in branches.vertices.iter().enumerate().filter(|(part, _)| plant.role(*part) == Role::Wood) {
            let bits = |v: usize| plant.parts()[part].positions[v].to_array().map(f32::to_bits);
            let weights = |v: usize| values.weights[part][v].map(f32::to_bits);
            list.extend(places.iter().enumerate().map(|(v, place)| (place.branch, bits(v), weights(v))));
        }
        list.sort_unstable();
        let copies = list.windows(2).filter(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1));
        let apart = copies.clone().filter(|w| w[0].2 != w[1].2).count();
        assert!(apart == 0 && copies.count() > 1000, "{name}: {apart} copies apart");
    }
}

#[test]
fn where_weights_start_at_the_root_twigs_slide() {
    let plant = hard_tree("clean", 1).unwrap().plant;
    let branches = plant.branches().unwrap();
    let rule = Rule { exit: Exit::Root, ..(&Params::default()).into() };
    let values = fast::values(&plant, branches, rule);
    let layer = bake(&plant);
    let mut player = Player::new(&plant, &layer).unwrap();
    player.weights = values.weights;
    let gusts = [player.gust(0.15, 3.0, DVec2::X, 0.0), player.gust(0.15, 9.0, DVec2::X, 0.0)];
    let q = measure(&plant, &player, &gusts, &noise()).unwrap();
    assert!(q.slip_max > 0.3, "{q:?}");
}

#[test]
fn a_clean_branch_starts_at_its_first_ring_outside() {
    // A trunk of radius 1, a bough across it whose rings stand at .5, 1.5, 2.5 and 4.5 from the axis.
    let tube = |from: DVec3, way: DVec3, stops: &[f64], radius: f64| {
        let (a, b) = way.any_orthonormal_pair();
        let turn = |k: usize| std::f64::consts::TAU * k as f64 / 8.0;
        let ring = move |s: &f64| {
            let center = from + way * *s;
            (0..8).map(move |k| center + (a * libm::cos(turn(k)) + b * libm::sin(turn(k))) * radius).collect::<Vec<_>>()
        };
        stops.iter().flat_map(ring).collect::<Vec<_>>()
    };
    let trunk = tube(DVec3::ZERO, DVec3::Y, &[0.0, 5.0, 10.0], 1.0);
    let bough = tube(DVec3::new(0.0, 5.0, 0.0), DVec3::X, &[0.5, 1.5, 2.5, 4.5], 0.2);
    let faces = |first: u32, rings: u32| {
        let quad = move |i: u32, k: u32| (first + 8 * i + k, first + 8 * i + (k + 1) % 8);
        (0..rings - 1).flat_map(move |i| {
            (0..8).flat_map(move |k| {
                let (a, b) = quad(i, k);
                [[a, b, b + 8], [a, b + 8, a + 8]]
            })
        })
    };
    let count = (trunk.len() + bough.len()) as u32;
    let part = Part {
        triangles: faces(0, 3).chain(faces(trunk.len() as u32, 4)).collect(),
        positions: trunk.iter().chain(&bough).map(|p| p.as_vec3()).collect(),
        position_ids: (0..count).collect(),
        ..Part::default()
    };
    let axis = |points: Vec<DVec3>, radius: f64| Axis::new(points.clone(), vec![radius; points.len()]);
    let stalk = |parent, axis, first_vertex| Stalk { parent, axis, margin: 1.0, first_vertex };
    let stops = [0.5, 1.5, 2.5, 4.5];
    let (mut branches, _) = Branches::grow(vec![
        stalk(None, axis(vec![DVec3::ZERO, DVec3::Y * 5.0, DVec3::Y * 10.0], 1.0), 0),
        stalk(Some(0), axis(stops.map(|s| DVec3::new(s, 5.0, 0.0)).into(), 0.2), 24),
    ]);
    let on = |branch, arc| vec![OnBranch { branch, arc }; 8];
    branches.vertices =
        vec![[on(0, 0.0), on(0, 5.0), on(0, 10.0), on(1, 0.0), on(1, 1.0), on(1, 2.0), on(1, 4.0)].concat()];
    let base = Base { parts: vec![part], position_count: count, ..Base::default() };
    let structure = Structure { roles: vec![Role::Wood], leaf_ids: vec![Vec::new()], ..Structure::default() };
    let plant = Plant::new(base, structure).unwrap().with_branches(branches).unwrap();
    let values = fast::values(&plant, plant.branches().unwrap(), (&Params::default()).into());
    let weights = |ring: usize| values.weights[0][8 * ring];
    // The trunk's middle is at half its length; the bough's own weight starts 1.5 m from the axis: 3 m are left.
    assert_eq!((weights(0), weights(1), weights(2)), ([0.0; 4], [0.5, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]));
    let third = (1.0f64 / 3.0) as f32;
    for (ring, own) in [(4, 0.0), (5, third), (6, 1.0)] {
        let [stem, bough, ..] = weights(ring);
        // The bough's bark is 0.2 m high on either side of the trunk's middle, where the square of the weight grows by
        // 0.05 below and 0.15 above a meter: what it inherits lies between.
        let power = f64::from(stem * stem);
        assert!((0.24..0.28).contains(&power) && (bough - own).abs() < 1e-6, "{:?}", weights(ring));
    }
    // Arc lengths of straight axes: exact but for the rounding of an arc to f32.
    assert!(values.longest_m.iter().zip([10.0, 3.0, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-6));
}
