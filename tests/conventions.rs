//! The conventions of every program (house rules, section 6): one walk over all programs and all flags.

use crate::common::{
    CHECK, DENSITY, FOLIAR, IMPORT, LEAFSCAN, NOISE, PACK, Run, TRANSLUCENCY, VIEW, folder, run_in, text, tree,
};
use crate::leafscan::leaf;
use crate::translucency::thickness;
use foliar_bake::Baker;
use foliar_programs::BAKERS;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// One command, run on a prepared folder.
#[derive(Clone)]
struct Case {
    /// As one types it.
    name: String,
    program: PathBuf,
    arguments: Vec<String>,
    /// The file that it writes; none where it only answers.
    output: Option<String>,
    /// Files that it reads, the project's configuration aside.
    reads: &'static [&'static str],
}

const OBJ: &[&str] = &["tree.obj", "tree.mtl"];

/// Commands that are no room's of a tree: as one types them, program, output and what they read.
#[rustfmt::skip]
const COMMANDS: [(&str, &str, Option<&str>, &[&str]); 15] = [
    ("foliar bake tree.obj -o bake.glb", FOLIAR, Some("bake.glb"), OBJ),
    ("foliar rebake baked.glb -o rebake.glb --up z", FOLIAR, Some("rebake.glb"), &["baked.glb"]),
    ("foliar assemble plant.glb density.layer -o assemble.gltf --up z", FOLIAR, Some("assemble.gltf"),
        &["plant.glb", "density.layer"]),
    ("foliar strip baked.glb -o strip.glb --up z", FOLIAR, Some("strip.glb"), &["baked.glb"]),
    ("foliar inspect tree.obj", FOLIAR, None, OBJ),
    ("foliar config tree.obj", FOLIAR, None, OBJ),
    ("foliar-import tree.obj -o import.glb", IMPORT, Some("import.glb"), OBJ),
    ("foliar-noise -o noise.png --size 64 --kmax 16", NOISE, Some("noise.png"), &[]),
    ("foliar-leafscan leaf.obj -o leaf.exr --resolution 32", LEAFSCAN, Some("leaf.exr"), &["leaf.obj"]),
    ("foliar-translucency tree.obj --thickness leaf.png --leaf-width-mm 60 --thickness-scale-mm 0.4 -o translucency.glb",
        TRANSLUCENCY, Some("translucency.glb"), &["tree.obj", "tree.mtl", "leaf.png"]),
    ("foliar-view tree.obj -o view.png --width-px 64 --height-px 48 --samples 1", VIEW, Some("view.png"), OBJ),
    ("foliar-pack baked.glb -o pack.glb --for core --up z", PACK, Some("pack.glb"), &["baked.glb"]),
    ("foliar-check tree.obj", CHECK, None, OBJ),
    ("foliar diff baked.glb baked.glb --up z", FOLIAR, None, &["baked.glb"]),
    ("foliar explain STALE", FOLIAR, None, &[]),
];

/// A case for each command, and one for each room of a tree.
fn cases() -> Vec<Case> {
    let command = |(typed, program, output, reads): (&str, &str, Option<&str>, &'static [&'static str])| {
        let words: Vec<&str> = typed.split(' ').collect();
        let named = if program == FOLIAR { 2 } else { 1 };
        Case {
            name: words[..named].join(" "),
            program: program.into(),
            arguments: words[1..].iter().map(|word| (*word).to_owned()).collect(),
            output: output.map(Into::into),
            reads,
        }
    };
    let room = |baker: &&dyn Baker| {
        let (name, output) = (format!("foliar-{}", baker.room()), format!("{}.glb", baker.room()));
        let program = Path::new(FOLIAR).with_file_name(format!("{name}{}", std::env::consts::EXE_SUFFIX));
        let arguments = ["tree.obj", "-o", &output].map(Into::into).into();
        Case { name, program, arguments, output: Some(output), reads: OBJ }
    };
    let rooms = BAKERS.iter().filter(|baker| baker.needs().plant).map(room);
    COMMANDS.into_iter().map(command).chain(rooms).collect()
}

/// Everything that the commands read, and a configuration.
fn prepared() -> tempfile::TempDir {
    let here = folder();
    tree(here.path(), 20);
    leaf(here.path(), &[]);
    thickness(here.path(), "leaf.png", 16, 0.1);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "baked.glb"]).expect(0, &[]);
    run_in(here.path(), IMPORT, &["tree.obj", "-o", "plant.glb"]).expect(0, &[]);
    run_in(here.path(), DENSITY, &["plant.glb", "-o", "density.layer"]).expect(0, &[]);
    std::fs::write(here.path().join("foliar.toml"), "[import]\nunit = 'm'\n").unwrap();
    here
}

impl Case {
    fn run(&self, here: &Path, flags: &[&str]) -> Run {
        let own: Vec<&str> = self.arguments.iter().map(String::as_str).collect();
        run_in(here, text(&self.program), &[&own, flags].concat())
    }

    /// Whether there is anything that findings could be about: its tree says neither unit nor up.
    fn reads_an_asset(&self) -> bool {
        !self.reads.is_empty()
    }

    fn written(&self, here: &Path) -> Option<Vec<u8>> {
        std::fs::read(here.join(self.output.as_ref()?)).ok()
    }
}

