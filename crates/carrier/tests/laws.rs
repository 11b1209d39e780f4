//! Laws 1 (base untouched) and 3 (idempotent), over real files.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::*;
use foliar_carrier::{Document, assemble, encode};
use std::path::Path;

/// Assembles, reads back, and demands the base and the layers as they were.
fn round_trip(asset: &foliar_carrier::Asset) -> Document {
    let layers = layers_for(asset);
    let (master, _) = assemble(&asset.document, &layers).unwrap();
    assert_contains(&asset.document.json, &master.json, "");
    for (base, full) in asset.document.buffers.iter().zip(&master.buffers) {
        assert!(full.starts_with(base), "bytes of the base changed");
    }
    let bytes = master.to_glb().unwrap();
    let back = foliar_carrier::read_bytes(
        bytes.clone(),
        "back.glb",
        asset.document.folder.as_deref().unwrap_or(std::path::Path::new("")),
        &foliar_schema::Import::default(),
    )
    .unwrap();
    assert_eq!(back.layers, layers);
    assert_eq!(back.base_hash, asset.base_hash);
    // As a GLB the first buffer has no URI: the base is compared in the same container.
    let mut base = asset.document.json.clone();
    base["buffers"][0].as_object_mut().unwrap().shift_remove("uri");
    assert_eq!(back.document.json.to_string(), base.to_string(), "stripping gives the base");
    assert!(back.document.to_glb().unwrap() == asset.document.to_glb().unwrap(), "and its bytes");
    let mut reversed = back.layers.clone();
    reversed.reverse();
    let again = assemble(&back.document, &reversed).unwrap().0.to_glb().unwrap();
    assert!(again == bytes, "baking twice gives the same file");
    master
}

#[test]
fn every_shared_file_survives_layers() {
    for name in SHARED {
        let Some(asset) = read_shared(name) else { return };
        let master = round_trip(&asset);
        let input = trees().map(|t| t.join(name));
        let name = format!("shared_{}.glb", name.replace(['/', '.'], "_"));
        let bytes = encode(&master, Path::new(&name)).unwrap().remove(0).bytes;
        keep(&name, &bytes, input.as_deref());
    }
}

#[test]
fn every_odd_document_survives_layers() {
    for (name, document) in odd::all() {
        let asset = from_document(&document);
        assert_eq!(asset.document.json.to_string(), document.json.to_string(), "{name}: reading changed the JSON");
        let master = round_trip(&asset);
        keep(&format!("odd_{name}.glb"), &master.to_glb().unwrap(), None);
    }
}
