//! Bases whose bytes are laid out in ways that writing in place could break.

use super::files::File;
use super::laws::{stored, vectors};
use super::{leaves, master, soft};
use crate::pack;
use foliar_plant::Place;
use foliar_schema::Engine;
use glam::Vec3;
use serde_json::json;

/// The new normals are right, whatever the layout was; the positions stay.
fn assert_realigned(file: &File) -> foliar_carrier::Document {
    let asset = master(file, 4);
    let packed = pack(&asset, Engine::Core).unwrap().document;
    assert_eq!(stored(&packed, "POSITION"), stored(&asset.document, "POSITION"));
    for (found, wanted) in vectors(&stored(&packed, "NORMAL")).iter().zip(soft(4).chunks(3)) {
        assert!((*found - Vec3::from_slice(wanted).as_dvec3()).length() < 1e-6);
    }
    packed
}

/// Positions and normals of [`leaves`] one after the other for each vertex.
fn interleaved() -> File {
    let mut file = leaves();
    let (positions, normals) = (file.binary[..192].to_vec(), file.binary[192..384].to_vec());
    let vertex = |v: usize| [&positions[12 * v..12 * v + 12], &normals[12 * v..12 * v + 12]].concat();
    let bytes: Vec<u8> = (0..16).flat_map(vertex).collect();
    file.binary[..384].copy_from_slice(&bytes);
    file.json["bufferViews"][0] = json!({"buffer": 0, "byteOffset": 0, "byteLength": 384, "byteStride": 24});
    file.json["accessors"][1]["bufferView"] = json!(0);
    file.json["accessors"][1]["byteOffset"] = json!(12);
    // The view that held the normals alone: of bytes that nothing reads.
    file.binary.resize(file.binary.len().next_multiple_of(4) + 4, 0);
    file.json["bufferViews"][1] = json!({"buffer": 0, "byteOffset": file.binary.len() - 4, "byteLength": 4});
    file
}

#[test]
fn interleaved_attributes_are_replaced_between_the_others() {
    let file = interleaved();
    let packed = assert_realigned(&file);
    let wanted = file.binary.len() + 16 * 4 + 8 * 3 * 2;
    assert!((wanted..=wanted + 16).contains(&packed.buffers[0].len()), "in place: {}", packed.buffers[0].len());
}

#[test]
fn a_normal_that_other_views_share_is_written_elsewhere() {
    let mut file = leaves();
    // Two views of the same bytes: a picture, or another accessor, might stand behind the second.
    let again = file.push("bufferViews", json!({"buffer": 0, "byteOffset": 192, "byteLength": 192}));
    let shared =
        file.push("accessors", json!({"bufferView": again, "componentType": 5126, "count": 16, "type": "VEC3"}));
    file.primitive()["attributes"]["_OWN"] = json!(shared);
    let before = file.read().document;
    let packed = assert_realigned(&file);
    assert_eq!(stored(&packed, "_OWN"), stored(&before, "_OWN"));
}

#[test]
fn a_normal_that_two_primitives_share_is_written_for_each() {
    let mut file = leaves();
    let other = file.primitive().clone();
    file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(other);
    let packed = assert_realigned(&file);
    let second = foliar_carrier::edit::attribute(&packed, Place { mesh: 0, primitive: 1 }, "NORMAL").unwrap().unwrap();
    assert_eq!(second.values[..3], [0.0, 0.0, 1.0], "that has no realigned normals");
    let color = foliar_carrier::edit::attribute(&packed, Place { mesh: 0, primitive: 1 }, "COLOR_0").unwrap().unwrap();
    assert!(color.values.iter().all(|v| *v >= 1.0), "one layout for the mesh: white where nothing was baked");
}

#[test]
fn quantized_and_sparse_normals_become_floats_of_their_own() {
    let mut quantized = leaves();
    quantized.stored("NORMAL", 3, 5122, true, &[0, 0, 0, 0, 255, 127].repeat(16), 16);
    quantized.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    quantized.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let packed = assert_realigned(&quantized);
    assert_eq!(stored(&packed, "NORMAL").component, 5126);
    assert_eq!(
        packed.list("bufferViews").len(),
        quantized.json["bufferViews"].as_array().unwrap().len() + 1,
        "a color"
    );
    let mut sparse = leaves();
    let index = sparse.push("bufferViews", json!({"buffer": 0, "byteOffset": 384, "byteLength": 2}));
    let value = sparse.push("bufferViews", json!({"buffer": 0, "byteOffset": 0, "byteLength": 12}));
    sparse.json["accessors"][1]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": index, "componentType": 5123}, "values": {"bufferView": value}
    });
    assert_realigned(&sparse);
}

#[test]
fn strips_and_triangles_without_indices_get_their_backs_as_well() {
    for mode in ["list", "strip"] {
        let mut file = leaves();
        file.primitive().as_object_mut().unwrap().shift_remove("indices");
        if mode == "strip" {
            file.primitive()["mode"] = json!(5);
        } else {
            // 15 of 16 vertices make five triangles.
            for accessor in file.json["accessors"].as_array_mut().unwrap() {
                accessor["count"] = json!(15);
            }
        }
        let mut asset = file.read();
        let vertices = asset.base.parts[0].positions.len();
        let mut baked = soft(4);
        baked.truncate(3 * vertices);
        asset.layers = super::layers(4, None, Some(baked));
        asset.layers.remove(0);
        let packed = pack(&asset, Engine::Core).unwrap();
        let again = packed.document.to_glb().unwrap();
        let again = foliar_carrier::read_bytes(again, "x.glb", std::path::Path::new(""), &Default::default()).unwrap();
        let (before, after) = (&asset.base.parts[0].triangles, &again.base.parts[0].triangles);
        assert_eq!(after.len(), 2 * before.len(), "{mode}");
        assert_eq!(&after[..before.len()], before, "{mode}");
        assert!(after[before.len()..].iter().zip(before).all(|(b, f)| *b == [f[0], f[2], f[1]]), "{mode}");
    }
}

#[test]
fn what_a_buffer_file_of_its_own_holds_is_never_written_to() {
    let mut file = leaves();
    let uri = format!("data:application/octet-stream;base64,{}", "AACAPwAAAAAAAAAA".repeat(16));
    file.push("buffers", json!({"byteLength": 192, "uri": uri}));
    let view = file.push("bufferViews", json!({"buffer": 1, "byteLength": 192}));
    file.json["accessors"][1]["bufferView"] = json!(view);
    let before = file.read().document.buffers[1].clone();
    assert_eq!(assert_realigned(&file).buffers[1], before);
}
