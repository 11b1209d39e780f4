//! Structure <-> layer, both ways exactly.

use crate::{StructureError, VERSION};
use foliar_bake::{Array, AttributeKey, ColumnKey, Layer};
use foliar_plant::{Base, Leaf, NO_LEAF, Part, Structure};
use foliar_schema::{Record, Role, names};
use glam::Vec3;
use std::collections::BTreeMap;

/// The layer of a structure: roles, leaf ids on leaf parts (null id = number of leaves), table
/// `foliarLeaf`. `given` and `resolved` of the record are left empty.
pub fn to_layer(structure: &Structure, base: &Base) -> Layer {
    let mut attributes = BTreeMap::new();
    for ((part, role), ids) in base.parts.iter().zip(&structure.roles).zip(&structure.leaf_ids) {
        if *role == Role::Leaf {
            let key = AttributeKey { place: part.place, name: names::LEAF_ID.into() };
            attributes.insert(key, Array::scalars(id_floats(ids, part.positions.len(), structure.leaves.len())));
        }
    }
    let columns = leaf_columns(&structure.leaves);
    let mut writes: Vec<String> = columns.keys().map(|k| format!("{}/{}", k.class, k.property)).collect();
    if !attributes.is_empty() {
        writes.push(names::LEAF_ID.into());
    }
    writes.sort();
    let record = Record {
        room: names::ROOM_STRUCTURE.into(),
        version: VERSION,
        reads: BTreeMap::from([("base".into(), foliar_bake::base_hash(base))]),
        writes,
        ..Record::default()
    };
    let roles = base.parts.iter().map(|p| p.place).zip(structure.roles.iter().copied()).collect();
    Layer { record, attributes, columns, roles, ..Layer::default() }
}

fn id_floats(ids: &[u32], vertices: usize, leaves: usize) -> Vec<f32> {
    let null = leaves as f32;
    if ids.is_empty() {
        return vec![null; vertices];
    }
    ids.iter().map(|&id| if id == NO_LEAF { null } else { id as f32 }).collect()
}

fn leaf_columns(leaves: &[Leaf]) -> BTreeMap<ColumnKey, Array> {
    if leaves.is_empty() {
        return BTreeMap::new();
    }
    let vectors = |get: fn(&Leaf) -> Vec3| Array::vectors(&leaves.iter().map(get).collect::<Vec<_>>());
    let integers = |get: fn(&Leaf) -> i32| Array::integers(leaves.iter().map(get).collect());
    let columns = [
        ("center", vectors(|l| l.center)),
        ("normal", vectors(|l| l.normal)),
        ("area", Array::scalars(leaves.iter().map(|l| l.area).collect())),
        ("group", integers(|l| l.group as i32)),
        ("petiole", vectors(|l| l.petiole)),
        ("crownVolume", integers(|l| i32::from(l.crown_volume))),
    ];
    columns.into_iter().map(|(name, array)| (column_key(name), array)).collect()
}

fn column_key(property: &str) -> ColumnKey {
    ColumnKey { class: names::CLASS_LEAF.into(), property: property.into() }
}

/// The structure that a layer holds.
///
/// # Errors
/// [`StructureError::NoRole`] and [`StructureError::Layer`] where the layer does not fit the base.
pub fn from_layer(layer: &Layer, base: &Base) -> Result<Structure, StructureError> {
    let leaves = read_leaves(layer)?;
    let mut roles = Vec::with_capacity(base.parts.len());
    let mut leaf_ids = Vec::with_capacity(base.parts.len());
    for part in &base.parts {
        let role = *layer.roles.get(&part.place).ok_or(StructureError::NoRole { place: part.place })?;
        roles.push(role);
        leaf_ids.push(if role == Role::Leaf { read_ids(layer, part, leaves.len())? } else { Vec::new() });
    }
    Ok(Structure { roles, leaves, leaf_ids })
}

fn read_leaves(layer: &Layer) -> Result<Vec<Leaf>, StructureError> {
    let Some(area) = layer.column(names::CLASS_LEAF, "area") else { return Ok(Vec::new()) };
    let rows = area.rows();
    let area = floats(layer, "area", 1, rows)?;
    let [center, normal, petiole] = ["center", "normal", "petiole"].map(|name| floats(layer, name, 3, rows));
    let (center, normal, petiole) = (center?, normal?, petiole?);
    let (group, crown_volume) = (integers(layer, "group", rows)?, integers(layer, "crownVolume", rows)?);
    let vector = |data: &[f32], row: usize| Vec3::new(data[3 * row], data[3 * row + 1], data[3 * row + 2]);
    let leaf = |row| Leaf {
        center: vector(center, row),
        normal: vector(normal, row),
        area: area[row],
        group: group[row] as u32,
        petiole: vector(petiole, row),
        crown_volume: crown_volume[row] != 0,
    };
    Ok((0..rows).map(leaf).collect())
}

fn floats<'a>(layer: &'a Layer, name: &str, width: usize, rows: usize) -> Result<&'a [f32], StructureError> {
    let array = layer.column(names::CLASS_LEAF, name).filter(|a| a.width() == width && a.rows() == rows);
    array.and_then(Array::as_f32).ok_or_else(|| misfit(layer, name, rows))
}

fn integers<'a>(layer: &'a Layer, name: &str, rows: usize) -> Result<&'a [i32], StructureError> {
    let array = layer.column(names::CLASS_LEAF, name).filter(|a| a.width() == 1 && a.rows() == rows);
    array.and_then(Array::as_i32).ok_or_else(|| misfit(layer, name, rows))
}

fn misfit(layer: &Layer, name: &str, rows: usize) -> StructureError {
    let found = layer.column(names::CLASS_LEAF, name);
    StructureError::Layer {
        layer: names::ROOM_STRUCTURE,
        what: format!("column {}/{name}", names::CLASS_LEAF),
        found: found.map_or("missing".into(), |a| format!("{} rows of {}", a.rows(), a.width())),
        expected: format!("{rows} rows, as many as areas, of the contract's type"),
    }
}

fn read_ids(layer: &Layer, part: &Part, leaves: usize) -> Result<Vec<u32>, StructureError> {
    let vertices = part.positions.len();
    let place = part.place;
    let error = |found: String, expected: String| StructureError::Layer {
        layer: names::ROOM_STRUCTURE,
        what: format!("{} of mesh {}, primitive {}", names::LEAF_ID, place.mesh, place.primitive),
        found,
        expected,
    };
    let array = layer.attribute(place, names::LEAF_ID).and_then(Array::as_f32);
    let array = array.ok_or_else(|| error("missing".into(), format!("{vertices} floats")))?;
    if array.len() != vertices {
        return Err(error(format!("{} rows", array.len()), format!("{vertices}, one per vertex")));
    }
    if let Some(bad) = array.iter().find(|&&id| !(id >= 0.0 && id <= leaves as f32 && id.fract() == 0.0)) {
        return Err(error(bad.to_string(), format!("whole, 0 to {leaves}")));
    }
    Ok(array.iter().map(|&id| if id as usize == leaves { NO_LEAF } else { id as u32 }).collect())
}
