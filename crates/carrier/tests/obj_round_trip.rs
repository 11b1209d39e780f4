//! An OBJ in memory and the GLB written from it are the same plant, to the bit.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::*;
use foliar_carrier::assemble;
use serde_json::Value;

#[test]
fn a_written_obj_reads_back_as_the_same_base_and_the_same_layers() {
    let Some(trees) = trees() else { return };
    let expected: Value = serde_json::from_slice(&std::fs::read(trees.join("expected.json")).unwrap()).unwrap();
    for (name, _) in expected["files"].as_object().unwrap().iter().filter(|(name, _)| name.ends_with(".obj")) {
        let asset = read_shared(name).unwrap();
        let from_file = from_document(&asset.document);
        assert_eq!(from_file.base_hash, asset.base_hash, "{name}");
        let layers = layers_for(&asset);
        let (master, findings) = assemble(&asset.document, &layers).unwrap();
        assert_eq!(findings, [], "{name}");
        let bytes = master.to_glb().unwrap();
        keep(&format!("obj_{}.glb", name.replace('/', "_")), &bytes, None);
        let back = from_memory(&bytes);
        assert_eq!(back.layers, layers, "{name}");
        assert!(back.document.to_glb().unwrap() == asset.document.to_glb().unwrap(), "{name}");
    }
}
