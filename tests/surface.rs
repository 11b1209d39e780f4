//! `--surface`: the file, its refusals, and its mesh on every shared tree.

use crate::common::{DENSITY, FOLIAR, folder, open_glb, output, run, shared, text, tree};
use foliar_density::surface::{Surface, check_mesh, pieces};
use glam::Vec3;
use serde_json::Value;
use std::path::Path;

#[test]
fn a_surface_is_written_beside_an_output_or_alone() {
    let here = folder();
    let (plant, out, alone) = (tree(here.path(), 40), output("surface-tree.glb"), output("surface-alone.glb"));
    let (beside, list) = (output("surface-beside.glb"), here.path().join("outputs.json"));
    let _ = std::fs::remove_file(&alone);
    let told = run(DENSITY, &[text(&plant), "--surface", text(&alone)]).expect(0, &[]).stdout;
    assert!(told.contains("surface-alone.glb: written"), "{told}");
    let both = ["bake", text(&plant), "-o", text(&out), "--surface", text(&beside), "--outputs", text(&list)];
    run(FOLIAR, &both).expect(0, &[]);
    assert!(std::fs::read(&alone).unwrap() == std::fs::read(&beside).unwrap(), "the same by either program");
    let listed = std::fs::read_to_string(&list).unwrap();
    assert!(listed.contains("surface-tree.glb") && listed.contains("surface-beside.glb"), "{listed}");
    run(DENSITY, &[text(&plant), "--surface", text(&alone), "--check"]).expect(0, &[]);
    run(DENSITY, &[text(&plant), "--surface", text(&alone), "--check", "--surface-cell-m", "0.01"])
        .expect(1, &["would change", "surface-alone.glb"]);
    let (json, _) = open_glb(&alone);
    assert!(json["extensions"].is_null() && json["meshes"].as_array().is_some_and(|meshes| meshes.len() == 1));
}

#[test]
fn a_surface_that_cannot_be_leaves_every_file_as_it_was() {
    let here = folder();
    let plant = tree(here.path(), 40);
    let (out, crown) = (here.path().join("tree.glb"), here.path().join("crown.glb"));
    let refused = |flags: &[&str], said: &[&str]| {
        let common = [text(&plant), "-o", text(&out), "--surface", text(&crown)];
        run(DENSITY, &[&common[..], flags].concat()).expect(2, said);
        assert!(!out.exists() && !crown.exists(), "{flags:?}");
    };
    refused(&["--threshold", "0"], &["density.threshold", "gradient vanishes"]);
    refused(&["--surface-cell-m", "1e-7"], &["density.surface_cell_m", "surface_memory_mb", "would"]);
    refused(&["--surface-cell-m", "1e3"], &["density.surface_cell_m", "at most radius_m"]);
    run(DENSITY, &[text(&plant), "--surface", "crown.obj"]).expect(2, &["--surface crown.obj: must end in .glb"]);
    run(DENSITY, &[text(&plant), text(&plant), "-d", text(here.path()), "--surface", text(&crown)])
        .expect(2, &["--surface names one file for 2 inputs"]);
    run(DENSITY, &[text(&plant), "-o", text(&crown), "--surface", text(&crown)]).expect(2, &["would both write"]);
}

#[test]
fn bare_wood_has_an_empty_surface_and_a_finding() {
    let here = folder();
    let (plant, crown) = (here.path().join("bare.obj"), output("surface-bare.glb"));
    std::fs::write(&plant, "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl bark\nf 1 2 3\n").unwrap();
    run(DENSITY, &[text(&plant), "--wood", "bark", "--surface", text(&crown)]).expect(0, &["LEAF-NONE"]);
    assert!(open_glb(&crown).0["meshes"].is_null());
}

/// The mesh of a surface's file.
fn mesh(path: &Path) -> Surface {
    let (json, binary) = open_glb(path);
    let primitive = &json["meshes"][0]["primitives"][0];
    let number = |value: &Value| value.as_u64().unwrap() as usize;
    let bytes = |accessor: &Value| {
        let accessor = &json["accessors"][number(accessor)];
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        let start = number(&view["byteOffset"]);
        (binary[start..start + number(&view["byteLength"])].to_vec(), number(&accessor["componentType"]))
    };
    let vectors = |name: &str| -> Vec<Vec3> {
        let floats: Vec<f32> = bytes(&primitive["attributes"][name])
            .0
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
            .collect();
        floats.chunks_exact(3).map(Vec3::from_slice).collect()
    };
    let (indices, kind) = bytes(&primitive["indices"]);
    let width = if kind == 5123 { 2 } else { 4 };
    let corners: Vec<u32> =
        indices.chunks_exact(width).map(|b| b.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte))).collect();
    let triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    Surface { positions: vectors("POSITION"), normals: vectors("NORMAL"), triangles, ..Surface::default() }
}

/// Closed, manifold, every piece with its inside inside, normals on the side of their triangles.
fn assert_closed_and_outward(name: &str, surface: &Surface) {
    assert!(!surface.triangles.is_empty(), "{name}");
    assert!(check_mesh(&surface.triangles, surface.positions.len()).is_empty(), "{name}: open or not manifold");
    assert!(pieces(surface).iter().all(|piece| piece.volume > 0.0), "{name}: a piece is turned inside out");
    let outward = surface.triangles.iter().filter(|t| {
        let [a, b, c] = t.map(|v| surface.positions[v as usize]);
        (b - a).cross(c - a).dot(t.map(|v| surface.normals[v as usize]).iter().sum()) >= 0.0
    });
    // The true normal of a corner may lie behind the flat face of a sliver.
    assert!(outward.count() * 100 >= surface.triangles.len() * 99, "{name}: normals point in");
}

#[test]
fn every_shared_tree_has_a_closed_outward_surface() {
    let Some(trees) = shared("trees") else { return };
    let expected: Value = serde_json::from_str(&std::fs::read_to_string(trees.join("expected.json")).unwrap()).unwrap();
    let mut meshed = 0;
    for (index, (name, file)) in expected["files"].as_object().unwrap().iter().enumerate() {
        let out = output(&format!("surface-shared-{index}.glb"));
        let up = if file["up"] == "z" { "z" } else { "y" };
        let flags = if name.ends_with(".obj") { vec!["--up", up, "--unit", "m"] } else { Vec::new() };
        let input = trees.join(name);
        run(DENSITY, &[&[text(&input), "--surface", text(&out)], &flags[..]].concat()).expect(0, &[]);
        if open_glb(&out).0["meshes"].is_null() {
            continue;
        }
        assert_closed_and_outward(name, &mesh(&out));
        meshed += 1;
    }
    assert!(meshed >= 15, "{meshed}");
}
