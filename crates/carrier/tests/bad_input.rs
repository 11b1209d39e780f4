//! Bad input: a message with file, place and remedy each time, and never a panic.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::odd::{Maker, plain};
use common::*;
use foliar_carrier::{Asset, CarrierError, Document, assemble, read, read_bytes, second_reader};
use foliar_schema::Import;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::path::Path;

fn attempt(bytes: &[u8], name: &str) -> Result<Asset, CarrierError> {
    read_bytes(bytes.to_vec(), name, Path::new(""), &Import::default())
}

/// The message of an input that must be refused.
fn refusal(bytes: &[u8], name: &str) -> String {
    let error = attempt(bytes, name).unwrap_err();
    assert!(!error.is_output());
    let text = error.to_string();
    assert!(text.starts_with(name), "{text} names the file");
    text
}

fn refused(maker: Maker, words: &[&str]) {
    let text = refusal(&maker.finish().to_glb().unwrap(), "a.glb");
    for word in words {
        assert!(text.contains(word), "{text} should say {word:?}");
    }
}

fn master_bytes() -> Vec<u8> {
    let asset = from_document(&odd::plain().finish());
    assemble(&asset.document, &layers_for(&asset)).unwrap().0.to_glb().unwrap()
}

#[test]
fn files_that_are_no_gltf_at_all() {
    for (bytes, name, words) in [
        (&b""[..], "a.glb", "is empty"),
        (b"", "a.obj", "is empty"),
        (b"glTF", "a.glb", "no GLB header"),
        (b"\0\x01\x02\x03 binary", "a.glb", "does not start with \"glTF\""),
        (b"{}", "a.gltf", "/asset/version: glTF version \"\""),
        (br#"{"asset": {"version": "1.0"}}"#, "a.gltf", "export it as glTF 2.0"),
        (b"{\"asset\": ", "a.gltf", "line 1 column"),
        (b"[]", "a.gltf", "no object"),
        (b"\xFF\xFE{\0}\0", "a.gltf", "UTF-16: save it as UTF-8"),
        (b"{\0}\0", "a.gltf", "UTF-16"),
        (b"\xFE\xFF\0v", "a.obj", "UTF-16"),
        (b"%PDF-1.4", "a.pdf", "files of kind \"pdf\" are not read"),
    ] {
        let text = refusal(bytes, name);
        assert!(text.contains(words), "{text} should say {words:?}");
    }
    let error = read(Path::new("/nowhere/a.glb"), &Import::default()).unwrap_err().to_string();
    assert!(error.contains("/nowhere/a.glb: cannot be read"), "{error}");
}

#[test]
fn a_byte_order_mark_is_tolerated() {
    let json = plain().finish().json;
    let bin = plain().finish().buffers.remove(0);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("b.bin"), bin).unwrap();
    let mut json = json;
    json["buffers"][0]["uri"] = "b.bin".into();
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, [b"\xEF\xBB\xBF".to_vec(), json.to_string().into_bytes()].concat()).unwrap();
    let asset = read(&path, &Import::default()).unwrap();
    assert_eq!(asset.files, [path, folder.path().join("b.bin")]);
}

#[test]
fn a_glb_cut_anywhere_is_refused_with_its_lengths() {
    let bytes = master_bytes();
    for length in 0..bytes.len() {
        let text = refusal(&bytes[..length], "a.glb");
        let said =
            ["is empty", "no GLB header", "the header says", "does not start with"].iter().any(|w| text.contains(w));
        assert!(said, "{length}: {text}");
    }
    // With a header that agrees, chunks and buffers are found too short.
    for length in (20..bytes.len()).step_by(4) {
        let mut cut = bytes[..length].to_vec();
        cut[8..12].copy_from_slice(&(length as u32).to_le_bytes());
        refusal(&cut, "a.glb");
    }
    let mut longer = bytes;
    longer.extend([0; 4]);
    assert!(refusal(&longer, "a.glb").contains("the header says"));
}

