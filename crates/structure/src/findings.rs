//! What a person should know of roles and leaves.

use crate::PartEvidence;
use crate::evidence::{Evidence, Source};
use crate::geometry::Geometry;
use crate::patterns::{Patterns, names, pattern_for};
use foliar_plant::Base;
use foliar_schema::{Finding, Role, code};
use std::collections::BTreeMap;

/// Names of parts that a message lists at most.
const SHOWN_NAMES: usize = 12;

/// Findings about roles: mixed parts, unsure parts with the lines to paste, no leaf at all.
pub(crate) fn role_findings(parts: &[PartEvidence], min_confidence: f64) -> Vec<Finding> {
    let place = |part: &PartEvidence| format!("/meshes/{}/primitives/{}", part.place.mesh, part.place.primitive);
    let mut findings = Vec::new();
    for part in parts.iter().filter(|p| p.mixed) {
        let message = format!(
            "part {:?} holds trunk and crown (or pictures of whole plants), and nothing tells them apart; it is treated \
             as {}; split it in the modeller, or say what it is: --{} {:?}",
            part.name,
            part.role,
            part.role,
            pattern_for(&part.name)
        );
        findings.push(Finding::new(&code::ROLE_MIXED, message).at(place(part)));
    }
    for part in parts.iter().filter(|p| patterns_of(p).count() > 1) {
        let reasons: Vec<String> = patterns_of(part).map(|e| format!("as {}: {}", e.role, e.reason)).collect();
        let message = format!(
            "part {:?} is claimed by two roles ({}) and is treated as {}; change one of the patterns so that it leaves this part out",
            part.name,
            reasons.join("; "),
            part.role
        );
        findings.push(Finding::new(&code::ROLE_UNSURE, message).at(place(part)));
    }
    let is_guess = |p: &&PartEvidence| !p.mixed && p.confidence < min_confidence && patterns_of(p).count() < 2;
    let unsure: Vec<&PartEvidence> = parts.iter().filter(is_guess).collect();
    if let Some(first) = unsure.first() {
        findings.push(Finding::new(&code::ROLE_UNSURE, unsure_message(&unsure)).at(place(first)));
    }
    if !parts.iter().any(|p| p.role == Role::Leaf) {
        let message = format!("none of {} parts is a leaf; name them: --leaf PATTERN", parts.len());
        findings.push(Finding::new(&code::LEAF_NONE, message));
    }
    findings
}

/// What patterns say of a part: one piece of evidence per role.
fn patterns_of(part: &PartEvidence) -> impl Iterator<Item = &Evidence> {
    part.evidence.iter().filter(|e| e.source == Source::Pattern)
}

/// Findings about patterns that match nothing: a misspelled name must not pass in silence.
pub(crate) fn pattern_findings(patterns: &Patterns, base: &Base) -> Vec<Finding> {
    let mut known: Vec<String> = base.parts.iter().flat_map(names).map(|name| format!("{name:?}")).collect();
    known.sort();
    known.dedup();
    let more = known.len().saturating_sub(SHOWN_NAMES);
    known.truncate(SHOWN_NAMES);
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    let finding = |(role, pattern): (Role, &str)| {
        let message = format!("roles.{role} = {pattern:?} matches no part; there are {}{more}", known.join(", "));
        Finding::new(&code::ROLE_UNMATCHED, message)
    };
    patterns.unmatched(&base.parts).map(finding).collect()
}

/// One message for all unsure parts, since a file can hold the table [roles] only once.
fn unsure_message(unsure: &[&PartEvidence]) -> String {
    let guess = |p: &&PartEvidence| format!("{:?} looks like {} (confidence {:.2})", p.name, p.role, p.confidence);
    let guesses: Vec<String> = unsure.iter().map(guess).collect();
    let mut lists: BTreeMap<Role, Vec<String>> = BTreeMap::new();
    for part in unsure {
        lists.entry(part.role).or_default().push(format!("{:?}", pattern_for(&part.name)));
    }
    let lines: Vec<String> = lists.iter().map(|(role, list)| format!("{role} = [{}]", list.join(", "))).collect();
    format!("{}; if that is right, put into foliar.toml:\n[roles]\n{}", guesses.join(", "), lines.join("\n"))
}

/// The trunk's end points to `axis`.
pub(crate) fn lying_finding(axis: &str) -> Finding {
    Finding::new(&code::IMPORT_LYING, format!("the trunk's end points to {axis}, not down"))
}

/// Findings about geometry that is kept and left alone.
pub(crate) fn geometry_findings(geometry: &Geometry, zero_area: usize, lying: Option<&str>) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(lying.map(lying_finding));
    let arealess: usize = geometry.parts.iter().map(|p| p.has_area.iter().filter(|a| !**a).count()).sum();
    let unused: usize = geometry.parts.iter().map(|p| p.pieces.unused_vertices()).sum();
    if arealess + unused > 0 {
        let message =
            format!("{arealess} triangles without area, {unused} vertices that no triangle uses: kept, and ignored");
        findings.push(Finding::new(&code::IMPORT_DEGENERATE, message));
    }
    if zero_area > 0 {
        let message = format!("{zero_area} pieces of leaf parts have no area: kept, without a leaf row");
        findings.push(Finding::new(&code::LEAF_ZERO_AREA, message));
    }
    findings
}
