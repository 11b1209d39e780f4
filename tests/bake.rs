//! `foliar bake`: the whole way, its conventions, several inputs.

use crate::common::{FOLIAR, folder, open_glb, output, run, run_in, shared, text, tree};
use serde_json::Value;

#[test]
fn an_obj_becomes_a_gltf_with_roles_leaves_and_density() {
    let (here, out) = (folder(), output("bake-obj.glb"));
    let run =
        run(FOLIAR, &["bake", text(&tree(here.path(), 60)), "-o", text(&out)]).expect(0, &["IMPORT-UP", "IMPORT-UNIT"]);
    assert!(run.stdout.contains("written (60 leaves; wind, light, density"), "{}", run.stdout);
    let (json, _) = open_glb(&out);
    let records = &json["extensions"]["FOLIAR_foliage"]["records"];
    let rooms: Vec<&str> = records.as_array().unwrap().iter().map(|r| r["room"].as_str().unwrap()).collect();
    assert_eq!(rooms[..5], ["structure", "branches", "wind", "light", "density"]);
    let order = |room: &&str| foliar_schema::ROOMS.iter().position(|r| r == room);
    assert!(rooms.is_sorted_by_key(order), "{rooms:?}: files list rooms in the order of the contract");
    let attributes = |mesh: usize| json["meshes"][mesh]["primitives"][0]["attributes"].as_object().unwrap().clone();
    let carriers: Vec<usize> = (0..2).filter(|&mesh| attributes(mesh).contains_key("_AMBIENT")).collect();
    assert_eq!(carriers, [0, 1], "wood and leaves carry k_a");
    assert_eq!((0..2).filter(|&mesh| attributes(mesh).contains_key("_SOFT_NORMAL")).count(), 1, "leaves only");
}

#[test]
fn bytes_predicted_are_bytes_written() {
    let (here, out) = (folder(), output("bake-bytes.glb"));
    let report = here.path().join("report.json");
    run(FOLIAR, &["bake", text(&tree(here.path(), 60)), "-o", text(&out), "--report", text(&report)]).expect(0, &[]);
    let report: Value = serde_json::from_slice(&std::fs::read(report).unwrap()).unwrap();
    let rooms = report["assets"][0]["rooms"].as_array().unwrap();
    for name in ["wind", "light", "density"] {
        let room = rooms.iter().find(|room| room["room"] == name).unwrap();
        assert!(room["bytesWritten"].as_u64().unwrap() > 0, "{room}");
        assert_eq!(room["bytesPredicted"], room["bytesWritten"], "{room}");
        assert!(room["seconds"].as_f64().unwrap() > 0.0, "{room}");
    }
}

#[test]
fn a_dry_run_prints_the_plan_and_writes_nothing() {
    let here = folder();
    tree(here.path(), 60);
    let run = run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb", "--dry-run"]).expect(0, &[]);
    let radius = "\"radius_m\":\"from the crown's size and the number of its leaves\"";
    for fragment in ["baker", "density", "yes", "occlusion: not in this version", radius] {
        assert!(run.stdout.contains(fragment), "no {fragment:?} in {}", run.stdout);
    }
    assert!(!run.stdout.contains("null"), "a parameter that the room settles says so: {}", run.stdout);
    assert!(!here.path().join("tree.glb").exists());
}

#[test]
fn plan_and_roles_come_as_json_where_asked_for() {
    let here = folder();
    tree(here.path(), 60);
    let arguments = ["bake", "tree.obj", "--dry-run", "--explain-roles", "--format", "json"];
    let line = run_in(here.path(), FOLIAR, &arguments).expect(0, &[]).json_lines().remove(0);
    assert_eq!((&line["status"], &line["plan"][0]["needed"]), (&"planned".into(), &true.into()));
    assert!(line["plan"][0]["bytes"].as_u64().unwrap() > 0);
    assert!(line["parts"][0]["evidence"][0]["reason"].is_string(), "{line}");
}

#[test]
fn a_scene_without_ambient_soft_normals_and_wind_needs_no_room() {
    let (here, out) = (folder(), output("bake-no-room.glb"));
    tree(here.path(), 60);
    let scene = "[scene.light]\nambient = 'none'\nsoft_normals = false\nsun = 'none'\nsky = 'constant'\n[scene.wind]\nstrength = 'none'\n";
    std::fs::write(here.path().join("foliar.toml"), scene).unwrap();
    let plan = run_in(here.path(), FOLIAR, &["bake", "tree.obj", "--dry-run"]).expect(0, &[]);
    assert!(plan.stdout.contains("no      "), "{}", plan.stdout);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", text(&out)]).expect(0, &[]);
    let (json, _) = open_glb(&out);
    let records = json["extensions"]["FOLIAR_foliage"]["records"].as_array().unwrap();
    let rooms: Vec<&str> = records.iter().filter_map(|record| record["room"].as_str()).collect();
    assert!(rooms.contains(&"structure"), "an output all the same: {rooms:?}");
    assert!(["wind", "light", "density"].iter().all(|room| !rooms.contains(room)), "{rooms:?}");
}