#[test]
fn counts_beyond_the_bytes_take_no_memory() {
    for (pointer, value, words) in [
        (
            "/accessors/0/count",
            json!(4_000_000_000u64),
            "/accessors/0: 4000000000 elements at stride 12 from 0 do not fit",
        ),
        ("/accessors/0/count", json!(u64::MAX), "do not fit"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "do not fit"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "reach past the"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "/bufferViews/0"),
        ("/bufferViews/0/byteStride", json!(4), "stride 4"),
        ("/bufferViews/0/buffer", json!(7), "/bufferViews/0/buffer: names no buffer"),
        ("/buffers/0/byteLength", json!(1e12 as u64), "/buffers/0: byteLength is 1000000000000, there are"),
        ("/accessors/0/bufferView", json!(99), "/bufferViews/99: does not exist: there are"),
        ("/accessors/0/componentType", json!(5124), "componentType"),
        ("/accessors/0/type", json!("MAT3"), "type \"MAT3\" where 3 numbers"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(77), "/accessors/77"),
        ("/nodes/0/mesh", json!(12), "/nodes/0/mesh: names no mesh"),
        ("/scenes/0/nodes/0", json!(50), "/nodes/50: does not exist"),
        ("/nodes/0", json!({"mesh": 0, "matrix": [1, 2]}), "/nodes/0/matrix: must be 16 numbers"),
        ("/nodes/0", json!({"mesh": 0, "rotation": [0, 0, 0, 0]}), "quaternion of length 0"),
    ] {
        let mut document = plain().finish();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match document.json.pointer_mut(parent).unwrap() {
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
            object => object[key] = value,
        }
        let text = refusal(&document.to_glb().unwrap(), "a.glb");
        assert!(text.contains(words), "{pointer}: {text} should say {words:?}");
    }
}

#[test]
fn zeros_without_bytes_are_limited() {
    let mut maker = Maker::new();
    let position = maker.bare_accessor(json!({"componentType": 5126, "type": "VEC3", "count": 3_000_000_000u32}));
    maker.draw(vec![json!({"attributes": {"POSITION": position}})], json!({}));
    refused(maker, &["/accessors/0", "count 3000000000 with no buffer view"]);
}

#[test]
fn indices_beyond_the_vertices_and_odd_counts() {
    let mut maker = plain();
    maker.json["accessors"][3]["count"] = 17.into();
    refused(maker, &["/meshes/0/primitives/0/indices: 17 indices are no triangles"]);
    let mut document = plain().finish();
    let offset = document.json["bufferViews"][3]["byteOffset"].as_u64().unwrap() as usize;
    document.buffers[0][offset] = 200;
    let text = refusal(&document.to_glb().unwrap(), "a.glb");
    assert!(text.contains("index 200 at 0 is not below 12"), "{text}");
}

#[test]
fn nodes_in_a_circle_or_with_two_parents() {
    for children in [json!([1, 0]), json!([1, 1])] {
        let mut maker = plain();
        maker.json["scenes"][0]["nodes"] = json!([0]);
        maker.json["nodes"][0]["children"] = children;
        refused(maker, &["/nodes/", "is reached twice: nodes must form a tree without cycles"]);
    }
    let mut deep = plain();
    for node in 0..3000 {
        deep.node(json!({"children": [node + 3]}));
    }
    deep.node(json!({}));
    deep.json["scenes"][0]["nodes"] = json!([2]);
    refused(deep, &["has more than 1024 nodes above it"]);
}

#[test]
fn numbers_that_no_tree_has() {
    for (number, words) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (1e30, "1000000000000000000000000000000")] {
        for accessor in [0, 1] {
            let mut document = plain().finish();
            let offset = document.json["bufferViews"][accessor]["byteOffset"].as_u64().unwrap() as usize + 5 * 12 + 4;
            document.buffers[0][offset..offset + 4].copy_from_slice(&number.to_le_bytes());
            let text = refusal(&document.to_glb().unwrap(), "a.glb");
            assert!(text.contains(&format!("/accessors/{accessor} element 5: {words}")), "{text}");
        }
    }
}

