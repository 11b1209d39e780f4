//! Masters that a tool has changed, records of rooms that this version does not know, and layers that
//! do not belong.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "helpers of tests are tests")]

mod common;
use common::*;
use foliar_bake::{Array, Layer};
use foliar_carrier::{Document, assemble, check_layer, layer_from_bytes, layer_to_bytes};
use foliar_schema::{Finding, channel, names};
use serde_json::{Value, json};

fn codes(findings: &[Finding]) -> Vec<&str> {
    findings.iter().map(|f| f.code.as_str()).collect()
}

fn plain() -> foliar_carrier::Asset {
    from_document(&odd::plain().finish())
}

fn master(asset: &foliar_carrier::Asset) -> Document {
    assemble(&asset.document, &layers_for(asset)).unwrap().0
}

#[test]
fn taken_names_give_way_with_a_finding() {
    for (name, codes_wanted) in [("numbers", 2), ("foreign_metadata", 1), ("schema_uri", 1), ("taken_names", 3)] {
        let document = odd::all().into_iter().find(|(n, _)| *n == name).unwrap().1;
        let asset = from_document(&document);
        let findings = assemble(&asset.document, &layers_for(&asset)).unwrap().1;
        assert_eq!(codes(&findings), vec!["NAME-TAKEN"; codes_wanted], "{name}: {findings:#?}");
    }
}

#[test]
fn where_names_are_taken_the_next_free_ones_stand() {
    let asset = from_document(&odd::taken_names());
    let json = assemble(&asset.document, &layers_for(&asset)).unwrap().0.json;
    assert!(json["meshes"][1]["primitives"][0]["attributes"]["_AMBIENT_1"].is_u64());
    assert!(json.pointer("/extensions/EXT_structural_metadata/schema/classes/foliarLeaf_1").is_some());
    let asset = from_document(&odd::foreign_metadata());
    let json = assemble(&asset.document, &layers_for(&asset)).unwrap().0.json;
    let features = &json["meshes"][0]["primitives"][1]["extensions"]["EXT_mesh_features"]["featureIds"];
    assert_eq!(features[0]["attribute"], 1, "one number for all primitives of a mesh");
    assert_eq!(features[0]["propertyTable"], 1);
    assert_eq!(features[0]["nullFeatureId"], ROWS);
}

#[test]
fn the_mirror_serves_where_a_tool_dropped_the_extension() {
    let asset = plain();
    let mut dropped = master(&asset);
    dropped.json["extensions"].as_object_mut().unwrap().remove(names::EXTENSION);
    dropped.json["extensionsUsed"].as_array_mut().unwrap().retain(|n| n != names::EXTENSION);
    for mesh in dropped.json["meshes"].as_array_mut().unwrap() {
        for primitive in mesh["primitives"].as_array_mut().unwrap() {
            primitive["extensions"].as_object_mut().unwrap().remove(names::EXTENSION);
        }
    }
    let back = from_document(&dropped);
    assert_eq!(back.layers, layers_for(&asset));
    assert_eq!(back.document.json.to_string(), asset.document.json.to_string());
}

#[test]
fn a_rearranged_file_still_gives_its_layers_and_loses_all_names() {
    let asset = plain();
    let mut moved = master(&asset);
    // As a tool does that renames buffer views.
    for view in moved.json["bufferViews"].as_array_mut().unwrap() {
        view.as_object_mut().unwrap().remove("name");
    }
    let back = from_document(&moved);
    assert_eq!(back.layers, layers_for(&asset));
    assert_eq!(back.base_hash, asset.base_hash);
    let text = back.document.json.to_string();
    assert!(!text.contains("FOLIAR") && !text.contains("foliar") && !text.contains("_AMBIENT"), "{text}");
}

#[test]
fn a_lost_attribute_is_a_finding() {
    let asset = plain();
    let mut lost = master(&asset);
    for mesh in lost.json["meshes"].as_array_mut().unwrap() {
        for primitive in mesh["primitives"].as_array_mut().unwrap() {
            primitive["attributes"].as_object_mut().unwrap().remove(names::AMBIENT);
        }
    }
    let back = from_document(&lost);
    assert_eq!(codes(&back.findings), ["STALE"]);
    assert!(back.findings[0].message.contains("_AMBIENT of density is missing"), "{:?}", back.findings);
    assert_eq!(back.layers.len(), 2, "its record stays, so that it can be baked again");
}

