//! What programs say to machines is what `docs/schema` says of it, by a validator that is not ours.

use crate::common::{
    CHECK, DENSITY, FOLIAR, IMPORT, LEAFSCAN, NOISE, PACK, TRANSLUCENCY, VIEW, folder, run, run_in, text, tree,
};
use serde_json::Value;
use std::path::Path;

/// A schema as pipelines get it.
fn schema(name: &str) -> jsonschema::Validator {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../docs/schema/{name}.schema.json"));
    let schema: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    jsonschema::meta::validate(&schema).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

#[track_caller]
fn fits(validator: &jsonschema::Validator, said: &Value) {
    let errors: Vec<String> = validator.iter_errors(said).map(|e| format!("{}: {e}", e.instance_path())).collect();
    assert!(errors.is_empty(), "{said:#} {errors:#?}");
}

/// Every line fits, and fits no more once anything stands in it that the schema does not know, or something is gone.
#[track_caller]
fn lines(name: &str, status: i32, program: &str, arguments: &[&str]) {
    let validator = schema(name);
    let said = run(program, &[arguments, &["--format", "json"]].concat()).expect(status, &[]).json_lines();
    assert!(!said.is_empty(), "{program} {arguments:?}");
    for line in &said {
        fits(&validator, line);
        for (at, altered) in altered(line) {
            assert!(!validator.is_valid(&altered), "{name}: a stranger in {at:?}, or without it, is taken: {line:#}");
        }
    }
}

/// A line with one member more, in itself and in the first object of each of its lists, and without its first member.
fn altered(line: &Value) -> Vec<(String, Value)> {
    let lists = line.as_object().into_iter().flatten().filter(|(_, value)| value[0].is_object());
    let mut places: Vec<String> = lists.map(|(name, _)| format!("/{name}/0")).collect();
    places.push(if line.is_array() { "/0".into() } else { String::new() });
    let at = |place: &String| {
        let object = |of: &mut Value, change: &dyn Fn(&mut serde_json::Map<String, Value>)| {
            change(of.pointer_mut(place).unwrap().as_object_mut().unwrap());
        };
        let (mut more, mut less) = (line.clone(), line.clone());
        object(&mut more, &|object| _ = object.insert("stranger".into(), 1.into()));
        object(&mut less, &|object| _ = object.shift_remove(&object.keys().next().unwrap().clone()));
        [more, less].map(|altered| (place.clone(), altered))
    };
    places.iter().flat_map(at).collect()
}

/// Bakes a small tree.
fn baked(here: &Path, name: &str, more: &[&str]) -> std::path::PathBuf {
    let out = here.join(name);
    run(FOLIAR, &[&["bake", text(&tree(here, 40)), "-o", text(&out)], more].concat()).expect(0, &[]);
    out
}

#[test]
fn what_check_inspect_and_diff_say_fits_their_schemas() {
    let here = folder();
    let (obj, one) = (tree(here.path(), 40), baked(here.path(), "one.glb", &[]));
    let other = baked(here.path(), "other.glb", &["--only", "density", "--set", "density.radius_m=0.2"]);
    let layer = baked(here.path(), "density.layer", &["--only", "density"]);
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/check");
    let broken = ["geometry-nan.gltf", "import-mtl.obj", "contract-range.gltf"].map(|name| fixtures.join(name));
    let [nan, mtl, range] = broken.each_ref().map(|path| text(path));
    let gone = here.path().join("gone.glb");
    lines("foliar-check", 1, CHECK, &[nan, mtl, range, text(&one), text(&obj)]);
    lines("foliar-check", 5, CHECK, &[nan, text(&gone)]);
    lines("foliar-check", 1, CHECK, &["--after", text(&obj), "--master", text(&one)]);
    lines("foliar-inspect", 0, FOLIAR, &["inspect", text(&one), text(&other), text(&obj), text(&layer)]);
    lines("foliar-inspect", 3, FOLIAR, &["inspect", text(&gone)]);
    lines("foliar-diff", 0, FOLIAR, &["diff", text(&one), text(&one)]);
    lines("foliar-diff", 1, FOLIAR, &["diff", text(&one), text(&other)]);
    lines("foliar-diff", 3, FOLIAR, &["diff", text(&obj), text(&obj)]);
    lines("foliar-explain", 0, FOLIAR, &["explain", "STALE"]);
    lines("foliar-explain", 0, FOLIAR, &["explain"]);
    let whole = schema("foliar-config");
    for input in [&[][..], &[text(&obj)], &[text(&gone)]] {
        let said = run(FOLIAR, &[&["config", "--format", "json", "--set", "density.radius_m=0.2"], input].concat())
            .json_lines();
        fits(&whole, &said[0]);
    }
}

#[test]
fn reports_and_lines_of_every_program_fit_their_schemas() {
    let here = folder();
    let (whole, line) = (schema("foliar-report"), schema("foliar-line"));
    let (obj, one) = (tree(here.path(), 40), baked(here.path(), "one.glb", &[]));
    let layer = baked(here.path(), "density.layer", &["--only", "density"]);
    let map = crate::translucency::thickness(here.path(), "t.png", 24, 0.1);
    let (obj, one, layer, map) = (text(&obj), text(&one), text(&layer), text(&map));
    crate::leafscan::leaf(here.path(), &[0]);
    let lit = crate::translucency::with_flags(&["--thickness", map, "-o", "leaf.exr"]);
    let runs: [(i32, &str, &[&str]); 18] = [
        (0, FOLIAR, &["bake", obj, "-o", "again.glb", "--explain-roles"]),
        (0, FOLIAR, &["bake", obj, "-o", "again.glb", "--check"]),
        (0, FOLIAR, &["bake", obj, "-o", "third.glb", "--dry-run"]),
        (3, FOLIAR, &["bake", "gone.obj", "-o", "never.glb"]),
        (5, FOLIAR, &["bake", obj, "gone.obj", "-d", "all", "--keep-going"]),
        (0, FOLIAR, &["rebake", "again.glb"]),
        (0, FOLIAR, &["assemble", obj, layer, "-o", "put.glb"]),
        (0, FOLIAR, &["assemble", obj, layer, "-o", "put.glb", "--dry-run"]),
        (0, FOLIAR, &["strip", one, "-o", "bare.glb"]),
        (0, FOLIAR, &["inspect", one, obj]),
        (0, FOLIAR, &["config", obj, "--set", "density.radius_m=0.2"]),
        (0, IMPORT, &[obj, "-o", "plant.glb"]),
        (0, DENSITY, &[obj, "-o", "d.glb", "--surface", "crown.glb"]),
        (0, PACK, &[one, "-o", "ship.glb", "--for", "core"]),
        (0, NOISE, &["-o", "n.png", "--measure", "--set", "noise.size=128"]),
        (0, TRANSLUCENCY, &lit),
        (0, LEAFSCAN, &["leaf.obj", "--unit", "mm", "--up", "y", "--resolution", "64", "-o", "maps.png"]),
        (0, VIEW, &[one, "-o", "v.png", "--width-px", "32", "--height-px", "32", "--samples", "1"]),
    ];
    for (status, program, arguments) in runs {
        let ends = ["--report", "report.json", "--format", "json"];
        let done = run_in(here.path(), program, &[arguments, &ends].concat()).expect(status, &[]);
        let report = std::fs::read_to_string(here.path().join("report.json")).unwrap();
        fits(&whole, &serde_json::from_str(&report).unwrap());
        let answers = ["inspect", "config"].contains(&arguments[0]);
        done.json_lines().iter().filter(|_| !answers).for_each(|said| fits(&line, said));
    }
}
