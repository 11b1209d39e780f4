//! Rules of the contract: everything that a master promises, read again by a reader that shares no code with the
//! writer; what a scene requires; whether the base has changed since.

use crate::{CheckError, Report, Subject};
use foliar_carrier::survey::{Stale, Survey};
use foliar_carrier::{DAMAGED, second_reader};
use foliar_schema::{CHANNELS, Finding, Import, LATER_ROOMS, ROOMS, code, names};
use glam::{DVec3, Vec3};
use serde_json::Value;
use std::collections::BTreeSet;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

/// A leaf may lie this far outside the plant's box, over the box's diagonal: rounding, and centers of curled leaves.
const OUTSIDE: f64 = 0.01;

/// Rooms and channels that a file must hold.
pub(crate) struct Required(Vec<String>);

impl Required {
    /// Reads the entries; commas separate several in one.
    pub fn new(entries: &[String]) -> Result<Self, CheckError> {
        let names: Vec<String> = entries.iter().flat_map(|entry| entry.split(',')).map(|n| n.trim().into()).collect();
        let channels = CHANNELS.iter().map(|channel| channel.name);
        let known: Vec<&str> = ROOMS.iter().chain(LATER_ROOMS).copied().chain(channels).collect();
        match names.iter().find(|name| !known.contains(&name.as_str())) {
            Some(name) => {
                let text = format!("check.require = {name:?}: no such room or channel; there are {}", known.join(", "));
                Err(CheckError::Setting(text))
            }
            None => Ok(Required(names)),
        }
    }

    /// Says what is missing.
    pub fn check(&self, seen: &Survey, report: &mut Report) {
        let records = seen.foliage().map_or(&Value::Null, |root| &root["records"]);
        let records = || records.as_array().into_iter().flatten();
        let rooms: BTreeSet<&str> = records().filter_map(|record| record["room"].as_str()).collect();
        let writes: BTreeSet<&str> =
            records().flat_map(|r| r["writes"].as_array().into_iter().flatten()).filter_map(Value::as_str).collect();
        for name in self.0.iter().filter(|name| !rooms.contains(name.as_str()) && !writes.contains(name.as_str())) {
            let held: Vec<&str> = rooms.iter().copied().collect();
            let held = if held.is_empty() { "no layer".into() } else { held.join(", ") };
            report.say(&code::REQUIRED_MISSING, "", format!("{name} is required and missing; the file holds {held}"));
        }
    }
}

/// Checks a master; rooms of its records.
pub(crate) fn check(subject: &Subject, report: &mut Report) -> Vec<String> {
    let seen = subject.seen;
    let root = seen.document.json.get("extensions").and_then(|e| e.get(names::EXTENSION));
    if root.is_none() && seen.foliage().is_some() {
        let message = "the extension is gone, its mirror in asset.extras is there: a tool dropped it";
        report.say(&code::LOST_EXTENSION, "", message);
    }
    if root.is_none() {
        mirrored(seen, report);
    }
    // A document that was given up early has its JSON and no buffer.
    let Some(buffer) = seen.document.buffers.first().filter(|_| !report.has(&code::FILE_COMPRESSED)) else {
        return Vec::new();
    };
    let (summary, problems) = second_reader::problems(&seen.document.json, buffer);
    for problem in problems {
        report.say(problem.code, problem.place, problem.text);
    }
    if root.is_some() {
        leaves(subject, report);
    }
    summary.rooms
}

/// Maps that lie beside the file: whether they do, and are what their names say. Their headers alone are read. Gives their
/// paths, there or not.
pub(crate) fn beside(seen: &Survey, folder: &Path, import: &Import, report: &mut Report) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for (sheet, map, uri) in second_reader::maps_beside(seen.foliage().unwrap_or(&Value::Null)) {
        let place = format!("map {sheet}/{map}");
        match foliar_carrier::paths::resolve(uri, folder, &import.search, report.file) {
            Err(error) => report.say(&code::TEXTURE_BROKEN, place, error.to_string()),
            Ok(file) => {
                let (code, problem) = match is_exr(&file) {
                    Ok(true) => (&code::TEXTURE_BROKEN, None),
                    Ok(false) => (&code::TEXTURE_BROKEN, Some("is no EXR: bake again".into())),
                    Err(error) if error.kind() == ErrorKind::NotFound => {
                        (&code::TEXTURE_MISSING, Some("is not there: put it beside the file, or bake again".into()))
                    }
                    Err(error) => (&code::TEXTURE_BROKEN, Some(format!("cannot be read: {error}: make it readable"))),
                };
                problem.into_iter().for_each(|text| report.say(code, &place, format!("{} {text}", file.display())));
                files.push(file);
            }
        }
    }
    files
}

