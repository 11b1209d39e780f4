//! Parameters of the step: the section [structure].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How roles and leaves are found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StructureParams {
    /// Distance between the virtual leaves of a crown volume; nothing said means that each crown gets about a thousand.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub crown_spacing_m: Option<f64>,
    /// A role that is less sure than this (0 to 1) is a finding.
    #[schemars(range(min = 0, max = 1))]
    pub min_confidence: f64,
}

impl Default for StructureParams {
    fn default() -> Self {
        StructureParams { crown_spacing_m: None, min_confidence: 0.8 }
    }
}
