//! The conventions of every program (house rules, section 6): one walk over all programs and all flags.

use crate::common::{
    CHECK, DENSITY, FOLIAR, IMPORT, LEAFSCAN, LIGHT, NOISE, PACK, Run, VIEW, WIND, folder, run_in, tree,
};
use crate::leafscan::leaf;
use foliar_programs::BAKERS;
use serde_json::{Value, json};
use std::path::Path;

/// One command, run on a prepared folder.
struct Case {
    /// As one types it.
    name: &'static str,
    program: &'static str,
    arguments: &'static [&'static str],
    /// The file that it writes; none where it only answers.
    output: Option<&'static str>,
    /// Files that it reads, the project's configuration aside.
    reads: &'static [&'static str],
}

const OBJ: &[&str] = &["tree.obj", "tree.mtl"];

#[rustfmt::skip]
const CASES: [Case; 17] = [
    Case { name: "foliar bake", program: FOLIAR, arguments: &["bake", "tree.obj", "-o", "bake.glb"],
        output: Some("bake.glb"), reads: OBJ },
    Case { name: "foliar rebake", program: FOLIAR, arguments: &["rebake", "baked.glb", "-o", "rebake.glb", "--up", "z"],
        output: Some("rebake.glb"), reads: &["baked.glb"] },
    Case { name: "foliar assemble", program: FOLIAR,
        arguments: &["assemble", "plant.glb", "density.layer", "-o", "assemble.gltf", "--up", "z"],
        output: Some("assemble.gltf"), reads: &["plant.glb", "density.layer"] },
    Case { name: "foliar strip", program: FOLIAR, arguments: &["strip", "baked.glb", "-o", "strip.glb", "--up", "z"],
        output: Some("strip.glb"), reads: &["baked.glb"] },
    Case { name: "foliar inspect", program: FOLIAR, arguments: &["inspect", "tree.obj"], output: None, reads: OBJ },
    Case { name: "foliar config", program: FOLIAR, arguments: &["config", "tree.obj"], output: None, reads: OBJ },
    Case { name: "foliar-import", program: IMPORT, arguments: &["tree.obj", "-o", "import.glb"],
        output: Some("import.glb"), reads: OBJ },
    Case { name: "foliar-density", program: DENSITY, arguments: &["tree.obj", "-o", "density.glb"],
        output: Some("density.glb"), reads: OBJ },
    Case { name: "foliar-wind", program: WIND, arguments: &["tree.obj", "-o", "wind.glb"],
        output: Some("wind.glb"), reads: OBJ },
    Case { name: "foliar-light", program: LIGHT, arguments: &["tree.obj", "-o", "light.glb"],
        output: Some("light.glb"), reads: OBJ },
    Case { name: "foliar-noise", program: NOISE, arguments: &["-o", "noise.png", "--size", "64", "--kmax", "16"],
        output: Some("noise.png"), reads: &[] },
    Case { name: "foliar-leafscan", program: LEAFSCAN, arguments: &["leaf.obj", "-o", "leaf.exr", "--resolution", "32"],
        output: Some("leaf.exr"), reads: &["leaf.obj"] },
    Case { name: "foliar-view", program: VIEW,
        arguments: &["tree.obj", "-o", "view.png", "--width-px", "64", "--height-px", "48", "--samples", "1"],
        output: Some("view.png"), reads: OBJ },
    Case { name: "foliar-pack", program: PACK, arguments: &["baked.glb", "-o", "pack.glb", "--for", "core", "--up", "z"],
        output: Some("pack.glb"), reads: &["baked.glb"] },
    Case { name: "foliar-check", program: CHECK, arguments: &["tree.obj"], output: None,
        reads: &["tree.obj", "tree.mtl"] },
    Case { name: "foliar diff", program: FOLIAR, arguments: &["diff", "baked.glb", "baked.glb", "--up", "z"],
        output: None, reads: &["baked.glb"] },
    Case { name: "foliar explain", program: FOLIAR, arguments: &["explain", "STALE"], output: None, reads: &[] },
];

/// Everything that the commands read, and a configuration.
fn prepared() -> tempfile::TempDir {
    let here = folder();
    tree(here.path(), 20);
    leaf(here.path(), &[]);
    run_in(here.path(), FOLIAR, &["bake", "tree.obj", "-o", "baked.glb"]).expect(0, &[]);
    run_in(here.path(), IMPORT, &["tree.obj", "-o", "plant.glb"]).expect(0, &[]);
    run_in(here.path(), DENSITY, &["plant.glb", "-o", "density.layer"]).expect(0, &[]);
    std::fs::write(here.path().join("foliar.toml"), "[import]\nunit = 'm'\n").unwrap();
    here
}

impl Case {
    fn run(&self, here: &Path, flags: &[&str]) -> Run {
        run_in(here, self.program, &[self.arguments, flags].concat())
    }

    /// Whether there is anything that findings could be about: its tree says neither unit nor up.
    fn reads_an_asset(&self) -> bool {
        !self.reads.is_empty()
    }

    fn written(&self, here: &Path) -> Option<Vec<u8>> {
        std::fs::read(here.join(self.output?)).ok()
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
    let mut walked = CASES.map(|case| case.name);
    walked.sort_unstable();
    assert_eq!(all, walked, "a new command gets a row here");
}

#[test]
fn plans_and_checks_write_nothing() {
    let here = prepared();
    let here = here.path();
    for case in CASES {
        let Some(output) = case.output else {
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
    for case in CASES {
        let mut flags = vec!["--report", "r.json", "--depfile", "t.d", "-v"];
        flags.extend(case.output.iter().flat_map(|_| ["--outputs", "o.json"]));
        let run = case.run(here, &flags).expect(0, &["read: ", " s\n"]);
        let named = ["r.json", "t.d"].into_iter().chain(case.output).chain(case.output.map(|_| "o.json"));
        for file in named {
            assert!(run.stdout.contains(&format!("{file}: written")), "{}: {file} in {}", case.name, run.stdout);
        }
        let read = |name: &str| std::fs::read_to_string(here.join(name)).unwrap();
        let rule = read("t.d");
        let (target, files) = rule.trim_end().split_once(": ").unwrap();
        assert_eq!(target, case.output.unwrap_or("r.json"), "{}", case.name);
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
            assert_eq!(listed.last().map(String::as_str), case.output, "{}: the commit is last", case.name);
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
    for case in CASES {
        let said = |format| case.run(here, &["--format", format]).expect(0, &[]).stdout;
        let line: Value = serde_json::from_str(&said("json")).unwrap();
        if let Some(output) = case.output {
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
    for case in CASES {
        case.run(here, &["--threads", "0"]).expect(2, &["--threads"]);
        let made = ["1", "3"].map(|threads| {
            let run = case.run(here, &["--threads", threads]).expect(0, &[]);
            if case.output.is_some() { case.written(here) } else { Some(run.stdout.into_bytes()) }
        });
        assert!(made[0].is_some() && made[0] == made[1], "{}: threads change the result", case.name);
    }
}
