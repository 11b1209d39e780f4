//! The paper's own modes and the surface's normals: what each means, and that each bears every extreme.

use super::plants::{Quad, crown, plant};
use crate::surface::{Balls, Surface, SurfaceParams, check_mesh, extract_fast, nearest, pieces};
use crate::{Density, Field, Foliage, Generator, GeneratorKind, Params, fast};
use foliar_bake::{BakeError, Inputs, Layer, Maps, Quiet, Request, run};
use foliar_plant::{Plant, sample::odd_plants};
use foliar_schema::names;
use glam::{DAffine3, DQuat, DVec3, Vec3};
use serde_json::{Value, json};

fn try_bake(plant: &Plant, given: &Value) -> Result<Layer, BakeError> {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    Ok(run(&Density, &inputs, &request, &Quiet)?.0)
}

fn channel(layer: &Layer, name: &str) -> Vec<f32> {
    let of = layer.attributes.iter().filter(|(key, _)| key.name == name);
    of.flat_map(|(_, array)| array.as_f32().unwrap().to_vec()).collect()
}

fn normals(layer: &Layer) -> Vec<DVec3> {
    let list = channel(layer, names::SOFT_NORMAL);
    list.chunks_exact(3).map(|n| Vec3::from_slice(n).as_dvec3()).collect()
}

fn leaf(center: DVec3, edge: f64) -> Quad {
    Quad { center, edge, normal: DVec3::Z }
}

/// Every mode, one parameter at a time and the paper's all together.
fn modes() -> Vec<Value> {
    vec![
        json!({"ambient": "luft"}),
        json!({"generators": "leaf-count"}),
        json!({"generators": "primitive"}),
        json!({"subsample": 0.3}),
        json!({"self": "include", "ambient": "luft"}),
        json!({"density_unit": "absolute", "ambient": "luft"}),
        json!({"normals": "surface"}),
        json!({"normals": "surface", "ambient": "luft", "blend": 0.5}),
        json!({"normals": "surface", "ambient": "luft", "generators": "primitive", "self": "include",
               "density_unit": "absolute", "subsample": 0.5, "exponent": 1.0}),
    ]
}

fn with(mode: &Value, name: &str, value: impl Into<Value>) -> Value {
    let mut mode = mode.clone();
    mode[name] = value.into();
    mode
}

#[test]
fn every_mode_bears_every_extreme() {
    let row = |n: usize, step: DVec3| -> Vec<Quad> { (0..n).map(|i| leaf(step * i as f64, 0.05)).collect() };
    let plane = (0..25).map(|i| leaf(DVec3::new((i % 5) as f64, 0.0, (i / 5) as f64) * 0.2, 0.05)).collect();
    let grown = |scale: f64, shift: f64| -> Vec<Quad> {
        let ball = super::plants::in_ball(40);
        ball.map(|p| leaf(p * scale + DVec3::splat(shift), 0.1 * scale)).collect()
    };
    let shapes: [(&str, Vec<Quad>); 9] = [
        ("one leaf", row(1, DVec3::ZERO)),
        ("two coincident", row(2, DVec3::ZERO)),
        ("line", row(20, DVec3::X * 0.2)),
        ("plane", plane),
        ("no area", super::plants::in_ball(10).map(|p| leaf(p, 0.0)).collect()),
        ("1e-6 m", grown(1e-6, 0.0)),
        ("1e6 m", grown(1e6, 0.0)),
        ("1e6 m away", grown(1.0, 1e6)),
        ("none", Vec::new()),
    ];
    for (name, quads) in &shapes {
        let plant = plant(quads, 6, DAffine3::IDENTITY);
        for mode in modes() {
            // Ranges and units are checked by `run`.
            let layer = try_bake(&plant, &mode).unwrap_or_else(|e| panic!("{name}, {mode}: {e}"));
            let count = if quads.is_empty() { 0 } else { 4 * quads.len() };
            assert_eq!(normals(&layer).len(), count, "{name}, {mode}");
        }
    }
}