#[test]
fn a_changed_base_is_stale() {
    let asset = plain();
    let mut changed = master(&asset);
    changed.buffers[0][0] ^= 1;
    let back = from_document(&changed);
    assert_eq!(codes(&back.findings), ["STALE", "STALE"]);
    assert!(back.findings[0].message.contains(&asset.base_hash));
}

#[test]
fn a_layer_of_an_unknown_room_is_kept_whole() {
    let asset = plain();
    let mut layers = layers_for(&asset);
    let place = asset.base.parts[2].place;
    let mut tide = Layer { roles: Default::default(), ..layers[1].clone() };
    tide.attributes.clear();
    tide.attributes.insert(key(place, "_TIDE"), Array::F32 { width: 4, data: vec![0.25; 16] });
    tide.attributes.insert(key(place, "BRANCH_ID"), Array::scalars(vec![0.0, 1.0, 2.0, 1.0]));
    tide.columns.insert(column("foliarBranch", "chain"), Array::I32 { width: 4, data: vec![0, -1, 2, 3, 1, 1, 1, 1] });
    tide.columns.insert(column("foliarBranch", "spline"), Array::F32 { width: 9, data: vec![0.5; 18] });
    tide.record.room = "tide".into();
    tide.record.reads.remove("structure");
    tide.record.writes = ["BRANCH_ID", "_TIDE", "foliarBranch/chain", "foliarBranch/spline"].map(String::from).to_vec();
    layers.push(tide.clone());
    let mut made = assemble(&asset.document, &layers).unwrap().0;
    // What a newer foliar would say: four numbers are an array there, no vector.
    let chain = "/extensions/EXT_structural_metadata/schema/classes/foliarBranch/properties/chain";
    let definition =
        json!({"type": "SCALAR", "componentType": "INT32", "array": true, "count": 4, "name": "of theirs"});
    *made.json.pointer_mut(chain).unwrap() = definition.clone();
    let back = from_document(&made);
    assert_eq!(codes(&back.findings), ["RECORD-UNKNOWN"]);
    let kept = &back.layers[2];
    assert_eq!((&kept.attributes, &kept.columns), (&tide.attributes, &tide.columns));
    assert_eq!(back.document.json.to_string(), asset.document.json.to_string());
    let again = assemble(&back.document, &back.layers).unwrap().0;
    assert_eq!(again.json.to_string(), made.json.to_string());
    assert!(again.buffers == made.buffers);
}

#[test]
fn a_newer_contract_stays_as_it_is_and_nothing_joins_it() {
    let asset = plain();
    let mut newer = master(&asset);
    newer.json["extensions"][names::EXTENSION]["contract"] = 99.into();
    let back = from_document(&newer);
    assert_eq!(codes(&back.findings), ["RECORD-UNKNOWN"]);
    assert_eq!((back.document.json.to_string(), back.layers.len()), (newer.json.to_string(), 0));
    let error = assemble(&back.document, &layers_for(&asset)).unwrap_err().to_string();
    assert!(error.contains("newer foliar") && error.contains("update"), "{error}");
}

#[test]
fn a_table_without_rows_comes_back_as_one() {
    let asset = plain();
    let structure = structure_for(&asset, 0);
    let made = assemble(&asset.document, std::slice::from_ref(&structure)).unwrap().0;
    keep("no_leaves.glb", &made.to_glb().unwrap(), None);
    assert_eq!(from_document(&made).layers, [structure]);
}

#[test]
fn own_normals_fill_a_mesh_of_both_roles_and_are_taken_out_again() {
    let asset = plain();
    let made = master(&asset);
    let primitives = &made.json["meshes"][0]["primitives"];
    let names_of = |p: usize| primitives[p]["attributes"].as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(names_of(0), names_of(1), "one vertex layout per mesh");
    let wood = asset.base.parts[1].place;
    assert!(from_document(&made).layers.iter().all(|l| l.attribute(wood, names::SOFT_NORMAL).is_none()));
}