/// Whether a file begins as an EXR does.
fn is_exr(file: &Path) -> std::io::Result<bool> {
    const HEAD: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
    // A pipe would be waited for.
    if !std::fs::metadata(file)?.is_file() {
        return Ok(false);
    }
    let mut head = Vec::new();
    std::fs::File::open(file)?.take(HEAD.len() as u64).read_to_end(&mut head)?;
    Ok(head == HEAD)
}

/// Values of channels of a file whose extension a tool dropped: what they may be still holds, whatever form they have.
fn mirrored(seen: &Survey, report: &mut Report) {
    /// Share of its range by which a value that was rounded may lie outside.
    const ROUNDED: f32 = 0.01;
    let Some(root) = seen.foliage().filter(|_| !report.has(&code::FILE_COMPRESSED)) else { return };
    let meshes = seen.document.list("meshes").iter().enumerate();
    let primitives = meshes.flat_map(|(m, mesh)| {
        let list = mesh["primitives"].as_array().into_iter().flatten().enumerate();
        list.map(move |(p, primitive)| (format!("/meshes/{m}/primitives/{p}"), primitive))
    });
    for (place, primitive) in primitives {
        for channel in CHANNELS {
            let name = root["renamed"][channel.name].as_str().unwrap_or(channel.name);
            let Some(read) = seen.attribute(primitive, name) else { continue };
            let slack = ROUNDED * (channel.max - channel.min).min(f32::MAX);
            let is_wild = |v: &f32| !(v.is_finite() && *v >= channel.min - slack && *v <= channel.max + slack);
            if let Some(at) = read.values.iter().position(is_wild) {
                let message = format!("{name} of vertex {} is {}", at / read.width.max(1), read.values[at]);
                report.say(&code::CONTRACT_RANGE, place.clone(), message);
            }
        }
    }
}

/// Leaves of the table beside the geometry.
fn leaves(subject: &Subject, report: &mut Report) {
    let seen = subject.seen;
    let branches = seen.column(names::CLASS_BRANCH, "parent").map_or(0, |rows| rows.len());
    let own = seen.column(names::CLASS_LEAF, "branch").unwrap_or_default();
    let loose = own.iter().filter(|row| i32::from_le_bytes(**row) < 0).count();
    if branches > 0 && loose > 0 {
        let message = format!("{loose} of {} leaves sit on no branch: they stand still in the wind", own.len());
        report.say(&code::LEAF_UNBOUND, "", message);
    }
    let points = subject.parts().flat_map(|(part, _)| {
        let used = part.triangles.iter().flatten();
        used.map(|vertex| part.rest_position(*vertex as usize))
    });
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let slack = (high - low).length() * OUTSIDE;
    let centers = seen.column(names::CLASS_LEAF, "center").unwrap_or_default();
    let center = |row: &[[u8; 4]]| Vec3::from_slice(&[0, 1, 2].map(|i| f32::from_le_bytes(row[i]))).as_dvec3();
    let outside = |p: &DVec3| p.cmplt(low - slack).any() || p.cmpgt(high + slack).any();
    let count = centers.chunks_exact(3).map(center).filter(outside).count();
    if slack.is_finite() && count > 0 {
        let message = format!("{count} of {} leaf centers lie outside the plant", centers.len() / 3);
        report.say(&code::CONTRACT_UNIT, "", message);
    }
}

/// Whether the base is still what records were baked from. Takes the survey, whose memory it needs.
pub(crate) fn stale(seen: Survey, import: &Import, report: &mut Report) {
    if seen.foliage().is_none() || !seen.problems.is_empty() {
        return;
    }
    let told: BTreeSet<String> = seen.findings.iter().map(|finding| finding.code.clone()).collect();
    let was_told = report.findings.iter().any(|finding| finding.code.starts_with("CONTRACT-"));
    match seen.stale(report.file, import) {
        Ok(Stale::Known(findings)) => {
            // Numbers that no room writes are what the contract's rules have said already.
            let is_told = |finding: &Finding| was_told && finding.message.contains(DAMAGED);
            let new = findings.into_iter().filter(|finding| !told.contains(&finding.code) && !is_told(finding));
            report.findings.extend(new);
        }
        Ok(Stale::Unknown(pixels)) => {
            report.say(&code::STALE_UNKNOWN, "", format!("{pixels} pixels were not decoded to look for changes"));
        }
        // A reader of layers stumbles over what the contract's rules have said already.
        Err(_) if was_told || report.has(&code::LOST_EXTENSION) => {}
        Err(error) => report.say(&code::CONTRACT_RECORD, "", error.to_string()),
    }
}
