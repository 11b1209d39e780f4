//! Configuration: precedence, unknown names, contradictions, places in messages.

use crate::common::{DENSITY, FOLIAR, command, finish, folder, run, run_in, tree};
use serde_json::Value;
use std::path::Path;

/// Value and source of `density.exponent` for `tree.obj` in a folder.
fn exponent(here: &Path, environment: Option<&str>, flags: &[&str]) -> (f64, String) {
    let mut command = command(FOLIAR);
    command.current_dir(here).args(["config", "tree.obj", "--format", "json"]).args(flags);
    if let Some(value) = environment {
        command.env("FOLIAR_DENSITY_EXPONENT", value);
    }
    let run = finish(command.output().unwrap()).expect(0, &[]);
    let all: Value = serde_json::from_str(&run.stdout).unwrap();
    let line = &all["density.exponent"];
    (line["value"].as_f64().unwrap(), line["from"].as_str().unwrap().to_owned())
}

#[test]
fn each_source_is_stronger_than_the_one_before() {
    let outer = folder();
    let here = outer.path().join("trees");
    std::fs::create_dir(&here).unwrap();
    tree(&here, 20);
    let is = |found: (f64, String), value: f64, from: &str| {
        assert!((found.0 - value).abs() < f64::EPSILON && found.1 == from, "{found:?}, not {value} from {from}");
    };
    is(exponent(&here, None, &[]), 3.0, "default");
    // The project's file is found upward from the input.
    std::fs::write(outer.path().join("foliar.toml"), "[density]\nexponent = 4\n").unwrap();
    is(exponent(&here, None, &[]), 4.0, "file");
    is(exponent(&here, None, &["--no-config"]), 3.0, "default");
    std::fs::write(outer.path().join("other.toml"), "[density]\nexponent = 4.5\n").unwrap();
    is(exponent(&here, None, &["--config", "../other.toml"]), 4.5, "file");
    std::fs::write(here.join("tree.foliar.toml"), "density.exponent = 5\n").unwrap();
    is(exponent(&here, None, &[]), 5.0, "file");
    is(exponent(&here, Some("6"), &[]), 6.0, "environment");
    is(exponent(&here, Some("6"), &["--set", "density.exponent=7"]), 7.0, "flag");
}

#[test]
fn what_the_scene_implies_is_stronger_than_a_default_and_weaker_than_a_file() {
    let here = folder();
    tree(here.path(), 20);
    let channels = |toml: &str| {
        std::fs::write(here.path().join("foliar.toml"), toml).unwrap();
        let run = run_in(here.path(), FOLIAR, &["config", "tree.obj", "--format", "json"]).expect(0, &[]);
        let all: Value = serde_json::from_str(&run.stdout).unwrap();
        let line = &all["density.channels"];
        (line["value"].as_str().unwrap().to_owned(), line["from"].as_str().unwrap().to_owned())
    };
    let scene = "[scene.light]\nsoft_normals = false\n";
    assert_eq!(channels(""), ("both".into(), "default".into()));
    assert_eq!(channels(scene), ("ambient".into(), "scene".into()));
    assert_eq!(channels(&format!("{scene}[density]\nchannels = 'normals'\n")), ("normals".into(), "file".into()));
}

#[test]
fn config_names_file_and_line() {
    let here = folder();
    std::fs::write(here.path().join("foliar.toml"), "# ours\n[import]\nup = 'z'\n").unwrap();
    let run = run_in(here.path(), FOLIAR, &["config"]).expect(0, &[]);
    let line = run.stdout.lines().find(|line| line.starts_with("import.up")).unwrap();
    assert!(line.contains("\"z\"") && line.ends_with("foliar.toml:3"), "{line}");
    let default = run.stdout.lines().find(|line| line.starts_with("import.unit")).unwrap();
    assert!(default.ends_with("default"), "{default}");
}

#[test]
fn unknown_names_are_usage_errors_with_the_nearest_name() {
    let here = folder();
    tree(here.path(), 20);
    run(FOLIAR, &["config", "--set", "density.radus_m=1"])
        .expect(2, &["--set density.radus_m=1: density.radus_m: no such parameter; did you mean density.radius_m?"]);
    run(FOLIAR, &["config", "--set", "density.radius_m"]).expect(2, &["must be SECTION.KEY=VALUE"]);
    std::fs::write(here.path().join("foliar.toml"), "[density]\n\nexponnent = 2\n").unwrap();
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb"])
        .expect(2, &["foliar.toml:3: density.exponnent: no such parameter; did you mean density.exponent?"]);
    let mut command = command(DENSITY);
    command.args(["a.obj", "-o", "a.glb"]).env("FOLIAR_DENSITY_RADIUS", "1");
    finish(command.output().unwrap())
        .expect(2, &["environment FOLIAR_DENSITY_RADIUS: no such parameter; did you mean FOLIAR_DENSITY_RADIUS_M?"]);
    run(FOLIAR, &["bake", "a.obj", "-o", "a.glb", "--radius-m", "1"]).expect(2, &["--radius-m"]);
}