#[test]
fn layers_that_do_not_fit_are_refused_in_words() {
    let asset = plain();
    let other = from_document(&odd::many_meshes());
    let [structure, density] = <[Layer; 2]>::try_from(layers_for(&other)).unwrap();
    let refused = |layers: &[Layer], words: &str| {
        let error = assemble(&asset.document, layers).unwrap_err();
        assert!(error.to_string().contains(words) && !error.is_output(), "{error} should say {words:?}");
    };
    refused(std::slice::from_ref(&structure), "layer structure, mesh 0 primitive 2: does not exist in the base");
    let error = check_layer(&structure, &asset.base_hash).unwrap_err().to_string();
    assert!(error.contains(&asset.base_hash) && error.contains(&other.base_hash), "{error}");
    refused(&[density.clone(), density], "given twice");
    let [own, density] = <[Layer; 2]>::try_from(layers_for(&asset)).unwrap();
    let mut changed = own.clone();
    changed.columns.insert(column(names::CLASS_LEAF, "area"), Array::scalars(vec![0.5; ROWS]));
    refused(&[changed, density], "it was baked from the layer structure");
    let mut outside = own.clone();
    let place = asset.base.parts[0].place;
    outside.attributes.insert(key(place, names::LEAF_ID), Array::scalars(vec![9.0; 12]));
    refused(&[outside], "id 9 is no row of foliarLeaf (0 to 7)");
    let mut short = own;
    short.columns.insert(column(names::CLASS_LEAF, "area"), Array::scalars(vec![0.5; 2]));
    refused(&[short], "7 rows where the table has 2");
}

#[test]
fn a_layer_file_is_exact_and_the_same_every_time() {
    let asset = plain();
    for layer in layers_for(&asset) {
        let bytes = layer_to_bytes(&layer).unwrap();
        assert!(bytes == layer_to_bytes(&layer).unwrap());
        let back = layer_from_bytes(&bytes, "x.layer").unwrap();
        assert_eq!(back, layer);
        assert_eq!(back.content_hash(), layer.content_hash());
        // Where the arrays start at an odd byte.
        let mut odd = vec![0];
        odd.extend(&bytes);
        assert_eq!(layer_from_bytes(&odd[1..], "x.layer").unwrap(), layer);
    }
}

#[test]
fn bad_layer_files_are_refused_in_words() {
    let bytes = layer_to_bytes(&layers_for(&plain())[0]).unwrap();
    for length in (0..bytes.len()).step_by(7) {
        let error = layer_from_bytes(&bytes[..length], "x.layer").unwrap_err().to_string();
        assert!(error.starts_with("x.layer") && error.contains("bake the layer again"), "{error}");
    }
    for at in 0..bytes.len().min(600) {
        let mut bad = bytes.clone();
        bad[at] ^= 0x55;
        let _ = layer_from_bytes(&bad, "x.layer");
    }
    let foreign =
        safetensors::serialize(std::iter::empty::<(String, safetensors::tensor::TensorView)>(), None).unwrap();
    assert!(layer_from_bytes(&foreign, "x").unwrap_err().to_string().contains("no key \"foliar\""));
}

#[test]
fn a_layer_file_with_a_value_that_no_room_can_have_written_is_refused() {
    let asset = plain();
    let place = asset.base.parts[0].place;
    for (name, values, row) in [(names::AMBIENT, vec![0.5, 1.5], 1), (names::SOFT_NORMAL, vec![0.0, 0.5, 0.0], 0)] {
        let width = channel(name).unwrap().width;
        let mut layer = Layer::default();
        layer.attributes.insert(key(place, name), Array::F32 { width, data: values });
        let error = layer_from_bytes(&layer_to_bytes(&layer).unwrap(), "x.layer").unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(&format!("row {row} is ")), "{error}");
    }
    let mut layer = Layer::default();
    layer.columns.insert(column(names::CLASS_LEAF, "area"), Array::scalars(vec![1.0, 2.0, f32::NAN]));
    let error = layer_from_bytes(&layer_to_bytes(&layer).unwrap(), "x.layer").unwrap_err().to_string();
    assert!(error.contains("foliarLeaf/area") && error.contains("row 2 is NaN"), "{error}");
}

#[test]
fn the_extension_obeys_its_schema() {
    let schema = |value: schemars::Schema| jsonschema::validator_for(&serde_json::to_value(value).unwrap()).unwrap();
    let root = schema(schemars::schema_for!(foliar_schema::FoliageExtension));
    let primitive = schema(schemars::schema_for!(foliar_schema::PrimitiveExtension));
    for (name, document) in odd::all() {
        let made = master(&from_document(&document)).json;
        let check = |validator: &jsonschema::Validator, value: &Value| {
            assert!(validator.is_valid(value), "{name}: {value}");
        };
        check(&root, &made["extensions"][names::EXTENSION]);
        check(&primitive, &made["meshes"][0]["primitives"][0]["extensions"][names::EXTENSION]);
        let indices = made["extensions"][names::EXTENSION].to_string();
        assert!(!indices.contains("accessor\""), "names only, no indices");
    }
}
