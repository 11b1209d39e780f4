//! The record that each layer carries: who baked it, from what, with which parameters.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Measured error of one channel against the room's reference, over a fixed sample of places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct MeasuredError {
    /// Channel or column name.
    pub channel: String,
    /// Root mean square, in visible steps of the channel.
    pub rms_steps: f64,
    /// 99.9th percentile, in visible steps of the channel.
    pub p999_steps: f64,
    /// Number of places compared.
    pub places: u32,
}

/// What one layer was made by and from. Self-contained: names only, no indices into a glTF.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct Record {
    /// Step or room.
    pub room: String,
    /// Version of the room: it changes when its results change.
    pub version: u32,
    /// Parameters that a person gave (the only ones that a re-bake starts from).
    pub given: Map<String, Value>,
    /// Every parameter as it was used.
    pub resolved: Map<String, Value>,
    /// blake3 of what was read: `base`, `structure`, map names ...
    pub reads: BTreeMap<String, String>,
    /// Names of the channels and `class/property` columns written.
    pub writes: Vec<String>,
    /// Errors against the reference.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<MeasuredError>,
    /// Facts that a reader needs beside the arrays: scales, bounds, reference values.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub facts: Map<String, Value>,
    /// Members written by a newer foliar; kept as they are.
    #[serde(flatten)]
    pub more: Map<String, Value>,
}
