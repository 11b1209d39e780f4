//! Material libraries: found, missing, looping; colors, roughness, opacity; tobj as second reader.

use super::{converted, converted_in, findings, shared};
use foliar_carrier::CarrierError;
use foliar_carrier::obj::{convert, parse_mtl};
use foliar_schema::Import;
use serde_json::{Value, json};
use std::path::Path;

const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";

/// A folder with these libraries.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    folder
}

/// Material 0 of a file with this library, and the codes of its findings.
fn material(mtl: &str) -> (Value, Vec<String>) {
    let folder = folder(&[("t.mtl", mtl)]);
    let converted = converted_in(folder.path(), &format!("mtllib t.mtl\n{FACE}"), &Import::default());
    let codes = converted.findings.iter().map(|f| f.code.clone()).filter(|c| !c.starts_with("IMPORT-U")).collect();
    (converted.document.json["materials"][0].clone(), codes)
}

#[test]
fn color_shininess_and_opacity_follow_the_stated_rules() {
    let (plain, codes) = material("newmtl a\nKd 0.5 0.25 0.125\nNs 250\nKs 0.5 0.5 0.5\nd 1\n");
    assert_eq!(
        plain,
        json!({
            "name": "a",
            "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 0.125, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.5 },
            "doubleSided": true,
        })
    );
    assert!(codes.is_empty(), "{codes:?}");
    let roughness = |mtl: &str| material(mtl).0["pbrMetallicRoughness"]["roughnessFactor"].as_f64().unwrap();
    assert_eq!(roughness("newmtl a\nNs 1000\n").to_bits(), 0f64.to_bits());
    assert_eq!(roughness("newmtl a\nNs 1000\nKs 0 0 0\n").to_bits(), 1f64.to_bits());
    assert_eq!(roughness("newmtl a\n").to_bits(), 1f64.to_bits());
    let (glass, _) = material("newmtl a\nd 0.25\nKe 0 1 0\n");
    assert_eq!((glass["alphaMode"].as_str(), glass["emissiveFactor"][1].as_f64()), (Some("BLEND"), Some(1.0)));
    let (hidden, codes) = material("newmtl a\nd 0\n");
    assert_eq!((hidden.get("alphaMode"), codes), (None, vec!["IMPORT-MTL".to_string()]));
}

#[test]
fn a_missing_library_or_material_is_said_even_where_another_loads() {
    let folder = folder(&[("there.mtl", "newmtl a\nKd 1 0 0\n")]);
    let text = format!("mtllib there.mtl\nmtllib gone.mtl\n{FACE}usemtl b\nf 1/1 2/2 3/3\n");
    let converted = converted_in(folder.path(), &text, &Import::default());
    let said = findings(&converted, "IMPORT-MTL");
    assert!(said.len() == 2 && said[0].contains("gone.mtl") && said[1].contains("[\"b\"]"), "{said:?}");
    assert_eq!(converted.document.json["materials"][1]["name"], "b");
    assert_eq!(converted.files.len(), 1);
    let none = super::converted(FACE, &Import::default());
    assert!(findings(&none, "IMPORT-MTL")[0].contains("names no material library"));
}

