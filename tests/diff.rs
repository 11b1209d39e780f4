//! `foliar diff`: how two bakes differ, and the status that says so.

use crate::common::{CHECK, FOLIAR, TRANSLUCENCY, folder, output, run, text, tree};

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
    run(FOLIAR, &["diff", text(&obj), text(&obj)]).expect(3, &["hold no layer", "bake them first"]);
    // The same parameters on another base.
    let moved = here.path().join("moved.obj");
    let whole = std::fs::read_to_string(&obj).unwrap();
    let first = whole.lines().find(|line| line.starts_with("v ")).unwrap();
    std::fs::write(&moved, whole.replacen(first, first.replacen("v ", "v 1e-3 ", 1).rsplit_once(' ').unwrap().0, 1))
        .unwrap();
    let third = here.path().join("third.glb");
    run(FOLIAR, &["bake", text(&moved), "-o", text(&third)]).expect(0, &[]);
    let said = run(FOLIAR, &["diff", text(&one), text(&third), "--tolerance", "1e9"]).expect(1, &["base"]).stdout;
    assert!(said.contains("another base"), "{said}");
}

/// Maps of leaves, in figures and beside each other.
#[test]
fn maps_are_told_and_compared() {
    let here = folder();
    let map = crate::translucency::thickness(here.path(), "t.png", 24, 0.1);
    let (one, other) = (here.path().join("one.glb"), here.path().join("other.glb"));
    for (out, nm) in [(&one, "510"), (&other, "550")] {
        let flags = [text(&tree(here.path(), 20)), "--thickness", text(&map), "--wavelength-nm", nm, "-o", text(out)]
            .map(String::from);
        let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
        run(TRANSLUCENCY, &crate::translucency::with_flags(&flags)).expect(0, &[]);
    }
    let said = run(FOLIAR, &["diff", text(&one), text(&other)]).expect(1, &["map leaves/translucencyFront"]).stdout;
    assert!(said.contains("24 x 24 texel"), "{said}");
    run(FOLIAR, &["diff", text(&one), text(&one), "--tolerance", "0"]).expect(0, &[]);
    let told = run(FOLIAR, &["inspect", text(&one)]).expect(0, &[]).stdout;
    assert!(told.contains("leaves/translucencyFront") && told.contains("map of 24 x 24 texels"), "{told}");
    // A map that is not beside its file any more, or is none.
    let side = std::fs::read_dir(one.with_extension("foliar")).unwrap().next().unwrap().unwrap().path();
    std::fs::write(&side, "no EXR at all").unwrap();
    let found = run(CHECK, &[text(&one)]);
    assert!(found.stdout.contains("TEXTURE-BROKEN") && found.stdout.contains("is no EXR"), "{found:?}");
    std::fs::remove_file(&side).unwrap();
    let found = run(CHECK, &[text(&one)]);
    assert!(found.stdout.contains("TEXTURE-MISSING") && found.stdout.contains("is not there"), "{found:?}");
}
