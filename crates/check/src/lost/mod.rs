//! What a third-party optimizer lost: a file beside the master that it was made from.

mod parts;

use crate::Report;
use foliar_carrier::survey::{Found, Survey, Trouble};
use foliar_schema::{CHANNELS, Channel, Finding, code, names};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Ids with their labels and the classes of their tables.
const IDS: [(&str, &str, &str); 2] = [
    (names::LEAF_ID, names::LABEL_LEAF, names::CLASS_LEAF),
    (names::BRANCH_ID, names::LABEL_BRANCH, names::CLASS_BRANCH),
];

/// Compares an optimized file with its master.
pub fn lost(optimized: &Survey, master: &Survey, file: &str) -> Vec<Finding> {
    let mut report = Report { file, findings: Vec::new() };
    compare(optimized, master, &mut report);
    report.findings
}

pub(crate) fn compare(after: &Survey, master: &Survey, report: &mut Report) {
    carriers(after, master, report);
    for channel in CHANNELS {
        match IDS.iter().find(|(name, ..)| *name == channel.name) {
            Some((_, label, _)) => ids(after, master, label, report),
            None => values(after, master, channel, report),
        }
    }
    parts::lost_tables(after, master, report);
    parts::lost_maps(after, master, report);
    let roles = |seen: &Survey| primitives(seen).filter(|(_, p)| parts::role(p).is_some()).count();
    let (before, now) = (roles(master), roles(after));
    if before > 0 && now == 0 {
        report.say(&code::LOST_ROLE, "", format!("{before} primitives of the master have a role, none here"));
    } else if before > 0 {
        parts::lost_roles(after, master, report);
    }
    materials(after, master, report);
    let triangles = |seen: &Survey| seen.base.parts.iter().map(|part| part.triangles.len()).sum::<usize>();
    let (before, now) = (triangles(master), triangles(after));
    let is_read = !after.problems.iter().any(|problem| problem.trouble == Trouble::Compressed);
    if before != now && is_read && !after.base.parts.is_empty() {
        report.say(&code::LOST_GEOMETRY, "", format!("{before} triangles in the master, {now} here"));
    }
}

/// The root extension and its mirror.
fn carriers(after: &Survey, master: &Survey, report: &mut Report) {
    let root = |seen: &Survey| seen.document.json["extensions"][names::EXTENSION].is_object();
    let mirror = |seen: &Survey| seen.document.json["asset"]["extras"][names::EXTENSION].is_object();
    if root(master) && !root(after) && !report.has(&code::LOST_EXTENSION) {
        report.say(&code::LOST_EXTENSION, "", "the extension of the master is gone");
    }
    if mirror(master) && !mirror(after) {
        report.say(&code::LOST_MIRROR, "", "the mirror of the master in asset.extras is gone");
    }
}

fn primitives(seen: &Survey) -> impl Iterator<Item = (String, &Value)> {
    let list = |value: &'_ Value| value["primitives"].as_array().map_or(0, Vec::len);
    seen.document.list("meshes").iter().enumerate().flat_map(move |(m, mesh)| {
        (0..list(mesh)).map(move |p| (format!("/meshes/{m}/primitives/{p}"), &mesh["primitives"][p]))
    })
}

/// The name of a channel in the master, which may have had to step aside.
fn name<'a>(master: &'a Survey, channel: &'a str) -> &'a str {
    master.foliage().and_then(|root| root["renamed"][channel].as_str()).unwrap_or(channel)
}

/// Whether a primitive has an attribute.
fn carried_by(primitive: &Value, name: &str) -> bool {
    !primitive["attributes"][name].is_null()
}

/// Whether a primitive's attributes lie in a code of their own.
fn is_coded(primitive: &Value) -> bool {
    !primitive["extensions"]["KHR_draco_mesh_compression"].is_null()
}

/// Everything that primitives carry under a name.
struct Carried {
    primitives: usize,
    /// Numbers of all primitives, ascending; `None` where one cannot be read.
    values: Option<Vec<f32>>,
}

fn carried(seen: &Survey, attribute: impl Fn(&Value) -> Option<String>) -> Carried {
    let mut all = Carried { primitives: 0, values: Some(Vec::new()) };
    for (_, primitive) in primitives(seen) {
        let Some(name) = attribute(primitive).filter(|name| carried_by(primitive, name)) else { continue };
        all.primitives += 1;
        // What only a decoder can read reads as zeros here.
        let read = seen.attribute(primitive, &name).filter(|_| !is_coded(primitive));
        match (read, &mut all.values) {
            (Some(read), Some(values)) => values.extend(read.values),
            _ => all.values = None,
        }
    }
    if let Some(values) = &mut all.values {
        values.sort_unstable_by(f32::total_cmp);
    }
    all
}

fn values(after: &Survey, master: &Survey, channel: &Channel, report: &mut Report) {
    let name = name(master, channel.name);
    let before = carried(master, |_| Some(name.into()));
    if before.primitives == 0 {
        return;
    }
    let now = carried(after, |_| Some(name.into()));
    if now.primitives == 0 {
        let message = format!("{name} stood on {} primitives of the master and is gone", before.primitives);
        return report.say(&code::LOST_CHANNEL, "", message);
    }
    parts::lost_channel(after, master, channel, report);
    let (Some(old), Some(new)) = (before.values, now.values) else { return };
    let step = match channel.step_unit {
        "degree" => channel.visible_step.to_radians(),
        _ => channel.visible_step,
    };
    // Depths go down to transmittances, both lists the other way round alike.
    let seen = |v: f32| if channel.optical_depth { libm::expf(-v) } else { v };
    let [old, new] = [old, new].map(|list| list.into_iter().map(seen).collect::<Vec<_>>());
    let steps = difference(&old, &new) / step;
    if steps > 1.0 {
        let message = format!("{name} is off by {steps:.1} visible steps or more ({step:.4} each)");
        report.say(&code::LOST_PRECISION, "", message);
    }
}

