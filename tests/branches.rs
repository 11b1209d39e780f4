//! The layer `branches`: written, read back, taken out, kept, found again.

use crate::common::{FOLIAR, IMPORT, Run, folder, glb, open_glb, output, run, run_in, text};
use foliar_carrier::second_reader::verify_file;
use foliar_plant::sample::hard_tree;
use foliar_schema::names;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A hard tree as `tree.obj`; its vertices are those of the sample.
fn tree(folder: &Path, name: &str) -> PathBuf {
    let plant = hard_tree(name, 1).unwrap().plant;
    let (mut text, mut first) = (String::new(), 1);
    for (part, role) in plant.parts().iter().zip(&plant.structure().roles) {
        writeln!(text, "o {}", if *role == foliar_schema::Role::Wood { "trunk" } else { "leaves" }).unwrap();
        part.positions.iter().for_each(|p| writeln!(text, "v {} {} {}", p.x, p.y, p.z).unwrap());
        for [a, b, c] in &part.triangles {
            writeln!(text, "f {} {} {}", a + first, b + first, c + first).unwrap();
        }
        first += part.positions.len() as u32;
    }
    let path = folder.join("tree.obj");
    std::fs::write(&path, text).unwrap();
    path
}

/// Bakes and gives the report's line about branches in the plan.
fn bake(input: &Path, out: &Path, more: &[&str]) -> (Run, Value) {
    let report = out.with_extension("report.json");
    let done = run(FOLIAR, &[&["bake", text(input), "-o", text(out), "--report", text(&report)], more].concat());
    let report: Value = serde_json::from_slice(&std::fs::read(&report).unwrap()).unwrap();
    let plan = report["assets"][0]["plan"].as_array().or(report["plan"].as_array()).cloned().unwrap_or_default();
    let step = plan.into_iter().find(|row| row["baker"] == "branches").unwrap_or_default();
    (done, step)
}

fn record(file: &Path, room: &str) -> Value {
    let records = open_glb(file).0["extensions"][names::EXTENSION]["records"].as_array().cloned().unwrap_or_default();
    records.into_iter().find(|record| record["room"] == room).unwrap_or_default()
}

#[test]
fn branches_are_written_kept_and_taken_out_again() {
    let here = folder();
    let tree = tree(here.path(), "clean");
    let (out, base, plain) = (output("branches.glb"), output("branches-base.glb"), output("branches-plain.glb"));
    let (done, step) = bake(&tree, &out, &["--only", "branches"]);
    done.expect(0, &[]);
    assert_eq!(step["from"], "found");
    let summary = verify_file(&out).unwrap();
    assert_eq!(summary.rooms, ["structure", "branches"]);
    let own = record(&out, "branches");
    for name in ["BRANCH_ID", "_BRANCH_ARC", "foliarBranch/parent", "foliarBranchAxis/offset", "foliarLeaf/branchArc"] {
        assert!(own["writes"].as_array().unwrap().contains(&json!(name)), "{name} in {own}");
    }
    assert_eq!(own["resolved"], json!({"method": "robust", "continuation": "merge"}));
    // Nobody asks for them: nothing is found.
    let (done, step) = bake(&tree, &plain, &["--only", "density"]);
    done.expect(0, &[]);
    assert_eq!(step, Value::Null);
    assert_eq!(verify_file(&plain).unwrap().rooms, ["structure", "density"]);
    // What they were put onto comes back.
    let imported = output("branches-imported.glb");
    run(IMPORT, &[text(&tree), "-o", text(&imported)]).expect(0, &[]);
    for (master, base) in [(&out, &base), (&imported, &plain)] {
        run(FOLIAR, &["strip", text(master), "-o", text(base)]).expect(0, &[]);
    }
    assert!(std::fs::read(&base).unwrap() == std::fs::read(&plain).unwrap(), "the base as it was");
}

#[test]
fn a_master_keeps_its_branches_until_parameters_or_base_change() {
    let here = folder();
    // Its rings are told apart by the OBJ's own indices alone.
    let tree = tree(here.path(), "coincident-rings");
    let (out, other) = (output("branches-kept.glb"), output("branches-kept-other.glb"));
    bake(&tree, &out, &["--only", "branches"]).0.expect(0, &[]);
    let before = std::fs::read(&out).unwrap();
    let again = run(FOLIAR, &["rebake", text(&out)]).expect(0, &[]);
    assert!(again.stdout.contains("unchanged") && std::fs::read(&out).unwrap() == before, "{again:?}");
    let (done, step) = bake(&out, &other, &["--only", "branches"]);
    done.expect(0, &[]);
    assert_eq!(step["from"], "file");
    assert!(std::fs::read(&other).unwrap() == before);
    let (done, step) = bake(&out, &other, &["--only", "branches", "--set", "branches.continuation=split"]);
    done.expect(0, &[]);
    assert_eq!(step["from"], "found");
    assert_eq!(record(&other, "branches")["given"], json!({"continuation": "split"}));
    // One vertex elsewhere: what was found before belongs to another base.
    let (json, mut binary) = open_glb(&out);
    let view = json["accessors"]
        [json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().unwrap() as usize]["bufferView"]
        .as_u64()
        .unwrap() as usize;
    let at = json["bufferViews"][view]["byteOffset"].as_u64().unwrap_or(0) as usize;
    let moved = f32::from_le_bytes(binary[at..at + 4].try_into().unwrap()) + 1e-3;
    binary[at..at + 4].copy_from_slice(&moved.to_le_bytes());
    let changed = here.path().join("changed.glb");
    std::fs::write(&changed, glb(&json, &binary)).unwrap();
    let (done, step) = bake(&changed, &other, &["--only", "branches"]);
    done.expect(0, &[]);
    assert_eq!(step["from"], "found");
    let (done, step) = bake(&changed, &other, &["--only", "density"]);
    done.expect(0, &["STALE", "branches"]);
    assert_eq!(step, Value::Null);
    assert_eq!(verify_file(&other).unwrap().rooms, ["structure", "density"]);
}

