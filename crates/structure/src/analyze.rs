//! The whole step: base in, roles, leaves, layer, evidence and findings out.

use crate::geometry::Geometry;
use crate::patterns::Patterns;
use crate::shape::measure;
use crate::{PartEvidence, StructureError, StructureParams, to_layer};
use crate::{findings, leaves, lying, roles};
use foliar_bake::Layer;
use foliar_plant::{Base, Structure};
use foliar_schema::{Finding, Role, Roles};
use serde_json::{Map, Value, json};

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
    params.check()?;
    base.check()?;
    let patterns = Patterns::new(roles)?;
    let geometry = Geometry::new(base);
    let shapes: Vec<_> = geometry.parts.iter().map(measure).collect();
    let parts = roles::decide(&geometry, &shapes, &patterns);
    let decided: Vec<Role> = parts.iter().map(|p| p.role).collect();
    let lying = lying::lying_axis(&geometry, &decided);
    let found = leaves::find(&geometry, &shapes, decided, params)?;
    let mut findings = findings::role_findings(&parts, params.min_confidence);
    findings.extend(findings::pattern_findings(&patterns, base));
    findings.extend(findings::geometry_findings(&geometry, found.zero_area, lying));
    let mut layer = to_layer(&found.structure, base);
    layer.record.resolved = resolved(roles, params, found.crown_spacing);
    Ok(Analysis { structure: found.structure, layer, parts, findings })
}

/// Roles alone, with what a person should know of them: nothing is looked for piece by piece, so it is cheap.
///
/// # Errors
/// As [`analyze`].
pub fn judge_roles(
    base: &Base,
    roles: &Roles,
    params: &StructureParams,
) -> Result<(Vec<PartEvidence>, Vec<Finding>), StructureError> {
    params.check()?;
    base.check()?;
    let patterns = Patterns::new(roles)?;
    let geometry = Geometry::new(base);
    let shapes: Vec<_> = geometry.parts.iter().map(measure).collect();
    let parts = roles::decide(&geometry, &shapes, &patterns);
    let decided: Vec<Role> = parts.iter().map(|p| p.role).collect();
    let mut findings = findings::role_findings(&parts, params.min_confidence);
    findings.extend(findings::pattern_findings(&patterns, base));
    findings.extend(lying::lying_axis(&geometry, &decided).map(findings::lying_finding));
    Ok((parts, findings))
}

/// Parameters as they were used.
fn resolved(roles: &Roles, params: &StructureParams, crown_spacing: Option<f64>) -> Map<String, Value> {
    let values = [
        ("crown_spacing_m", json!(crown_spacing.or(params.crown_spacing_m))),
        ("min_confidence", json!(params.min_confidence)),
        ("roles", json!(roles)),
    ];
    values.into_iter().map(|(name, value)| (name.to_string(), value)).collect()
}
