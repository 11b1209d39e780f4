//! Bad input: each a message with file, place and remedy, its exit status, and the old output intact.

use crate::common::{FOLIAR, folder, glb, run_in, tree_text};
use serde_json::{Value, json};

/// Bakes `name` with these bytes over an old output.
#[track_caller]
fn refused(name: &str, bytes: &[u8], status: i32, said: &[&str]) {
    let here = folder();
    std::fs::write(here.path().join(name), bytes).unwrap();
    std::fs::write(here.path().join("out.glb"), b"old").unwrap();
    run_in(here.path(), FOLIAR, &["bake", name, "-o", "out.glb"]).expect(status, &[&[name], said].concat());
    assert_eq!(std::fs::read(here.path().join("out.glb")).unwrap(), b"old", "the old output");
    assert_eq!(std::fs::read_dir(here.path()).unwrap().count(), 2, "nothing beside it");
}

#[test]
fn obj_files() {
    refused("empty.obj", b"", 3, &["empty"]);
    refused("binary.obj", &[0u8, 159, 146, 150, 0, 1, 2, 3, 255, 254, 0, 0], 3, &["byte 0", "zero byte", "format OBJ"]);
    refused("truncated.obj", b"v 0 0 0\nv 1 0 0\nv 0 1\n", 3, &["line 3"]);
    refused("nan.obj", b"v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", 3, &["line 2", "nan"]);
    refused("huge.obj", b"v 0 0 0\nv 1 1e30 0\nv 0 1 0\nf 1 2 3\n", 3, &["1e30"]);
    refused("index.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 3, &["line 4", "4"]);
    refused("zero.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", 3, &["line 4"]);
    let utf16: Vec<u8> = [0xfeff].into_iter().chain("v 0 0 0\n".encode_utf16()).flat_map(u16::to_le_bytes).collect();
    refused("utf16.obj", &utf16, 3, &["UTF-16"]);
    refused("comma.obj", b"v 0,5 0 0\n", 3, &["line 1"]);
}

#[test]
fn glb_files() {
    let good = glb(&json!({"asset": {"version": "2.0"}}), &[]);
    refused("cut.glb", &good[..good.len() / 2], 3, &["byte 8", "download it again"]);
    refused("header.glb", &good[..7], 3, &["byte 0", "download it again"]);
    let mut long = good.clone();
    long[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    refused("length.glb", &long, 3, &["4294967295"]);
    let mut chunk = good;
    chunk[12..16].copy_from_slice(&0xfff0_0000_u32.to_le_bytes());
    refused("chunk.glb", &chunk, 3, &["byte 12", "download it again"]);
    refused("version.glb", &glb(&json!({"asset": {"version": "1.0"}}), &[]), 3, &["1.0"]);
    refused("nothing.gltf", b"{", 3, &["line 1", "download it again"]);
}

/// One triangle of 36 bytes, with one thing changed.
fn triangle(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let mut json = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
    });
    change(&mut json);
    let corners = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    glb(&json, &corners.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<u8>>())
}

#[test]
fn gltf_content() {
    refused("bounds.glb", &triangle(|j| j["accessors"][0]["count"] = 4.into()), 3, &["/accessors/0"]);
    refused("count.glb", &triangle(|j| j["accessors"][0]["count"] = 4_000_000_000_u64.into()), 3, &["/accessors/0"]);
    refused("cycle.glb", &triangle(|j| j["nodes"] = json!([{"mesh": 0, "children": [0]}])), 3, &["/nodes/0"]);
    refused("view.glb", &triangle(|j| j["accessors"][0]["bufferView"] = 7.into()), 3, &["7"]);
    refused("mesh.glb", &triangle(|j| j["nodes"][0]["mesh"] = 3.into()), 3, &["/nodes/0/mesh"]);
    let infinite = |j: &mut Value| j["nodes"][0]["translation"] = json!([1e308, 0, 0]);
    refused("far.glb", &triangle(infinite), 3, &["position", "below 1e15 m"]);
    let draco = |j: &mut Value| {
        j["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        j["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0}});
    };
    refused("draco.glb", &triangle(draco), 3, &["KHR_draco_mesh_compression"]);
    for (name, uri, said) in [
        ("outside.glb", "../secret.bin", "--search"),
        ("absolute.glb", "/etc/passwd", "/etc/passwd"),
        ("network.glb", "https://example.invalid/a.bin", "save the file beside the asset"),
        ("file.glb", "file:///etc/passwd", "save the file beside the asset"),
    ] {
        let with_uri = |j: &mut Value| {
            j["buffers"] = json!([{"byteLength": 36}, {"byteLength": 4, "uri": uri}]);
        };
        refused(name, &triangle(with_uri), 3, &[said]);
    }
}

/// Bakes the small tree with these materials.
fn with_materials(materials: Option<&str>) -> crate::common::Run {
    let here = folder();
    std::fs::write(here.path().join("tree.obj"), tree_text(40)).unwrap();
    if let Some(text) = materials {
        std::fs::write(here.path().join("tree.mtl"), text).unwrap();
    }
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "out.glb"])
}

#[test]
fn materials_that_are_missing_or_loop_are_findings() {
    with_materials(None).expect(0, &["IMPORT-MTL", "tree.mtl"]);
    with_materials(Some("mtllib tree.mtl\nnewmtl bark\n")).expect(0, &[]);
}

#[test]
fn textures_outside_the_assets_folder_are_named_with_the_flag_that_allows_them() {
    for (path, said) in [
        ("../secret.png", "--search"),
        ("/etc/secret.png", "/etc/secret.png"),
        ("https://example.invalid/a.png", "https"),
    ] {
        let run = with_materials(Some(&format!("newmtl bark\nmap_Kd {path}\nnewmtl leaves\n")));
        assert_eq!(run.status, 3, "{path}: {run:?}");
        assert!(run.stderr.contains(said), "{path}: {}", run.stderr);
    }
}