#[test]
fn every_mode_bears_every_radius() {
    let crown = crown(30, 2.0, 0.08, 20);
    for radius in [1e-30, 1e-3, 0.5, 1e12] {
        for mode in modes() {
            let layer = try_bake(&crown, &with(&mode, "radius_m", radius));
            assert_eq!(normals(&layer.unwrap_or_else(|e| panic!("{radius}, {mode}: {e}"))).len(), 120);
        }
    }
}

#[test]
fn the_record_says_which_modes() {
    let crown = crown(30, 1.0, 0.08, 0);
    for mode in modes() {
        let layer = try_bake(&crown, &mode).unwrap();
        for (name, value) in mode.as_object().unwrap() {
            assert_eq!(&layer.record.resolved[name], value, "{mode}");
        }
        assert_eq!(layer.record.facts["normals"], layer.record.resolved["normals"]);
        if let Some(unit) = layer.record.facts.get("referenceDensity").and_then(Value::as_f64) {
            let absolute = mode["density_unit"] == "absolute";
            assert!(!absolute || (unit - 1.0).abs() < 1e-12, "{mode}");
            assert!((layer.record.facts["threshold"].as_f64().unwrap() - 0.1 * unit).abs() < 1e-12 * unit);
        }
    }
}

/// The plant with each leaf's two triangles cut into eight.
fn cut_finer(plant: &Plant) -> Plant {
    let (mut base, mut structure) = (plant.base().clone(), plant.structure().clone());
    let (part, ids) = (&mut base.parts[0], &mut structure.leaf_ids[0]);
    for _ in 0..2 {
        let coarse = std::mem::take(&mut part.triangles);
        for [a, b, c] in coarse {
            // Longest side first: b to c of a right triangle's two halves stays right.
            let middle = (part.positions[a as usize] + part.positions[c as usize]) / 2.0;
            let new = part.positions.len() as u32;
            part.positions.push(middle);
            part.normals.push(part.normals[a as usize]);
            part.position_ids.push(base.position_count);
            base.position_count += 1;
            ids.push(ids[a as usize]);
            part.triangles.extend([[a, b, new], [new, b, c]]);
        }
    }
    Plant::new(base, structure).unwrap()
}

#[test]
fn primitives_count_triangles_and_leaves_do_not() {
    let coarse = crown(200, 1.0, 0.05, 0);
    let fine = cut_finer(&coarse);
    let densities = |plant: &Plant, generators| {
        let params = Params { generators, radius_m: Some(0.4), ..Params::default() };
        let foliage = Foliage::new(plant, &[], &params);
        (
            foliage.generators.len(),
            fast::density_unit(&foliage, &params, |queries| {
                crate::Field::new(foliage.own(), foliage.radius).densities(queries)
            }),
            foliage.mean_area,
        )
    };
    for kind in [GeneratorKind::Leaf, GeneratorKind::LeafCount] {
        let (one, other) = (densities(&coarse, kind), densities(&fine, kind));
        assert_eq!((one.0, other.0), (200, 200));
        assert!((one.1 / other.1 - 1.0).abs() < 1e-6, "{kind:?}: {one:?} {other:?}");
    }
    let (one, other) = (densities(&coarse, GeneratorKind::Primitive), densities(&fine, GeneratorKind::Primitive));
    assert_eq!((one.0, other.0), (400, 1600));
    // Four times the balls at nearly the same places, a twentieth of a leaf's edge apart of a radius of 8 edges.
    assert!((other.1 / one.1 / 4.0 - 1.0).abs() < 0.02, "{one:?} {other:?}");
    assert!((one.2 / other.2 / 4.0 - 1.0).abs() < 1e-6, "the foliage's whole area stays");
}

