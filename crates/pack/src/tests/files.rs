//! GLBs made by the letter of the format: one mesh of quads, its attributes laid out as a test wants.

use foliar_carrier::{Asset, read_bytes};
use foliar_schema::Import;
use serde_json::{Value, json};
use std::path::Path;

/// A quad in a plane of constant z, which it looks along.
pub struct Leaf {
    corners: [[f32; 3]; 4],
}

impl Leaf {
    /// The leaf of this number: each stands aside of the last.
    pub fn at(number: usize) -> Leaf {
        let x = number as f32;
        Leaf { corners: [[x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x + 0.5, 0.5, 0.0], [x, 0.5, 0.0]] }
    }
}

/// A glTF in the making.
pub struct File {
    pub json: Value,
    pub binary: Vec<u8>,
}

impl File {
    /// One mesh, one primitive: POSITION, NORMAL along z, indices.
    pub fn of(leaves: Vec<Leaf>) -> File {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "materials": [{"name": "leaf", "doubleSided": true}],
            "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}],
            "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}],
        });
        let mut file = File { json, binary: Vec::new() };
        let vertices = leaves.len() * 4;
        let positions: Vec<f32> = leaves.iter().flat_map(|leaf| leaf.corners).flatten().collect();
        let accessor = file.attribute("POSITION", 3, &positions);
        file.json["accessors"][accessor]["min"] = json!([0, 0, 0]);
        file.json["accessors"][accessor]["max"] = json!([leaves.len(), 1, 0]);
        file.attribute("NORMAL", 3, &[0.0f32, 0.0, 1.0].repeat(vertices));
        let corners =
            (0..leaves.len() as u16).flat_map(|leaf| [0, 1, 2, 0, 2, 3].map(|c| (4 * leaf + c).to_le_bytes()));
        let bytes: Vec<u8> = corners.flatten().collect();
        let indices = file.accessor(&bytes, 5123, "SCALAR", leaves.len() * 6, false);
        file.primitive()["indices"] = json!(indices);
        file
    }

    /// The primitive.
    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// An attribute of floats with a view of its own; its accessor.
    pub fn attribute(&mut self, name: &str, width: usize, data: &[f32]) -> usize {
        let bytes: Vec<u8> = data.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.stored(name, width, 5126, false, &bytes, data.len() / width)
    }

    /// An attribute of any type.
    pub fn stored(
        &mut self,
        name: &str,
        width: usize,
        component: u32,
        normalized: bool,
        bytes: &[u8],
        count: usize,
    ) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
        let accessor = self.accessor(bytes, component, kind, count, normalized);
        self.primitive()["attributes"][name] = json!(accessor);
        accessor
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize, normalized: bool) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len()});
        self.binary.extend_from_slice(bytes);
        let view = self.push("bufferViews", view);
        let mut accessor = json!({"bufferView": view, "componentType": component, "count": count, "type": kind});
        if normalized {
            accessor["normalized"] = json!(true);
        }
        self.push("accessors", accessor)
    }

    /// Appends to a list at the root; its index.
    pub fn push(&mut self, list: &str, item: Value) -> usize {
        let items = self.json[list].as_array_mut().unwrap();
        items.push(item);
        items.len() - 1
    }

    /// As foliar reads it: a base without layers.
    pub fn read(&self) -> Asset {
        let mut json = self.json.clone();
        json["buffers"][0]["byteLength"] = json!(self.binary.len());
        let padded =
            |bytes: &[u8], fill: u8| [bytes, &vec![fill; bytes.len().next_multiple_of(4) - bytes.len()]].concat();
        let (json, binary) = (padded(json.to_string().as_bytes(), b' '), padded(&self.binary, 0));
        let word = |n: usize| (n as u32).to_le_bytes();
        let total = 12 + 8 + json.len() + 8 + binary.len();
        let parts: [&[u8]; 9] = [
            b"glTF",
            &word(2),
            &word(total),
            &word(json.len()),
            b"JSON",
            &json,
            &word(binary.len()),
            b"BIN\0",
            &binary,
        ];
        read_bytes(parts.concat(), "test.glb", Path::new(""), &Import::default()).unwrap()
    }
}
