//! Parameters of the step: the section [structure].

use crate::StructureError;
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

impl StructureParams {
    /// Whether every value is in its range.
    ///
    /// # Errors
    /// [`StructureError::Parameter`] names the first that is not.
    pub fn check(&self) -> Result<(), StructureError> {
        let error = |name, value, expected| Err(StructureError::Parameter { name, value, expected });
        match self.crown_spacing_m {
            Some(spacing) if !(spacing.is_finite() && spacing > 0.0) => {
                error("crown_spacing_m", spacing, "above 0 and finite (distance between virtual leaves)")
            }
            _ if !(0.0..=1.0).contains(&self.min_confidence) => {
                error("min_confidence", self.min_confidence, "0 to 1 (the least confidence without a finding)")
            }
            _ => Ok(()),
        }
    }
}