#[test]
fn the_walk_meets_every_command_of_every_program() {
    let fields = foliar_shell::config::Fields::new(BAKERS).unwrap();
    let mut all = Vec::new();
    for program in foliar_shell::Program::all(BAKERS) {
        let command = foliar_shell::commands(&program, BAKERS, &fields);
        let name = command.get_name().to_owned();
        let inner: Vec<_> = command.get_subcommands().filter(|sub| !sub.is_hide_set()).collect();
        match inner.as_slice() {
            [] => all.push(name),
            inner => all.extend(inner.iter().map(|sub| format!("{name} {}", sub.get_name()))),
        }
    }
    all.sort();
    let mut walked: Vec<String> = cases().into_iter().map(|case| case.name).collect();
    walked.sort();
    assert_eq!(all, walked, "a new command gets a row here");
}

#[test]
fn plans_and_checks_write_nothing() {
    let here = prepared();
    let here = here.path();
    for case in cases() {
        let Some(output) = case.output.as_deref() else {
            for flag in [&["--check"][..], &["--dry-run"], &["--outputs", "x.json"]] {
                case.run(here, flag).expect(2, &[flag[0]]);
            }
            continue;
        };
        let lists = ["--depfile", "t.d", "--outputs", "o.json"];
        let plan = case.run(here, &[&["--dry-run"], &lists[..]].concat()).expect(0, &[]);
        assert!(!plan.stdout.is_empty(), "{}: no plan", case.name);
        case.run(here, &[&["--check"], &lists[..]].concat()).expect(1, &["would change: ", output]);
        if case.reads_an_asset() {
            case.run(here, &["--fail-on", "note"]).expect(1, &["--fail-on: found IMPORT-", "nothing was written"]);
        }
        let left = [output, "t.d", "o.json"].map(|file| here.join(file).exists());
        assert_eq!(left, [false; 3], "{}: written by a plan or a check", case.name);
        case.run(here, &["--fail-on", "error"]).expect(0, &[]);
        case.run(here, &["--check"]).expect(0, &[]);
    }
}

#[test]
fn lists_name_what_was_read_and_made() {
    let here = prepared();
    let here = here.path();
    for case in cases() {
        let mut flags = vec!["--report", "r.json", "--depfile", "t.d", "-v"];
        flags.extend(case.output.iter().flat_map(|_| ["--outputs", "o.json"]));
        let run = case.run(here, &flags).expect(0, &["read: ", " s\n"]);
        let output = case.output.as_deref();
        let named = ["r.json", "t.d"].into_iter().chain(output).chain(output.map(|_| "o.json"));
        for file in named {
            assert!(run.stdout.contains(&format!("{file}: written")), "{}: {file} in {}", case.name, run.stdout);
        }
        let read = |name: &str| std::fs::read_to_string(here.join(name)).unwrap();
        let rule = read("t.d");
        let (target, files) = rule.trim_end().split_once(": ").unwrap();
        assert_eq!(target, output.unwrap_or("r.json"), "{}", case.name);
        let mut files: Vec<&str> = files.split(' ').map(|file| file.rsplit('/').next().unwrap()).collect();
        files.sort_unstable();
        let mut expected = [case.reads, &["foliar.toml"]].concat();
        expected.sort_unstable();
        assert_eq!(files, expected, "{}", case.name);
        let report: Value = serde_json::from_str(&read("r.json")).unwrap();
        let asset = &report["assets"][0];
        assert_eq!(asset["status"], if case.output.is_some() { "written" } else { "answered" }, "{}", case.name);
        assert!(!case.reads_an_asset() || asset["findings"][0]["code"].is_string(), "{}: {asset}", case.name);
        if case.output.is_some() {
            let listed: Vec<String> = serde_json::from_str(&read("o.json")).unwrap();
            assert_eq!(json!(listed), asset["outputs"], "{}", case.name);
            assert!(listed.iter().all(|file| here.join(file).exists()), "{}: {listed:?}", case.name);
            assert_eq!(listed.last().map(String::as_str), output, "{}: the commit is last", case.name);
        }
        for list in ["r.json", "t.d", "o.json"] {
            _ = std::fs::remove_file(here.join(list));
        }
    }
}

#[test]
fn every_program_speaks_in_every_format_or_not_at_all() {
    let here = prepared();
    let here = here.path();
    for case in cases() {
        let said = |format| case.run(here, &["--format", format]).expect(0, &[]).stdout;
        let line: Value = serde_json::from_str(&said("json")).unwrap();
        if let Some(output) = case.output.as_deref() {
            assert_eq!((&line["output"], &line["status"]), (&output.into(), &"written".into()), "{}", case.name);
        }
        let sarif: Value = serde_json::from_str(&said("sarif")).unwrap();
        let found = sarif["runs"][0]["results"][0]["ruleId"].is_string();
        assert_eq!(found, case.reads_an_asset(), "{}: {sarif}", case.name);
        assert!(said("junit").contains("<testcase"), "{}", case.name);
        assert_eq!(said("github").starts_with("::"), case.reads_an_asset(), "{}", case.name);
        let quiet = case.run(here, &["--quiet"]).expect(0, &[]);
        assert_eq!(quiet.stderr, "", "{}", case.name);
        assert!(case.output.is_none() || quiet.stdout.is_empty(), "{}: {}", case.name, quiet.stdout);
    }
}

#[test]
fn any_number_of_threads_gives_the_same() {
    let here = prepared();
    let here = here.path();
    for case in cases() {
        case.run(here, &["--threads", "0"]).expect(2, &["--threads"]);
        let made = ["1", "3"].map(|threads| {
            let run = case.run(here, &["--threads", threads]).expect(0, &[]);
            if case.output.is_some() { case.written(here) } else { Some(run.stdout.into_bytes()) }
        });
        assert!(made[0].is_some() && made[0] == made[1], "{}: threads change the result", case.name);
    }
}
