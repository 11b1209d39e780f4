//! `foliar-pack`: files that ship, and the numbers that loaders which are not ours must find in them
//! (`cargo xtask loaders`).

use crate::common::{FOLIAR, IMPORT, PACK, VIEW, folder, glb, open_glb, output, run, run_in, shared, text, tree};
use foliar_carrier::second_reader;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

const ENGINES: [&str; 3] = ["core", "blender", "luft07"];
/// Rounding to f32, and back from it.
const ROUNDED: f64 = 1e-6;
/// Rounding to a byte.
const BYTE: f64 = 0.5 / 255.0 + ROUNDED;

/// A baked tree.
fn master(folder: &Path, leaves: usize) -> PathBuf {
    let path = folder.join("master.glb");
    run(FOLIAR, &["bake", text(&tree(folder, leaves)), "-o", text(&path)]).expect(0, &[]);
    path
}

/// Floats of one attribute, read by the letter of the format; none where there is no such attribute.
fn floats(json: &Value, binary: &[u8], primitive: &Value, name: &str) -> Option<Vec<f64>> {
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let accessor = &json["accessors"][primitive["attributes"].get(name)?.as_u64()? as usize];
    assert_eq!(accessor["componentType"], 5126, "{name}");
    let width = match accessor["type"].as_str()? {
        "SCALAR" => 1,
        vector => vector.trim_start_matches("VEC").parse().unwrap(),
    };
    let view = &json["bufferViews"][number(&accessor["bufferView"])];
    let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
    let stride = view["byteStride"].as_u64().map_or(4 * width, |stride| stride as usize);
    let at = |vertex: usize, c: usize| {
        let byte = start + vertex * stride + 4 * c;
        f64::from(f32::from_le_bytes(binary[byte..byte + 4].try_into().unwrap()))
    };
    Some((0..number(&accessor["count"])).flat_map(|v| (0..width).map(move |c| at(v, c))).collect())
}

/// What a loader must find, from the master alone: per mesh, attributes with their numbers.
fn expected(master: &Path, engine: &str) -> Value {
    let (json, binary) = open_glb(master);
    let (mut meshes, mut sheets) = (Map::new(), Map::new());
    for node in json["nodes"].as_array().unwrap().iter().filter(|node| node["mesh"].is_u64()) {
        let primitive = &json["meshes"][node["mesh"].as_u64().unwrap() as usize]["primitives"][0];
        let read = |name: &str| floats(&json, &binary, primitive, name);
        let own = read("NORMAL").unwrap();
        let soft = read("_SOFT_NORMAL").unwrap_or_else(|| own.clone());
        let ambient = read("_AMBIENT").unwrap();
        let thrice = |values: &[f64]| values.iter().flat_map(|v| [*v; 3]).collect::<Vec<f64>>();
        let vectors = |make: &dyn Fn(&[f64], f64) -> [f64; 3]| {
            soft.chunks(3).zip(&ambient).flat_map(|(n, k)| make(n, *k)).collect()
        };
        let mut attributes: Vec<(&str, Vec<f64>, f64)> = match engine {
            "core" => vec![("NORMAL", soft.clone(), ROUNDED), ("COLOR_0", thrice(&ambient), BYTE)],
            "blender" => vec![("NORMAL", own, ROUNDED), ("_AMBIENT", thrice(&ambient), ROUNDED)],
            _ => vec![("_NORMAL_AMBIENT", vectors(&|n, k| [n[0] * k, n[1] * k, n[2] * k]), ROUNDED)],
        };
        if engine == "blender" && primitive["extensions"]["FOLIAR_foliage"]["role"] == "leaf" {
            attributes.push(("_SOFT_NORMAL_ZUP", vectors(&|n, _| [n[0], -n[2], n[1]]), ROUNDED));
            let ids = primitive["extensions"]["EXT_mesh_features"]["featureIds"][0]["attribute"].as_u64().unwrap();
            attributes.push(("_LEAF_ID", thrice(&read(&format!("_FEATURE_ID_{ids}")).unwrap()), 0.0));
        }
        let double = json["materials"][primitive["material"].as_u64().unwrap() as usize]["doubleSided"] == true;
        if engine == "core" && double && read("_SOFT_NORMAL").is_some() {
            let indices = &json["accessors"][primitive["indices"].as_u64().unwrap() as usize]["count"];
            sheets.insert(node["name"].as_str().unwrap().into(), json!(indices.as_u64().unwrap() / 3));
        }
        let one = |(name, values, tolerance): (&str, Vec<f64>, f64)| {
            (name.to_owned(), json!({"width": 3, "tolerance": tolerance, "values": values}))
        };
        meshes.insert(node["name"].as_str().unwrap().into(), attributes.into_iter().map(one).collect());
    }
    assert_eq!(sheets.len(), usize::from(engine == "core"), "the crown is two-sided");
    json!({"engine": engine, "meshes": meshes, "sheets": sheets})
}

