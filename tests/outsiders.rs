//! Programs that are not ours: what gltf-transform, gltfpack and Blender lose of a master, and what foliar-check says of
//! it; SARIF and JUnit in the hands of their own readers; the example page in a browser. Each is skipped in words
//! where it is not installed.

use crate::common::{CHECK, FOLIAR, Run, folder, open_glb, run, run_in, skip, text, tree};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

pub fn starts(command: &mut Command) -> bool {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
}

/// A file of the npm packages that this folder pins, or nothing, said in words.
pub fn packaged(in_folder: &str, name: &str) -> Option<PathBuf> {
    let path = repository().join(in_folder).join("node_modules").join(name);
    if !starts(Command::new("node").arg("--version")) {
        skip("programs of npm packages: node is not installed (.ci/run installs it on Debian)");
    } else if path.exists() {
        return Some(path);
    } else {
        skip(&format!("{name}: not installed: npm ci --prefix {in_folder} (cargo xtask test does it)"));
    }
    None
}

/// Runs a tool that must succeed.
fn tool(command: &mut Command) {
    let output = command.stdin(Stdio::null()).output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Codes of what foliar-check says was lost.
fn told(after: &Path, master: &Path) -> BTreeSet<String> {
    let run: Run = run(CHECK, &["--after", text(after), "--master", text(master), "--format", "json"]);
    let report = run.json_lines().remove(0);
    let findings = report["findings"].as_array().unwrap();
    let codes = findings.iter().map(|finding| finding["code"].as_str().unwrap().to_string());
    codes.filter(|code| code.starts_with("LOST-")).collect()
}

/// What a file still holds, by the letter of its JSON alone.
fn held(file: &Path) -> BTreeSet<&'static str> {
    let (json, _) = open_glb(file);
    let primitives: Vec<&Value> = json["meshes"]
        .as_array()
        .into_iter()
        .flatten()
        .flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten())
        .collect();
    let any = |test: &dyn Fn(&Value) -> bool| primitives.iter().any(|primitive| test(primitive));
    let named = json["materials"].as_array().is_some_and(|all| all.iter().all(|m| m["name"].is_string()));
    let extension = "FOLIAR_foliage";
    let tables = &json["extensions"]["EXT_structural_metadata"]["propertyTables"];
    let mut held = BTreeSet::new();
    for (what, is_there) in [
        ("LOST-EXTENSION", json["extensions"][extension].is_object()),
        ("LOST-MIRROR", json["asset"]["extras"][extension].is_object()),
        ("LOST-ROLE", any(&|p| ["extensions", "extras"].iter().any(|at| p[at][extension]["role"].is_string()))),
        ("LOST-ID", any(&|p| p["extensions"]["EXT_mesh_features"]["featureIds"].is_array())),
        ("LOST-TABLE", tables.as_array().is_some_and(|tables| !tables.is_empty())),
        ("LOST-CHANNEL", any(&|p| !p["attributes"]["_AMBIENT"].is_null())),
        ("LOST-NAME", named),
    ] {
        if is_there {
            held.insert(what);
        }
    }
    held
}

/// A master with `structure` and `density`.
fn master(here: &Path) -> PathBuf {
    let out = here.join("master.glb");
    run(FOLIAR, &["bake", text(&tree(here, 60)), "-o", text(&out), "--only", "density"]).expect(0, &[]);
    out
}

/// What was said, and what the file's own JSON says: they agree on everything that JSON can show.
#[track_caller]
fn agrees(after: &Path, master: &Path, lost: &[&str]) {
    let (told, before, now) = (told(after, master), held(master), held(after));
    let gone: BTreeSet<String> = before.difference(&now).map(|code| code.to_string()).collect();
    // Numbers are not seen in JSON, nor that some of the ids have gone.
    let numbers = |code: &String| {
        ["LOST-PRECISION", "LOST-GEOMETRY", "LOST-ALPHA"].contains(&code.as_str())
            || code == "LOST-ID" && now.contains("LOST-ID")
    };
    let shown: BTreeSet<String> = told.iter().filter(|code| !numbers(code)).cloned().collect();
    assert_eq!(shown, gone, "{}: said, and read in its JSON", after.display());
    let expected: BTreeSet<String> = lost.iter().map(|code| code.to_string()).collect();
    assert_eq!(told, expected, "{}", after.display());
}

