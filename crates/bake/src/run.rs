//! Runs a baker: parameters over defaults, ranges, the bake, and the laws that can be checked on
//! the spot (own room, in range).

use crate::{Array, BakeError, Baked, Baker, Inputs, Layer, Progress};
use foliar_numerics::find_first;
use foliar_schema::{CHANNELS, COLUMNS, Channel, RASTERS, Record, check_ranges, names};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// What is asked of one baker.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Parameters that a person gave: they go into the record.
    pub given: Map<String, Value>,
    /// Parameters that the scene implies, weaker than `given`.
    pub implied: Map<String, Value>,
    /// Hashes of what the room reads, by name.
    pub reads: BTreeMap<String, String>,
}

/// Every parameter: defaults of the schema, then `implied`, then `given`, ranges checked.
///
/// # Errors
/// [`BakeError::Parameter`] for a name that the baker does not know, [`BakeError::Range`] for a
/// value outside its range.
pub fn resolve_params(
    baker: &dyn Baker,
    implied: &Map<String, Value>,
    given: &Map<String, Value>,
) -> Result<Map<String, Value>, BakeError> {
    let schema = baker.schema();
    let known = schema["properties"].as_object().cloned().unwrap_or_default();
    let mut params: Map<String, Value> =
        known.iter().map(|(name, property)| (name.clone(), property["default"].clone())).collect();
    for (name, value) in implied.iter().chain(given) {
        let slot = params.get_mut(name).ok_or_else(|| BakeError::Parameter {
            room: baker.room().into(),
            place: name.clone(),
            reason: format!("no such parameter; there are {}", known.keys().cloned().collect::<Vec<_>>().join(", ")),
        })?;
        // Null never means "auto": it is what a NaN becomes in JSON.
        if !value.is_null() {
            *slot = value.clone();
        }
    }
    check_ranges(&schema, &Value::Object(params.clone()))
        .map_err(|source| BakeError::Range { room: baker.room().into(), source })?;
    Ok(params)
}

/// Bakes one layer.
///
/// # Errors
/// [`BakeError`]; a value outside its channel's declared range is [`BakeError::Broken`].
pub fn run(
    baker: &dyn Baker,
    inputs: &Inputs,
    request: &Request,
    progress: &dyn Progress,
) -> Result<(Layer, Vec<foliar_schema::Finding>), BakeError> {
    let params = resolve_params(baker, &request.implied, &request.given)?;
    if baker.needs().plant {
        inputs.plant_for(baker.room())?;
    }
    if baker.needs().branches && inputs.plant.is_none_or(|plant| plant.branches().is_none()) {
        return Err(BakeError::Needs {
            room: baker.room().into(),
            what: "branches",
            remedy: "find them (foliar_structure::branches) and hand over the plant with them".into(),
        });
    }
    if let Some(missing) = baker.needs().maps.iter().find(|m| !inputs.maps.contains_key(**m)) {
        return Err(BakeError::Needs { room: baker.room().into(), what: missing, remedy: "give the map".into() });
    }
    let mut baked = baker.bake(inputs, &params, progress)?;
    check_baked(baker.room(), &baked)?;
    baked.findings.extend(idle(baker, inputs, &params, &request.given));
    Ok(into_layer(baker, request, baked))
}

/// What was given and has no say: it is no error, for a section may serve a whole library, but nobody must believe that it
/// was heard.
fn idle(
    baker: &dyn Baker,
    inputs: &Inputs,
    params: &Map<String, Value>,
    given: &Map<String, Value>,
) -> Vec<foliar_schema::Finding> {
    let said = baker.idle(inputs, params).into_iter().filter(|idle| given.contains_key(idle.param));
    let finding = |idle: crate::Idle| {
        let message = format!("{} has no say: {}", idle.param, idle.because);
        foliar_schema::Finding::new(&foliar_schema::code::PARAM_IDLE, message).at(format!(
            "[{}] {}",
            baker.room(),
            idle.param
        ))
    };
    said.map(finding).collect()
}

fn into_layer(baker: &dyn Baker, request: &Request, baked: Baked) -> (Layer, Vec<foliar_schema::Finding>) {
    let mut writes: Vec<String> = baked.attributes.keys().map(|k| k.name.clone()).collect();
    writes.extend(baked.columns.keys().map(|k| format!("{}/{}", k.class, k.property)));
    writes.extend(baked.rasters.keys().map(|name| format!("{}{name}", names::WRITES_RASTER)));
    writes.sort();
    writes.dedup();
    let record = Record {
        room: baker.room().into(),
        version: baker.version(),
        given: request.given.clone(),
        resolved: baked.resolved,
        reads: request.reads.clone(),
        writes,
        errors: baked.errors,
        facts: baked.facts,
        more: Map::new(),
    };
    let Baked { attributes, columns, rasters, findings, .. } = baked;
    (Layer { record, attributes, columns, rasters, ..Layer::default() }, findings)
}

fn check_baked(room: &str, baked: &Baked) -> Result<(), BakeError> {
    for (key, array) in &baked.attributes {
        let channel = CHANNELS.iter().find(|c| c.name == key.name && c.room == room);
        // A channel that is not the room's is broken in its first row.
        let broken = channel.map_or(Some((0, f32::NAN)), |channel| first_broken(channel, array));
        if let Some((row, value)) = broken {
            return Err(BakeError::Broken { room: room.into(), channel: key.name.clone(), row, value });
        }
    }
    for (key, array) in &baked.columns {
        let declared = COLUMNS.iter().find(|c| c.class == key.class && c.name == key.property && c.room == room);
        let outside = |v: f32| !declared.is_some_and(|c| (c.range[0]..=c.range[1]).contains(&v));
        let bad = (0..array.numbers()).find(|at| outside(array.number(*at)));
        if declared.is_none() || bad.is_some() {
            let (row, value) = (bad.unwrap_or(0) / array.width(), bad.map(|at| array.number(at)));
            let channel = format!("{}/{}", key.class, key.property);
            return Err(BakeError::Broken { room: room.into(), channel, row, value: value.unwrap_or(f32::NAN) });
        }
    }
    for (name, raster) in &baked.rasters {
        let info = RASTERS.iter().find(|info| info.name == name && info.room == room);
        let right = info.filter(|info| info.channels == raster.channels && raster.is_whole());
        let inside = |value: &f32| right.is_some_and(|info| *value >= info.min && *value <= info.max);
        if let Some(at) = find_first(&raster.data, |value| !inside(value)) {
            let (row, value) = (at / (raster.channels * raster.width).max(1) as usize, raster.data[at]);
            return Err(BakeError::Broken { room: room.into(), channel: format!("raster/{name}"), row, value });
        }
    }
    Ok(())
}

/// First row outside the declared range of its channel, and what it is; row 0 where the array is of another type.
pub fn first_broken(channel: &Channel, array: &Array) -> Option<(usize, f32)> {
    // One ulp of a unit vector's rounded components, three times squared and summed.
    const UNIT_TOLERANCE: f32 = 1e-6;
    let data = array.as_f32().filter(|_| channel.width == array.width());
    let Some(data) = data else { return Some((0, f32::NAN)) };
    data.chunks_exact(channel.width).enumerate().find_map(|(row, values)| {
        let outside = values.iter().find(|v| !(**v >= channel.min && **v <= channel.max));
        let length = values.iter().map(|v| v * v).sum::<f32>().sqrt();
        let off = channel.unit_length && (length - 1.0).abs() > UNIT_TOLERANCE;
        outside.copied().or(off.then_some(length)).map(|value| (row, value))
    })
}
