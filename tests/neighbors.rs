//! Plants around the one that is baked: what is read, recorded, found again, refused.

use crate::common::{DENSITY, FOLIAR, folder, open_glb, output, run, run_in, text, tree};
use serde_json::Value;
use std::path::Path;

/// The record of density in a GLB.
fn record(file: &Path) -> Value {
    let (json, _) = open_glb(file);
    let records = json["extensions"]["FOLIAR_foliage"]["records"].as_array().unwrap().clone();
    records.into_iter().find(|record| record["room"] == "density").unwrap()
}

#[test]
fn a_neighbor_is_read_recorded_by_name_and_found_again() {
    let here = folder();
    let woods = here.path().join("woods");
    std::fs::create_dir(&woods).unwrap();
    tree(here.path(), 60);
    std::fs::rename(tree(&woods, 200), woods.join("large.obj")).unwrap();
    let baked = output("neighbors.glb");
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "alone.glb"]).expect(0, &[]);
    let place = ["--neighbor", "woods/large.obj@1,0,0.5,90,2"];
    let arguments = [&["bake", "tree.obj", "-o", text(&baked), "--depfile", "rule.d"], &place[..]].concat();
    run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
    let record = self::record(&baked);
    assert_eq!(record["given"]["neighbor"], serde_json::json!(["large.obj@1,0,0.5,90,2"]), "no folder");
    assert_eq!(record["resolved"]["neighbor"], record["given"]["neighbor"]);
    assert!(record["reads"]["neighbor/large.obj"].is_string(), "{record:#}");
    assert!(!record.to_string().contains("woods"), "a record holds no paths");
    assert_ne!(record["reads"], self::record(&here.path().join("alone.glb"))["reads"]);
    assert!(std::fs::read_to_string(here.path().join("rule.d")).unwrap().contains("woods/large.obj"));

    // By its name, beside the file or in a searched folder; what is not there is said with what helps.
    let copy = here.path().join("copy.glb");
    std::fs::copy(&baked, &copy).unwrap();
    run_in(here.path(), FOLIAR, &["rebake", "copy.glb"])
        .expect(3, &["neighbor ./large.obj (record in copy.glb) is not there", "--search"]);
    run_in(here.path(), FOLIAR, &["rebake", "copy.glb", "--search", "woods"]).expect(0, &[]);
    let arrays = |file: &Path| std::fs::read(file).unwrap();
    assert_eq!(self::record(&copy)["reads"], record["reads"]);
    assert!(arrays(&copy).len() >= arrays(&baked).len());
    // Another tree under the same name is found, and said.
    std::fs::write(woods.join("large.obj"), crate::common::tree_text(100)).unwrap();
    run_in(here.path(), FOLIAR, &["rebake", "copy.glb", "--search", "woods"])
        .expect(0, &["STALE", "neighbor large.obj is not the one"]);
    // None at all: the record's list is given up.
    run_in(here.path(), FOLIAR, &["rebake", "copy.glb", "--set", "density.neighbor=[]"]).expect(0, &[]);
    assert_eq!(self::record(&copy)["resolved"]["neighbor"], serde_json::json!([]));
}

#[test]
fn flag_configuration_and_layer_agree() {
    let here = folder();
    tree(here.path(), 60);
    std::fs::create_dir(here.path().join("woods")).unwrap();
    std::fs::rename(tree(&here.path().join("woods"), 100), here.path().join("woods/large.obj")).unwrap();
    run_in(here.path(), DENSITY, &["tree.obj", "-o", "flag.layer", "--neighbor", "woods/large.obj@1,0,0"])
        .expect(0, &[]);
    std::fs::write(here.path().join("foliar.toml"), "[density]\nneighbor = ['woods/large.obj@1,0,0']\n").unwrap();
    run_in(here.path(), DENSITY, &["tree.obj", "-o", "file.layer"]).expect(0, &[]);
    let bytes = |name: &str| std::fs::read(here.path().join(name)).unwrap();
    assert_eq!(bytes("flag.layer"), bytes("file.layer"));
    // The same neighbor as a master: of it too base and structure count, never its layers.
    run_in(here.path(), FOLIAR, &["bake", "woods/large.obj", "-o", "large.glb", "--no-config"]).expect(0, &[]);
    let glb = ["tree.obj", "-o", "glb.glb", "--no-config", "--neighbor", "large.glb@1,0,0"];
    run_in(here.path(), DENSITY, &glb).expect(0, &[]);
    run_in(here.path(), DENSITY, &["tree.obj", "-o", "obj.glb"]).expect(0, &[]);
    let hash =
        |name: &str, neighbor: &str| record(&here.path().join(name))["reads"][format!("neighbor/{neighbor}")].clone();
    assert_eq!(hash("glb.glb", "large.glb"), hash("obj.glb", "large.obj"));
}

