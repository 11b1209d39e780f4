//! The page about CI: its hook and the line of its workflow, run as they stand there.

use crate::common::{CHECK, folder, run, run_in, skip, text, tree};
use crate::outsiders::{repository, starts};
use std::path::Path;
use std::process::Command;

const BROKEN: &str = "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n";

/// The first block of this language under a heading of docs/ci.md.
fn block(heading: &str, language: &str) -> String {
    let page = std::fs::read_to_string(repository().join("docs/ci.md")).unwrap();
    let section = page.split("\n## ").find(|section| section.starts_with(heading)).unwrap();
    let block = section.split(&format!("```{language}\n")).nth(1).unwrap();
    block.split("```").next().unwrap().to_string()
}

/// A repository of its own, whose commits find the programs under test.
struct Repository(tempfile::TempDir);

impl Repository {
    /// None where git or a shell is missing, said in words.
    fn new() -> Option<Self> {
        if !cfg!(unix) || !starts(Command::new("git").arg("--version")) || !starts(Command::new("xargs").arg("true")) {
            skip("the page about CI: needs git, a shell and xargs");
            return None;
        }
        let here = Repository(folder());
        assert!(here.git(&["init", "-q"]));
        Some(here)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn with_programs<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        let programs = Path::new(CHECK).parent().unwrap();
        let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap_or_default());
        command.current_dir(self.path()).env("PATH", path).env("GIT_CONFIG_GLOBAL", "/dev/null")
    }

    fn git(&self, arguments: &[&str]) -> bool {
        let who = ["-c", "user.name=a", "-c", "user.email=a@b"];
        starts(self.with_programs(Command::new("git").args(who).args(arguments)))
    }
}

#[cfg(unix)]
#[test]
fn the_hook_refuses_a_commit_of_a_broken_tree_and_no_other() {
    use std::os::unix::fs::PermissionsExt;
    let Some(here) = Repository::new() else { return };
    let hook = here.path().join(".git/hooks/pre-commit");
    std::fs::create_dir_all(hook.parent().unwrap()).unwrap();
    std::fs::write(&hook, block("A hook", "sh")).unwrap();
    std::fs::set_permissions(&hook, std::fs::Permissions::from_mode(0o755)).unwrap();
    tree(here.path(), 40);
    assert!(here.git(&["add", "-A"]) && here.git(&["commit", "-qm", "sound"]));
    std::fs::write(here.path().join("a broken one.obj"), BROKEN).unwrap();
    assert!(here.git(&["add", "-A"]) && !here.git(&["commit", "-qm", "broken"]), "a broken tree was committed");
    std::fs::write(here.path().join("notes.txt"), "nothing to check").unwrap();
    assert!(here.git(&["rm", "-q", "--cached", "a broken one.obj"]) && here.git(&["add", "notes.txt"]));
    assert!(here.git(&["commit", "-qm", "no foliage"]), "a commit without foliage was refused");
}

#[test]
fn the_line_of_the_workflow_writes_one_report_of_all_files() {
    let Some(here) = Repository::new() else { return };
    let workflow = block("A workflow", "yaml");
    let line = workflow.split("run: |\n").nth(1).unwrap().split("      - uses").next().unwrap();
    tree(here.path(), 40);
    std::fs::write(here.path().join("a broken one.obj"), BROKEN).unwrap();
    assert!(here.git(&["add", "-A"]));
    let passed = starts(here.with_programs(Command::new("bash").args(["-eo", "pipefail", "-c", line])));
    assert!(!passed, "an error stops the step");
    let report = std::fs::read_to_string(here.path().join("foliage.sarif")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let results = report["runs"][0]["results"].as_array().unwrap();
    let uri = |r: &serde_json::Value| r["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].clone();
    assert!(results.iter().any(|r| r["ruleId"] == "GEOMETRY-NAN" && uri(r) == "a%20broken%20one.obj"), "{report:#}");
    assert!(results.iter().any(|r| uri(r) == "tree.obj"), "{report:#}");
}

#[test]
fn what_the_page_says_of_a_project_is_taken() {
    let here = folder();
    let obj = tree(here.path(), 40);
    std::fs::write(here.path().join("foliar.toml"), block("What counts", "toml")).unwrap();
    let said = run_in(here.path(), CHECK, &[text(&obj)]).expect(1, &[]).stdout;
    assert!(said.contains("error[REQUIRED-MISSING]"), "{said}");
    run(CHECK, &[text(&obj), "--no-config"]).expect(0, &[]);
}
