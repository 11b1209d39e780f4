//! What is wrong with the parts that structure found, by a file's entry in `expected.json`. `xtask bench`
//! counts the same.

use foliar_structure::PartEvidence;
use serde_json::Value;

/// Every deviation, in words; none where all parts come out exactly.
pub fn wrong_parts(expected: &Value, found: &[PartEvidence]) -> Vec<String> {
    let parts = expected["parts"].as_array().map_or(&[][..], Vec::as_slice);
    let is_right = |part: &&Value| {
        found.iter().any(|p| {
            part["part"] == p.name.as_str()
                && part["role"] == p.role.name()
                && part["triangles"] == p.triangles
                && (part["pieces"].is_null() || part["pieces"] == p.pieces)
                && part["crown_volume"].as_bool().unwrap_or(false) == p.crown_volume
        })
    };
    let mut wrong: Vec<String> = parts.iter().filter(|part| !is_right(part)).map(|part| format!("{part}")).collect();
    if parts.len() != found.len() || parts.is_empty() {
        wrong.push(format!("{} parts, must be {}", found.len(), parts.len()));
    }
    wrong
}