#[test]
fn absolute_densities_are_those_of_the_paper() {
    // Eq. 4 at one other leaf half a radius away: S = (1 - 1/4)^2 = .5625.
    let pair = plant(&[leaf(DVec3::ZERO, 1e-4), leaf(DVec3::X * 0.5, 1e-4)], 0, DAffine3::IDENTITY);
    let given = json!({"ambient": "luft", "density_unit": "absolute", "radius_m": 1.0, "threshold": 0.0625,
                       "darkest_density": 1.0, "darkest_ambient": 0.2, "exponent": 2.0});
    let ambient = channel(&try_bake(&pair, &given).unwrap(), names::AMBIENT);
    // Corners lie within 1e-4 of the center; the slope of k_a there is below 2.
    assert!(ambient.iter().all(|k| (f64::from(*k) - (0.2 + 0.8 * 0.25)).abs() < 2e-4), "{ambient:?}");
    let relative = channel(&try_bake(&pair, &with(&given, "density_unit", "median")).unwrap(), names::AMBIENT);
    // The median of two leaves that see .5625 each is below a leaf's weight: the unit is 1 again.
    assert_eq!(relative, ambient);
}

#[test]
fn a_subsample_stands_for_the_whole() {
    let crown = crown(4000, 1.0, 0.03, 0);
    let given = json!({"ambient": "luft", "radius_m": 0.4, "density_unit": "absolute", "darkest_density": 1000.0});
    let whole = channel(&try_bake(&crown, &given).unwrap(), names::AMBIENT);
    assert_eq!(channel(&try_bake(&crown, &with(&given, "subsample", 1.0)).unwrap(), names::AMBIENT), whole);
    let half = channel(&try_bake(&crown, &with(&given, "subsample", 0.5)).unwrap(), names::AMBIENT);
    let mean = |list: &[f32]| list.iter().map(|&v| f64::from(v)).sum::<f64>() / list.len() as f64;
    // Some 250 balls in reach, half of them drawn: a deviation of 1 / sqrt(250) at each place, less on average.
    assert!((mean(&whole) - mean(&half)).abs() < 0.06 * (1.0 - mean(&whole)), "{} {}", mean(&whole), mean(&half));
    assert_ne!(whole, half);
    for share in [0.0, -0.5, 1.5] {
        assert!(try_bake(&crown, &with(&given, "subsample", share)).is_err(), "{share}");
    }
}

#[test]
fn surface_normals_point_out_of_a_round_crown_and_not_into_its_hollow() {
    let boughs: Vec<Quad> = (0..3000).map(|i| leaf(foliar_numerics::fibonacci_sphere(i, 3000) * 2.0, 0.05)).collect();
    let hollow = plant(&boughs, 0, DAffine3::IDENTITY);
    let layer = try_bake(&hollow, &json!({"normals": "surface", "radius_m": 0.5, "surface_cell_m": 0.1})).unwrap();
    let outward = |(at, n): (&Quad, &[DVec3])| n.iter().all(|n| n.dot(at.center.normalize()) > 0.95);
    // The leaves' shell is a radius thick; the outer sheet follows it to a few per cent.
    assert!(boughs.iter().zip(normals(&layer).chunks_exact(4)).all(outward));
}

#[test]
fn a_blend_mixes_and_is_unit() {
    let crown = crown(200, 1.0, 0.05, 0);
    let of = |mode: &str, blend: f64| {
        normals(&try_bake(&crown, &json!({"normals": mode, "radius_m": 0.4, "blend": blend})).unwrap())
    };
    for mode in ["sky", "surface"] {
        let (pure, own) = (of(mode, 0.0), crown.parts()[0].normals.iter().map(|n| n.as_dvec3()));
        for ((mixed, pure), own) in of(mode, 0.3).iter().zip(&pure).zip(own) {
            let expected = (*pure * 0.7 + own * 0.3).normalize();
            // Three rounded f32 components of a unit vector, blown up where .7 and .3 nearly cancel: not below .4.
            assert!(mixed.distance(expected) < 1e-6, "{mode}: {mixed}, {expected}");
        }
        assert!(of(mode, 1.0).iter().zip(&crown.parts()[0].normals).all(|(a, b)| a.as_vec3().distance(*b) < 1e-6));
    }
}