#[test]
fn layers_of_branches_and_density_come_together_in_any_order() {
    let here = folder();
    let tree = tree(here.path(), "palm");
    let (at_once, one, two) = (output("branches-at-once.glb"), output("branches-one.glb"), output("branches-two.glb"));
    bake(&tree, &at_once, &["--only", "density", "--only", "branches"]).0.expect(0, &[]);
    run_in(here.path(), IMPORT, &["tree.obj", "-o", "plant.glb"]).expect(0, &[]);
    for room in ["density", "branches"] {
        let file = format!("{room}.layer");
        run_in(here.path(), FOLIAR, &["bake", "tree.obj", "--only", room, "-o", &file]).expect(0, &[]);
    }
    for (order, out) in [(["density.layer", "branches.layer"], &one), (["branches.layer", "density.layer"], &two)] {
        run_in(here.path(), FOLIAR, &["assemble", "plant.glb", order[0], order[1], "-o", text(out)]).expect(0, &[]);
        assert!(std::fs::read(out).unwrap() == std::fs::read(&at_once).unwrap(), "{order:?}");
    }
    // What was baked from branches is nothing without them.
    let (file, twigs) = (here.path().join("density.layer"), here.path().join("twigs.layer"));
    let mut layer = foliar_carrier::layer_from_bytes(&std::fs::read(&file).unwrap(), "density.layer").unwrap();
    layer.record.reads.insert(names::ROOM_BRANCHES.into(), "hash".into());
    std::fs::write(&twigs, foliar_carrier::layer_to_bytes(&layer).unwrap()).unwrap();
    let assemble = ["assemble", "plant.glb", "twigs.layer", "-o", "twigs.glb"];
    run_in(here.path(), FOLIAR, &assemble).expect(3, &["density", "--only branches"]);
    let assemble = ["assemble", "plant.glb", "twigs.layer", "branches.layer", "-o", "twigs.glb"];
    run_in(here.path(), FOLIAR, &assemble).expect(3, &["density", "branches hash"]);
}

#[test]
fn the_report_names_every_branch_and_the_terminal_the_doubtful_ones() {
    let here = folder();
    let (tree, out) = (tree(here.path(), "islands"), output("branches-islands.glb"));
    let (done, _) = bake(&tree, &out, &["--only", "branches"]);
    done.expect(0, &["BRANCH-ISLAND", "5 of", "\"trunk\""]);
    let told = |file: &Path| -> Value {
        let report = std::fs::read(file.with_extension("report.json")).unwrap();
        let report: Value = serde_json::from_slice(&report).unwrap();
        if report["branches"].is_null() { report["assets"][0]["branches"].clone() } else { report["branches"].clone() }
    };
    let first = told(&out);
    assert_eq!(first["islands"].as_array().unwrap().len(), 5);
    assert_eq!(first["branches"].as_array().unwrap().len(), first["count"].as_u64().unwrap() as usize);
    assert!(first["metrics"]["roughness"]["p99"].as_f64().unwrap() < 0.3);
    // A master says the same of the branches that it holds.
    let again = output("branches-islands-again.glb");
    let (done, _) = bake(&out, &again, &["--only", "branches"]);
    done.expect(0, &["BRANCH-ISLAND"]);
    let mut second = told(&again);
    assert_eq!(second["from"], "file");
    second["from"] = "found".into();
    assert_eq!(first, second);
}

#[test]
fn branches_are_taken_from_the_cache() {
    let here = folder();
    tree(here.path(), "clean");
    let from = || {
        let arguments =
            ["bake", "tree.obj", "--only", "branches", "--cache", "cache", "-o", "out.glb", "--report", "r.json"];
        run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
        let report: Value = serde_json::from_slice(&std::fs::read(here.path().join("r.json")).unwrap()).unwrap();
        let plan = report["assets"][0]["plan"].as_array().or(report["plan"].as_array()).cloned().unwrap();
        let bytes = std::fs::read(here.path().join("out.glb")).unwrap();
        (plan[0]["from"].as_str().unwrap().to_owned(), bytes)
    };
    let (first, second) = (from(), from());
    assert_eq!((first.0.as_str(), second.0.as_str()), ("found", "cache"));
    assert!(first.1 == second.1);
}