/// How far two lots of numbers, both ascending, must be apart: number by number where there are as many, else from each new
/// one to the nearest old one. Vertices that were renumbered, welded or taken away do not count.
fn difference(old: &[f32], new: &[f32]) -> f64 {
    let apart = |a: f32, b: f32| (f64::from(a) - f64::from(b)).abs();
    if old.len() == new.len() {
        return old.iter().zip(new).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max);
    }
    let nearest = |value: f32| {
        let after = old.partition_point(|known| *known < value);
        let around = [after.checked_sub(1), Some(after)];
        let known = around.into_iter().flatten().filter_map(|at| old.get(at));
        known.map(|known| apart(*known, value)).fold(f64::INFINITY, f64::min)
    };
    new.iter().map(|value| nearest(*value)).fold(0.0, f64::max)
}

/// The attribute that holds the ids of a label.
fn id_attribute(primitive: &Value, label: &str) -> Option<String> {
    let features = primitive["extensions"][names::MESH_FEATURES]["featureIds"].as_array()?;
    let feature = features.iter().find(|feature| feature["label"] == label)?;
    Some(format!("{}{}", names::FEATURE_ID_PREFIX, feature["attribute"].as_u64()?))
}

fn ids(after: &Survey, master: &Survey, label: &str, report: &mut Report) {
    let before = carried(master, |primitive| id_attribute(primitive, label));
    if before.primitives == 0 {
        return;
    }
    let now = carried(after, |primitive| id_attribute(primitive, label));
    if now.primitives == 0 {
        let attributes: BTreeSet<String> = primitives(master).filter_map(|(_, p)| id_attribute(p, label)).collect();
        let kept = primitives(after).any(|(_, p)| attributes.iter().any(|name| !p["attributes"][name].is_null()));
        let rest = if kept { "; its numbers are still there, without their declaration" } else { "" };
        return report.say(&code::LOST_ID, "", format!("ids {label} of the master are gone{rest}"));
    }
    let (Some(mut old), Some(mut new)) = (before.values, now.values) else { return };
    old.dedup();
    new.dedup();
    let known: BTreeSet<u32> = old.iter().map(|id| id.to_bits()).collect();
    let foreign = new.iter().filter(|id| !known.contains(&id.to_bits())).count();
    if foreign > 0 {
        report.say(&code::LOST_ID, "", format!("{foreign} ids {label} are none of the master's: they were rounded"));
    } else if new.len() < old.len() {
        let message = format!("{} of {} ids {label} have no vertex any more", old.len() - new.len(), old.len());
        report.say(&code::LOST_ID, "", message);
    }
}

/// Materials by name: what became of their alpha, and of the names.
fn materials(after: &Survey, master: &Survey, report: &mut Report) {
    let holes = |seen: &Survey, index: usize| {
        // A file that was given up early has materials and no pictures.
        let picture = seen.base_pictures.get(index).copied().flatten();
        let picture = picture.map(|picture| &seen.pictures[picture].found);
        !matches!(picture, Some(Found::Picture { has_alpha: false, .. } | Found::Missing(_)))
    };
    let named = |seen: &Survey| -> BTreeMap<String, (String, bool)> {
        let list = seen.document.list("materials").iter().enumerate();
        let mode = |material: &Value| material["alphaMode"].as_str().unwrap_or("OPAQUE").to_string();
        list.filter_map(|(i, m)| Some((m["name"].as_str()?.to_string(), (mode(m), holes(seen, i))))).collect()
    };
    let (before, now) = (named(master), named(after));
    let gone: Vec<&str> = before.keys().filter(|name| !now.contains_key(*name)).map(String::as_str).collect();
    if !gone.is_empty() {
        report.say(&code::LOST_NAME, "", format!("materials {} have no name here, or another", gone.join(", ")));
    }
    for (name, (old, had)) in &before {
        let Some((new, has)) = now.get(name) else { continue };
        if old != new {
            report.say(&code::LOST_ALPHA, "", format!("material {name:?} was {old} in the master and is {new} here"));
        } else if *had && !has && old != "OPAQUE" {
            report.say(
                &code::LOST_ALPHA,
                "",
                format!("material {name:?} is {old}, and its texture has lost its alpha"),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_in_order_or_with_the_nearest() {
        assert!(difference(&[0.0, 0.5, 1.0], &[0.0, 0.5, 1.0]) == 0.0);
        assert!((difference(&[0.0, 0.5, 1.0], &[0.0, 0.25, 1.0]) - 0.25).abs() < 1e-9);
        assert!(difference(&[0.0, 0.5, 1.0], &[0.5, 0.5]) == 0.0, "vertices that are gone change no value");
        assert!((difference(&[0.0, 0.5], &[0.0, 0.1, 0.7]) - 0.2).abs() < 1e-6);
    }
}
