//! Everything that must pass before work is handed in, one step after the other.

use crate::{fixtures, generated, repo, tidy, validator, with_foliar};
use anyhow::{Result, bail};
use std::process::Command;

type Step = (&'static str, fn() -> Result<()>);

/// In the order in which a person wants to hear of a fault.
const STEPS: [Step; 9] = [
    ("format", || cargo(&["fmt", "--all", "--check"])),
    ("tidy", tidy::run),
    ("lints", || {
        cargo(&["clippy", "--workspace", "--all-targets", "--all-features", "--quiet", "--", "-D", "warnings"])
    }),
    ("documents", || {
        repo::run(repo::cargo().args(["doc", "--workspace", "--no-deps", "--quiet"]).env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("generated documents", || generated::run(true)),
    ("fixtures", fixtures::check),
    ("tests", tests),
    ("validator", validator::run),
    ("second reader", || with_foliar::run("second-reader", None)),
];

/// Runs every step, even after one failed, and names those that did.
pub fn run() -> Result<()> {
    let mut failed = Vec::new();
    for (name, step) in STEPS {
        println!("== {name}");
        if let Err(error) = step() {
            eprintln!("error: {name}: {error:#}");
            failed.push(name);
        }
    }
    if !failed.is_empty() {
        bail!("{} of {} steps failed: {}", failed.len(), STEPS.len(), failed.join(", "));
    }
    println!("all {} steps passed", STEPS.len());
    Ok(())
}

/// All tests, on a clean folder of outputs: the validator must not judge yesterday's.
fn tests() -> Result<()> {
    let _ = std::fs::remove_dir_all(repo::root().join(validator::OUTPUTS));
    let result = cargo(&["test", "--workspace", "--all-features", "--quiet"]);
    print_skipped();
    result
}

/// The end-to-end tests that had nothing to run on, which cargo keeps to itself when they pass.
fn print_skipped() {
    let list = std::fs::read_to_string(repo::root().join(validator::OUTPUTS).join("skipped.txt")).unwrap_or_default();
    let mut lines: Vec<&str> = list.lines().collect();
    lines.sort_unstable();
    lines.dedup();
    for line in lines {
        println!("skipped: {line}");
    }
}

fn cargo(arguments: &[&str]) -> Result<()> {
    let mut command: Command = repo::cargo();
    repo::run(command.args(arguments))
}
