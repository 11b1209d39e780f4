//! Values to arrays, resolved parameters and facts: what the layer holds.

use crate::fast::Values;
use crate::frames;
use crate::params::Params;
use crate::sway::power;
use foliar_bake::{Array, AttributeKey, Baked, ColumnKey, params_json};
use foliar_plant::{Branches, LEVELS, Plant};
use foliar_schema::{Finding, Role, code, names};
use glam::DVec2;
use serde_json::{Map, Value, json};

/// The layer of a plant.
pub(crate) fn baked(plant: &Plant, branches: &Branches, values: &Values, params: &Params) -> Baked {
    let mut baked = Baked { resolved: params_json(params), facts: facts(plant, values, params), ..Baked::default() };
    for (index, part) in plant.parts().iter().enumerate() {
        let key = |name: &str| AttributeKey { place: part.place, name: name.into() };
        let (weights, own) = (&values.weights[index], &values.leaf_weights[index]);
        if !weights.is_empty() {
            let data = weights.as_flattened().to_vec();
            baked.attributes.insert(key(names::WIND_WEIGHTS), Array::F32 { width: LEVELS, data });
        }
        if !own.is_empty() {
            baked.attributes.insert(key(names::LEAF_WEIGHT), Array::scalars(own.clone()));
        }
    }
    if branches.count() > 0 {
        let mut column = |name: &str, width, data| {
            let key = ColumnKey { class: names::CLASS_WIND.into(), property: name.into() };
            baked.columns.insert(key, Array::F32 { width, data });
        };
        let phases = frames::phases(plant, branches);
        column("phase", 2, phases.iter().flat_map(|p: &DVec2| p.as_vec2().to_array()).collect());
        let frame = |direction: glam::Vec3| frames::frame(direction.as_dvec3()).as_quat().to_array();
        column("frame", 4, branches.rows.iter().flat_map(|row| frame(row.direction)).collect());
    } else {
        let message = "wind: the plant has no branches, so nothing but leaves can move; name its wood with --wood";
        baked.findings.push(Finding::new(&code::WOOD_NONE, message));
    }
    baked
}

/// What a shader needs beside the arrays.
fn facts(plant: &Plant, values: &Values, params: &Params) -> Map<String, Value> {
    let reach = |role: Role| {
        let parts = values.weights.iter().enumerate().filter(|(part, _)| plant.role(*part) == role);
        let mut reach = [0.0f64; LEVELS];
        for weights in parts.flat_map(|(_, list)| list) {
            let powers = (0..LEVELS).map(|level| power(f64::from(weights[level]), params.exponents[level]));
            reach.iter_mut().zip(powers).for_each(|(reach, power)| *reach = reach.max(power));
        }
        // Both channels of the noise at their peak: the diagonal.
        reach.map(|reach| reach * std::f64::consts::SQRT_2)
    };
    let facts = json!({
        "levels": params.levels,
        "exponents": params.exponents,
        "longestM": values.longest_m,
        "boundsPerAmplitude": {"wood": reach(Role::Wood), "leaf": reach(Role::Leaf)},
    });
    facts.as_object().cloned().unwrap_or_default()
}
