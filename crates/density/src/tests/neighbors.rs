//! Laws of neighbors: they only darken, keep every bit where they do not reach, and stand where they are put.

use super::plants::{Quad, crown, plant};
use crate::{Density, Foliage, Params, Query, reference};
use foliar_bake::{Baker, Inputs, Layer, Maps, Placed, Placement, Quiet, Request, laws, run};
use foliar_numerics::ErrorStats;
use foliar_plant::Plant;
use foliar_schema::names;
use glam::{DAffine3, DVec3};
use serde_json::{Value, json};

fn bake(plant: &Plant, neighbors: &[Placed], given: &Value) -> Layer {
    let inputs = Inputs { plant: Some(plant), maps: &Maps::new(), neighbors };
    let request = Request { given: given.as_object().cloned().unwrap(), ..Request::default() };
    run(&Density, &inputs, &request, &Quiet).unwrap().0
}

fn values<'a>(plant: &Plant, layer: &'a Layer, name: &str) -> Vec<&'a [f32]> {
    plant.parts().iter().filter_map(|part| layer.attribute(part.place, name)?.as_f32()).collect()
}

fn placed(plant: Plant, offset_m: DVec3, yaw_deg: f64, scale: f64) -> Placed {
    Placed::new(plant, &Placement { offset_m, yaw_deg, scale })
}

fn small() -> Plant {
    crown(400, 1.0, 0.05, 10)
}

fn large(x: f64, z: f64) -> Placed {
    placed(crown(900, 1.5, 0.1, 5), DVec3::new(x, 0.3, z), 30.0, 1.2)
}

/// Both ambient terms, and the sky on its lattice rather than by single chords.
fn terms() -> [Value; 2] {
    [json!({"ambient": "luft", "radius_m": 0.4}), json!({"ambient": "sky", "radius_m": 0.2})]
}

#[test]
fn a_neighbor_never_brightens() {
    for given in terms() {
        let plant = crown(1200, 1.0, 0.05, 10);
        let mut neighbors: Vec<Placed> = Vec::new();
        let mut before = bake(&plant, &neighbors, &given);
        for (x, z) in [(1.0, 0.0), (-2.0, 1.0), (0.2, 0.1), (0.0, 9.0)] {
            neighbors.push(large(x, z));
            let after = bake(&plant, &neighbors, &given);
            let pairs = values(&plant, &before, names::AMBIENT).concat();
            let pairs = pairs.into_iter().zip(values(&plant, &after, names::AMBIENT).concat());
            // The mean of 32 exponentials rounds by some 1e-16; a k_a is rounded to f32 (6e-8) at last.
            assert!(pairs.clone().all(|(a, b)| b <= a + 1e-7), "{given} with one more at {x}, {z}");
            before = after;
        }
    }
}

#[test]
fn the_reference_density_is_the_plants_own() {
    let given = json!({"ambient": "luft"});
    let fact = |neighbors: &[Placed]| bake(&small(), neighbors, &given).record.facts;
    assert_eq!(fact(&[]), fact(&[large(0.5, 0.0), large(0.0, 0.0)]));
}

#[test]
fn beyond_the_radius_luft_keeps_every_bit_and_the_sky_does_not() {
    let [luft, sky] = terms();
    let (plant, far) = (small(), || [large(4.0, 0.0), large(0.0, 5e5)]);
    let ambient = |layer: &Layer| values(&plant, layer, names::AMBIENT).concat();
    assert_eq!(ambient(&bake(&plant, &[], &luft)), ambient(&bake(&plant, &far(), &luft)));
    let sum = |layer: &Layer| values(&plant, layer, names::AMBIENT).concat().iter().sum::<f32>();
    assert!(sum(&bake(&plant, &far(), &sky)) < sum(&bake(&plant, &[], &sky)), "it hides a part of the horizon");
}

#[test]
fn normals_turn_away_from_a_wall_of_foliage() {
    let plant = small();
    let normals = |neighbors: &[Placed]| -> f32 {
        let layer = bake(&plant, neighbors, &json!({}));
        values(&plant, &layer, names::SOFT_NORMAL).concat().chunks_exact(3).map(|n| n[0]).sum()
    };
    assert!(normals(&[large(3.0, 0.0)]) < normals(&[]), "a neighbor toward +X turns normals toward -X");
}

#[test]
fn the_order_of_neighbors_does_not_matter() {
    // Three of one plant too: only where they stand tells them apart.
    let stand = |x: f64| placed(small(), DVec3::X * x, 0.0, 1.0);
    for given in terms() {
        let plant = crown(1200, 1.0, 0.05, 10);
        let one = bake(&plant, &[stand(1.0), large(-1.0, 0.5), stand(1.5), stand(0.5)], &given);
        let other = bake(&plant, &[stand(0.5), stand(1.5), stand(1.0), large(-1.0, 0.5)], &given);
        assert_eq!(one.attributes, other.attributes);
    }
}

#[test]
fn one_leaf_turned_scaled_and_moved_stands_where_it_should() {
    let leaf = |center| plant(&[Quad { center, edge: 0.1, normal: DVec3::Y }], 0, DAffine3::IDENTITY);
    // A quarter turn takes +Z to +X: twice (0, 1, 3) becomes (6, 2, 0), moved by (10, 0, -1).
    let neighbor = placed(leaf(DVec3::new(0.0, 1.0, 3.0)), DVec3::new(10.0, 0.0, -1.0), 90.0, 2.0);
    let own = leaf(DVec3::new(1.0, 2.0, 3.0));
    let params = Params { radius_m: Some(0.5), ..Params::default() };
    let foliage = Foliage::new(&own, &[neighbor], &params);
    let ball = foliage.generators[1];
    let expected = DVec3::new(16.0, 2.0, -1.0) - own.center();
    // The leaf's center is an f32: 1e-7 of 16 m.
    assert!((ball.position - expected).length() < 4e-6, "{} {expected}", ball.position);
    assert!((ball.weight - 4.0).abs() < 1e-5, "four times the area of the plant's mean leaf: {}", ball.weight);
    let query = Query { position: expected + DVec3::X * 0.25, skip: crate::NO_GROUP };
    let density = reference::field(&foliage.generators, 0.5, &query).density;
    assert!((density - 4.0 * 0.75 * 0.75).abs() < 1e-4, "eq. 2 at half the radius: {density}");
}

/// The plant itself is summed chord by chord here, so that the error is the neighbors' alone.
#[test]
fn what_neighbors_add_meets_the_reference() {
    let plant = small();
    let dense = |x: f64| placed(crown(2000, 1.5, 0.1, 0), DVec3::X * x, 30.0, 1.2);
    let neighbors = [dense(1.0), dense(-3.0)];
    for rung in Density.ladder() {
        let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &neighbors };
        let mut given = rung.params.clone();
        // With smaller balls a lattice as fine as the last rung asks for would be too large, and the promise off.
        given.insert("radius_m".into(), json!(0.4));
        let layer = bake(&plant, &neighbors, &Value::Object(given.clone()));
        let params = foliar_bake::resolve_params(&Density, &given, &serde_json::Map::new()).unwrap();
        let exact = Density.reference(&inputs, &params).unwrap();
        for name in &layer.record.writes {
            let channel = foliar_schema::channel(name).unwrap();
            let both = layer.attributes.iter().filter(|(key, _)| key.name == *name);
            let errors = both.flat_map(|(key, array)| laws::steps(channel, array, &exact.attributes[key]));
            let rms = ErrorStats::of(errors.collect::<Vec<_>>()).rms;
            assert!(rms <= rung.promise_steps, "{}: {name} is off by {rms} steps", rung.name);
        }
    }
}
