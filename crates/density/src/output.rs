//! Values to arrays, resolved parameters and facts: what the layer holds.

use crate::fast::{Places, Values};
use crate::generators::Foliage;
use crate::params::Params;
use foliar_bake::{Array, AttributeKey, Baked, params_json};
use foliar_plant::Plant;
use foliar_schema::{Finding, MeasuredError, code, names};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
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
        findings: missed(values, params),
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
        let mesh_normal = |normal: &Option<DVec3>| normal.map(|n| part.normal_to_mesh(n).as_vec3());
        let normals: Vec<Vec3> = normals.par_iter().filter_map(mesh_normal).collect();
        if normals.len() == end - start && end > start {
            baked.attributes.insert(key(names::SOFT_NORMAL), Array::vectors(&normals));
        }
    }
    baked
}

/// What was promised and not kept: everything was summed ball by ball then, and f32 goes no further.
fn missed(values: &Values, params: &Params) -> Vec<Finding> {
    let missed = values.errors.iter().filter(|error| error.rms_steps > params.quality());
    let finding = |error: &MeasuredError| {
        let (steps, promise) = (error.rms_steps, params.quality());
        let message = format!(
            "density: {} is off by {steps:.2e} visible steps rms, quality {promise} was asked for: every ball was \
             summed already, in f32; ask for quality {steps:.1e} or more",
            error.channel
        );
        Finding::new(&code::QUALITY_MISSED, message)
    };
    missed.map(finding).collect()
}

fn resolved(params: &Params, radius: Option<f64>) -> Map<String, Value> {
    let params = Params { radius_m: radius, quality: Some(params.quality()), ..params.clone() };
    params_json(&params)
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
    if let Some(points) = values.field_points {
        fact("fieldPointsPerRadius", json!(points));
        fact("fieldError", json!(values.field_error));
    }
    if let Some(points) = values.sky_points {
        fact("skyPointsPerRadius", json!(points));
        fact("skyDirections", json!(crate::directions::DIRECTIONS));
    }
    facts
}