#[test]
fn what_gltf_transform_loses_is_said() {
    let Some(program) = packaged("xtask/outsiders", ".bin/gltf-transform") else { return };
    let here = folder();
    let master = master(here.path());
    let after = |name: &str, arguments: &[&str]| {
        let out = here.path().join(name);
        tool(Command::new(&program).arg(arguments[0]).args([&master, &out]).args(&arguments[1..]));
        out
    };
    // It knows neither our extension nor what hangs on it, and keeps everything else.
    agrees(&after("copy.glb", &["copy"]), &master, &["LOST-EXTENSION"]);
    agrees(&after("welded.glb", &["weld"]), &master, &["LOST-EXTENSION"]);
    // Twelve bits for what is no position, normal or color are finer than an eye.
    agrees(&after("coarse.glb", &["quantize"]), &master, &["LOST-EXTENSION"]);
    let halved = after("halved.glb", &["simplify", "--ratio", "0.5", "--error", "0.1"]);
    agrees(&halved, &master, &["LOST-EXTENSION", "LOST-GEOMETRY", "LOST-ID"]);
    // What is compressed is not looked into, and nothing is said of what was not seen.
    for way in ["meshopt", "draco"] {
        let file = after(&format!("{way}.glb"), &[way]);
        agrees(&file, &master, &["LOST-EXTENSION"]);
        let said = run(CHECK, &["--after", text(&file), "--master", text(&master)]).expect(0, &[]).stdout;
        assert!(said.contains("warning[FILE-COMPRESSED]") && said.contains("decode it first"), "{said}");
    }
}

#[test]
fn what_gltfpack_loses_is_said() {
    let Some(program) = packaged("xtask/outsiders", ".bin/gltfpack") else { return };
    let here = folder();
    let master = master(here.path());
    let after = |name: &str, flags: &[&str]| {
        let out = here.path().join(name);
        tool(Command::new(&program).arg("-i").arg(&master).arg("-o").arg(&out).args(flags));
        out
    };
    let always = ["LOST-CHANNEL", "LOST-EXTENSION", "LOST-ID", "LOST-TABLE"];
    agrees(&after("usual.glb", &[]), &master, &[&always[..], &["LOST-ROLE"]].concat());
    // Extras of primitives hold the roles; no flag keeps custom attributes.
    agrees(&after("kept.glb", &["-kn", "-km", "-ke", "-kv", "-noq"]), &master, &always);
}

#[test]
fn what_blender_loses_is_said() {
    let python = std::env::var("BLENDER_PYTHON").unwrap_or_else(|_| "python3".into());
    if !starts(Command::new(&python).args(["-c", "import bpy"])) {
        return skip(&format!(
            "what Blender loses: {python} cannot import bpy: pip install bpy==5.0.1, for Python 3.11, or name another Python in BLENDER_PYTHON"
        ));
    }
    let here = folder();
    // Blender 5.0.1 fails on a mesh whose custom attributes have different widths: scalars alone.
    let master = here.path().join("master.glb");
    let input = tree(here.path(), 60);
    let scalars = ["--only", "density", "--set", "density.channels=ambient"];
    run(FOLIAR, &[&["bake", text(&input), "-o", text(&master)], &scalars[..]].concat()).expect(0, &[]);
    let out = here.path().join("blender.glb");
    let script = format!(
        "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\nbpy.ops.import_scene.gltf(filepath={:?})\n\
         bpy.ops.export_scene.gltf(filepath={:?}, export_attributes=True, export_extras=True)\n",
        text(&master),
        text(&out)
    );
    tool(Command::new(&python).args(["-c", &script]));
    agrees(&out, &master, &["LOST-EXTENSION", "LOST-ID", "LOST-MIRROR", "LOST-ROLE", "LOST-TABLE"]);
}

#[test]
fn reports_are_accepted_by_their_own_readers() {
    let Some(_) = packaged("xtask/outsiders", "libxml2-wasm/package.json") else { return };
    if !cfg!(target_os = "linux") {
        return skip("reports in the hands of their own readers: the multitool is pinned for Linux alone");
    }
    let here = folder();
    // A name with everything that XML and URIs must escape, findings with and without a line, and a failure.
    let odd = here.path().join("a <b> & 'ü' 100 %.obj");
    std::fs::write(&odd, "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n").unwrap();
    let sound = tree(here.path(), 40);
    let cut = here.path().join("cut.glb");
    std::fs::write(&cut, b"glTF").unwrap();
    let inputs = [text(&odd), text(&sound), text(&cut), "gone.glb"];
    let report = |format: &str| {
        let said = run_in(here.path(), CHECK, &[&inputs[..], &["--format", format]].concat()).expect(5, &[]);
        let file = here.path().join(format!("report.{format}"));
        std::fs::write(&file, said.stdout).unwrap();
        file
    };
    let (sarif, junit) = (report("sarif"), report("junit"));
    let script = repository().join("xtask/outsiders/accept.mjs");
    let output = Command::new("node").arg(script).args([&sarif, &junit]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let results: Value = serde_json::from_str(&std::fs::read_to_string(&sarif).unwrap()).unwrap();
    let count = results["runs"][0]["results"].as_array().unwrap().len();
    assert!(count > 4 && said.contains(&format!("SARIF: {count} results")), "{said}");
    // A case per finding, and one for the sound file, which has notes alone.
    assert!(said.contains(&format!("JUnit: {} cases", count + 1)), "{count} findings: {said}");
}