#[test]
fn bad_values_name_their_source() {
    let here = folder();
    tree(here.path(), 20);
    let bad = |toml: &str, said: &[&str]| {
        std::fs::write(here.path().join("foliar.toml"), toml).unwrap();
        run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb"]).expect(2, said);
        assert!(!here.path().join("tree.glb").exists());
    };
    bad("[density]\nexponent = nan\n", &["foliar.toml:2: density.exponent = nan: must be a finite number"]);
    bad("[density]\nexponent = 0\n", &["foliar.toml:2: density.exponent = 0: must be above 0"]);
    bad("[density]\nambient = 'bright'\n", &["foliar.toml:2: density.ambient = \"bright\": must be one of luft, sky"]);
    bad("[scene.camera]\nheight_px = 1.5\n", &["foliar.toml:2: scene.camera.height_px = 1.5: must be a whole number"]);
    bad("[density\n", &["foliar.toml:1: no TOML"]);
    bad("[occlusion]\nquality = 1\n", &["foliar.toml:1: occlusion: occlusion: not in this version"]);
    run(FOLIAR, &["config", "--config", "no/such.toml"]).expect(2, &["no/such.toml: cannot be read"]);
    run(FOLIAR, &["config", "--quality", "inf"]).expect(2, &["--quality", "a finite number"]);
}

#[test]
fn contradictory_flags_are_refused_with_both_named() {
    let bake = |flags: &[&str]| run(FOLIAR, &[&["bake", "a.obj", "-o", "a.glb"], flags].concat());
    bake(&["--unit", "cm", "--height-m", "3"]).expect(2, &["--unit", "--height-m"]);
    bake(&["--quiet", "-v"]).expect(2, &["--quiet", "--verbose"]);
    bake(&["--check", "--dry-run"]).expect(2, &["--check", "--dry-run"]);
    bake(&["--config", "x.toml", "--no-config"]).expect(2, &["--config", "--no-config"]);
    run(FOLIAR, &["bake", "a.obj", "-o", "-", "--check"]).expect(2, &["--check", "-o -", "nothing to compare"]);
    bake(&["-d", "out"]).expect(2, &["--output", "--directory"]);
    bake(&["--set", "import.unit=cm", "--set", "import.height_m=3"])
        .expect(2, &["import.unit", "import.height_m", "contradict"]);
}

#[test]
fn a_stronger_source_rules_out_its_rival() {
    let here = folder();
    std::fs::write(here.path().join("foliar.toml"), "[import]\nheight_m = 12\n").unwrap();
    let run = run_in(here.path(), FOLIAR, &["config", "--unit", "cm", "--format", "json"]).expect(0, &[]);
    let all: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&all["import.unit"]["value"], &all["import.height_m"]["value"]), (&"cm".into(), &Value::Null));
}

#[test]
fn one_pattern_for_two_roles_is_refused_with_both_named() {
    let here = folder();
    tree(here.path(), 20);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb", "--leaf", "Leaves", "--wood", "leaves"])
        .expect(2, &["\"leaves\"", "roles.leaf (flag --leaf)", "roles.wood (flag --wood)", "take it out of one"]);
    assert!(!here.path().join("tree.glb").exists());
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb", "--leaf", "leav*", "--wood", "*aves"])
        .expect(0, &["ROLE-UNSURE", "\"leav*\"", "\"*aves\"", "change one of the patterns"]);
}

#[test]
fn axis_and_unit_of_a_gltf_are_said_to_be_ignored() {
    let here = folder();
    tree(here.path(), 20);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "tree.glb"]).expect(0, &[]);
    run_in(here.path(), FOLIAR, &["bake", "tree.glb", "-o", "again.glb", "--up", "z", "--unit", "cm"])
        .expect(0, &["warning[IMPORT-IGNORED]", "flag --up is ignored", "flag --unit is ignored"]);
}
