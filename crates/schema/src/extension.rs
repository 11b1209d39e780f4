//! JSON of the extension `FOLIAR_foliage`.

use crate::{Record, Role};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

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
    /// What is needed to take the layers out again.
    pub base: Map<String, Value>,
    /// Members written by a newer foliar; kept as they are.
    #[serde(flatten)]
    pub more: Map<String, Value>,
}

/// `FOLIAR_foliage` at a primitive, mirrored in its extras.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct PrimitiveExtension {
    /// What the primitive is.
    pub role: Role,
}