#[test]
fn compressed_geometry_is_refused_by_name_with_the_command() {
    let mut draco = plain();
    draco.json["meshes"][0]["primitives"][1]["extensions"] =
        json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}});
    refused(draco, &["/meshes/0/primitives/1", "KHR_draco_mesh_compression is in use", "npx @gltf-transform/cli copy"]);
    let mut meshopt = plain();
    let buffers = meshopt.json["buffers"].as_array_mut().unwrap();
    buffers.push(json!({"byteLength": 9, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}));
    let mut document = meshopt.finish();
    document.buffers.truncate(1);
    let text = refusal(&document.to_glb().unwrap(), "a.glb");
    assert!(text.contains("/buffers/1: EXT_meshopt_compression") && text.contains("npx"), "{text}");
}

#[test]
fn uris_that_leave_the_folder_are_refused_with_the_flag() {
    for uri in ["/etc/passwd", "../secret.bin", "%2e%2e/secret.bin", "file:///etc/passwd", "https://example.org/a.bin"]
    {
        let mut json = plain().finish().json;
        json["buffers"][0]["uri"] = uri.into();
        let text = refusal(json.to_string().as_bytes(), "a.gltf");
        let remedy = if uri.contains("://") { "save the file beside the asset" } else { "--search" };
        assert!(text.contains(remedy) && text.contains("/buffers/0"), "{uri}: {text}");
    }
    let mut json = plain().finish().json;
    json["buffers"][0]["uri"] = "missing.bin".into();
    let error = attempt(json.to_string().as_bytes(), "a.gltf").unwrap_err().to_string();
    assert!(error.contains("missing.bin") && error.contains("a.gltf names it at /buffers/0"), "{error}");
}

#[test]
fn a_damaged_extension_is_refused() {
    let mut document = Document::clone(&from_document(&odd::plain().finish()).document);
    document.json["extensions"] = json!({"FOLIAR_foliage": {"contract": 1, "records": 7}});
    let text = refusal(&document.to_glb().unwrap(), "a.glb");
    assert!(text.contains("/extensions/FOLIAR_foliage: is damaged"), "{text}");
}

/// Every JSON value of a master, one at a time, replaced by odd ones or gone: refused or read, never a panic;
/// and what is read can be assembled or is refused.
#[test]
fn any_json_value_may_be_anything() {
    let asset = from_document(&odd::foreign_metadata());
    let master = assemble(&asset.document, &layers_for(&asset)).unwrap().0;
    let mut pointers = Vec::new();
    collect(&master.json, String::new(), &mut pointers);
    for pointer in pointers {
        for odd in
            [json!(null), json!(-1), json!(1e300), json!("x"), json!([]), json!({}), json!(4_294_967_295u32), json!(1)]
        {
            let mut changed = master.clone();
            *changed.json.pointer_mut(&pointer).unwrap() = odd;
            read_and_assemble(&changed);
        }
        let mut without = master.clone();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        if let Some(object) = without.json.pointer_mut(parent).and_then(Value::as_object_mut) {
            object.remove(&key.replace("~1", "/"));
            read_and_assemble(&without);
        }
    }
}

fn read_and_assemble(document: &Document) {
    let Ok(bytes) = document.to_glb() else { return };
    let _ = second_reader::verify(&bytes);
    if let Ok(read) = attempt(&bytes, "a.glb") {
        let _ = assemble(&read.document, &read.layers);
        let _ = assemble(&read.document, &layers_for(&read));
    }
}

fn collect(value: &Value, pointer: String, out: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            map.iter().for_each(|(k, v)| collect(v, format!("{pointer}/{}", k.replace('/', "~1")), out))
        }
        Value::Array(list) => list.iter().enumerate().for_each(|(i, v)| collect(v, format!("{pointer}/{i}"), out)),
        _ => {}
    }
    if !pointer.is_empty() {
        out.push(pointer);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipped_bytes_never_panic(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = master_bytes();
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = second_reader::verify(&bytes);
        if let Ok(read) = attempt(&bytes, "a.glb") {
            let _ = assemble(&read.document, &read.layers);
        }
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = attempt(&bytes, "a.glb");
        let _ = attempt(&[b"glTF\x02\0\0\0".to_vec(), bytes].concat(), "a.glb");
    }
}
