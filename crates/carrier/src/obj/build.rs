//! The glTF document of converted meshes: everything in one buffer, one view per accessor.

use super::mesh::Mesh;
use super::textures::Image;
use crate::Document;
use glam::Vec3;
use serde_json::{Map, Value, json};

/// glTF component types and buffer targets.
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Most vertices whose indices fit 16 bits (the largest 16-bit number restarts primitives).
const MOST_U16_VERTICES: usize = u16::MAX as usize;

/// A mesh, its name and its material.
pub(crate) struct Piece {
    /// Vertices and triangles.
    pub mesh: Mesh,
    /// Name of mesh and node.
    pub name: Option<String>,
    /// Index into the materials.
    pub material: usize,
}

/// Lists of the document as they grow.
#[derive(Default)]
struct Builder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Builder {
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        // Attributes must start at multiples of 4.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, view: usize, component: u32, count: usize, kind: &str) -> usize {
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }));
        self.accessors.len() - 1
    }

    fn floats<T: bytemuck::NoUninit>(&mut self, values: &[T], kind: &str) -> usize {
        let bytes = little_endian(bytemuck::cast_slice(values));
        let view = self.view(&bytes, Some(ARRAY_BUFFER));
        self.accessor(view, F32, values.len(), kind)
    }

    fn indices(&mut self, mesh: &Mesh) -> usize {
        let short = mesh.positions.len() <= MOST_U16_VERTICES;
        let bytes: Vec<u8> = if short {
            mesh.indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect()
        } else {
            mesh.indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(view, if short { U16 } else { U32 }, mesh.indices.len(), "SCALAR")
    }

    fn primitive(&mut self, mesh: &Mesh, material: usize) -> Value {
        let mut attributes = Map::new();
        let position = self.floats(&mesh.positions, "VEC3");
        let (low, high) = bounds(&mesh.positions);
        self.accessors[position]["min"] = json!(low.to_array().map(f64::from));
        self.accessors[position]["max"] = json!(high.to_array().map(f64::from));
        attributes.insert("POSITION".into(), json!(position));
        attributes.insert("NORMAL".into(), json!(self.floats(&mesh.normals, "VEC3")));
        if !mesh.tangents.is_empty() {
            attributes.insert("TANGENT".into(), json!(self.floats(&mesh.tangents, "VEC4")));
        }
        if !mesh.uvs.is_empty() {
            attributes.insert("TEXCOORD_0".into(), json!(self.floats(&mesh.uvs, "VEC2")));
        }
        json!({ "attributes": attributes, "indices": self.indices(mesh), "material": material })
    }
}

fn little_endian(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

fn bounds(positions: &[Vec3]) -> (Vec3, Vec3) {
    let first = positions.first().copied().unwrap_or_default();
    positions.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)))
}

/// Writes the document: one node, mesh and primitive per piece.
pub(crate) fn document(pieces: &[Piece], materials: Vec<Value>, images: &[Image]) -> Document {
    let mut builder = Builder::default();
    let mut meshes = Vec::with_capacity(pieces.len());
    let mut nodes = Vec::with_capacity(pieces.len());
    for (index, piece) in pieces.iter().enumerate() {
        let primitive = builder.primitive(&piece.mesh, piece.material);
        meshes.push(named(&piece.name, [("primitives", json!([primitive]))]));
        nodes.push(named(&piece.name, [("mesh", json!(index))]));
    }
    let listed: Vec<Value> = images.iter().map(|image| image_json(&mut builder, image)).collect();
    let textures: Vec<Value> = (0..images.len()).map(|source| json!({ "source": source })).collect();
    let mut json = json!({
        "asset": { "version": "2.0", "generator": concat!("foliar ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
    });
    if !images.is_empty() {
        json["textures"] = json!(textures);
        json["images"] = json!(listed);
    }
    json["accessors"] = Value::Array(builder.accessors);
    json["bufferViews"] = Value::Array(builder.views);
    json["buffers"] = json!([{ "byteLength": builder.bytes.len() }]);
    Document { json, buffers: vec![builder.bytes], ..Document::default() }
}

fn image_json(builder: &mut Builder, image: &Image) -> Value {
    let view = builder.view(&image.bytes, None);
    json!({ "name": image.name, "mimeType": image.mime, "bufferView": view })
}

fn named<const N: usize>(name: &Option<String>, members: [(&str, Value); N]) -> Value {
    let name = name.iter().map(|n| ("name".to_string(), json!(n)));
    Value::Object(name.chain(members.map(|(key, value)| (key.to_string(), value))).collect())
}
