//! Everything that must pass before work is handed in, one step after the other.

use crate::{fixtures, generated, loaders, new_baker, packages, repo, tidy, validator, with_foliar};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};

type Step = (&'static str, fn() -> Result<()>);

/// In the order in which a person wants to hear of a fault.
const STEPS: [Step; 12] = [
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
    ("npm packages", packages::for_tests),
    ("tests", tests),
    ("validator", validator::run),
    ("second reader", || with_foliar::run("second-reader", None)),
    ("loaders", loaders::run),
    ("new baker", new_baker::trial),
];

/// Runs every step, even after one failed, and names those that did. What was skipped stands in the last
/// lines, since cargo keeps to itself what a passing test says.
pub fn run() -> Result<()> {
    let mut failed = Vec::new();
    for (name, step) in STEPS {
        println!("== {name}");
        if let Err(error) = step() {
            eprintln!("error: {name}: {error:#}");
            failed.push(name);
        }
    }
    let skipped = std::fs::read_to_string(skipped_list()).unwrap_or_default();
    print!("{skipped}");
    if !failed.is_empty() {
        bail!("{} of {} steps failed: {}", failed.len(), STEPS.len(), failed.join(", "));
    }
    println!("all {} steps passed{}", STEPS.len(), if skipped.is_empty() { "" } else { ", but for what was skipped" });
    Ok(())
}

/// Says that something was skipped, now and in the last lines.
pub fn skip(why: &str) {
    println!("skipped: {why}");
    let list = std::fs::File::options().create(true).append(true).open(skipped_list());
    // Where the list cannot be written, the line above has said it.
    _ = list.and_then(|mut list| writeln!(list, "skipped: {why}"));
}

/// Where the step `tests` leaves what was skipped.
fn skipped_list() -> PathBuf {
    repo::root().join("target/skipped.txt")
}

/// All tests, on a clean folder of outputs: the validator must not judge yesterday's.
fn tests() -> Result<()> {
    let _ = std::fs::remove_dir_all(repo::root().join(validator::OUTPUTS));
    let _ = std::fs::remove_file(skipped_list());
    let mut command = repo::cargo();
    command.args(["test", "--workspace", "--all-features", "--quiet", "--", "--show-output"]);
    command.current_dir(repo::root()).stdout(Stdio::piped());
    let mut child = command.spawn().context("cargo could not be started")?;
    let mut sieve = Sieve::default();
    if let Some(output) = child.stdout.take() {
        for line in BufReader::new(output).split(b'\n') {
            let line = String::from_utf8_lossy(&line?).into_owned();
            if sieve.shows(&line) {
                println!("{line}");
            }
        }
    }
    let list: String = sieve.skipped.iter().map(|line| format!("{line}\n")).collect();
    std::fs::create_dir_all(repo::root().join("target"))?;
    std::fs::write(skipped_list(), list).context("the list of skipped tests cannot be written")?;
    let status = child.wait()?;
    if !status.success() {
        bail!("{} ended with {status}", repo::line(&command));
    }
    Ok(())
}

/// Takes what passing tests say out of the output of `cargo test -- --show-output`, and keeps what was skipped.
#[derive(Debug, Default)]
struct Sieve {
    /// Inside what passing tests say.
    passing: bool,
    /// Each reason once.
    skipped: BTreeSet<String>,
}

impl Sieve {
    /// Whether a line is for people.
    fn shows(&mut self, line: &str) -> bool {
        if line.starts_with("skipped: ") {
            self.skipped.insert(line.to_owned());
        }
        match line {
            "successes:" => self.passing = true,
            "failures:" => self.passing = false,
            _ if line.starts_with("test result: ") => self.passing = false,
            _ => {}
        }
        !self.passing
    }
}

fn cargo(arguments: &[&str]) -> Result<()> {
    let mut command: Command = repo::cargo();
    repo::run(command.args(arguments))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_skipped_is_kept_and_other_talk_of_passing_tests_is_not_shown() {
        let output = "\nrunning 2 tests\n..\nsuccesses:\n\n---- a stdout ----\nskipped: b, no shared data\nchatter\n\n\n\
            successes:\n    a\n\nfailures:\n\n---- c stdout ----\nleft: 1\n\ntest result: FAILED.";
        let mut sieve = Sieve::default();
        let shown: Vec<&str> = output.lines().filter(|line| sieve.shows(line)).collect();
        assert_eq!(sieve.skipped.into_iter().collect::<Vec<_>>(), ["skipped: b, no shared data"]);
        let kept =
            ["", "running 2 tests", "..", "failures:", "", "---- c stdout ----", "left: 1", "", "test result: FAILED."];
        assert_eq!(shown, kept);
    }
}
