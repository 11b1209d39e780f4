//! `foliar-translucency`: maps alone, onto trees, into files and out of them again.

use crate::common::{
    CHECK, DENSITY, FOLIAR, TRANSLUCENCY, folder, glb, made_from, open_glb, output, run, run_in, text, tree, tree_text,
};
use foliar_carrier::second_reader::verify_file;
use image::{ImageBuffer, Luma, Rgb};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A round leaf of .1 to .3 mm in a map of 16 bits whose white is .4 mm; other `bump`s are other leaves.
pub fn thickness(folder: &Path, name: &str, size: u32, bump: f64) -> PathBuf {
    let texel = |x: u32, y: u32| {
        let at = |v: u32| (f64::from(v) + 0.5) / f64::from(size) - 0.5;
        let (x, y) = (at(x), at(y));
        let rib = bump * (1.0 - (12.0 * y.abs()).min(1.0));
        let mm = 0.1 + 0.1 * (0.5 + x) + rib;
        Luma([if x * x + y * y < 0.2 { (mm / 0.4 * 65_535.0) as u16 } else { 0 }])
    };
    let path = folder.join(name);
    ImageBuffer::from_fn(size, size, texel).save(&path).unwrap();
    path
}

/// A normal map that leans by turns.
pub fn normals(folder: &Path, name: &str, size: u32) -> PathBuf {
    let path = folder.join(name);
    let texel = |x: u32, y: u32| Rgb([(96 + 8 * (x % 8)) as u8, (160 - 8 * (y % 8)) as u8, 235]);
    ImageBuffer::from_fn(size, size, texel).save(&path).unwrap();
    path
}

const FLAGS: [&str; 4] = ["--leaf-width-mm", "60", "--thickness-scale-mm", "0.4"];

pub fn with_flags<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [arguments, &FLAGS].concat()
}

/// The extension of a file.
fn foliage(path: &Path) -> Value {
    open_glb(path).0["extensions"]["FOLIAR_foliage"].clone()
}

