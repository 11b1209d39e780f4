//! Synthetic documents, each odd in its own way.

use foliar_carrier::Document;
use serde_json::{Value, json};

/// Makes a document piece by piece.
pub struct Maker {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Maker {
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
            "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]
        });
        Maker { json, bytes: Vec::new() }
    }

    fn push(&mut self, list: &str, item: Value) -> usize {
        let list = self.json[list].as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8], more: Value) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        merge(&mut view, more);
        self.bytes.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize, more: Value) -> usize {
        let view = self.view(bytes, json!({}));
        let mut accessor = json!({"bufferView": view, "componentType": component, "type": kind, "count": count});
        merge(&mut accessor, more);
        self.push("accessors", accessor)
    }

    pub fn bare_accessor(&mut self, value: Value) -> usize {
        self.push("accessors", value)
    }

    pub fn floats(&mut self, data: &[f32], kind: &str, width: usize) -> usize {
        let mut more = json!({});
        if kind == "VEC3" {
            let column = |c: usize| data.iter().skip(c).step_by(3).copied();
            let low: Vec<f32> = (0..3).map(|c| column(c).fold(f32::INFINITY, f32::min)).collect();
            let high: Vec<f32> = (0..3).map(|c| column(c).fold(f32::NEG_INFINITY, f32::max)).collect();
            more = json!({"min": low, "max": high});
        }
        self.accessor(bytemuck::cast_slice(data), 5126, kind, data.len() / width, more)
    }

    /// `quads` unit quads side by side along x, at `z`, facing +z.
    pub fn quads(&mut self, quads: usize, z: f32) -> Value {
        let corner = |q: usize, x: f32, y: f32| [q as f32 * 1.5 + x, y, z];
        let positions: Vec<f32> = (0..quads)
            .flat_map(|q| [corner(q, 0., 0.), corner(q, 1., 0.), corner(q, 1., 1.), corner(q, 0., 1.)])
            .flatten()
            .collect();
        let indices: Vec<u16> = (0..quads as u16).flat_map(|q| [0, 1, 2, 0, 2, 3].map(|i| q * 4 + i)).collect();
        let position = self.floats(&positions, "VEC3", 3);
        let normal = self.floats(&[0.0, 0.0, 1.0].repeat(quads * 4), "VEC3", 3);
        let uv = self.floats(&[0., 1., 1., 1., 1., 0., 0., 0.].repeat(quads), "VEC2", 2);
        let indices = self.accessor(bytemuck::cast_slice(&indices), 5123, "SCALAR", quads * 6, json!({}));
        json!({"attributes": {"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv}, "indices": indices})
    }

    pub fn mesh(&mut self, primitives: Vec<Value>) -> usize {
        self.push("meshes", json!({"primitives": primitives}))
    }

    /// A node at the root of the scene.
    pub fn node(&mut self, node: Value) -> usize {
        let index = self.push("nodes", node);
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(index.into());
        index
    }

    pub fn draw(&mut self, primitives: Vec<Value>, mut node: Value) -> usize {
        let mesh = self.mesh(primitives);
        node["mesh"] = mesh.into();
        self.node(node)
    }

    pub fn finish(mut self) -> Document {
        self.json["buffers"][0]["byteLength"] = self.bytes.len().into();
        Document { json: self.json, buffers: vec![self.bytes], ..Document::default() }
    }
}

pub fn merge(into: &mut Value, more: Value) {
    if let (Some(into), Value::Object(more)) = (into.as_object_mut(), more) {
        into.extend(more);
    }
}

/// Two meshes: one of two primitives, one of one.
pub fn plain() -> Maker {
    let mut maker = Maker::new();
    let (a, b, c) = (maker.quads(3, 0.0), maker.quads(2, 1.0), maker.quads(1, 2.0));
    maker.draw(vec![a, b], json!({"name": "both"}));
    maker.draw(vec![c], json!({"name": "one"}));
    maker
}

/// All odd documents by name.
pub fn all() -> Vec<(&'static str, Document)> {
    vec![
        ("plain", plain().finish()),
        ("numbers", numbers()),
        ("foreign_metadata", foreign_metadata()),
        ("schema_uri", schema_uri()),
        ("taken_names", taken_names()),
        ("empty_containers", empty_containers()),
        ("mirrored", mirrored()),
        ("animated", animated()),
        ("no_normals", no_normals()),
        ("many_meshes", many_meshes()),
    ]
}

/// An unknown extension, extras and numbers that a careless writer changes.
pub fn numbers() -> Document {
    let mut maker = plain();
    merge(
        &mut maker.json,
        serde_json::from_str(
            r#"{"extensionsUsed": ["EXT_nobody_knows", "KHR_materials_diffuse_transmission"],
            "extensions": {"EXT_nobody_knows": {"a": 0.1, "b": 1e-7, "c": 1.0, "d": 1E5, "e": -0.0, "f": 12345678901234567890,
            "g": 0.30000000000000004, "h": [], "i": {}, "j": null, "z": 3.4028234663852886e38}},
            "extras": [1, 2.50, "text"],
            "materials": [{"name": "own", "extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.25}}}]}"#,
        )
        .unwrap(),
    );
    maker.json["meshes"][0]["primitives"][0]["material"] = 0.into();
    maker.json["meshes"][0]["primitives"][1]["extras"] = json!("no object");
    maker.json["asset"]["extras"] = json!(["no", "object"]);
    maker.finish()
}

/// Feature ids and a metadata schema of somebody else.
pub fn foreign_metadata() -> Document {
    let mut maker = plain();
    let ids = maker.floats(&[0.0; 12], "SCALAR", 1);
    let values = maker.view(&7.5f32.to_le_bytes(), json!({}));
    let primitive = &mut maker.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["_FEATURE_ID_0"] = ids.into();
    primitive["extensions"] = json!({"EXT_mesh_features": {"featureIds": [
        {"featureCount": 1, "attribute": 0, "label": "theirs", "propertyTable": 0}]}});
    maker.json["extensionsUsed"] = json!(["EXT_mesh_features", "EXT_structural_metadata"]);
    maker.json["extensions"] = json!({"EXT_structural_metadata": {
        "schema": {"id": "theirs", "classes": {"theirs": {"properties": {"height": {"type": "SCALAR", "componentType": "FLOAT32"}}}}},
        "propertyTables": [{"class": "theirs", "count": 1, "properties": {"height": {"values": values}}}]}});
    maker.finish()
}

/// A schema in another file: nothing may join it.
pub fn schema_uri() -> Document {
    let mut maker = plain();
    maker.json["extensionsUsed"] = json!(["EXT_structural_metadata"]);
    maker.json["extensions"] = json!({"EXT_structural_metadata": {"schemaUri": "schema.json"}});
    maker.finish()
}

/// Names that foliar writes, taken by the base.
pub fn taken_names() -> Document {
    let mut maker = plain();
    let own = maker.floats(&[0.5; 4], "SCALAR", 1);
    maker.json["meshes"][1]["primitives"][0]["attributes"]["_AMBIENT"] = own.into();
    maker.json["meshes"][0]["primitives"][0]["extras"] = json!({"FOLIAR_foliage": "theirs"});
    maker.json["extensionsUsed"] = json!(["EXT_structural_metadata"]);
    maker.json["extensions"] =
        json!({"EXT_structural_metadata": {"schema": {"id": "theirs", "classes": {"foliarLeaf": {}}}}});
    maker.finish()
}

/// Containers that are there, and empty.
pub fn empty_containers() -> Document {
    let mut maker = plain();
    maker.json["asset"]["extras"] = json!({});
    maker.json["extensions"] = json!({});
    maker.json["meshes"][0]["primitives"][0]["extensions"] = json!({});
    maker.json["meshes"][0]["primitives"][0]["extras"] = json!({});
    maker.json["meshes"][0]["primitives"][1]["extras"] = json!({});
    maker.json["meshes"][1]["extras"] = json!({});
    maker.finish()
}

/// A node that mirrors, and one that flattens unevenly.
pub fn mirrored() -> Document {
    let mut maker = Maker::new();
    let (a, b) = (maker.quads(2, 0.0), maker.quads(2, 1.0));
    maker.draw(vec![a], json!({"scale": [-1.0, 2.0, 1.0]}));
    let matrix = json!([0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 3.0, 0.0, 0.0, 1.0]);
    maker.draw(vec![b], json!({ "matrix": matrix }));
    maker.finish()
}

/// An animation, a camera and a skin.
pub fn animated() -> Document {
    let mut maker = plain();
    let times =
        maker.accessor(bytemuck::cast_slice(&[0.0f32, 1.0]), 5126, "SCALAR", 2, json!({"min": [0.0], "max": [1.0]}));
    let moves = maker.floats(&[0.0, 0.0, 0.0, 0.1, 0.2, 0.3], "VEC3", 3);
    maker.json["animations"] = json!([{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
        "samplers": [{"input": times, "output": moves}]}]);
    maker.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}}]);
    maker.node(json!({"camera": 0, "name": "eye"}));
    maker.finish()
}

/// Neither normals nor texture coordinates.
pub fn no_normals() -> Document {
    let mut maker = plain();
    for primitive in maker.json["meshes"][0]["primitives"].as_array_mut().unwrap() {
        primitive["attributes"].as_object_mut().unwrap().retain(|name, _| name == "POSITION");
    }
    maker.finish()
}

/// Five meshes of three primitives.
pub fn many_meshes() -> Document {
    let mut maker = Maker::new();
    for m in 0..5 {
        let primitives = (0..3).map(|p| maker.quads(1 + p, m as f32)).collect();
        maker.draw(primitives, json!({"name": format!("m{m}")}));
    }
    maker.finish()
}
