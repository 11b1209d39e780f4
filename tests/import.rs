//! `foliar-import`: structure and nothing else.

use crate::common::{IMPORT, folder, open_glb, output, run, shared, text, tree};

#[test]
fn an_imported_plant_has_structure_only() {
    let (here, out) = (folder(), output("import.glb"));
    run(IMPORT, &[text(&tree(here.path(), 40)), "-o", text(&out)]).expect(0, &[]);
    let (json, _) = open_glb(&out);
    let records = json["extensions"]["FOLIAR_foliage"]["records"].as_array().unwrap();
    assert_eq!(records.len(), 1);
    assert_eq!(records[0]["room"], "structure");
    assert_eq!(json["asset"]["extras"]["FOLIAR_foliage"], json["extensions"]["FOLIAR_foliage"], "the mirror");
}

#[test]
fn patterns_decide_roles_and_stand_in_the_record() {
    let (here, out) = (folder(), output("import-roles.glb"));
    let input = tree(here.path(), 40);
    run(IMPORT, &[text(&input), "-o", text(&out), "--leaf", "bark", "--leaf", "leaves"]).expect(0, &[]);
    let (json, _) = open_glb(&out);
    let record = &json["extensions"]["FOLIAR_foliage"]["records"][0];
    assert_eq!(record["given"]["roles"]["leaf"], serde_json::json!(["bark", "leaves"]));
    for mesh in json["meshes"].as_array().unwrap() {
        assert_eq!(mesh["primitives"][0]["extensions"]["FOLIAR_foliage"]["role"], "leaf");
    }
}

#[test]
fn units_and_axes_are_turned_at_import() {
    let (here, out) = (folder(), output("import-height.glb"));
    let run =
        run(IMPORT, &[text(&tree(here.path(), 40)), "-o", text(&out), "--up", "y", "--height-m", "12"]).expect(0, &[]);
    assert!(!run.stderr.contains("IMPORT-U"), "nothing to guess: {}", run.stderr);
    let (json, _) = open_glb(&out);
    let tops = json["accessors"].as_array().unwrap().iter().filter_map(|accessor| accessor["max"][1].as_f64());
    let top = tops.fold(0.0, f64::max);
    assert!((top - 12.0).abs() < 1e-3, "12 m tall, not {top} (f32 coordinates)");
}

#[test]
fn a_lying_trunk_is_told_what_helps_this_kind_of_file() {
    let here = folder();
    let out = here.path().join("out.glb");
    let said = |name: &str, flags: &[&str]| {
        let input = shared(&format!("trees/{name}"))?;
        Some(run(IMPORT, &[&[text(&input), "-o", text(&out)], flags].concat()).expect(0, &["IMPORT-LYING"]).stderr)
    };
    let Some(obj) = said("mtree_fused_small/tree.obj", &[]) else { return };
    assert!(obj.contains("if Z is up in this file, say --up z"), "{obj}");
    // What an OBJ became is a glTF: the flag does nothing any more.
    let again = run(IMPORT, &[text(&out), "-o", text(&out), "--min-confidence", "0.4"]).expect(0, &["IMPORT-LYING"]);
    assert!(again.stderr.contains("turn it in the modeller") && !again.stderr.contains("--up"), "{}", again.stderr);
}

#[test]
fn the_sections_own_parameters_are_direct_flags() {
    run(IMPORT, &["a.obj", "-o", "a.glb", "--min-confidence", "2"])
        .expect(2, &["--min-confidence: structure.min_confidence = 2: must be at most 1"]);
}