#[test]
fn check_says_whether_the_output_would_change() {
    let (here, out) = (folder(), output("bake-check.glb"));
    let input = tree(here.path(), 60);
    let check = ["bake", text(&input), "-o", text(&out), "--check"];
    run(FOLIAR, &check).expect(1, &["would change: ", "bake-check.glb"]);
    assert!(!out.exists());
    run(FOLIAR, &check[..4]).expect(0, &[]);
    run(FOLIAR, &check).expect(0, &[]);
    tree(here.path(), 61);
    run(FOLIAR, &check).expect(1, &[]);
}

#[test]
fn fail_on_leaves_the_old_output() {
    let (here, out) = (folder(), output("bake-fail-on.glb"));
    let input = tree(here.path(), 60);
    let report = here.path().join("report.json");
    let with = |limit| ["bake", text(&input), "-o", text(&out), "--report", text(&report), "--fail-on", limit];
    run(FOLIAR, &with("note")).expect(1, &["--fail-on: found IMPORT-UP, IMPORT-UNIT; nothing was written"]);
    assert!(!out.exists());
    let text = std::fs::read_to_string(&report).unwrap();
    assert!(text.contains("\"status\": \"failed\"") && text.contains("IMPORT-UP"), "the report tells why: {text}");
    run(FOLIAR, &with("error")).expect(0, &[]);
    assert!(out.exists());
}

#[test]
fn several_inputs_give_a_json_line_each_and_status_5_where_some_fail() {
    let here = folder();
    let one = tree(here.path(), 20);
    std::fs::rename(&one, here.path().join("one.obj")).unwrap();
    std::fs::write(here.path().join("bad.obj"), "v 1 2\n").unwrap();
    tree(here.path(), 30);
    let all = ["bake", "one.obj", "bad.obj", "tree.obj", "-d", "out", "--keep-going"];
    let run = run_in(here.path(), FOLIAR, &all).expect(5, &["bad.obj", "line 1", "1 of 3 assets failed"]);
    let statuses: Vec<Value> = run.json_lines().into_iter().map(|line| line["status"].clone()).collect();
    assert_eq!(statuses, ["written", "failed", "written"]);
    assert_eq!(run.json_lines()[1]["exit"], 3);
    let stopped = run_in(here.path(), FOLIAR, &all[..6]).expect(5, &["1 not tried"]);
    let statuses: Vec<Value> = stopped.json_lines().into_iter().map(|line| line["status"].clone()).collect();
    assert_eq!(statuses, ["unchanged", "failed"]);
}

#[test]
fn inputs_that_would_write_one_file_are_refused() {
    run(FOLIAR, &["bake", "a/tree.obj", "b/tree.obj", "-d", "out"]).expect(2, &["would both write out/tree.glb"]);
    run(FOLIAR, &["bake", "a.obj", "b.obj", "-o", "x.glb"]).expect(2, &["-o names one file for 2 inputs: use -d DIR"]);
    run(FOLIAR, &["bake", "a.obj"]).expect(2, &["-o OUT", "-d DIR"]);
    run(FOLIAR, &["bake", "a.obj", "-o", "x.obj"]).expect(2, &["must end in .glb"]);
}

#[test]
fn lists_for_build_systems_name_what_was_read_and_written() {
    let (here, out) = (folder(), output("bake-lists.glb"));
    tree(here.path(), 20);
    std::fs::write(here.path().join("foliar.toml"), "[import]\nup = 'y'\n").unwrap();
    let arguments = ["bake", "tree.obj", "-o", text(&out), "--depfile", "tree.d", "--outputs", "outputs.json"];
    run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
    let rule = std::fs::read_to_string(here.path().join("tree.d")).unwrap();
    let (target, read) = rule.split_once(": ").unwrap();
    assert_eq!(target, text(&out));
    for file in ["tree.obj", "tree.mtl", "foliar.toml"] {
        assert!(read.contains(file), "{rule}");
    }
    let outputs: Value = serde_json::from_slice(&std::fs::read(here.path().join("outputs.json")).unwrap()).unwrap();
    assert_eq!(outputs, serde_json::json!([text(&out)]));
}

