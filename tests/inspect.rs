//! `foliar inspect`: what a file holds.

use crate::common::{FOLIAR, folder, output, run, text, tree};

#[test]
fn parts_roles_leaves_channels_and_records_are_told() {
    let (here, out) = (folder(), output("inspect.glb"));
    run(FOLIAR, &["bake", text(&tree(here.path(), 40)), "-o", text(&out)]).expect(0, &[]);
    let human = run(FOLIAR, &["inspect", text(&out)]).expect(0, &[]).stdout;
    for fragment in [
        "40 leaves",
        "bark",
        "wood",
        "_AMBIENT",
        "structure version",
        "density version",
        "error of _AMBIENT",
        "m, rest frame",
    ] {
        assert!(human.contains(fragment), "no {fragment:?} in {human}");
    }
    let json = run(FOLIAR, &["inspect", text(&out), "--format", "json"]).expect(0, &[]).json_lines().remove(0);
    assert_eq!(json["leaves"], 40);
    assert_eq!(json["parts"][0]["role"], "wood");
    let rooms = json["rooms"].as_array().unwrap();
    let channels = rooms.iter().flat_map(|room| room["channels"].as_array().into_iter().flatten());
    let channels: Vec<_> = channels.collect();
    let ambient = channels.iter().find(|channel| channel["name"] == "_AMBIENT").unwrap();
    let center = channels.iter().find(|channel| channel["name"] == "center").unwrap();
    let heights = &center["components"][1];
    assert!(
        heights["min"].as_f64() >= Some(1.5) && heights["max"].as_f64() <= Some(3.1),
        "crown of the tree: {center}"
    );
    assert!(ambient["min"].as_f64() >= Some(0.0) && ambient["max"].as_f64() <= Some(1.0), "{ambient}");
}

#[test]
fn a_file_without_layers_has_no_roles() {
    let here = folder();
    let json = run(FOLIAR, &["inspect", text(&tree(here.path(), 40)), "--format", "json"]).expect(0, &[]).json_lines();
    assert_eq!(json[0]["parts"][0]["role"], serde_json::Value::Null);
    assert_eq!(json[0]["rooms"], serde_json::json!([]));
}