/// Names of the files beside a file, sorted.
fn sides(path: &Path) -> Vec<String> {
    let files = std::fs::read_dir(path.with_extension("foliar")).into_iter().flatten();
    let mut names: Vec<String> = files.map(|file| file.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A file under test and its side files, fresh.
fn fresh(name: &str) -> PathBuf {
    let path = output(name);
    _ = std::fs::remove_dir_all(path.with_extension("foliar"));
    path
}

#[test]
fn maps_alone_become_exr_png_and_a_json_that_explains_them() {
    let here = folder();
    thickness(here.path(), "t.png", 48, 0.1);
    normals(here.path(), "nb.png", 48);
    let arguments = ["--thickness", "t.png", "--normal-back", "nb.png", "-o", "leaf.exr"];
    let said = run_in(here.path(), TRANSLUCENCY, &with_flags(&arguments))
        .expect(0, &["MAP-ROUNDED", "% of the brightest", "the EXR beside it loses nothing that shows"]);
    assert!(said.stdout.contains("leaf.exr"), "{said:?}");
    let names = ["leaf.exr", "leaf-back.exr", "leaf.png", "leaf.json"];
    assert!(names.iter().all(|name| here.path().join(name).is_file()));
    let about: Value = serde_json::from_slice(&std::fs::read(here.path().join("leaf.json")).unwrap()).unwrap();
    let map = &about["translucency"]["maps"]["translucencyFront"];
    assert_eq!((&map["exr"], &map["texture"]), (&json!("leaf.exr"), &json!("leaf.png")));
    assert!(map["rmsError"].as_f64().unwrap() < 1e-3, "{map}");
    assert_eq!(about["record"]["resolved"]["thickness_scale_mm"], 0.4);
    // The front is lit from the back, which has bumps; the back from a flat front.
    assert_ne!(map["scale"], about["translucency"]["maps"]["translucencyBack"]["scale"]);
    let again = run_in(here.path(), TRANSLUCENCY, &with_flags(&arguments)).expect(0, &[]);
    assert!(again.stdout.contains("unchanged"), "{again:?}");
}

#[test]
fn maps_alone_in_every_form() {
    let here = folder();
    thickness(here.path(), "t.png", 32, 0.1);
    let bake = |more: &[&str]| {
        run_in(here.path(), TRANSLUCENCY, &with_flags(&[&["--thickness", "t.png"], more].concat())).expect(0, &[])
    };
    bake(&["-o", "rgb.png", "--bands", "rgb"]);
    for name in ["rgb.png", "rgb-front-red.png", "rgb-front-blue.png", "rgb-back.png", "rgb-back-blue.png", "rgb.json"]
    {
        assert!(here.path().join(name).is_file(), "{name}");
    }
    bake(&["-o", "leaf.layer", "--sides", "front"]);
    let planned = bake(&["-o", "never.exr", "--dry-run"]);
    assert!(planned.stdout.contains("never.exr") && !here.path().join("never.exr").exists());
    bake(&["-o", "float.exr", "--sides", "back", "--exr", "float"]);
    let (half, float) = (std::fs::metadata(here.path().join("float.exr")).unwrap().len(), {
        bake(&["-o", "half.exr", "--sides", "back"]);
        std::fs::metadata(here.path().join("half.exr")).unwrap().len()
    });
    assert!(half > float, "{half} {float}");
}

/// All laws that need bytes, on a tree with maps.
#[test]
fn laws_1_3_and_9_hold_with_maps() {
    let here = folder();
    let base = here.path().join("base.glb");
    run(FOLIAR, &["bake", text(&tree(here.path(), 40)), "--only", "density", "-o", text(&base)]).expect(0, &[]);
    run(FOLIAR, &["strip", text(&base), "-o", text(&base)]).expect(0, &[]);
    let map = thickness(here.path(), "t.png", 40, 0.1);
    let (baked, stripped) = (fresh("lucy.glb"), output("lucy-stripped.glb"));
    made_from(&baked, &base);
    made_from(&stripped, &base);
    let arguments = ["bake", text(&base), "-o", text(&baked), "--set"];
    let set = format!("translucency.thickness=[\"{}\"]", text(&map));
    let more = ["--set", "translucency.leaf_width_mm=60", "--set", "translucency.thickness_scale_mm=0.4"];
    let bake = |word: &str| {
        let run = run(FOLIAR, &[&arguments[..], &[set.as_str()], &more].concat()).expect(0, &[]);
        assert!(run.stdout.contains(word), "{run:?}");
    };
    bake("written");
    let summary = verify_file(&baked).unwrap();
    assert!(summary.rooms.contains(&"translucency".to_owned()));
    assert_eq!(sides(&baked).len(), 2, "{:?}", sides(&baked));
    let ((old, old_bytes), (new, new_bytes)) = (open_glb(&base), open_glb(&baked));
    assert!(new_bytes.starts_with(&old_bytes));
    let material =
        |json: &Value| json["materials"].as_array().unwrap().iter().position(|m| m["name"] == "leaves").unwrap();
    let shows = &new["materials"][material(&new)]["extensions"]["KHR_materials_diffuse_transmission"];
    assert!(shows["diffuseTransmissionFactor"].as_f64().unwrap() > 0.0, "{shows}");
    // Again, and again for another room alone: the same file.
    bake("unchanged");
    let kept = run(DENSITY, &[text(&baked), "-o", text(&baked)]).expect(0, &[]);
    assert!(kept.stdout.contains("unchanged"), "{kept:?}");
    run(FOLIAR, &["strip", text(&baked), "-o", text(&stripped)]).expect(0, &[]);
    assert_eq!(open_glb(&stripped), (old, old_bytes));
    let checked = run(CHECK, &[text(&baked)]);
    assert!(!checked.stdout.contains("CONTRACT"), "{checked:?}");
}

/// A bake by a record alone; what only the old file named is gone afterwards.
#[test]
fn a_record_repeats_a_bake_and_old_side_files_go() {
    let here = folder();
    let source = tree(here.path(), 20);
    thickness(here.path(), "t.png", 24, 0.1);
    let baked = here.path().join("tree.glb");
    let arguments = with_flags(&[text(&source), "--thickness", "t.png", "-o", text(&baked)]);
    run_in(here.path(), TRANSLUCENCY, &arguments).expect(0, &[]);
    let (first, before) = (sides(&baked), std::fs::read(&baked).unwrap());
    let again = run(FOLIAR, &["rebake", text(&baked)]).expect(0, &[]);
    assert!(again.stdout.contains("unchanged"), "{again:?}");
    run(FOLIAR, &["rebake", text(&baked), "--set", "translucency.wavelength_nm=550"]).expect(0, &[]);
    let second = sides(&baked);
    assert!(second.len() == 2 && second.iter().all(|name| !first.contains(name)), "{first:?} {second:?}");
    assert_ne!(std::fs::read(&baked).unwrap(), before);
    verify_file(&baked).unwrap();
    // Without its maps a bake cannot be repeated, and nothing is changed.
    std::fs::rename(here.path().join("t.png"), here.path().join("elsewhere.png")).unwrap();
    run(FOLIAR, &["rebake", text(&baked)]).expect(3, &["t.png", "--search"]);
    // Another room can.
    run(DENSITY, &[text(&baked), "-o", text(&baked)]).expect(0, &[]);
    assert_eq!(sides(&baked), second);
    run(FOLIAR, &["strip", text(&baked), "-o", text(&baked)]).expect(0, &[]);
    assert!(!baked.with_extension("foliar").exists(), "nothing names them any more");
}

/// A tree of two leaf materials, each with its own map and width, by its own configuration file.
#[test]
fn each_leaf_material_has_its_own_maps() {
    let here = folder();
    let obj = tree_text(40).replacen("f 97/", "usemtl needles\nf 97/", 1);
    std::fs::write(here.path().join("two.obj"), obj).unwrap();
    let materials = "newmtl bark\nKd .4 .3 .2\nnewmtl leaves\nKd .2 .5 .2\nnewmtl needles\nKd .1 .4 .1\n";
    std::fs::write(here.path().join("tree.mtl"), materials).unwrap();
    std::fs::create_dir(here.path().join("maps")).unwrap();
    thickness(&here.path().join("maps"), "broad.png", 32, 0.1);
    thickness(&here.path().join("maps"), "thin.png", 16, 0.02);
    let toml = "[roles]\nleaf = ['leaves', 'needles']\n[translucency]\n\
        thickness = ['leaves=maps/broad.png', 'Need*=maps/thin.png']\nleaf_width_mm = 60\nthickness_scale_mm = 0.4\n\
        for_material = ['needles:leaf_width_mm=4', 'needles:preset=dark']\n";
    std::fs::write(here.path().join("two.foliar.toml"), toml).unwrap();
    let baked = fresh("lucy-two.glb");
    run(FOLIAR, &["bake", text(&here.path().join("two.obj")), "-o", text(&baked)]).expect(0, &[]);
    verify_file(&baked).unwrap();
    let links = &foliage(&baked)["translucency"];
    assert_eq!(links.as_object().unwrap().keys().collect::<Vec<_>>(), ["leaves", "needles"]);
    let records = foliage(&baked)["records"].clone();
    let record = records.as_array().unwrap().iter().find(|r| r["room"] == "translucency").unwrap();
    let sheet = |name: &str| &record["facts"]["sheets"][name];
    assert_eq!(sheet("needles")["texelMm"], 0.25);
    assert_eq!(sheet("needles")["parameters"]["preset"], "dark");
    assert_eq!(sheet("leaves")["texelMm"], 1.875);
    assert_eq!(record["given"]["thickness"], json!(["leaves=maps/broad.png", "Need*=maps/thin.png"]));
    // Materials that share a map share the texture.
    let shared = here.path().join("shared.glb");
    let map = text(&here.path().join("maps/broad.png")).to_owned();
    let flags = with_flags(&[text(&baked), "--no-config", "--thickness", &map, "--material", "*", "-o", text(&shared)]);
    let flags = [&flags[..], &["--set", "translucency.for_material=[]"]].concat();
    run(TRANSLUCENCY, &flags).expect(0, &[]);
    let links = foliage(&shared)["translucency"].clone();
    assert_eq!(links["leaves"]["materials"], json!(["leaves", "needles"]));
    assert_eq!(open_glb(&shared).0["textures"].as_array().unwrap().len(), 1);
}

/// A material that says itself how light passes through keeps its word.
#[test]
fn a_material_with_its_own_transmission_is_left_alone() {
    let here = folder();
    let base = here.path().join("own.glb");
    run(FOLIAR, &["bake", text(&tree(here.path(), 20)), "--only", "density", "-o", text(&base)]).expect(0, &[]);
    run(FOLIAR, &["strip", text(&base), "-o", text(&base)]).expect(0, &[]);
    let (mut json, binary) = open_glb(&base);
    let leaf = json["materials"].as_array().unwrap().iter().position(|m| m["name"] == "leaves").unwrap();
    let own = json!({"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.25}});
    json["materials"][leaf]["extensions"] = own.clone();
    json["extensionsUsed"] = json!(["KHR_materials_diffuse_transmission"]);
    std::fs::write(&base, glb(&json, &binary)).unwrap();
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let baked = fresh("lucy-own.glb");
    made_from(&baked, &base);
    run(TRANSLUCENCY, &with_flags(&[text(&base), "--thickness", text(&map), "-o", text(&baked)]))
        .expect(0, &["NAME-TAKEN", "/materials/"]);
    verify_file(&baked).unwrap();
    let (new, _) = open_glb(&baked);
    assert_eq!(new["materials"][leaf]["extensions"], own);
    assert_eq!(new["textures"].as_array().unwrap().len(), 1, "its map is there by name");
    let back = here.path().join("back.glb");
    run(FOLIAR, &["strip", text(&baked), "-o", text(&back)]).expect(0, &[]);
    assert_eq!(open_glb(&back), (json, binary));
}

/// A photograph against the light is passed on byte for byte; what is embedded needs nothing beside it.
#[test]
fn photographs_are_passed_on_and_embedded_maps_stand_alone() {
    let here = folder();
    let source = tree(here.path(), 20);
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let photo = normals(here.path(), "photo.png", 20);
    let baked = fresh("lucy-photo.glb");
    let flags =
        [text(&source), "--thickness", text(&map), "--backlit", text(&photo), "--embed-all", "-o", text(&baked)];
    run(TRANSLUCENCY, &with_flags(&flags)).expect(0, &["MAP-TWICE", "--normalize diffuse"]);
    verify_file(&baked).unwrap();
    assert!(sides(&baked).is_empty(), "{:?}", sides(&baked));
    let (json, binary) = open_glb(&baked);
    let bytes = std::fs::read(&photo).unwrap();
    assert!(binary.windows(bytes.len()).any(|window| window == bytes), "the photograph as it is");
    assert_eq!(json["textures"].as_array().unwrap().len(), 3, "both sides and the color");
    assert_eq!(foliage(&baked)["translucency"]["leaves"]["color"]["estimate"], false);
    let leaf = json["materials"].as_array().unwrap().iter().find(|material| material["name"] == "leaves").unwrap();
    let shown = &leaf["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionColorTexture"];
    let texture = &json["textures"][shown["index"].as_u64().unwrap() as usize];
    let view = &json["images"][texture["source"].as_u64().unwrap() as usize]["bufferView"];
    let view = &json["bufferViews"][view.as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
    assert!(binary[start..].starts_with(&bytes), "the color is the photograph");
    // What is there in 8 bits alone stays the same 8 bits, however often another room is baked onto it.
    let (before, links) = (pictures(&baked), foliage(&baked)["translucency"].clone());
    let again = run(DENSITY, &[text(&baked), "-o", text(&baked)]).expect(0, &[]);
    assert!(again.stdout.contains("written"), "{again:?}");
    verify_file(&baked).unwrap();
    assert!(pictures(&baked) == before && foliage(&baked)["translucency"] == links);
    let again = run(DENSITY, &[text(&baked), "-o", text(&baked)]).expect(0, &[]);
    assert!(again.stdout.contains("unchanged"), "{again:?}");
}

/// Bytes of the pictures that foliar wrote, by name.
fn pictures(file: &Path) -> BTreeMap<String, Vec<u8>> {
    let (json, binary) = open_glb(file);
    let bytes = |image: &serde_json::Value| {
        let view = &json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
        let at = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        binary[at..at + view["byteLength"].as_u64().unwrap() as usize].to_vec()
    };
    let images = json["images"].as_array().unwrap().iter().filter(|image| image["name"].is_string());
    images.map(|image| (image["name"].as_str().unwrap().to_owned(), bytes(image))).collect()
}

/// Three bands of both sides on a tree: beside it, or in it.
#[test]
fn three_bands_go_onto_a_tree() {
    let here = folder();
    let source = tree(here.path(), 20);
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let baked = fresh("lucy-rgb.glb");
    let flags = [text(&source), "--thickness", text(&map), "--bands", "rgb", "-o", text(&baked)];
    run(TRANSLUCENCY, &with_flags(&flags)).expect(0, &["MAP-ROUNDED"]);
    verify_file(&baked).unwrap();
    assert_eq!(sides(&baked).len(), 6, "{:?}", sides(&baked));
    let photo = here.path().join("photo.jpg");
    ImageBuffer::from_pixel(8, 8, Rgb([90u8, 160, 40])).save(&photo).unwrap();
    let all = [&flags[..], &["--embed-all", "--backlit", text(&photo)]].concat();
    run(TRANSLUCENCY, &with_flags(&all)).expect(0, &["write an EXR to lose nothing"]);
    verify_file(&baked).unwrap();
    assert!(sides(&baked).is_empty(), "{:?}", sides(&baked));
    let (json, binary) = open_glb(&baked);
    assert_eq!(json["textures"].as_array().unwrap().len(), 7, "six maps and the photograph");
    let bytes = std::fs::read(&photo).unwrap();
    assert!(binary.windows(bytes.len()).any(|window| window == bytes), "a JPEG is passed on as it is");
}

/// `tree.glb` and `tree.gltf` have one folder of maps: what either still names is left when the other is baked anew.
#[test]
fn two_files_of_one_name_keep_their_maps() {
    let here = folder();
    let source = tree(here.path(), 20);
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let [glb, gltf] = ["two.glb", "two.gltf"].map(|name| here.path().join(name));
    let bake = |to: &Path, more: &[&str]| {
        let flags = [text(&source), "--thickness", text(&map), "-o", text(to)];
        run(TRANSLUCENCY, &with_flags(&[&flags[..], more].concat())).expect(0, &[]);
    };
    bake(&glb, &[]);
    bake(&gltf, &[]);
    let both = sides(&glb);
    bake(&glb, &["--preset", "dark"]);
    assert!(both.iter().all(|side| sides(&glb).contains(side)), "{both:?} {:?}", sides(&glb));
    verify_file(&gltf).unwrap();
    bake(&gltf, &["--preset", "dark"]);
    assert!(both.iter().all(|side| !sides(&glb).contains(side)), "{both:?} {:?}", sides(&glb));
}

/// Nothing can lie beside standard output: what goes there stands alone.
#[test]
fn standard_output_holds_all_maps() {
    let here = folder();
    let source = tree(here.path(), 10);
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let arguments = with_flags(&[text(&source), "--thickness", text(&map), "-o", "-"]);
    let bytes = crate::common::command(TRANSLUCENCY).args(&arguments).output().unwrap().stdout;
    let piped = here.path().join("piped.glb");
    std::fs::write(&piped, bytes).unwrap();
    verify_file(&piped).unwrap();
    assert_eq!(open_glb(&piped).0["textures"].as_array().unwrap().len(), 2);
}

/// The plan says why no map is baked, and asking for one without giving it is an error.
#[test]
fn a_tree_without_maps_is_baked_without_them() {
    let here = folder();
    let source = tree(here.path(), 10);
    let plan = run(FOLIAR, &["bake", text(&source), "--dry-run"]).expect(0, &[]);
    let line = plan.stdout.lines().find(|line| line.starts_with("translucency")).unwrap().to_owned();
    assert!(line.contains("no") && line.contains("thickness"), "{line}");
    run(FOLIAR, &["bake", text(&source), "--only", "translucency", "-o", "never.glb"]).expect(2, &["thickness"]);
}

/// A scene keeps no texel finer than one of its pixels, and the plan says so.
#[test]
fn a_scene_says_how_fine_maps_are() {
    let here = folder();
    let source = tree(here.path(), 10);
    let map = thickness(here.path(), "t.png", 16, 0.1);
    let set = format!("translucency.thickness=[\"{}\"]", text(&map));
    let (size, white) = ("translucency.leaf_width_mm=60", "translucency.thickness_scale_mm=0.4");
    let baked = fresh("lucy-scene.glb");
    // 60 mm over 16 texels are 3.75 mm; a pixel at 8 m is 8.55 mm: pairs of texels become one.
    let flags = ["--set", &set, "--set", size, "--set", white, "--set", "scene.camera.nearest_m=8"];
    let plan = run(FOLIAR, &[&["bake", text(&source), "--dry-run"], &flags[..]].concat()).expect(0, &[]);
    assert!(plan.stdout.contains("no texel finer than a pixel at 8 m, 8.55 mm"), "{}", plan.stdout);
    run(FOLIAR, &[&["bake", text(&source), "-o", text(&baked)], &flags[..]].concat()).expect(0, &[]);
    verify_file(&baked).unwrap();
    let told = run(FOLIAR, &["inspect", text(&baked)]).expect(0, &[]).stdout;
    assert!(told.contains("map of 8 x 8 texels") && !told.contains("16 x 16"), "{told}");
}

/// A leaf texture is enough: thickness and the color of what comes through are estimated from it, and said to be that.
#[test]
fn thickness_and_color_are_estimated_from_the_leaf_texture() {
    let source = crate::outsiders::repository().join("fixtures/linden/linden.obj");
    let baked = fresh("lucy-own.glb");
    let flags = [text(&source), "--thickness-from", "photo", "--leaf-width-mm", "400", "-o", text(&baked)];
    let run = run(TRANSLUCENCY, &flags).expect(0, &["MAP-ESTIMATED"]);
    assert!(!format!("{run:?}").contains("MAP-COLOR"), "a photograph is meant to have colors: {run:?}");
    verify_file(&baked).unwrap();
    let sheets = &foliage(&baked)["translucency"];
    let color = &sheets.as_object().unwrap().values().next().unwrap()["color"];
    assert_eq!(color["estimate"], true, "{sheets}");
    let factor: Vec<f64> = color["factor"].as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect();
    assert!(
        factor[1] > 0.999 && factor[0] < 1.0 && factor[2] < factor[0],
        "light through a linden is green: {factor:?}"
    );
    let (json, _) = open_glb(&baked);
    let shown = json["materials"].as_array().unwrap().iter().filter_map(|material| {
        material["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionColorFactor"].as_array()
    });
    assert!(shown.count() > 0);
}