#[test]
fn a_cached_room_gives_the_same_bytes_and_says_so() {
    let (here, out) = (folder(), output("bake-cache.glb"));
    tree(here.path(), 60);
    let arguments = [
        "bake",
        "tree.obj",
        "-o",
        text(&out),
        "--cache",
        "cache",
        "--report",
        "report.json",
        "--set",
        "density.exponent=2",
    ];
    let mut bytes = Vec::new();
    for cached in [false, true] {
        run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
        let report: Value = serde_json::from_slice(&std::fs::read(here.path().join("report.json")).unwrap()).unwrap();
        assert_eq!(report["assets"][0]["rooms"][0]["cached"], cached);
        bytes.push(std::fs::read(&out).unwrap());
    }
    assert!(bytes[0] == bytes[1], "the cache changed the output");
    run_in(here.path(), FOLIAR, &[&arguments[..8], &["--set", "density.exponent=3"]].concat()).expect(0, &[]);
    let report = std::fs::read_to_string(here.path().join("report.json")).unwrap();
    assert!(report.contains("\"cached\": false"), "another parameter, another key");
}

#[test]
fn a_damaged_cache_is_baked_anew() {
    let (here, out) = (folder(), output("bake-damaged-cache.glb"));
    tree(here.path(), 60);
    let arguments = ["bake", "tree.obj", "-o", text(&out), "--cache", "cache"];
    run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
    let first = std::fs::read(&out).unwrap();
    for file in std::fs::read_dir(here.path().join("cache")).unwrap() {
        std::fs::write(file.unwrap().path(), b"no layer").unwrap();
    }
    run_in(here.path(), FOLIAR, &arguments).expect(0, &[]);
    assert!(std::fs::read(&out).unwrap() == first);
}

#[test]
fn only_bakes_what_it_names() {
    run(FOLIAR, &["bake", "a.obj", "-o", "a.glb", "--only", "occlusion"])
        .expect(2, &["occlusion: not in this version"]);
    run(FOLIAR, &["bake", "a.obj", "-o", "a.glb", "--only", "soup"]).expect(2, &["no such room; there are wind"]);
}

#[test]
fn a_picture_is_drawn_beside_the_output() {
    let (here, out) = (folder(), output("bake-picture.glb"));
    let small = ["--set", "view.width_px=64", "--set", "view.height_px=48", "--set", "view.samples=1"];
    let picture = here.path().join("tree.png");
    let input = tree(here.path(), 60);
    let arguments = [&["bake", text(&input), "-o", text(&out), "--picture", text(&picture)], &small[..]].concat();
    let said = run(FOLIAR, &arguments).expect(0, &[]).stdout;
    assert_eq!(&std::fs::read(&picture).unwrap()[..8], b"\x89PNG\r\n\x1a\n");
    assert!(said.contains(&format!("{}: written", text(&picture))), "where the picture is: {said}");
    let line = run(FOLIAR, &[&arguments[..], &["--format", "json"]].concat()).expect(0, &[]).json_lines().remove(0);
    assert_eq!(line["outputs"], serde_json::json!([text(&picture), text(&out)]));
}

#[test]
fn roles_are_explained() {
    let here = folder();
    let run = run(FOLIAR, &["bake", text(&tree(here.path(), 60)), "--explain-roles"]).expect(0, &[]);
    for fragment in ["\"bark\"", "wood", "\"leaves\"", "leaf", "confidence"] {
        assert!(run.stdout.contains(fragment), "no {fragment:?} in {}", run.stdout);
    }
}

#[test]
fn a_real_tree_bakes_all_the_way() {
    let Some(input) = shared("trees/ez_bush_2/tree.obj") else { return };
    let out = output("bake-ez_bush_2.glb");
    let run = run(FOLIAR, &["bake", text(&input), "-o", text(&out)]).expect(0, &[]);
    assert!(run.stdout.contains("written"), "{run:?}");
}

#[test]
fn findings_come_in_the_formats_of_those_who_show_them() {
    let (here, out) = (folder(), output("bake-formats.glb"));
    let input = tree(here.path(), 20);
    let bake =
        |format| run(FOLIAR, &["bake", text(&input), "-o", text(&out), "--format", format]).expect(0, &[]).stdout;
    let sarif: Value = serde_json::from_str(&bake("sarif")).unwrap();
    assert_eq!(sarif["runs"][0]["results"][0]["ruleId"], "IMPORT-UP");
    assert!(bake("junit").contains("<testcase"), "JUnit");
    assert!(bake("github").starts_with("::notice file="), "GitHub");
    let line: Value = serde_json::from_str(&bake("json")).unwrap();
    assert_eq!(line["status"], "unchanged");
    run(FOLIAR, &["bake", text(&input), "-o", text(&out), "--format", "xml"]).expect(2, &["--format"]);
}
