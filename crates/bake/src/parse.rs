//! Parameters of a room: from the JSON object that it is handed to its own struct, and back.

use crate::BakeError;
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// The parameters of a JSON object, with the defaults of `P` (`#[serde(default)]`) for what it does not name.
///
/// # Errors
/// [`BakeError::Range`] outside the ranges that the schema documents, [`BakeError::Parameter`] for unknown names
/// (`#[serde(deny_unknown_fields)]`) and wrong types.
pub fn parse_params<P: DeserializeOwned + JsonSchema>(room: &str, params: &Map<String, Value>) -> Result<P, BakeError> {
    let value = Value::Object(params.clone());
    foliar_schema::check_ranges(&schemars::schema_for!(P).to_value(), &value)
        .map_err(|source| BakeError::Range { room: room.into(), source })?;
    serde_json::from_value(value).map_err(|error| BakeError::Parameter {
        room: room.into(),
        place: "params".into(),
        reason: error.to_string(),
    })
}

/// Parameters as a record holds them; empty where they are no struct.
pub fn params_json(params: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(params) {
        Ok(Value::Object(map)) => map,
        _ => Map::new(),
    }
}