#[test]
fn every_engine_gets_a_file_and_loaders_get_the_numbers_to_expect() {
    let here = folder();
    let master = master(here.path(), 60);
    for engine in ENGINES {
        let out = output(&format!("pack-{engine}.glb"));
        let said = run(PACK, &[text(&master), "-o", text(&out), "--for", engine]).expect(0, &[]).stdout;
        assert!(said.contains(&format!("for {engine}: ")) && said.contains("_AMBIENT in "), "{said}");
        let (json, _) = open_glb(&out);
        for gone in ["FOLIAR_foliage", "EXT_mesh_features", "foliarLeaf"] {
            assert!(!json.to_string().contains(gone), "{engine}: {gone} is of no use to an engine");
        }
        second_reader::verify_file(&out).unwrap();
        std::fs::write(format!("{}.expected.json", text(&out)), expected(&master, engine).to_string()).unwrap();
    }
}

#[test]
fn a_real_tree_is_packed_and_the_report_says_what_it_cost() {
    let Some(obj) = shared("trees/sapling_default_1k5/tree.obj") else { return };
    let here = folder();
    let (master, out, report) = (here.path().join("m.glb"), output("pack-real.glb"), here.path().join("r.json"));
    run(FOLIAR, &["bake", text(&obj), "-o", text(&master)]).expect(0, &[]);
    run(PACK, &[text(&master), "-o", text(&out), "--for", "core", "--report", text(&report)]).expect(0, &[]);
    let report: Value = serde_json::from_str(&std::fs::read_to_string(report).unwrap()).unwrap();
    let pack = &report["assets"][0]["pack"];
    assert_eq!(pack["engine"], "core");
    assert_eq!(pack["addedBytesPerVertex"], 4, "a color of four bytes; normals take the place of normals");
    let color = pack["attributes"].as_array().unwrap().iter().find(|a| a["attribute"] == "COLOR_0").unwrap();
    let most = color["maxSteps"].as_f64().unwrap();
    assert!(most > 0.3 && most < 0.5001, "rounding to bytes: {color}");
    assert!(std::fs::metadata(&out).unwrap().len() < std::fs::metadata(&master).unwrap().len());
}

#[test]
fn every_odd_plant_that_has_something_to_pack_is_packed_for_every_engine() {
    let here = folder();
    let (base, master) = (here.path().join("base.glb"), here.path().join("master.glb"));
    let mut packed = 0;
    for sample in foliar_plant::sample::odd_plants() {
        crate::plants::write_glb(sample.plant.base(), &base);
        run(FOLIAR, &["bake", text(&base), "-o", text(&master)]).expect(0, &[]);
        let is_baked = open_glb(&master).0.to_string().contains("_AMBIENT\":");
        for engine in ENGINES {
            let out = output(&format!("pack-odd-{}-{engine}.glb", sample.name));
            let run = run(PACK, &[text(&master), "-o", text(&out), "--for", engine]);
            packed += usize::from(run.status == 0);
            assert_eq!(run.status, if is_baked { 0 } else { 3 }, "{} {engine}: {run:?}", sample.name);
            assert!(!is_baked || second_reader::verify_file(&out).is_ok(), "{:?}", second_reader::verify_file(&out));
        }
    }
    assert!(packed > 3 * ENGINES.len(), "odd plants with leaves: {packed} files");
}

