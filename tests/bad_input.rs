//! Bad input: one table. Every kind has rows of input, exit status, and file, place and remedy in the message;
//! whatever happens, every file that was there, the old output first, stays as it was, and none joins it.

use crate::bad_places::{
    at_full_disk, at_full_file, at_read_only_disk, at_read_only_folder, killed, through_closed_pipe,
};
use crate::common::{CHECK, DENSITY, FOLIAR, IMPORT, Run, folder, glb, output, run_in, text, tree_text};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// The old output.
pub const OLD: &[u8] = b"old";

/// One bad input.
pub struct Bad {
    /// What is wrong.
    kind: &'static str,
    /// Files by name.
    files: Vec<(&'static str, Vec<u8>)>,
    /// What is called; `bake FILE -o out.glb` where nothing is said.
    arguments: Vec<&'static str>,
    /// Runs `foliar` with the arguments in the folder; none where this machine cannot show it, said in words.
    runs: fn(&Path, &[&str]) -> Option<Run>,
    /// Exit status; -1 where a signal ends the process.
    status: i32,
    /// File, place and remedy.
    said: [&'static str; 3],
}

/// A row: `bake FILE -o out.glb` ends with status 3.
fn bad(
    kind: &'static str,
    file: &'static str,
    bytes: impl Into<Vec<u8>>,
    place: &'static str,
    remedy: &'static str,
) -> Bad {
    Bad {
        kind,
        files: vec![(file, bytes.into())],
        arguments: vec!["bake", file, "-o", "out.glb"],
        runs: |here, arguments| Some(run_in(here, FOLIAR, arguments)),
        status: 3,
        said: [file, place, remedy],
    }
}

impl Bad {
    /// Writes its files.
    fn write(&self, here: &Path) {
        self.files.iter().for_each(|(name, bytes)| std::fs::write(here.join(name), bytes).unwrap());
    }

    /// The same row with other words.
    fn saying(self, said: [&'static str; 3]) -> Bad {
        Bad { said, ..self }
    }

    /// The same row with a flag or more.
    fn with(mut self, flags: &[&'static str]) -> Bad {
        self.arguments.extend(flags);
        self
    }
}

/// Every kind of bad input: the table.
fn table() -> Vec<Bad> {
    let mut rows = texts();
    rows.extend(containers());
    rows.extend(documents());
    rows.extend(outside());
    rows.extend(materials());
    rows.extend(places());
    rows.extend(words());
    rows
}

/// The kinds that the table must hold.
const KINDS: [&str; 22] = [
    "truncated",
    "empty",
    "binary",
    "NaN",
    "1e30",
    "UTF-16",
    "huge count",
    "cyclic nodes",
    "accessor out of bounds",
    "missing .mtl",
    "looping .mtl",
    "bad texture",
    "outside the folder",
    "absolute path",
    "network URI",
    "read-only output",
    "full disk",
    "killed while writing",
    "closed pipe",
    "unknown key",
    "contradictory flags",
    "layer of another base",
];

fn texts() -> Vec<Bad> {
    let utf16: Vec<u8> = [0xfeff].into_iter().chain("v 0 0 0\n".encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let binary = [0u8, 159, 146, 150, 0, 1, 2, 3, 255, 254, 0, 0];
    vec![
        bad("truncated", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1\n", "line 3", "write all numbers"),
        bad("truncated", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4", "export it again"),
        bad("truncated", "a.gltf", "{", "line 1", "download it again"),
        bad("empty", "a.obj", "", "byte 0", "export or download it again"),
        bad("empty", "a.glb", "", "byte 0", "export or download it again"),
        bad("binary", "a.obj", binary, "byte 0", "format OBJ"),
        bad("binary", "a.glb", binary, "byte 0", "export or download it again"),
        bad("NaN", "a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "line 2", "finite"),
        bad("NaN", "a.glb", triangle_of(f32::NAN, |_| {}), "/accessors/0 element 1", "finite number"),
        bad("1e30", "a.obj", "v 0 0 0\nv 1 1e30 0\nv 0 1 0\nf 1 2 3\n", "line 2", "below 1e15"),
        bad("1e30", "a.glb", triangle_of(1e30, |_| {}), "/accessors/0 element 1", "of at most"),
        bad("UTF-16", "a.obj", utf16.clone(), "byte 0", "save it as UTF-8"),
        bad("UTF-16", "a.gltf", utf16, "byte 0", "save it as UTF-8"),
    ]
}

fn containers() -> Vec<Bad> {
    let good = glb(&json!({"asset": {"version": "2.0"}}), &[]);
    let word = |at: usize, value: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    vec![
        bad("truncated", "a.glb", &good[..good.len() / 2], "byte 8", "download it again"),
        bad("truncated", "a.glb", &good[..7], "byte 0", "download it again"),
        bad("huge count", "a.glb", word(8, u32::MAX), "byte 8", "download it again"),
        bad("huge count", "a.glb", word(12, 0xfff0_0000), "byte 12", "download it again"),
    ]
}

fn documents() -> Vec<Bad> {
    let count = |n: u64| triangle(|j| j["accessors"][0]["count"] = n.into());
    let cycle = triangle(|j| j["nodes"] = json!([{"mesh": 0, "children": [0]}]));
    let view = triangle(|j| j["accessors"][0]["bufferView"] = 7.into());
    let mesh = triangle(|j| j["nodes"][0]["mesh"] = 3.into());
    let buffer = triangle(|j| j["buffers"][0]["byteLength"] = 1_000_000_000_000_u64.into());
    vec![
        bad("huge count", "a.glb", count(4_000_000_000), "/accessors/0", "export it again"),
        bad("huge count", "a.glb", buffer, "/buffers/0", "export or download it again"),
        bad("cyclic nodes", "a.glb", cycle, "/nodes/0", "must form a tree"),
        bad("accessor out of bounds", "a.glb", count(4), "/accessors/0", "export it again"),
        bad("accessor out of bounds", "a.glb", view, "/bufferViews/7", "export it again"),
        bad("accessor out of bounds", "a.glb", mesh, "/nodes/0/mesh", "export it again"),
    ]
}

/// A GLB with a second buffer, and a tree with a texture, that lie where they must not.
fn outside() -> Vec<Bad> {
    const ALLOW: &str = "--search FOLDER";
    const SAVE: &str = "save the file beside the asset";
    let cases = [
        ("outside the folder", "../secret.bin", ALLOW),
        ("absolute path", "/etc/passwd", ALLOW),
        ("network URI", "https://example.invalid/a.bin", SAVE),
        ("network URI", "file:///etc/passwd", SAVE),
    ];
    let mut rows = Vec::new();
    for (kind, uri, remedy) in cases {
        let buffer = triangle(|j| j["buffers"] = json!([{"byteLength": 36}, {"byteLength": 4, "uri": uri}]));
        rows.push(bad(kind, "a.glb", buffer, "/buffers/1", remedy));
        let library = format!("newmtl bark\nmap_Kd {uri}\nnewmtl leaves\n");
        rows.push(with_library(kind, Some(&library), "line 2", remedy));
        let tree = tree_text(40).replace("tree.mtl", uri);
        rows.push(bad(kind, "tree.obj", tree, "line 1", remedy));
    }
    rows
}

/// The small tree with this material library.
fn with_library(kind: &'static str, library: Option<&str>, place: &'static str, remedy: &'static str) -> Bad {
    let mut row = bad(kind, "tree.obj", tree_text(40), place, remedy);
    row.files.extend(library.map(|text| ("tree.mtl", text.into())));
    row
}

/// Findings, with which a bake goes on unless a person forbids it.
fn materials() -> Vec<Bad> {
    let textured = "newmtl bark\nnewmtl leaves\nmap_Kd leaf.png\n";
    let looping = "mtllib tree.mtl\nnewmtl bark\nmtllib tree.mtl\nnewmtl leaves\n";
    let missing_texture = with_library("bad texture", Some(textured), "tree.mtl, line 3", "put it beside the asset");
    let mut bad_texture = with_library("bad texture", Some(textured), "tree.mtl, line 3", "convert it to PNG");
    bad_texture.files.push(("leaf.png", b"no picture".into()));
    let mut cut_texture = with_library("bad texture", Some(textured), "tree.mtl, line 3", "export the picture again");
    cut_texture.files.push(("leaf.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".into()));
    let rows = [
        with_library("missing .mtl", None, "tree.obj, line 1", "put it beside the asset"),
        with_library("looping .mtl", Some(looping), "tree.mtl, line 1", "name it in the OBJ"),
        with_library("looping .mtl", Some(looping), "tree.mtl, line 3", "name it in the OBJ"),
        missing_texture.saying(["leaf.png", "tree.mtl, line 3", "put it beside the asset"]),
        bad_texture.saying(["leaf.png", "tree.mtl, line 3", "convert it to PNG"]),
        cut_texture.saying(["leaf.png", "tree.mtl, line 3", "export the picture again"]),
    ];
    rows.map(|row| Bad { status: 1, ..row }.with(&["--fail-on", "warning"])).into()
}

/// Outputs that cannot be written.
fn places() -> Vec<Bad> {
    const WRITABLE: &str = "make the file and its folder writable, or choose another output";
    const SPACE: &str = "free some space, or choose another output";
    let row = |kind, runs, status, said| Bad { runs, status, said, ..with_library(kind, None, "", "") };
    let written = "out.glb: cannot be written";
    vec![
        row("read-only output", at_read_only_folder, 4, ["out.glb", written, WRITABLE]),
        row("read-only output", at_read_only_disk, 4, ["out.glb", written, WRITABLE]),
        row("full disk", at_full_disk, 4, ["out.glb", written, SPACE]),
        row("full disk", at_full_file, 4, ["out.glb", written, SPACE]),
        row("killed while writing", killed, -1, ["", "", ""]),
        row("closed pipe", through_closed_pipe, 0, ["", "", ""]),
    ]
}

/// Words of the command line and of the configuration, and files that do not belong together.
fn words() -> Vec<Bad> {
    let usage =
        |kind, flags: &[&'static str], said| Bad { status: 2, said, ..with_library(kind, None, "", "") }.with(flags);
    let mut unknown =
        usage("unknown key", &[], ["foliar.toml", ":3: density.exponnent", "did you mean density.exponent?"]);
    unknown.files.push(("foliar.toml", b"[density]\n\nexponnent = 2\n".into()));
    let set = ["--set", "import.unit=cm", "--set", "import.height_m=3"];
    let layer = Bad { runs: assemble_another, ..bad("layer of another base", "tree.obj", tree_text(40), "", "") };
    vec![
        unknown,
        usage(
            "unknown key",
            &["--set", "density.radus_m=1"],
            ["--set", "density.radus_m", "did you mean density.radius_m?"],
        ),
        usage("contradictory flags", &["--unit", "cm", "--height-m", "3"], ["--unit", "--height-m", "--help"]),
        usage("contradictory flags", &set, ["import.unit", "import.height_m", "give one of them"]),
        layer.saying(["density.layer", "baked from the base", "bake it again from this base"]),
    ]
}

/// Assembles a plant with the layer of another.
fn assemble_another(here: &Path, _: &[&str]) -> Option<Run> {
    let elsewhere = folder();
    std::fs::write(elsewhere.path().join("other.obj"), tree_text(41)).unwrap();
    let file = |name: &str| elsewhere.path().join(name);
    let (plant, layer) = (file("plant.glb"), file("density.layer"));
    run_in(here, IMPORT, &["tree.obj", "-o", text(&plant)]).expect(0, &[]);
    run_in(elsewhere.path(), DENSITY, &["other.obj", "-o", text(&layer)]).expect(0, &[]);
    Some(run_in(here, FOLIAR, &["assemble", text(&plant), text(&layer), "-o", "out.glb"]))
}

/// Every file of a folder and of those below it.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(contents(&path)),
            false => _ = found.insert(path.display().to_string(), std::fs::read(&path).unwrap()),
        }
    }
    found
}

#[test]
fn every_bad_input_has_its_status_and_message_and_leaves_the_old_output() {
    let rows = table();
    for kind in KINDS {
        assert!(rows.iter().any(|row| row.kind == kind), "no row for {kind}");
    }
    let wrong: Vec<String> = rows.iter().filter_map(deviation).collect();
    assert!(wrong.is_empty(), "{} of {} rows:\n{}", wrong.len(), rows.len(), wrong.join("\n"));
}

/// The checker reports what a bake refuses: it never fails itself, and writes nothing.
#[test]
fn what_cannot_be_baked_can_be_checked() {
    for row in table().iter().filter(|row| row.arguments.first() == Some(&"bake") && row.status == 3) {
        let here = folder();
        row.write(here.path());
        let before = contents(here.path());
        let (Some(file), true) =
            (row.arguments.get(1), row.files.iter().any(|(name, _)| Some(name) == row.arguments.get(1)))
        else {
            continue;
        };
        let run = run_in(here.path(), CHECK, &[file]);
        assert!([0, 1].contains(&run.status), "{}: {run:?}", row.kind);
        assert!(run.stdout.contains(&format!("{file}: ")), "{}: {run:?}", row.kind);
        assert_eq!(contents(here.path()), before, "{}", row.kind);
    }
}

/// What of a row does not come true, in words.
fn deviation(row: &Bad) -> Option<String> {
    let here = folder();
    row.write(here.path());
    std::fs::write(here.path().join("out.glb"), OLD).unwrap();
    let before = contents(here.path());
    let run = (row.runs)(here.path(), &row.arguments)?;
    let unsaid: Vec<&str> = row.said.into_iter().filter(|words| !run.stderr.contains(words)).collect();
    let untouched = contents(here.path()) == before;
    let is_right = run.status == row.status && unsaid.is_empty() && untouched && KINDS.contains(&row.kind);
    let (kind, status) = (row.kind, row.status);
    let words = || format!("{kind}: status {status} wanted, unsaid {unsaid:?}, files untouched: {untouched}; {run:?}");
    (!is_right).then(words)
}

/// What is only a finding goes on to a whole output.
#[test]
fn findings_do_not_stop_a_bake() {
    for (index, row) in materials().into_iter().enumerate() {
        let (here, out) = (folder(), output(&format!("bad-input-{index}.glb")));
        row.write(here.path());
        let run = run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", text(&out)]).expect(0, &row.said);
        assert!(run.stdout.contains("written"), "{}: {run:?}", row.kind);
        assert_eq!(foliar_carrier::second_reader::verify_file(&out).unwrap().leaves, 40, "{}", row.kind);
    }
}

/// One triangle of 36 bytes, with one thing changed.
fn triangle(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    triangle_of(1.0, change)
}

/// The same, its second corner that far along x.
fn triangle_of(x: f32, change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let mut json = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
    });
    change(&mut json);
    let corners = [0.0f32, 0.0, 0.0, x, 0.0, 0.0, 0.0, 1.0, 0.0];
    glb(&json, &corners.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<u8>>())
}

#[test]
fn further_inputs_are_refused() {
    let infinite = triangle(|j| j["nodes"][0]["translation"] = json!([1e308, 0, 0]));
    let draco = triangle(|j| {
        j["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        j["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0}});
    });
    let old = glb(&json!({"asset": {"version": "1.0"}}), &[]);
    for row in [
        bad("0 as index", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4", ""),
        bad("comma", "a.obj", "v 0,5 0 0\n", "line 1", "comma"),
        bad("old version", "a.glb", old, "/asset/version", "export it as glTF 2.0"),
        bad("far away", "a.glb", infinite, "position", "below 1e15 m"),
        bad("compressed", "a.glb", draco, "/meshes/0/primitives/0", "npx @gltf-transform/cli copy"),
    ] {
        let here = folder();
        row.write(here.path());
        run_in(here.path(), FOLIAR, &row.arguments).expect(row.status, &row.said);
        assert!(!here.path().join("out.glb").exists(), "{}", row.kind);
    }
}
