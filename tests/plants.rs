//! Plants made by rule as GLB files, written by the letter of the format and by nothing of foliar.

use crate::common::glb;
use foliar_plant::{AlphaMode, Base, Material, Part, Raster};
use serde_json::{Value, json};
use std::path::Path;

/// JSON and binary chunk in the making.
struct Writer {
    json: Value,
    binary: Vec<u8>,
}

const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;

/// Writes a base.
pub fn write_glb(base: &Base, path: &Path) {
    let mut writer =
        Writer { json: json!({"asset": {"version": "2.0", "generator": "foliar tests"}}), binary: Vec::new() };
    for raster in &base.rasters {
        writer.texture(raster);
    }
    for material in &base.materials {
        writer.push("materials", material_json(material));
    }
    for part in base.parts.iter().filter(|part| !part.positions.is_empty()) {
        writer.part(part);
    }
    let nodes = writer.json["nodes"].as_array().map_or(0, Vec::len);
    if nodes > 0 {
        writer.json["scenes"] = json!([{"nodes": (0..nodes).collect::<Vec<_>>()}]);
        writer.json["scene"] = json!(0);
        writer.json["buffers"] = json!([{"byteLength": writer.binary.len()}]);
    }
    std::fs::write(path, glb(&writer.json, &writer.binary)).unwrap();
}

fn material_json(material: &Material) -> Value {
    let mut json = json!({
        "name": material.name,
        "doubleSided": material.double_sided,
        "pbrMetallicRoughness": {"baseColorFactor": material.base_color, "metallicFactor": 0.0},
    });
    if let AlphaMode::Mask(cutoff) = material.alpha_mode {
        json["alphaMode"] = json!("MASK");
        json["alphaCutoff"] = json!(cutoff);
    }
    if let Some(raster) = material.base_color_raster {
        json["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": raster});
    }
    json
}

impl Writer {
    /// Appends to a list; its index.
    fn push(&mut self, list: &str, item: Value) -> usize {
        if !self.json[list].is_array() {
            self.json[list] = json!([]);
        }
        let items = self.json[list].as_array_mut().unwrap();
        items.push(item);
        items.len() - 1
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let mut view = json!({"buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len()});
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.binary.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    fn accessor(&mut self, bytes: &[u8], kind: &str, component: u32, count: usize) -> usize {
        let target = if component == UNSIGNED { 34963 } else { 34962 };
        let view = self.view(bytes, Some(target));
        self.push("accessors", json!({"bufferView": view, "componentType": component, "count": count, "type": kind}))
    }

    fn floats<const N: usize>(&mut self, rows: impl Iterator<Item = [f32; N]>, kind: &str) -> usize {
        let rows: Vec<[f32; N]> = rows.collect();
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        let accessor = self.accessor(&bytes, kind, FLOAT, rows.len());
        let bound = |pick: fn(f32, f32) -> f32| {
            rows.iter().copied().reduce(|a, b| std::array::from_fn(|k| pick(a[k], b[k]))).map(|row| row.to_vec())
        };
        self.json["accessors"][accessor]["min"] = json!(bound(f32::min));
        self.json["accessors"][accessor]["max"] = json!(bound(f32::max));
        accessor
    }

    fn texture(&mut self, raster: &Raster) {
        let mut png = std::io::Cursor::new(Vec::new());
        let picture = image::RgbaImage::from_raw(raster.width, raster.height, raster.rgba.clone()).unwrap();
        picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
        let view = self.view(png.get_ref(), None);
        let source = self.push("images", json!({"bufferView": view, "mimeType": "image/png", "name": raster.name}));
        self.push("textures", json!({"source": source}));
    }

    fn part(&mut self, part: &Part) {
        let mut attributes = json!({"POSITION": self.floats(part.positions.iter().map(|p| p.to_array()), "VEC3")});
        if !part.normals.is_empty() {
            attributes["NORMAL"] = json!(self.floats(part.normals.iter().map(|n| n.to_array()), "VEC3"));
        }
        if !part.uvs.is_empty() {
            attributes["TEXCOORD_0"] = json!(self.floats(part.uvs.iter().map(|uv| uv.to_array()), "VEC2"));
        }
        let mut primitive = json!({"attributes": attributes});
        if !part.triangles.is_empty() {
            let mirrored = part.transform.matrix3.determinant() < 0.0;
            let corners = |t: &[u32; 3]| if mirrored { [t[0], t[2], t[1]] } else { *t };
            let bytes: Vec<u8> = part.triangles.iter().flat_map(corners).flat_map(u32::to_le_bytes).collect();
            primitive["indices"] = json!(self.accessor(&bytes, "SCALAR", UNSIGNED, 3 * part.triangles.len()));
        }
        if let Some(material) = part.material {
            primitive["material"] = json!(material);
        }
        let mesh = self.push("meshes", json!({"name": part.object_name, "primitives": [primitive]}));
        let matrix = glam::DMat4::from(part.transform).to_cols_array().to_vec();
        self.push("nodes", json!({"name": part.name(), "mesh": mesh, "matrix": matrix}));
    }
}
