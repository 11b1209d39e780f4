//! Values to arrays, resolved parameters and facts: what the layer holds.

use crate::fast::{Places, Values};
use crate::generators::Foliage;
use crate::params::Params;
use foliar_bake::{Array, AttributeKey, Baked};
use foliar_plant::Plant;
use foliar_schema::{Finding, code, names};
use glam::Vec3;
use serde_json::{Map, Value, json};

/// A plant without leaves: nothing to write, and why.
pub(crate) fn empty(params: &Params) -> Baked {
    let finding = Finding::new(
        &code::LEAF_NONE,
        "density: the plant has no leaves, so the layer is empty; name them with --leaf",
    );
    Baked { resolved: resolved(params, params.radius_m), findings: vec![finding], ..Baked::default() }
}

/// The layer of a plant with leaves.
pub(crate) fn baked(plant: &Plant, foliage: &Foliage, places: &Places, values: &Values, params: &Params) -> Baked {
    let mut baked = Baked {
        resolved: resolved(params, Some(foliage.radius)),
        facts: facts(foliage, values, params),
        errors: values.errors.clone(),
        ..Baked::default()
    };
    for (n, &(index, start)) in places.parts.iter().enumerate() {
        let part = &plant.parts()[index];
        let end = places.parts.get(n + 1).map_or(places.queries.len(), |next| next.1);
        let key = |name: &str| AttributeKey { place: part.place, name: name.into() };
        if let Some(ambient) = values.ambient.get(start..end) {
            baked.attributes.insert(key(names::AMBIENT), Array::scalars(ambient.to_vec()));
        }
        let normals = values.normals.get(start..end).unwrap_or_default();
        let normals: Vec<Vec3> = normals.iter().flatten().map(|n| part.normal_to_mesh(*n).as_vec3()).collect();
        if normals.len() == end - start && end > start {
            baked.attributes.insert(key(names::SOFT_NORMAL), Array::vectors(&normals));
        }
    }
    baked
}

fn resolved(params: &Params, radius: Option<f64>) -> Map<String, Value> {
    let params = Params { radius_m: radius, quality: Some(params.quality()), ..params.clone() };
    match json!(params) {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// What a shader or a reader needs beside the arrays, and the absolute values behind the relative ones.
fn facts(foliage: &Foliage, values: &Values, params: &Params) -> Map<String, Value> {
    let mut facts = Map::new();
    let mut fact = |name: &str, value: Value| facts.insert(name.into(), value);
    fact("radiusM", json!(foliage.radius));
    fact("generators", json!(foliage.own));
    fact("meanLeafAreaM2", json!(foliage.mean_area));
    fact("ambient", json!(params.ambient));
    fact("normals", json!(params.normals));
    fact("darkestAmbient", json!(params.darkest_ambient));
    if let Some(reference) = values.reference {
        fact("referenceDensity", json!(reference));
        fact("threshold", json!(params.threshold * reference));
        fact("darkestDensity", json!(params.darkest_density * reference));
        fact("exponent", json!(params.exponent));
    }
    if let Some(radius) = values.sky_radius {
        fact("skyRadiusM", json!(radius));
        fact("skyDirections", json!(crate::directions::DIRECTIONS));
    }
    facts
}