#[test]
fn the_second_reader_refuses_a_file_that_is_not_what_it_says() {
    let here = folder();
    let (master, out) = (master(here.path(), 20), here.path().join("packed.glb"));
    run(PACK, &[text(&master), "-o", text(&out), "--for", "blender"]).expect(0, &[]);
    let (json, binary) = open_glb(&out);
    let refused = |change: &dyn Fn(&mut Value)| {
        let mut json = json.clone();
        change(&mut json);
        second_reader::verify(&glb(&json, &binary)).unwrap_err()
    };
    let engine = |json: &mut Value, word: &str| json["asset"]["extras"]["FOLIAR_packed"]["engine"] = word.into();
    assert!(refused(&|json| engine(json, "luft07")).contains("nothing in it was packed"));
    assert!(refused(&|json| engine(json, "core")).contains("twice"));
    let ambient = json["meshes"][0]["primitives"][0]["attributes"]["_AMBIENT"].as_u64().unwrap() as usize;
    assert!(refused(&|json| json["accessors"][ambient]["type"] = "SCALAR".into()).contains("no VEC3 of floats"));
}

#[test]
fn a_viewer_draws_the_packed_file_another_way_than_the_base() {
    let here = folder();
    let (master, packed) = (master(here.path(), 60), here.path().join("packed.glb"));
    run(PACK, &[text(&master), "-o", text(&packed), "--for", "core"]).expect(0, &[]);
    let drawn = |name: &str, input: &Path| {
        let picture = here.path().join(name);
        let small = ["--look", "stock", "--width-px", "64", "--height-px", "48", "--samples", "1"];
        run(VIEW, &[&[text(input), "-o", text(&picture)], &small[..]].concat()).expect(0, &[]);
        std::fs::read(picture).unwrap()
    };
    assert!(drawn("before.png", &master) != drawn("after.png", &packed));
}

#[test]
fn what_cannot_be_packed_is_refused_with_the_remedy() {
    let here = folder();
    let here = here.path();
    let master = master(here, 20);
    run_in(here, IMPORT, &["tree.obj", "-o", "plant.glb"]).expect(0, &[]);
    let pack = |arguments: &[&str]| run_in(here, PACK, arguments);
    pack(&["plant.glb", "-o", "x.glb", "--for", "core"]).expect(3, &["plant.glb: ", "foliar-density"]);
    pack(&["tree.obj", "-o", "x.glb", "--for", "core"]).expect(3, &["tree.obj: ", "foliar-density"]);
    pack(&["master.glb", "-o", "x.glb", "--for", "three"]).expect(2, &["three", "core, blender, luft07"]);
    pack(&["master.glb", "-o", "x.glb"]).expect(2, &["--for core|blender|luft07", "[pack]"]);
    pack(&["master.glb", "-o", "x.obj", "--for", "core"]).expect(2, &["must end in .glb, .gltf"]);
    pack(&["master.glb", "--for", "core"]).expect(2, &["-o OUT"]);
    let before = std::fs::read(&master).unwrap();
    pack(&["master.glb", "-o", "./master.glb", "--for", "core"]).expect(2, &["would replace the master"]);
    assert!(std::fs::read(&master).unwrap() == before);
    assert!(!here.join("x.glb").exists());
    pack(&["master.glb", "-o", "packed.glb", "--for", "core"]).expect(0, &[]);
    pack(&["packed.glb", "-o", "x.glb", "--for", "core"]).expect(3, &["is packed for core already"]);
}

#[test]
fn the_project_says_for_which_engine_and_how_much_it_may_cost() {
    let here = folder();
    let here = here.path();
    master(here, 20);
    let text = "[pack]\nengine = \"blender\"\n[scene.budget]\nbytes_per_vertex = 8\n";
    std::fs::write(here.join("foliar.toml"), text).unwrap();
    let said = run_in(here, PACK, &["master.glb", "-o", "out.gltf"]).expect(0, &["PACK-BUDGET", "36", "8"]).stdout;
    assert!(said.contains("for blender"), "{said}");
    let line = run_in(here, PACK, &["master.glb", "-d", "ship", "--for", "luft07", "--format", "json"]).expect(0, &[]);
    let line = &line.json_lines()[0];
    assert_eq!((&line["output"], &line["pack"]["engine"]), (&json!("ship/master.glb"), &json!("luft07")));
    std::fs::write(here.join("foliar.toml"), "[pack]\nengine = \"godot\"\n").unwrap();
    run_in(here, PACK, &["master.glb", "-o", "out.gltf"]).expect(2, &["foliar.toml:2", "godot", "luft07"]);
}
