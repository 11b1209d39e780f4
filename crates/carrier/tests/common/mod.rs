//! What the tests of this crate share: shared files, synthetic documents, and layers made by rule.
#![allow(dead_code, reason = "each test binary uses a part of it")]

pub mod odd;

use foliar_bake::{Array, AttributeKey, ColumnKey, Layer};
use foliar_carrier::{Asset, Document, read, read_bytes, second_reader};
use foliar_plant::Place;
use foliar_schema::{Import, Record, Role, names};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The folder of shared trees, where there is one.
pub fn trees() -> Option<PathBuf> {
    let shared = std::env::var_os("FOLIAR_SHARED").map(PathBuf::from);
    let shared = shared.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"));
    let trees = shared.join("trees");
    if trees.is_dir() {
        return Some(trees);
    }
    eprintln!("skipped: {} does not exist, no shared data", trees.display());
    None
}

/// All shared glTF files.
pub const SHARED: &[&str] = &[
    "ez_aspen_large_40k/tree.glb",
    "ez_bush_2/tree.glb",
    "ez_oak_small_1k5/tree.glb",
    "khronos_glassvaseflowers/GlassVaseFlowers.gltf",
    "proton_scatter/bush.glb",
    "proton_scatter/dead_branch.glb",
    "proton_scatter/pine_tree.glb",
    "proton_scatter/tree.glb",
    "sapling_default_1k5/tree.glb",
];

pub fn read_shared(name: &str) -> Option<Asset> {
    Some(read(&trees()?.join(name), &Import::default()).unwrap())
}

pub fn from_memory(bytes: &[u8]) -> Asset {
    read_bytes(bytes.to_vec(), "test.glb", Path::new(""), &Import::default()).unwrap()
}

pub fn from_document(document: &Document) -> Asset {
    from_memory(&document.to_glb().unwrap())
}

/// Leaves a file for the Khronos validator and the second reader to judge; `input` is the foreign file
/// that it came from, which may have complaints of its own.
pub fn keep(name: &str, bytes: &[u8], input: Option<&Path>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/foliar-test-outputs/carrier");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(name), bytes).unwrap();
    if let Some(input) = input {
        std::fs::write(folder.join(format!("{name}.input")), input.display().to_string()).unwrap();
    }
    second_reader::verify(bytes).unwrap_or_else(|problem| panic!("{name}: {problem}"));
}

fn record(room: &str, reads: &[(&str, &str)], layer: Layer) -> Layer {
    let mut writes: Vec<String> = layer.attributes.keys().map(|k| k.name.clone()).collect();
    writes.extend(layer.columns.keys().map(|k| format!("{}/{}", k.class, k.property)));
    writes.sort();
    writes.dedup();
    let given = json!({"radius_m": 0.1, "name": "x"}).as_object().unwrap().clone();
    let record = Record {
        room: room.into(),
        version: 1,
        given: given.clone(),
        resolved: given,
        reads: reads.iter().map(|(k, v)| (k.to_string(), v.to_string())).collect(),
        writes,
        facts: json!({"tau": 1e-7}).as_object().unwrap().clone(),
        ..Record::default()
    };
    Layer { record, ..layer }
}

/// Leaf rows of the layers that [`layers_for`] makes.
pub const ROWS: usize = 7;

/// A layer of structure: every second part is a leaf, its vertices spread over the rows.
pub fn structure_for(asset: &Asset, rows: usize) -> Layer {
    let mut layer = Layer::default();
    for (index, part) in asset.base.parts.iter().enumerate() {
        let role = if index % 2 == 0 { Role::Leaf } else { Role::Wood };
        layer.roles.insert(part.place, role);
        if role == Role::Leaf {
            let ids = (0..part.positions.len()).map(|v| (v % (rows + 1)) as f32).collect();
            layer.attributes.insert(key(part.place, names::LEAF_ID), Array::scalars(ids));
        }
    }
    let vector = |x: f32| Array::F32 { width: 3, data: (0..rows).flat_map(|i| [x, 0.1 * i as f32, 1e-7]).collect() };
    let up = Array::F32 { width: 3, data: [0.0, 1.0, 0.0].repeat(rows) };
    let integers = |i: i32| Array::integers((0..rows as i32).map(|r| r * i).collect());
    let columns = [
        ("center", vector(0.1)),
        ("normal", up),
        ("area", Array::scalars(vec![0.25; rows])),
        ("group", integers(1)),
        ("petiole", vector(-3.0)),
        ("crownVolume", integers(0)),
    ];
    for (property, array) in columns {
        layer.columns.insert(column(names::CLASS_LEAF, property), array);
    }
    record(names::ROOM_STRUCTURE, &[("base", &asset.base_hash)], layer)
}

/// A layer of density over leaves and wood.
pub fn density_for(asset: &Asset, structure: &Layer) -> Layer {
    let mut layer = Layer::default();
    for part in &asset.base.parts {
        let count = part.positions.len();
        let ambient = (0..count).map(|v| v as f32 / count as f32).collect();
        layer.attributes.insert(key(part.place, names::AMBIENT), Array::scalars(ambient));
        if structure.roles.get(&part.place) == Some(&Role::Leaf) {
            let normals = Array::F32 { width: 3, data: [0.6, 0.0, 0.8].repeat(count) };
            layer.attributes.insert(key(part.place, names::SOFT_NORMAL), normals);
        }
    }
    let hash = structure.content_hash();
    record(names::ROOM_DENSITY, &[("base", &asset.base_hash), ("structure", &hash)], layer)
}

/// Both layers.
pub fn layers_for(asset: &Asset) -> Vec<Layer> {
    let structure = structure_for(asset, ROWS);
    let density = density_for(asset, &structure);
    vec![structure, density]
}

pub fn key(place: Place, name: &str) -> AttributeKey {
    AttributeKey { place, name: name.into() }
}

pub fn column(class: &str, property: &str) -> ColumnKey {
    ColumnKey { class: class.into(), property: property.into() }
}

/// Every pointer of `base` has the same value in `full`, but for byteLength of the first buffer and
/// lists and objects that are longer there.
pub fn assert_contains(base: &Value, full: &Value, pointer: &str) {
    match (base, full) {
        (Value::Object(a), Value::Object(b)) => {
            for (key, value) in a {
                let at = format!("{pointer}/{key}");
                let found = b.get(key).unwrap_or_else(|| panic!("{at} is gone"));
                if at != "/buffers/0/byteLength" {
                    assert_contains(value, found, &at);
                }
            }
        }
        (Value::Array(a), Value::Array(b)) => {
            assert!(a.len() <= b.len(), "{pointer} is shorter");
            a.iter().zip(b).enumerate().for_each(|(i, (x, y))| assert_contains(x, y, &format!("{pointer}/{i}")));
        }
        _ => assert_eq!(base.to_string(), full.to_string(), "{pointer}"),
    }
}
