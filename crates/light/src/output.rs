//! Values to arrays, resolved parameters and facts: what the layer holds.

use crate::bake::Values;
use crate::optics::Optics;
use crate::params::{DepthEngine, Params, SunModel};
use crate::profile::MOST_DEPTH;
use foliar_bake::{Array, AttributeKey, Baked, ColumnKey};
use foliar_plant::Plant;
use foliar_schema::{Finding, MeasuredError, code, names};
use serde_json::{Map, Value, json};

/// A plant without leaves: nothing to write, and why.
pub(crate) fn empty(params: &Params) -> Baked {
    let finding =
        Finding::new(&code::LEAF_NONE, "light: the plant has no leaves, so the layer is empty; name them with --leaf");
    Baked { resolved: resolved(params), findings: vec![finding], ..Baked::default() }
}

/// The layer of a plant with leaves.
pub(crate) fn baked(plant: &Plant, values: &Values, optics: &Optics, params: &Params) -> Baked {
    let used = Params {
        engine: values.engine,
        opening: values.opening.filter(|_| values.engine == DepthEngine::Tree),
        quality: Some(params.quality()),
        ..params.clone()
    };
    let mut baked = Baked {
        resolved: resolved(&used),
        facts: facts(values, optics, &used),
        errors: values.errors.clone(),
        findings: missed(values, params),
        ..Baked::default()
    };
    let column = |name: &str| ColumnKey { class: names::CLASS_LIGHT.into(), property: name.into() };
    let depths = values.leaves.iter().flatten().map(|depth| capped(*depth)).collect();
    baked.columns.insert(column(names::OPTICAL_DEPTH), Array::F32 { width: 8, data: depths });
    if !values.harmonics.is_empty() {
        let data = values.harmonics.as_flattened().to_vec();
        baked.columns.insert(column(names::SUN_HARMONICS), Array::F32 { width: 9, data });
    }
    for (part, depths) in &values.wood {
        let place = plant.parts()[*part].place;
        for (name, half) in [(names::LIGHT_DEPTH_0, 0), (names::LIGHT_DEPTH_1, 4)] {
            let data = depths.iter().flat_map(|depth| depth[half..half + 4].iter().map(|d| capped(*d))).collect();
            baked.attributes.insert(AttributeKey { place, name: name.into() }, Array::F32 { width: 4, data });
        }
    }
    baked
}

fn capped(depth: f32) -> f32 {
    depth.clamp(0.0, MOST_DEPTH as f32)
}

fn missed(values: &Values, params: &Params) -> Vec<Finding> {
    let missed = values.errors.iter().filter(|error| error.rms_steps > params.quality());
    let finding = |error: &MeasuredError| {
        let (steps, promise) = (error.rms_steps, params.quality());
        let message = format!(
            "light: {} is off by {steps:.2e} visible steps rms, quality {promise} was asked for: leave out light.opening, \
             or ask for quality {steps:.1e} or more",
            error.channel
        );
        Finding::new(&code::QUALITY_MISSED, message)
    };
    missed.map(finding).collect()
}

fn resolved(params: &Params) -> Map<String, Value> {
    match json!(params) {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// What a shader or a reader needs beside the arrays.
fn facts(values: &Values, optics: &Optics, params: &Params) -> Map<String, Value> {
    let facts = json!({
        "engine": params.engine,
        "profile": params.profile,
        "extinctionPerM": values.extinction_per_m,
        "leavesPerM3": values.leaves_per_m3,
        "meanLeafAreaM2": values.mean_area_m2,
        "leaf": optics,
    });
    let mut facts = facts.as_object().cloned().unwrap_or_default();
    if let Some(opening) = params.opening {
        facts.insert("opening".into(), json!(opening));
    }
    if params.engine == DepthEngine::Rays || params.sun == SunModel::Harmonics {
        facts.insert("raysPerOctant".into(), json!(params.rays));
    }
    facts
}
