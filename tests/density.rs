//! `foliar-density`: one room, onto a plant or alone.

use crate::common::{DENSITY, FOLIAR, IMPORT, folder, open_glb, output, run, text, tree};

#[test]
fn parameters_are_direct_flags() {
    let (here, out) = (folder(), output("density-flags.glb"));
    run(DENSITY, &[text(&tree(here.path(), 40)), "-o", text(&out), "--radius-m", "0.3"]).expect(0, &[]);
    let (json, _) = open_glb(&out);
    assert_eq!(json["extensions"]["FOLIAR_foliage"]["records"][1]["given"], serde_json::json!({"radius_m": 0.3}));
    run(DENSITY, &["a.obj", "-o", "a.glb", "--radius-m", "-1"])
        .expect(2, &["--radius-m: density.radius_m = -1: must be above 0"]);
}

#[test]
fn a_layer_alone_joins_its_plant() {
    let here = folder();
    let (plant, whole, joined) =
        (output("density-plant.glb"), output("density-whole.glb"), output("density-joined.glb"));
    run(IMPORT, &[text(&tree(here.path(), 40)), "-o", text(&plant)]).expect(0, &[]);
    let layer = here.path().join("density.layer");
    run(DENSITY, &[text(&plant), "-o", text(&layer)]).expect(0, &[]);
    run(DENSITY, &[text(&plant), "-o", text(&whole)]).expect(0, &[]);
    run(FOLIAR, &["assemble", text(&plant), text(&layer), "-o", text(&joined)]).expect(0, &[]);
    assert!(
        std::fs::read(&whole).unwrap() == std::fs::read(&joined).unwrap(),
        "{} and {}",
        whole.display(),
        joined.display()
    );
}

#[test]
fn help_holds_meaning_unit_and_range() {
    let help = run(DENSITY, &["--help"]).expect(0, &[]).stdout;
    for fragment in ["--radius-m", "meters", "above 0", "Luft07", "default 3"] {
        assert!(help.contains(fragment), "no {fragment:?} in {help}");
    }
}
