//! What is read from glTF: numbers of every kind, nodes, levels of detail, selections; and a second
//! decoder that must see the same positions.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::odd::{Maker, merge, plain};
use common::*;
use foliar_carrier::{Asset, CarrierError, read_bytes};
use foliar_schema::Import;
use glam::{Vec2, Vec3};
use serde_json::{Value, json};
use std::path::Path;

fn codes(asset: &Asset) -> Vec<&str> {
    asset.findings.iter().map(|f| f.code.as_str()).collect()
}

fn read_with(maker: Maker, import: &Import) -> Result<Asset, CarrierError> {
    read_bytes(maker.finish().to_glb().unwrap(), "test.glb", Path::new(""), import)
}

fn read_maker(maker: Maker) -> Asset {
    read_with(maker, &Import::default()).unwrap()
}

/// One triangle whose positions are the given accessor.
fn triangle(maker: &mut Maker, position: usize, more: Value) {
    let mut primitive = json!({"attributes": {"POSITION": position}});
    merge(&mut primitive, more);
    maker.draw(vec![primitive], json!({}));
}

#[test]
fn expected_triangles_of_every_shared_gltf() {
    let Some(trees) = trees() else { return };
    let expected: Value = serde_json::from_slice(&std::fs::read(trees.join("expected.json")).unwrap()).unwrap();
    let mut files = 0;
    for (name, file) in expected["files"].as_object().unwrap().iter().filter(|(name, _)| !name.ends_with(".obj")) {
        let asset = read_shared(name).unwrap();
        for wanted in file["parts"].as_array().unwrap() {
            let part = asset.base.parts.iter().find(|p| p.name() == wanted["part"]);
            let found = part.map(|p| p.triangles.len() as u64);
            assert_eq!(found, wanted["triangles"].as_u64(), "{name}: {}", wanted["part"]);
        }
        files += 1;
    }
    assert!(files >= 9, "only {files} files");
}

#[test]
fn the_gltf_crate_sees_the_same_positions_and_triangles() {
    for name in SHARED {
        let Some(asset) = read_shared(name) else { return };
        let bytes = asset.document.to_glb().unwrap();
        let gltf = gltf::Gltf::from_slice(&bytes).unwrap();
        let blob = gltf.blob.clone().unwrap();
        for part in &asset.base.parts {
            let mesh = gltf.meshes().nth(part.place.mesh as usize).unwrap();
            let primitive = mesh.primitives().nth(part.place.primitive as usize).unwrap();
            let reader = primitive.reader(|buffer| (buffer.index() == 0).then_some(&blob[..]));
            let positions: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
            assert_eq!(positions, part.positions, "{name}");
            let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            assert_eq!(indices, part.triangles.concat(), "{name}");
        }
    }
}

