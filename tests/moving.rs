//! Files that lie elsewhere: pictures that a moved glTF takes along, and pictures that a person names.

use crate::common::{FOLIAR, folder, output, run, run_in, text, tree};
use serde_json::{Value, json};
use std::path::Path;

/// Writes a picture of one color.
fn picture(path: &Path) {
    image::RgbaImage::from_pixel(4, 4, image::Rgba([40, 120, 30, 255])).save(path).unwrap();
}

/// A tree as `a/tree.gltf`, its buffer and the picture of its leaves in files beside it.
fn scattered(here: &Path) {
    let folder = here.join("a");
    std::fs::create_dir(&folder).unwrap();
    tree(&folder, 40);
    picture(&folder.join("leaf.png"));
    std::fs::write(folder.join("tree.mtl"), "newmtl bark\nnewmtl leaves\nmap_Kd leaf.png\n").unwrap();
    run_in(&folder, FOLIAR, &["strip", "tree.obj", "-o", "tree.gltf"]).expect(0, &[]);
    let mut json: Value = serde_json::from_slice(&std::fs::read(folder.join("tree.gltf")).unwrap()).unwrap();
    assert!(json["images"][0]["bufferView"].is_u64(), "an OBJ's picture lies in the buffer: {}", json["images"]);
    json["images"][0] = json!({"uri": "leaf.png"});
    std::fs::write(folder.join("tree.gltf"), json.to_string()).unwrap();
}

#[test]
fn a_gltf_in_another_folder_can_be_read_where_it_lies() {
    let here = folder();
    let here = here.path();
    scattered(here);
    std::fs::create_dir(here.join("b")).unwrap();
    run_in(here, FOLIAR, &["bake", "a/tree.gltf", "-o", "b/tree.gltf", "--depfile", "t.d"]).expect(0, &[]);
    let rule = std::fs::read_to_string(here.join("t.d")).unwrap();
    assert!(rule.contains("a/leaf.png") && rule.contains("a/tree.bin"), "{rule}");
    let held = |path: &str| {
        let run = run_in(here, FOLIAR, &["inspect", path, "--format", "json"]).expect(0, &[]);
        run.json_lines().remove(0)
    };
    let moved = held("b/tree.gltf");
    assert_eq!((&moved["leaves"], &moved["base"]), (&json!(40), &held("a/tree.gltf")["base"]));
    // Without the folder that it came from: nothing is missing.
    std::fs::remove_dir_all(here.join("a")).unwrap();
    assert_eq!(held("b/tree.gltf"), moved);
    let again = run_in(here, FOLIAR, &["rebake", "b/tree.gltf"]).expect(0, &[]);
    assert!(again.stdout.contains("unchanged"), "{again:?}");
}

#[test]
fn a_gltf_that_stays_in_its_folder_keeps_its_uris() {
    let here = folder();
    scattered(here.path());
    run_in(here.path(), FOLIAR, &["bake", "a/tree.gltf", "-o", "a/baked.gltf"]).expect(0, &[]);
    let json: Value = serde_json::from_slice(&std::fs::read(here.path().join("a/baked.gltf")).unwrap()).unwrap();
    assert_eq!(json["images"], json!([{"uri": "leaf.png"}]));
}

#[test]
fn a_picture_that_a_person_names_may_lie_anywhere() {
    let (here, elsewhere, out) = (folder(), folder(), output("moving-texture.glb"));
    let input = tree(here.path(), 40);
    let leaf = elsewhere.path().join("leaf.png");
    picture(&leaf);
    let given = format!("leaves={}", text(&leaf));
    let rule = here.path().join("t.d");
    let bake = ["bake", text(&input), "-o", text(&out), "--texture", &given, "--depfile", text(&rule)];
    run(FOLIAR, &bake).expect(0, &[]);
    let listed = std::fs::read_to_string(&rule).unwrap();
    assert!(listed.contains(text(&leaf)), "{listed}");
    let (json, _) = crate::common::open_glb(&out);
    assert_eq!(json["images"].as_array().map(Vec::len), Some(1));
    // One that is not there is no texture to go without: somebody asked for it.
    std::fs::remove_file(&leaf).unwrap();
    run(FOLIAR, &bake).expect(3, &["--texture", text(&leaf)]);
}
