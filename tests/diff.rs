//! `foliar diff`: how two bakes differ, and the status that says so.

use crate::common::{FOLIAR, folder, output, run, text, tree};

#[test]
fn a_bake_is_itself_and_another_radius_is_another_bake() {
    let here = folder();
    let obj = tree(here.path(), 40);
    let (one, other) = (output("diff-one.glb"), output("diff-other.glb"));
    run(FOLIAR, &["bake", text(&obj), "-o", text(&one)]).expect(0, &[]);
    run(FOLIAR, &["bake", text(&obj), "-o", text(&other), "--set", "density.radius_m=0.2"]).expect(0, &[]);
    run(FOLIAR, &["diff", text(&one), text(&one), "--tolerance", "0"]).expect(0, &[]);
    let said = run(FOLIAR, &["diff", text(&one), text(&other)]).expect(1, &["visible steps", "_AMBIENT"]).stdout;
    assert!(said.contains("density.radius_m") && said.contains("differs at mesh"), "{said}");
    let json = run(FOLIAR, &["diff", text(&one), text(&other), "--format", "json"]).expect(1, &[]).json_lines();
    let channels = json[0]["channels"].as_array().unwrap();
    let ambient = channels.iter().find(|c| c["name"] == "_AMBIENT").unwrap();
    assert!(ambient["max_steps"].as_f64() > Some(1.0) && ambient["worst"][0]["place"].is_string(), "{ambient}");
    let leaves = channels.iter().find(|c| c["name"] == "foliarLeaf/area").unwrap();
    assert_eq!(leaves["max_steps"], 0.0, "structure knows no radius");
    run(FOLIAR, &["diff", text(&one), text(&other), "--tolerance", "1e9"]).expect(0, &[]);
    run(FOLIAR, &["diff", text(&one), text(&other), "--tolerance=-1"]).expect(2, &["at least 0"]);
}
