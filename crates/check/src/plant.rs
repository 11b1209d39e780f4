//! Rules of the plant as a whole: wood and leaves, size, axis.

use crate::{CheckError, Report, Settings, Subject};
use foliar_carrier::SourceKind;
use foliar_carrier::survey::Survey;
use foliar_schema::{Role, code, names};
use foliar_structure::judge_roles;

/// The tallest tree that ever was measured stood below this.
const TALLEST_M: f64 = 150.0;
/// Smaller than this there is moss, and no plant that anybody bakes.
const SMALLEST_M: f64 = 0.02;

/// Longer is no leaf, nor a card of a whole branch.
const LONGEST_LEAF_EDGE_M: f64 = 4.0;

/// Role of each part: what a master says, else what the evidence says, whose findings are said.
pub(crate) fn roles(seen: &Survey, settings: &Settings, report: &mut Report) -> Result<Vec<Role>, CheckError> {
    let own: Vec<Option<Role>> = seen.base.parts.iter().map(|part| own_role(seen, part)).collect();
    if own.iter().any(Option::is_some) {
        return Ok(own.into_iter().map(|role| role.unwrap_or(Role::Other)).collect());
    }
    if seen.base.parts.is_empty() {
        return Ok(Vec::new());
    }
    let (parts, mut findings) = judge_roles(&seen.base, &settings.roles, &settings.structure)?;
    // What could not be read may have been the leaves.
    findings.retain(|finding| seen.problems.is_empty() || finding.code != code::LEAF_NONE.code);
    for finding in &mut findings {
        finding.file = Some(report.file.into());
        if finding.code == code::IMPORT_LYING.code {
            finding.message += match seen.source {
                Some(SourceKind::Obj) => "; where Z was up, say --up z; a branch that lies is as it should be",
                _ => "; turn it in the exporter, unless it is a branch that lies",
            };
        }
        let place = finding.place.as_deref();
        let part = parts.iter().zip(&seen.base.parts).find(|(evidence, _)| {
            place == Some(&format!("/meshes/{}/primitives/{}", evidence.place.mesh, evidence.place.primitive))
        });
        if let (Some((_, part)), Some(SourceKind::Obj)) = (part, seen.source) {
            finding.place = Some(seen.place(part)).filter(|place| !place.is_empty());
        }
    }
    report.findings.append(&mut findings);
    Ok(parts.into_iter().map(|part| part.role).collect())
}

/// The role that a primitive says itself, in the extension or its mirror.
fn own_role(seen: &Survey, part: &foliar_plant::Part) -> Option<Role> {
    let primitive = &seen.document.list("meshes").get(part.place.mesh as usize)?["primitives"];
    let primitive = primitive.get(part.place.primitive as usize)?;
    let said = [&primitive["extensions"][names::EXTENSION]["role"], &primitive["extras"][names::EXTENSION]["role"]];
    said.into_iter().find_map(|role| serde_json::from_value(role.clone()).ok())
}

pub(crate) fn check(subject: &Subject, report: &mut Report) {
    let has = |role: Role| subject.roles.contains(&role);
    let is_whole = subject.seen.problems.is_empty() && !report.has(&code::ROLE_MIXED);
    if has(Role::Leaf) && !has(Role::Wood) && is_whole {
        report.say(&code::WOOD_NONE, "", "there are leaves and no wood: name the wood with --wood, if there is any");
    }
    let heights = subject.parts().filter(|(_, role)| *role != Role::Other).flat_map(|(part, _)| {
        let used = part.triangles.iter().flatten();
        used.map(|vertex| part.rest_position(*vertex as usize).y)
    });
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(y), b.max(y)));
    let height = high - low;
    if height.is_finite() && !(SMALLEST_M..=TALLEST_M).contains(&height) {
        let likely = if height > TALLEST_M { "centimeters or millimeters" } else { "a larger unit" };
        let message = format!("the plant is {height:.4} m high: it was probably built in {likely}");
        report.say(&code::UNIT_SUSPECT, "", message);
        return;
    }
    if let Some(edge) = leaf_edge(subject).filter(|edge| *edge > LONGEST_LEAF_EDGE_M) {
        let message = format!(
            "half of the leaf triangles have an edge of {edge:.2} m or more: the plant was probably built in a smaller unit"
        );
        report.say(&code::UNIT_SUSPECT, "", message);
    }
}

/// Median of the longest edges of leaf triangles, meters.
fn leaf_edge(subject: &Subject) -> Option<f64> {
    let leaves = subject.parts().filter(|(_, role)| *role == Role::Leaf);
    let longest = |(part, _): (&foliar_plant::Part, Role)| {
        let corner = |v: u32| part.rest_position(v as usize);
        let edge = |t: &[u32; 3]| (0..3).map(|i| corner(t[i]).distance(corner(t[(i + 1) % 3]))).fold(0.0, f64::max);
        part.triangles.iter().map(edge).collect::<Vec<f64>>()
    };
    let mut edges: Vec<f64> = leaves.flat_map(longest).filter(|edge| edge.is_finite()).collect();
    let middle = edges.len() / 2;
    (!edges.is_empty()).then(|| *edges.select_nth_unstable_by(middle, f64::total_cmp).1)
}