#[test]
fn the_surface_turns_with_the_plant() {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.0);
    let ball = |position: DVec3| Generator { position, weight: 1.0, group: 0 };
    let here: Vec<Generator> = super::plants::in_ball(100).map(ball).collect();
    let there: Vec<Generator> = here.iter().map(|b| ball(turn * b.position)).collect();
    let places: Vec<DVec3> = super::plants::in_ball(300).map(|p| p * 1.5).collect();
    let cell = 0.02;
    let distances = |generators: &[Generator], turn: DQuat| -> Vec<f64> {
        let places: Vec<DVec3> = places.iter().map(|p| turn * *p).collect();
        let balls = Balls { generators, radius_m: 0.4, threshold: 0.5 };
        let surface = extract_fast(&balls, &SurfaceParams { cell_m: Some(cell), ..SurfaceParams::default() }).unwrap();
        let feet = nearest(&surface, &Field::new(generators, 0.4), &places).unwrap();
        feet.iter().zip(&places).map(|(f, p)| (f.point.as_dvec3() + surface.origin).distance(*p)).collect()
    };
    let pairs = distances(&here, DQuat::IDENTITY).into_iter().zip(distances(&there, turn));
    let mut off: Vec<f64> = pairs.map(|(a, b)| (a - b).abs()).collect();
    off.sort_unstable_by(f64::total_cmp);
    // The mesh lies within h^2 / 8 times the curvature, some 2 / rho, of the surface: h / 80. Necks and tips
    // thinner than a cell's diagonal may come and go with the lattice; the foot, and with it the normal, jumps
    // where two sheets are equally near: only its distance is a law.
    assert!(off[off.len() * 9 / 10] < 0.1 * cell && off[off.len() - 1] < 3.0f64.sqrt() * cell, "{:?}", off.last());
}

#[test]
fn the_hull_of_every_odd_plant_is_closed_and_outward() {
    for sample in odd_plants() {
        let maps = Maps::new();
        let inputs = Inputs { plant: Some(&sample.plant), maps: &maps, neighbors: &[] };
        let params = foliar_bake::resolve_params(&Density, &Default::default(), &Default::default()).unwrap();
        let hull = foliar_bake::Enclose::enclose(&Density, &inputs, &params).unwrap();
        assert_eq!(hull.triangles.is_empty(), sample.plant.leaves().is_empty(), "{}", sample.name);
        assert!(check_mesh(&hull.triangles, hull.positions.len()).is_empty(), "{}", sample.name);
        let surface = Surface { positions: hull.positions, triangles: hull.triangles, ..Surface::default() };
        assert!(pieces(&surface).iter().all(|piece| piece.volume > 0.0), "{}", sample.name);
        let bounds = surface.bounds().map(|(middle, half)| (middle + hull.origin - sample.plant.center(), half));
        // It encloses the foliage where the foliage is.
        let size = sample.plant.size().max_element();
        assert!(
            bounds.is_none_or(|(middle, half)| middle.length() <= size && half.max_element() <= 3.0 * size),
            "{}",
            sample.name
        );
    }
}

#[test]
fn a_surface_that_cannot_be_is_refused_in_the_rooms_own_words() {
    let crown = crown(100, 1.0, 0.05, 0);
    for (given, words) in [
        (json!({"threshold": 0.0}), ["density.threshold", "gradient vanishes"]),
        (json!({"surface_cell_m": 1e-6}), ["density.surface_cell_m", "surface_memory_mb = 4096"]),
        (json!({"surface_cell_m": 1e-6}), [" would", "1e-6"]),
        (json!({"surface_cell_m": 9.0}), ["density.surface_cell_m", "at most radius_m"]),
    ] {
        let error = try_bake(&crown, &with(&given, "normals", "surface")).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word) || error.contains("0.000001")), "{error}");
        let other = given.as_object().unwrap().clone();
        assert!(try_bake(&crown, &Value::Object(other)).is_ok(), "sky asks for no surface");
    }
}