#[test]
fn a_cached_layer_knows_its_neighbors() {
    let here = folder();
    tree(here.path(), 60);
    std::fs::rename(tree(here.path(), 200), here.path().join("large.obj")).unwrap();
    tree(here.path(), 60);
    let bake = |output: &str, place: &str| {
        let arguments = ["tree.obj", "-o", output, "--cache", "kept", "--neighbor", place];
        run_in(here.path(), DENSITY, &arguments).expect(0, &[]);
        std::fs::read(here.path().join(output)).unwrap()
    };
    let first = bake("a.layer", "large.obj@1,0,0");
    assert_eq!(bake("b.layer", "large.obj@1,0,0"), first);
    assert_ne!(bake("c.layer", "large.obj@1,0,0.25"), first);
    std::fs::write(here.path().join("large.obj"), crate::common::tree_text(150)).unwrap();
    assert_ne!(bake("d.layer", "large.obj@1,0,0"), first, "the key holds what the neighbor is");
}

#[test]
fn the_plant_itself_may_stand_elsewhere_and_is_a_finding_at_its_own_place() {
    let here = folder();
    tree(here.path(), 60);
    let bake = |place: &str| run_in(here.path(), DENSITY, &["tree.obj", "-o", "a.glb", "--neighbor", place]);
    assert!(!bake("tree.obj@1,0,0").expect(0, &[]).stderr.contains("NEIGHBOR"));
    bake("tree.obj@0,0,0").expect(0, &["NEIGHBOR-COINCIDES", "counts twice"]);
    let twice = ["tree.obj", "-o", "b.glb", "--neighbor", "tree.obj@1,0,0", "--neighbor", "tree.obj@1,0,0"];
    run_in(here.path(), DENSITY, &twice).expect(0, &["NEIGHBOR-COINCIDES"]);
}

#[test]
fn what_is_no_neighbor_is_refused_with_file_place_and_remedy() {
    let here = folder();
    tree(here.path(), 60);
    std::fs::create_dir(here.path().join("woods")).unwrap();
    tree(&here.path().join("woods"), 60);
    std::fs::write(here.path().join("broken.glb"), b"glTF").unwrap();
    let refused = |place: &str, status, said: &[&str]| {
        run_in(here.path(), DENSITY, &["tree.obj", "-o", "a.glb", "--neighbor", place]).expect(status, said);
        assert!(!here.path().join("a.glb").exists());
    };
    refused("oak.glb@1,0,0", 3, &["oak.glb", "cannot be read"]);
    refused("broken.glb@1,0,0", 3, &["broken.glb"]);
    refused("tree.obj@1,0", 2, &["flag --neighbor: density.neighbor", "has 2 numbers", "must be FILE@x,y,z"]);
    refused("tree.obj", 2, &["has no @"]);
    refused("tree.obj@1,0,nan", 2, &["finite numbers"]);
    refused("tree.obj@1,0,0,0,-1", 2, &["the scale -1"]);
    refused("..@1,0,0", 2, &["names no file"]);
    let both = ["tree.obj", "-o", "a.glb", "--neighbor", "tree.obj@1,0,0", "--neighbor", "woods/tree.obj@2,0,0"];
    run_in(here.path(), DENSITY, &both).expect(2, &["have one name", "rename one"]);
    let line = "[density]\nquality = 1\nneighbor = ['tree.obj@1']\n";
    std::fs::write(here.path().join("foliar.toml"), line).unwrap();
    run(DENSITY, &[text(&here.path().join("tree.obj")), "-o", text(&here.path().join("a.glb"))])
        .expect(2, &["foliar.toml:3", "has 1 numbers"]);
}
