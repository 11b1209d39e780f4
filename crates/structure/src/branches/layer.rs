//! Branches -> layer `branches`: ids and arcs on wood, tables `foliarBranch` and `foliarBranchAxis`, and the columns of
//! leaves that say where they hang. All that a room may ask of branches can be read back from it.

use super::{BranchReport, Found, VERSION};
use foliar_bake::{Array, AttributeKey, ColumnKey, Layer};
use foliar_plant::{Base, Branch, Branches, NO_BRANCH, OnBranch, Structure};
use foliar_schema::{Record, Role, names};
use glam::Vec3;
use serde_json::Map;
use std::collections::BTreeMap;

/// The layer of a plant's branches. `structure` is the content hash of the layer that they were found with;
/// `given` and `resolved` of the record are left empty. Where there are no branches the layer is empty.
pub fn to_layer(found: &Found, base: &Base, facts: &Structure, structure: &str) -> Layer {
    let branches = &found.branches;
    let mut attributes = BTreeMap::new();
    let wood =
        base.parts.iter().zip(&facts.roles).zip(&branches.vertices).filter(|((_, role), _)| **role == Role::Wood);
    for ((part, _), list) in wood.filter(|_| branches.count() > 0) {
        let vertices = part.positions.len();
        let key = |name: &str| AttributeKey { place: part.place, name: name.into() };
        attributes.insert(key(names::BRANCH_ID), Array::scalars(ids(list, vertices, branches.count())));
        attributes.insert(key(names::BRANCH_ARC), Array::scalars(arcs(list, vertices)));
    }
    let columns = if branches.count() == 0 { BTreeMap::new() } else { columns(found) };
    let mut writes: Vec<String> = columns.keys().map(|k| format!("{}/{}", k.class, k.property)).collect();
    if !attributes.is_empty() {
        writes.extend([names::BRANCH_ID, names::BRANCH_ARC].map(String::from));
    }
    writes.sort();
    let reads = [("base", foliar_bake::base_hash(base)), (names::ROOM_STRUCTURE, structure.to_string())];
    let record = Record {
        room: names::ROOM_BRANCHES.into(),
        version: VERSION,
        given: Map::new(),
        resolved: Map::new(),
        reads: reads.map(|(name, hash)| (name.to_string(), hash)).into(),
        writes,
        errors: Vec::new(),
        facts: Map::new(),
        more: Map::new(),
    };
    Layer { record, attributes, columns, ..Layer::default() }
}

fn ids(list: &[OnBranch], vertices: usize, null: usize) -> Vec<f32> {
    let id = |place: &OnBranch| if place.branch == NO_BRANCH { null as f32 } else { place.branch as f32 };
    if list.is_empty() { vec![null as f32; vertices] } else { list.iter().map(id).collect() }
}

fn arcs(list: &[OnBranch], vertices: usize) -> Vec<f32> {
    if list.is_empty() { vec![0.0; vertices] } else { list.iter().map(|place| place.arc).collect() }
}

/// -1 where there is none.
fn signed(branch: u32) -> i32 {
    if branch == NO_BRANCH { -1 } else { branch as i32 }
}

fn columns(found: &Found) -> BTreeMap<ColumnKey, Array> {
    let (branches, rows) = (&found.branches, &found.branches.rows);
    let vectors = |get: fn(&Branch) -> Vec3| Array::vectors(&rows.iter().map(get).collect::<Vec<_>>());
    let scalars = |get: fn(&Branch) -> f32| Array::scalars(rows.iter().map(get).collect());
    let integers = |get: fn(&Branch) -> i32| Array::integers(rows.iter().map(get).collect());
    let chain = Array::I32 { width: 4, data: rows.iter().flat_map(|b| b.chain.map(signed)).collect() };
    let mut columns: BTreeMap<ColumnKey, Array> = [
        ("parent", integers(|b| signed(b.parent))),
        ("level", integers(|b| b.level as i32)),
        ("chain", chain),
        ("pivot", vectors(|b| b.pivot)),
        ("direction", vectors(|b| b.direction)),
        ("length", scalars(|b| b.length)),
        ("radius", scalars(|b| b.radius)),
        ("margin", scalars(|b| b.margin)),
    ]
    .into_iter()
    .map(|(name, array)| (key(names::CLASS_BRANCH, name), array))
    .collect();
    if !branches.leaves.is_empty() {
        let of_leaf = branches.leaves.iter().map(|place| signed(place.branch)).collect();
        columns.insert(key(names::CLASS_LEAF, "branch"), Array::integers(of_leaf));
        let arcs = branches.leaves.iter().map(|place| place.arc).collect();
        columns.insert(key(names::CLASS_LEAF, "branchArc"), Array::scalars(arcs));
    }
    columns.extend(axis_columns(branches));
    columns.extend(report_columns(&found.reports));
    columns
}

/// How each branch came to its parent.
fn report_columns(reports: &[BranchReport]) -> [(ColumnKey, Array); 6] {
    let scalars = |get: fn(&BranchReport) -> f64| Array::scalars(reports.iter().map(|r| get(r) as f32).collect());
    let integers = |get: fn(&BranchReport) -> i32| Array::integers(reports.iter().map(get).collect());
    [
        ("cost", scalars(|r| r.cost)),
        ("gap", scalars(|r| r.gap)),
        ("kind", integers(|r| r.kind as i32)),
        ("roughness", scalars(|r| r.roughness)),
        ("split", scalars(|r| r.split)),
        ("tubes", integers(|r| r.tubes as i32)),
    ]
    .map(|(name, array)| (key(names::CLASS_BRANCH, name), array))
}

/// Rings of all axes. Offsets from pivots, not places: far from the scene's origin a float holds them better.
fn axis_columns(branches: &Branches) -> [(ColumnKey, Array); 3] {
    let (mut owners, mut offsets, mut radii) = (Vec::new(), Vec::new(), Vec::new());
    for (id, (axis, row)) in branches.axes.iter().zip(&branches.rows).enumerate() {
        owners.extend(axis.points.iter().map(|_| id as i32));
        offsets.extend(axis.points.iter().map(|p| (*p - row.pivot.as_dvec3()).as_vec3()));
        radii.extend(axis.radii.iter().map(|r| *r as f32));
    }
    let key = |name| key(names::CLASS_AXIS, name);
    [
        (key("branch"), Array::integers(owners)),
        (key("offset"), Array::vectors(&offsets)),
        (key("radius"), Array::scalars(radii)),
    ]
}

pub(super) fn key(class: &str, property: &str) -> ColumnKey {
    ColumnKey { class: class.into(), property: property.into() }
}
