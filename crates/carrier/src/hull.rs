//! The glTF of a closed surface around a plant: one node, one mesh, nothing else.

use crate::Document;
use crate::obj::{build, build::Piece, mesh::Mesh};
use foliar_bake::Hull;
use serde_json::json;

/// The document of a surface; an empty scene where it has no triangles.
pub fn hull_document(hull: &Hull, name: &str) -> Document {
    let asset = json!({ "version": "2.0", "generator": concat!("foliar ", env!("CARGO_PKG_VERSION")) });
    if hull.triangles.is_empty() {
        let json = json!({ "asset": asset, "scene": 0, "scenes": [{ "name": name }] });
        return Document { json, ..Document::default() };
    }
    let mesh = Mesh {
        positions: hull.positions.clone(),
        normals: hull.normals.clone(),
        indices: hull.triangles.iter().flatten().copied().collect(),
        ..Mesh::default()
    };
    let piece = Piece { mesh, name: Some(name.into()), material: 0 };
    let material = json!({ "name": name, "pbrMetallicRoughness": { "metallicFactor": 0 } });
    let mut document = build::document(&[piece], vec![material], &[]);
    // In f64, where vertices relative to it are f32: far from the scene's origin no digit is lost.
    document.json["nodes"][0]["translation"] = json!(hull.origin.to_array());
    document
}
