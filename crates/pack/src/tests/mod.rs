//! What profiles promise, on small files made by hand.

mod files;
mod laws;
mod odd;

use files::{File, Leaf};
use foliar_bake::{Array, AttributeKey, ColumnKey, Layer};
use foliar_carrier::Asset;
use foliar_plant::Place;
use foliar_schema::{Record, names};
use std::collections::BTreeMap;

/// Where all values of these tests stand.
const PLACE: Place = Place { mesh: 0, primitive: 0 };

/// An empty layer of a room.
fn layer(room: &str) -> Layer {
    let record = Record {
        room: room.into(),
        version: 1,
        given: Default::default(),
        resolved: Default::default(),
        reads: BTreeMap::new(),
        writes: Vec::new(),
        errors: Vec::new(),
        facts: Default::default(),
        more: Default::default(),
    };
    Layer { record, ..Layer::default() }
}

/// The layers of a file of leaves: ids, and whichever channels are given.
fn layers(leaves: usize, ambient: Option<Vec<f32>>, soft: Option<Vec<f32>>) -> Vec<Layer> {
    let key = |name: &str| AttributeKey { place: PLACE, name: name.into() };
    let (mut structure, mut density) = (layer(names::ROOM_STRUCTURE), layer(names::ROOM_DENSITY));
    let ids = (0..leaves).flat_map(|leaf| [leaf as f32; 4]).collect();
    structure.attributes.insert(key(names::LEAF_ID), Array::scalars(ids));
    let area = ColumnKey { class: names::CLASS_LEAF.into(), property: "area".into() };
    structure.columns.insert(area, Array::scalars(vec![1.0; leaves]));
    let channels = [(names::AMBIENT, 1, ambient), (names::SOFT_NORMAL, 3, soft)];
    for (name, width, data) in channels {
        if let Some(data) = data {
            density.attributes.insert(key(name), Array::F32 { width, data });
        }
    }
    vec![structure, density]
}

/// Ambient coefficients that no rounding hits exactly.
fn ambient(vertices: usize) -> Vec<f32> {
    (0..vertices).map(|v| 0.1 + 0.9 * (v as f32 * 0.37).fract()).collect()
}

/// Realigned normals: unit, one per leaf, half of them behind the leaf's own side.
fn soft(leaves: usize) -> Vec<f32> {
    let normal = |leaf: usize| {
        let side = if leaf.is_multiple_of(2) { 1.0 } else { -1.0 };
        glam::DVec3::new(0.3, 0.2 + leaf as f64 * 0.1, side).normalize().as_vec3().to_array()
    };
    (0..leaves).flat_map(|leaf| [normal(leaf); 4]).flatten().collect()
}

/// A master of so many leaves with both channels.
fn master(file: &File, leaves: usize) -> Asset {
    let mut asset = file.read();
    asset.layers = layers(leaves, Some(ambient(4 * leaves)), Some(soft(leaves)));
    asset
}

/// Four leaves, two-sided, NORMAL along z.
fn leaves() -> File {
    File::of((0..4).map(Leaf::at).collect())
}