#[test]
fn faces_before_any_material_get_an_unnamed_one_seen_from_both_sides() {
    let converted = converted("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &Import::default());
    let material = &converted.document.json["materials"][0];
    assert_eq!((material.get("name"), material["doubleSided"].as_bool()), (None, Some(true)));
    assert_eq!(converted.document.json["nodes"][0].get("name"), None);
    assert!(findings(&converted, "IMPORT-MTL").is_empty());
}

#[test]
fn libraries_may_be_several_have_blanks_and_repeat() {
    let files = [("my tree.mtl", "newmtl a\nKd 1 0 0\n"), ("b.mtl", "newmtl b\nKd 0 1 0\nnewmtl a\nKd 0 0 1\n")];
    let folder = folder(&files);
    for lines in [
        "mtllib my tree.mtl b.mtl",
        "mtllib my tree.mtl\nmtllib b.mtl\nmtllib my tree.mtl\n",
        "mtllib MY TREE.mtl b.MTL",
    ] {
        let converted = converted_in(folder.path(), &format!("{lines}\n{FACE}"), &Import::default());
        let color = &converted.document.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
        assert_eq!(*color, json!([1.0, 0.0, 0.0, 1.0]), "{lines}: the first definition counts");
        assert_eq!(converted.files.len(), 2, "{lines}");
    }
}

#[test]
fn a_library_that_names_itself_or_the_obj_ends() {
    let looping = "mtllib t.mtl\nnewmtl a\nmtllib t.mtl\nKd 1 0 0\n";
    let (material, _) = material(looping);
    assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"][0], 1.0);
    let folder = folder(&[("tree.obj", FACE)]);
    let converted = converted_in(folder.path(), &format!("mtllib tree.obj\n{FACE}"), &Import::default());
    assert!(findings(&converted, "IMPORT-MTL")[0].contains("defines no material"));
}

#[test]
fn a_library_outside_the_folder_is_refused_with_line_and_flag() {
    for name in ["../t.mtl", "/etc/hostname", "file:///etc/hostname", "http://example.org/t.mtl"] {
        let text = format!("# a comment\nmtllib {name}\n{FACE}");
        let error = convert(text.as_bytes(), "tree.obj", Path::new("/nowhere"), &Import::default()).unwrap_err();
        let message = error.to_string();
        let remedy = if name.contains("://") { "save the file beside the asset" } else { "--search" };
        assert!(message.starts_with("tree.obj, line 2: ") && message.contains(remedy), "{message}");
        assert!(matches!(error, CarrierError::Input { .. }) && !error.is_output());
    }
}

#[test]
fn a_damaged_library_is_named_with_its_line() {
    let folder = folder(&[("t.mtl", "newmtl a\nKd 1 x 0\n")]);
    let text = format!("mtllib t.mtl\n{FACE}");
    let error = convert(text.as_bytes(), "tree.obj", folder.path(), &Import::default()).unwrap_err().to_string();
    assert!(error.contains("t.mtl, line 2: Kd = \"x\""), "{error}");
}

#[test]
fn unknown_keys_are_said_in_file_order() {
    let folder = folder(&[("t.mtl", "newmtl a\nzeta 1\nalpha 2\nKa 1 1 1\nillum 2\n")]);
    let converted = converted_in(folder.path(), &format!("mtllib t.mtl\n{FACE}"), &Import::default());
    assert!(findings(&converted, "IMPORT-IGNORED")[0].ends_with("zeta 1, alpha 2"));
}

#[test]
fn tobj_reads_the_same_colors_and_maps() {
    let Some(shared) = shared() else { return };
    let mut seen = 0;
    for entry in
        std::fs::read_dir(shared.join("trees")).unwrap().flat_map(|e| std::fs::read_dir(e.unwrap().path())).flatten()
    {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "mtl") {
            continue;
        }
        let ours = parse_mtl(&std::fs::read(&path).unwrap(), "t.mtl").unwrap().materials;
        let (theirs, _) = tobj::load_mtl(&path).unwrap();
        assert_eq!(ours.len(), theirs.len(), "{}", path.display());
        for (a, b) in ours.iter().zip(&theirs) {
            let f32s = |c: Option<[f64; 3]>| c.map(|c| c.map(|x| x as f32));
            let file = |m: &Option<foliar_carrier::obj::Map>| m.as_ref().map(|m| m.file.clone());
            assert_eq!((&a.name, f32s(a.kd), f32s(a.ks)), (&b.name, b.diffuse, b.specular));
            assert_eq!((a.ns.map(|n| n as f32), a.opacity.map(|d| d as f32)), (b.shininess, b.dissolve));
            assert_eq!(
                (file(&a.map_kd), file(&a.map_d), file(&a.bump)),
                (b.diffuse_texture.clone(), b.dissolve_texture.clone(), b.normal_texture.clone())
            );
            seen += 1;
        }
    }
    assert!(seen >= 20, "{seen}");
}