#[test]
fn quantized_normalized_strided_and_sparse_numbers() {
    let mut maker = Maker::new();
    // Positions as i16 at a stride of 8, normals as normalized i8 at a stride of 4: KHR_mesh_quantization.
    let view =
        maker.view(bytemuck::cast_slice(&[0i16, 0, 0, 9, 100, 0, 0, 9, 0, -200, 7, 9]), json!({"byteStride": 8}));
    let position = maker.bare_accessor(json!({"bufferView": view, "componentType": 5122, "type": "VEC3", "count": 3}));
    let view =
        maker.view(bytemuck::cast_slice(&[0i8, 127, 0, 5, -128, 0, 0, 5, 0, 0, -127, 5]), json!({"byteStride": 4}));
    let normal = json!({"bufferView": view, "componentType": 5120, "normalized": true, "type": "VEC3", "count": 3});
    let normal = maker.bare_accessor(normal);
    let uv = maker.accessor(
        bytemuck::cast_slice(&[0u16, 65535, 32768, 0, 0, 0]),
        5123,
        "VEC2",
        3,
        json!({"normalized": true}),
    );
    let indices = maker.accessor(&[0, 2, 1], 5121, "SCALAR", 3, json!({}));
    let rgba = [255u8, 51, 0, 9, 0, 255, 102, 9, 0, 0, 0, 9];
    let color = maker.accessor(&rgba, 5121, "VEC4", 3, json!({"normalized": true}));
    let attributes = json!({"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv, "COLOR_0": color});
    maker.draw(vec![json!({"attributes": attributes, "indices": indices})], json!({"scale": [0.01, 0.01, 0.01]}));
    let asset = read_maker(maker);
    let part = &asset.base.parts[0];
    assert_eq!(part.positions, [Vec3::ZERO, Vec3::new(100.0, 0.0, 0.0), Vec3::new(0.0, -200.0, 7.0)]);
    assert_eq!(part.normals, [Vec3::Y, Vec3::NEG_X, Vec3::NEG_Z], "-128 is -1 too");
    assert_eq!(part.uvs[0], Vec2::new(0.0, 1.0));
    assert_eq!(part.uvs[1], Vec2::new(32768.0 / 65535.0, 0.0));
    assert_eq!(part.colors, [Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.0, 1.0, 0.4), Vec3::ZERO], "without their alpha");
    assert_eq!(part.triangles, [[0, 2, 1]]);
}

#[test]
fn sparse_accessors_change_zeros_and_stored_values() {
    for stored in [false, true] {
        let mut maker = Maker::new();
        let indices = maker.view(&[1, 0], json!({}));
        let values = maker.view(bytemuck::cast_slice(&[1.0f32, 2.0, 3.0]), json!({}));
        let sparse = json!({"count": 1, "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values}});
        let position = if stored {
            maker.accessor(bytemuck::cast_slice(&[9.0f32; 9]), 5126, "VEC3", 3, json!({ "sparse": sparse }))
        } else {
            maker.bare_accessor(json!({"componentType": 5126, "type": "VEC3", "count": 3, "sparse": sparse}))
        };
        triangle(&mut maker, position, json!({}));
        let rest = if stored { Vec3::splat(9.0) } else { Vec3::ZERO };
        assert_eq!(read_maker(maker).base.parts[0].positions, [rest, Vec3::new(1.0, 2.0, 3.0), rest]);
    }
}

#[test]
fn a_buffer_in_a_data_uri_is_the_same_buffer() {
    use base64::Engine;
    let document = plain().finish();
    let mut json = document.json.clone();
    let text = base64::engine::general_purpose::STANDARD.encode(&document.buffers[0]);
    json["buffers"][0]["uri"] = format!("data:application/gltf-buffer;base64,{text}").into();
    let asset = read_bytes(json.to_string().into_bytes(), "a.gltf", Path::new(""), &Import::default()).unwrap();
    assert_eq!(asset.document.buffers, document.buffers);
    assert_eq!(asset.base_hash, from_document(&document).base_hash);
    // And with layers, through both containers.
    let layers = layers_for(&asset);
    let master = foliar_carrier::assemble(&asset.document, &layers).unwrap().0;
    assert_eq!(from_document(&master).layers, layers);
}

#[test]
fn strips_fans_and_lists_without_indices() {
    for (mode, triangles) in [(4, vec![[0, 1, 2]]), (5, vec![[0, 1, 2], [2, 1, 3]]), (6, vec![[0, 1, 2], [0, 2, 3]])] {
        let mut maker = Maker::new();
        let count = if mode == 4 { 3 } else { 4 };
        let position = maker.floats(&vec![0.5; count * 3], "VEC3", 3);
        triangle(&mut maker, position, json!({"mode": mode}));
        assert_eq!(read_maker(maker).base.parts[0].triangles, triangles, "mode {mode}");
    }
}

#[test]
fn lines_and_points_are_left_out_with_a_finding() {
    let mut maker = plain();
    let position = maker.floats(&[0.0; 6], "VEC3", 3);
    maker.draw(vec![json!({"attributes": {"POSITION": position}, "mode": 1})], json!({}));
    let asset = read_maker(maker);
    assert_eq!(asset.base.parts.len(), 3);
    assert_eq!(codes(&asset), ["IMPORT-IGNORED"]);
    assert_eq!(asset.findings[0].place.as_deref(), Some("/meshes/2/primitives/0"));
}

#[test]
fn a_mirrored_node_turns_its_triangles() {
    let asset = from_document(&common::odd::mirrored());
    for part in &asset.base.parts {
        assert!(part.transform.matrix3.determinant() < 0.0);
        for t in &part.triangles {
            let [a, b, c] = t.map(|i| part.rest_position(i as usize));
            let normal = part.normal_to_rest(part.normals[t[0] as usize].as_dvec3());
            assert!((b - a).cross(c - a).dot(normal) > 0.0, "counter-clockwise seen from the normal's side");
        }
    }
}

#[test]
fn transforms_multiply_from_the_root_down() {
    let mut maker = plain();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    maker.json["nodes"][0]["translation"] = json!([1.0, 0.0, 0.0]);
    let turned = json!({"children": [0], "rotation": [0.0, 0.0, half, half], "scale": [2.0, 2.0, 2.0]});
    maker.json["scenes"][0]["nodes"] = json!([1]);
    maker.node(turned);
    let asset = read_maker(maker);
    // (1, 1, 0) + (1, 0, 0), twice as large, a quarter turn about z: (2, 1) -> (-2, 4).
    let corner = asset.base.parts[0].rest_position(2);
    assert!((corner - glam::DVec3::new(-2.0, 4.0, 0.0)).length() < 1e-14, "{corner}");
}

#[test]
fn only_the_finest_level_of_detail_is_baked() {
    let mut by_name = plain();
    by_name.json["nodes"][0]["name"] = json!("Oak_LOD1");
    by_name.json["nodes"][1]["name"] = json!("oak_lod0");
    let asset = read_maker(by_name);
    assert_eq!(asset.base.parts.iter().map(|p| p.place.mesh).collect::<Vec<_>>(), [1]);
    assert_eq!(codes(&asset), ["IMPORT-LOD"]);
    let mut by_extension = plain();
    by_extension.json["extensionsUsed"] = json!(["MSFT_lod"]);
    by_extension.json["nodes"][0]["extensions"] = json!({"MSFT_lod": {"ids": [1]}});
    let asset = read_maker(by_extension);
    assert_eq!(asset.base.parts.iter().map(|p| p.place.mesh).collect::<Vec<_>>(), [0, 0]);
    assert_eq!(codes(&asset), ["IMPORT-LOD"]);
    assert_eq!(asset.document.list("meshes").len(), 2, "the other level stays in the document");
}

#[test]
fn a_shared_mesh_is_baked_once_or_expanded() {
    let shared = || {
        let mut maker = plain();
        maker.node(json!({"mesh": 0, "translation": [0.0, 0.0, 50.0], "name": "again"}));
        maker
    };
    let once = read_maker(shared());
    assert_eq!((once.base.parts.len(), codes(&once)), (3, vec!["IMPORT-INSTANCES"]));
    let import = Import { expand_instances: true, ..Import::default() };
    let expanded = read_with(shared(), &import).unwrap();
    assert_eq!(expanded.base.parts.len(), 5);
    assert_eq!(expanded.document.list("meshes").len(), 3);
    assert_eq!(expanded.document.json["nodes"][2]["mesh"], 2);
    assert!(!codes(&expanded).contains(&"IMPORT-INSTANCES"));
    let (first, copy) = (&expanded.base.parts[0], &expanded.base.parts[3]);
    assert_eq!(copy.node_name.as_deref(), Some("again"));
    assert!(first.position_ids.iter().all(|id| !copy.position_ids.contains(id)), "copies share no vertices");
}

#[test]
fn position_ids_are_shared_where_an_accessor_is() {
    let mut maker = Maker::new();
    let one = maker.quads(1, 0.0);
    let two = one.clone();
    let other = maker.quads(1, 0.0);
    maker.draw(vec![one, two, other], json!({}));
    let base = read_maker(maker).base;
    assert_eq!(base.parts[0].position_ids, base.parts[1].position_ids);
    assert_eq!(base.parts[2].position_ids, [4, 5, 6, 7]);
    assert_eq!(base.position_count, 8);
}

#[test]
fn two_trees_side_by_side_are_a_finding_unless_one_is_chosen() {
    let forest = || {
        let mut maker = Maker::new();
        for tree in 0..2 {
            let (a, b) = (maker.quads(1, 0.0), maker.quads(1, 1.0));
            maker.draw(
                vec![a, b],
                json!({"name": format!("tree{tree}"), "translation": [10.0 * f64::from(tree), 0.0, 0.0]}),
            );
        }
        maker
    };
    assert_eq!(codes(&read_maker(forest())), ["IMPORT-TREES"]);
    let chosen = read_with(forest(), &Import { node: Some("tree1".into()), ..Import::default() }).unwrap();
    assert_eq!(codes(&chosen), [""; 0]);
    assert_eq!(chosen.base.parts.iter().map(|p| p.place.mesh).collect::<Vec<_>>(), [1, 1]);
    let error = read_with(forest(), &Import { node: Some("oak".into()), ..Import::default() }).unwrap_err().to_string();
    assert!(error.contains("\"oak\"") && error.contains("tree0, tree1"), "{error}");
    // A master remembers what was chosen.
    let layers = layers_for(&chosen);
    let master = foliar_carrier::assemble(&chosen.document, &layers).unwrap().0;
    let back = from_document(&master);
    assert_eq!((back.base_hash, back.layers), (chosen.base_hash, layers));
}

#[test]
fn a_scene_is_chosen_by_number() {
    let maker = || {
        let mut maker = plain();
        maker.json["scenes"].as_array_mut().unwrap().push(json!({"nodes": [1]}));
        maker
    };
    let second = read_with(maker(), &Import { scene: Some(1), ..Import::default() }).unwrap();
    assert_eq!(second.base.parts.len(), 1);
    let error = read_with(maker(), &Import { scene: Some(7), ..Import::default() }).unwrap_err().to_string();
    assert!(error.contains("scene 7 does not exist: there are 2"), "{error}");
}

#[test]
fn a_texture_without_a_core_image_is_a_finding() {
    let mut maker = plain();
    merge(
        &mut maker.json,
        json!({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "images": [{"uri": "a.webp"}],
            "extensionsUsed": ["EXT_texture_webp"], "textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}]}),
    );
    maker.json["meshes"][0]["primitives"][0]["material"] = 0.into();
    let asset = read_maker(maker);
    assert_eq!(codes(&asset), ["IMPORT-TEXTURE"]);
    assert!(
        asset.findings[0].message.contains("EXT_texture_webp") && asset.findings[0].message.contains("alpha not read")
    );
}
