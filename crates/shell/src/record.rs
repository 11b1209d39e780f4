//! What was given, to and from records: a re-bake starts from it. A record's `given` holds the room's
//! own parameters by name, and those of another section that it depends on below the section's name.

use crate::config::{Fields, Origin, Settings, from_json};
use foliar_schema::{Finding, Record, code, names};
use serde_json::{Map, Value};
use std::path::Path;

/// Section beside its own that a room's result depends on.
fn other_section(room: &str) -> Option<&'static str> {
    match room {
        names::ROOM_STRUCTURE => Some("roles"),
        names::ROOM_BRANCHES => None,
        _ => Some("scene"),
    }
}

/// What a person gave for a room, as its record keeps it.
pub fn given(settings: &Settings, room: &str) -> Map<String, Value> {
    let mut given = settings.given(room);
    if let Some(other) = other_section(room).filter(|other| settings.has_section(other)) {
        given.insert(other.into(), settings.given(other).into());
    }
    given
}

/// What the records of a master say was given. What this version does not know is left out, with a finding.
pub fn settings(fields: &Fields, records: &[&Record], file: &Path) -> (Settings, Vec<Finding>) {
    let (mut settings, mut findings) = (Settings::default(), Vec::new());
    for record in records.iter().filter(|r| foliar_schema::ROOMS.contains(&r.room.as_str())) {
        for (dotted, value) in places(record) {
            let known = fields.find(&dotted).and_then(|field| Ok((field, from_json(field, &value)?)));
            match known {
                Ok((field, value)) => settings.set(field, value, Origin::Record(file.to_path_buf())),
                Err(reason) => {
                    let text = format!("{dotted} in the record of {} was left out: {reason}", record.room);
                    findings.push(Finding::new(&code::RECORD_UNKNOWN, text).in_file(file.display().to_string()));
                }
            }
        }
    }
    (settings, findings)
}

/// Every given value of a record with its place in the configuration.
fn places(record: &Record) -> Vec<(String, Value)> {
    let other = other_section(&record.room);
    let mut places = Vec::new();
    for (name, value) in &record.given {
        match (value.as_object(), other) {
            (Some(section), Some(other)) if name == other => flatten(other, section, &mut places),
            _ => places.push((format!("{}.{name}", record.room), value.clone())),
        }
    }
    places
}

fn flatten(prefix: &str, object: &Map<String, Value>, places: &mut Vec<(String, Value)>) {
    for (name, value) in object {
        let dotted = format!("{prefix}.{name}");
        match value.as_object() {
            Some(inner) => flatten(&dotted, inner, places),
            None => places.push((dotted, value.clone())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn record(room: &str, given: Value) -> Record {
        serde_json::from_value(json!({
            "room": room, "version": 1, "given": given, "resolved": {}, "reads": {}, "writes": []
        }))
        .unwrap()
    }

    #[test]
    fn what_was_given_comes_back_from_the_record() {
        let fields = Fields::new(&[]).unwrap();
        let mut before = Settings::default();
        for (name, value) in [("structure.min_confidence", json!(0.5)), ("roles.leaf", json!(["a*"]))] {
            before.set(fields.find(name).unwrap(), value, Origin::Flag("--test".into()));
        }
        let kept = record("structure", given(&before, "structure").into());
        let (after, findings) = settings(&fields, &[&kept], Path::new("tree.glb"));
        assert_eq!(given(&after, "structure"), kept.given);
        assert_eq!(findings, []);
        assert_eq!(after.get("roles.leaf").unwrap().origin.to_string(), "record in tree.glb");
    }

    #[test]
    fn what_this_version_does_not_know_is_a_finding() {
        let kept = record("structure", json!({"magic": 1, "min_confidence": null}));
        let (after, findings) = settings(&Fields::new(&[]).unwrap(), &[&kept], Path::new("tree.glb"));
        assert!(!after.has_section("structure"));
        assert_eq!(findings.len(), 2);
    }
}
