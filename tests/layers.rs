//! `foliar assemble`, `strip` and `rebake`: what is put in can be taken out and baked again.

use crate::common::{DENSITY, FOLIAR, IMPORT, folder, glb, open_glb, output, run, run_in, text, tree};
use serde_json::json;

#[test]
fn stripping_gives_the_imported_base_back() {
    let (here, baked) = (folder(), output("strip-baked.glb"));
    let (base, again) = (output("strip-base.glb"), output("strip-again.glb"));
    run(FOLIAR, &["bake", text(&tree(here.path(), 40)), "-o", text(&baked)]).expect(0, &[]);
    run(FOLIAR, &["strip", text(&baked), "-o", text(&base)]).expect(0, &[]);
    let (json, _) = open_glb(&base);
    assert!(!json.to_string().contains("FOLIAR") && !json.to_string().contains("_AMBIENT"), "{json}");
    run(FOLIAR, &["strip", text(&base), "-o", text(&again)]).expect(0, &[]);
    assert!(std::fs::read(&base).unwrap() == std::fs::read(&again).unwrap(), "nothing left to take out");
    // And the base bakes to the very same file, since structure is found again on it.
    run(FOLIAR, &["bake", text(&base), "-o", text(&again)]).expect(0, &[]);
    let (a, b) = (open_glb(&baked).0, open_glb(&again).0);
    assert_eq!(a["extensions"]["FOLIAR_foliage"]["base"], b["extensions"]["FOLIAR_foliage"]["base"]);
}

#[test]
fn a_layer_of_another_base_is_refused() {
    let here = folder();
    let (plant, other) = (output("layers-plant.glb"), output("layers-other.glb"));
    run(IMPORT, &[text(&tree(here.path(), 40)), "-o", text(&plant)]).expect(0, &[]);
    run(IMPORT, &[text(&tree(here.path(), 41)), "-o", text(&other)]).expect(0, &[]);
    let layer = here.path().join("density.layer");
    run(DENSITY, &[text(&other), "-o", text(&layer)]).expect(0, &[]);
    let before = std::fs::read(&plant).unwrap();
    run(FOLIAR, &["assemble", text(&plant), text(&layer), "-o", text(&plant)])
        .expect(3, &["density.layer", "density", "base"]);
    assert!(std::fs::read(&plant).unwrap() == before, "the old output is intact");
    std::fs::write(&layer, b"no layer at all").unwrap();
    run(FOLIAR, &["assemble", text(&plant), text(&layer), "-o", text(&plant)]).expect(3, &["density.layer"]);
}

#[test]
fn rebaking_starts_from_what_was_given() {
    let (here, out) = (folder(), output("rebake.glb"));
    tree(here.path(), 40);
    std::fs::write(here.path().join("foliar.toml"), "[scene.light]\nsoft_normals = false\n").unwrap();
    let given = ["bake", "tree.obj", "-o", text(&out), "--set", "density.exponent=2", "--leaf", "leaves"];
    run_in(here.path(), FOLIAR, &given).expect(0, &[]);
    let baked = std::fs::read(&out).unwrap();
    // No OBJ, no project file: the records inside are enough.
    let again = run(FOLIAR, &["rebake", text(&out)]).expect(0, &[]);
    assert!(again.stdout.contains("unchanged"), "{again:?}");
    assert!(std::fs::read(&out).unwrap() == baked);
    run(FOLIAR, &["rebake", text(&out), "--set", "density.darkest_ambient=0.3"]).expect(0, &[]);
    let (json, _) = open_glb(&out);
    let records = json["extensions"]["FOLIAR_foliage"]["records"].as_array().unwrap();
    let record = records.iter().find(|record| record["room"] == "density").unwrap();
    let expected = json!({"darkest_ambient": 0.3, "exponent": 2.0, "scene": {"light": {"soft_normals": false}}});
    assert_eq!(record["given"], expected);
    assert_eq!(record["resolved"]["channels"], "ambient", "what the scene implied");
    let back = run(FOLIAR, &["rebake", text(&out), "--set", "density.darkest_ambient=0.1"]).expect(0, &[]);
    assert!(back.stdout.contains("written"), "{back:?}");
}

#[test]
fn a_file_without_records_has_nothing_to_repeat() {
    let here = folder();
    let out = output("rebake-nothing.glb");
    std::fs::write(&out, glb(&json!({"asset": {"version": "2.0"}}), &[])).unwrap();
    run(FOLIAR, &["rebake", text(&out)]).expect(3, &["rebake-nothing.glb"]);
    run(FOLIAR, &["rebake", text(&tree(here.path(), 4))]).expect(2, &["must end in .glb"]);
}

#[test]
fn rebaking_a_library_answers_line_by_line() {
    let here = folder();
    let (one, two) = (output("library-one.glb"), output("library-two.glb"));
    for (leaves, out) in [(20, &one), (30, &two)] {
        run(FOLIAR, &["bake", text(&tree(here.path(), leaves)), "-o", text(out)]).expect(0, &[]);
    }
    let run = run(FOLIAR, &["rebake", text(&one), text(&two), "--set", "density.exponent=2"]).expect(0, &[]);
    let lines = run.json_lines();
    assert_eq!(lines.len(), 2);
    assert!(lines.iter().all(|line| line["status"] == "written"), "{lines:?}");
}
