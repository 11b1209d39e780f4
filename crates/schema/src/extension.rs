//! JSON of the extension `FOLIAR_foliage`.

use crate::{Record, Role};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Version of the contract that this foliar writes.
pub const CONTRACT: u32 = 1;

/// `FOLIAR_foliage` at the root of a glTF, mirrored in `asset.extras.FOLIAR_foliage`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct FoliageExtension {
    /// Version of the contract.
    pub contract: u32,
    /// Program and version that assembled the file.
    pub generator: String,
    /// One record per layer, in the order of [`crate::ROOMS`], unknown rooms last.
    pub records: Vec<Record>,
    /// Maps of light through leaves, by the name of the set; several materials may share one.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub translucency: BTreeMap<String, SheetLinks>,
    /// What is needed to take the layers out again.
    pub base: Map<String, Value>,
    /// Members written by a newer foliar; kept as they are.
    #[serde(flatten)]
    pub more: Map<String, Value>,
}

/// Where the maps of one leaf stand, and what to make of their numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct SheetLinks {
    /// Names of the materials that it belongs to.
    pub materials: Vec<String>,
    /// Name of the map that diffuse transmission of those materials shows.
    pub shown: String,
    /// Maps by name.
    pub maps: BTreeMap<String, MapLink>,
    /// Color of the light that comes through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<ColorLink>,
}

/// One map of coefficients.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct MapLink {
    /// Name of the texture in this file that holds it in 8 bits, where one does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    /// Coefficient i is `scale[i]` times the stored number (0 to 1) plus `bias[i]`.
    pub scale: [f64; 3],
    /// See `scale`.
    pub bias: [f64; 3],
    /// Mean transmission is this times the stored alpha (0 to 1); a leaf never stores 0.
    pub mean_scale: f64,
    /// What 8 bits cost: rms difference of a coefficient over the leaf, as a share of incident light.
    pub rms_error: f64,
    /// The largest such difference.
    pub max_error: f64,
    /// The EXR beside this file that holds it exactly: R, G, B signed coefficients, A mean transmission, 0 off the leaf.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exr: Option<String>,
}

/// Color of the light that comes through.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct ColorLink {
    /// Whether nobody photographed it: the factor follows from the tissue.
    pub estimate: bool,
    /// Linear factor.
    pub factor: [f64; 3],
    /// Name of the texture, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
}

/// `FOLIAR_foliage` at a primitive, mirrored in its extras.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct PrimitiveExtension {
    /// What the primitive is.
    pub role: Role,
}
