//! Rules of geometry: what renderers choke on, what costs and draws nothing.

use crate::faces::{Facts, facts, twins};
use crate::{Report, Subject};
use foliar_carrier::SourceKind;
use foliar_plant::Part;
use foliar_schema::code;
use std::collections::BTreeMap;

/// How far a normal may be from unit length, as the Khronos validator has it.
const UNIT: f32 = 0.00674;
/// Vertices that 16 bits can number.
const SIXTEEN_BITS: usize = 65_536;

/// Runs the rules; what was found of each part's triangles.
pub(crate) fn check(subject: &Subject, report: &mut Report) -> Vec<Facts> {
    let mut all = Vec::new();
    for (part, _) in subject.parts() {
        let place = subject.seen.place(part);
        let found = facts(part);
        report.count(&code::GEOMETRY_ZERO_AREA, &place, found.flat, "triangles without area");
        let what = format!("of {} triangles stand twice on the same three points", part.triangles.len());
        report.count(&code::GEOMETRY_DUPLICATE, &place, found.duplicates, &what);
        let what = format!("pairs of triangles among {} lie back to back on the same points", part.triangles.len());
        report.count(&code::GEOMETRY_COINCIDENT, &place, found.coincident, &what);
        let off = part.normals.iter().filter(|n| (n.length() - 1.0).abs() > UNIT).count();
        let what = format!("of {} normals are not of unit length", part.normals.len());
        report.count(&code::GEOMETRY_NORMAL, &place, off, &what);
        all.push(found);
    }
    across(subject, report);
    vertices(subject, report);
    all
}

/// Triangles that stand where another part has the same ones already: both are drawn, and flicker. Back to back is how leaves
/// get two materials.
fn across(subject: &Subject, report: &mut Report) {
    let parts: Vec<&Part> = subject.parts().map(|(part, _)| part).collect();
    for (part, (count, other)) in twins(&parts) {
        let what = format!(
            "of {} triangles stand on those of {}, facing the same way",
            parts[part].triangles.len(),
            subject.seen.place(parts[other])
        );
        report.count(&code::GEOMETRY_DUPLICATE, subject.seen.place(parts[part]), count, &what);
    }
}

/// Rules over vertices, which several primitives may share.
fn vertices(subject: &Subject, report: &mut Report) {
    let seen = subject.seen;
    if seen.source == Some(SourceKind::Obj) {
        let used = seen.base.parts.iter().flat_map(|part| &part.position_ids).max();
        let highest = used.map_or(0, |id| *id as usize);
        let count = seen.base.position_count as usize;
        let place = "";
        if !wrapped(report, place, count, highest) {
            report.count(&code::GEOMETRY_UNUSED, place, seen.unused_positions, "vertices ('v') that no face uses");
        }
        return;
    }
    // Primitives that share a POSITION accessor share ids.
    let mut shared: BTreeMap<u32, Vec<&Part>> = BTreeMap::new();
    for part in seen.base.parts.iter().filter(|part| !part.positions.is_empty()) {
        shared.entry(part.position_ids[0]).or_default().push(part);
    }
    for parts in shared.into_values() {
        let count = parts[0].positions.len();
        let mut used = vec![false; count];
        parts.iter().flat_map(|part| part.triangles.iter().flatten()).for_each(|v| used[*v as usize] = true);
        let highest = used.iter().rposition(|used| *used).unwrap_or(0);
        let unused = used.iter().filter(|used| !**used).count();
        let place = seen.place(parts[0]);
        if !wrapped(report, &place, count, highest) {
            let what = format!("of {count} vertices are used by no triangle");
            report.count(&code::GEOMETRY_UNUSED, &place, unused, &what);
        }
    }
}

/// Whether indices were cut to 16 bits, which is said.
fn wrapped(report: &mut Report, place: &str, count: usize, highest: usize) -> bool {
    let is = count > SIXTEEN_BITS && highest < SIXTEEN_BITS;
    if is {
        let message = format!(
            "{count} vertices, and no index above {highest}: indices were cut to 16 bits and wrapped around at 65,536; \
             export with 32-bit indices or in smaller meshes"
        );
        report.say(&code::GEOMETRY_WRAP, place, message);
    }
    is
}
