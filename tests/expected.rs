//! What import and structure find in the shared trees, held against `expected.json` and the truth of
//! the generators: every listed file, exactly, without a single pattern.

use crate::expected_parts::wrong_parts;
use foliar_carrier::Asset;
use foliar_schema::{Finding, Import, Roles, Unit, Up};
use foliar_structure::{Analysis, StructureParams, analyze, from_layer};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The folder of shared trees, or nothing, said in so many words.
fn trees() -> Option<PathBuf> {
    crate::common::shared("trees")
}

fn listed(trees: &Path) -> Vec<(String, Value)> {
    let text = std::fs::read_to_string(trees.join("expected.json")).unwrap();
    let value: Value = serde_json::from_str(&text).unwrap();
    value["files"].as_object().unwrap().iter().map(|(name, file)| (name.clone(), file.clone())).collect()
}

/// Flags as the list has them.
fn import(file: &Value) -> Import {
    let up = if file["up"] == "z" { Up::Z } else { Up::Y };
    let unit = (file["unit"] == "m").then_some(Unit::M);
    Import { up: Some(up), unit, ..Import::default() }
}

fn find(path: &Path, import: &Import) -> (Asset, Analysis) {
    let asset = foliar_carrier::read(path, import).unwrap();
    let analysis = analyze(&asset.base, &Roles::default(), &StructureParams::default()).unwrap();
    (asset, analysis)
}

fn has(findings: &[Finding], code: &str) -> bool {
    findings.iter().any(|f| f.code == code)
}

#[test]
fn every_listed_file_comes_out_exactly() {
    let Some(trees) = trees() else { return };
    let mut wrong = Vec::new();
    for (name, file) in listed(&trees) {
        let (_, analysis) = find(&trees.join(&name), &import(&file));
        let deviations = wrong_parts(&file, &analysis.parts);
        if !deviations.is_empty() {
            wrong.push(format!("{name}: {}, found {:?}", deviations.join("; "), analysis.parts));
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn leaves_go_together_as_their_generators_made_them() {
    let Some(trees) = trees() else { return };
    for (name, leaves, groups) in [
        ("ez_oak_small_1k5/tree.obj", 1800, 900),
        ("ez_oak_small_1k5/tree.glb", 1800, 900),
        ("ez_ash_large_12k/tree.obj", 11880, 5940),
        ("ez_aspen_large_40k/tree.glb", 39060, 19530),
        ("proctree_default/proctree.obj", 448, 224),
        ("sapling_default_1k5/tree.obj", 1484, 1484),
        ("sapling_birch_12k/tree.obj", 11453, 11453),
        ("proton_scatter/tree.glb", 1440, 1440),
    ] {
        let (_, analysis) = find(&trees.join(name), &Import::default());
        let found = &analysis.structure.leaves;
        let count = found.iter().map(|leaf| leaf.group + 1).max().unwrap();
        assert_eq!((found.len(), count), (leaves, groups), "{name}");
    }
}

#[test]
fn the_same_tree_as_obj_and_as_glb_has_the_same_leaves() {
    let Some(trees) = trees() else { return };
    for folder in ["ez_oak_small_1k5", "ez_bush_2", "sapling_default_1k5"] {
        let [obj, glb] =
            ["tree.obj", "tree.glb"].map(|file| find(&trees.join(folder).join(file), &Import::default()).1);
        let (a, b) = (&obj.structure.leaves, &glb.structure.leaves);
        assert_eq!(a.len(), b.len(), "{folder}");
        let size = a.iter().flat_map(|l| l.center.to_array()).fold(0.0, |m: f32, x| m.max(x.abs()));
        for (a, b) in a.iter().zip(b) {
            // OBJ text carries six decimals or more of coordinates up to `size`.
            assert!(a.center.distance(b.center) <= 2e-6 * size.max(1.0), "{folder}: {a:?} {b:?}");
            assert_eq!(a.group, b.group, "{folder}");
        }
    }
}

#[test]
fn files_that_mix_trunk_and_crown_are_said_to() {
    let Some(trees) = trees() else { return };
    let list = listed(&trees);
    let mut seen = 0;
    for entry in std::fs::read_dir(trees.join("tree3d")).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("tree3d/{}", path.file_name().unwrap().to_str().unwrap());
        if path.extension().is_some_and(|e| e == "obj") && !list.iter().any(|(listed, _)| *listed == name) {
            let (_, analysis) = find(&path, &Import::default());
            assert!(has(&analysis.findings, "ROLE-MIXED"), "{name}: {:?}", analysis.findings);
            seen += 1;
        }
    }
    assert_eq!(seen, 10);
}

#[test]
fn a_tree_that_lies_on_its_side_is_said_to() {
    let Some(trees) = trees() else { return };
    for name in ["mtree_fused_small/tree.obj", "mtree_splines_small/tree.obj"] {
        for (up, lies) in [(Up::Y, true), (Up::Z, false)] {
            let (_, analysis) = find(&trees.join(name), &Import { up: Some(up), ..Import::default() });
            assert_eq!(has(&analysis.findings, "IMPORT-LYING"), lies, "{name} with {up:?} up");
        }
    }
    for (name, file) in listed(&trees) {
        let (_, analysis) = find(&trees.join(&name), &import(&file));
        // The dead branch does lie on the ground.
        let lies = name == "proton_scatter/dead_branch.glb";
        assert_eq!(has(&analysis.findings, "IMPORT-LYING"), lies, "{name}");
    }
}

#[test]
fn a_layer_gives_the_structure_back_exactly() {
    let Some(trees) = trees() else { return };
    for name in ["ez_oak_small_1k5/tree.glb", "quaternius_lowpoly/BirchTree_4.obj", "mtree_fused_small/tree.obj"] {
        let (asset, analysis) = find(&trees.join(name), &Import::default());
        let back = from_layer(&analysis.layer, &asset.base).unwrap();
        assert_eq!(back.leaves, analysis.structure.leaves, "{name}");
        assert_eq!(back.leaf_ids, analysis.structure.leaf_ids, "{name}");
        assert_eq!(back.roles, analysis.structure.roles, "{name}");
    }
}

#[test]
fn leaf_cards_cover_as_little_as_their_pictures_show() {
    let Some(trees) = trees() else { return };
    for (name, low, high) in [
        ("ez_oak_small_1k5/tree.obj", 0.1, 0.6),
        ("ez_ash_large_12k/tree.obj", 0.1, 0.6),
        ("khronos_glassvaseflowers/GlassVaseFlowers.gltf", 0.2, 1.0),
    ] {
        let (mut asset, analysis) = find(&trees.join(name), &Import::default());
        let sum = |analysis: &Analysis| analysis.structure.leaves.iter().map(|l| f64::from(l.area)).sum::<f64>();
        let covered = sum(&analysis);
        asset.base.materials.iter_mut().for_each(|m| m.alpha_mode = foliar_plant::AlphaMode::Opaque);
        let whole = sum(&analyze(&asset.base, &Roles::default(), &StructureParams::default()).unwrap());
        let share = covered / whole;
        assert!((low..high).contains(&share), "{name}: {share}");
        eprintln!("{name}: {share:.3} of the cards is leaf");
    }
}
