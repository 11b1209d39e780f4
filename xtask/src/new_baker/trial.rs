//! Writes a room in a scratch copy and demands that what was written is what it is said to be.

use crate::repo;
use crate::scratch::Copy;
use anyhow::{Context, Result, bail};
use std::path::Path;
use std::process::Command;

/// A name that no room will have.
const NAME: &str = "trial";
/// Package of that room.
const PACKAGE: &str = "foliar-trial";

/// Writes a room in a copy, and runs there what a room must pass: rules, lints, laws, the walks over all programs, a
/// bake and the check of what was baked. No file is touched by hand in between.
pub fn trial() -> Result<()> {
    let copy = Copy::refresh("new-baker")?;
    // Built crates of registries do not depend on the place of a workspace: they need not be built again.
    seed(&repo::build_folder(), &copy.build_folder());
    run(copy.git().args(["init", "--quiet"]))?;
    let chore = ["run", "--quiet", "--package", "xtask", "--"];
    run(copy.cargo().args(chore).args(["new-baker", NAME]))?;
    run(copy.cargo().args(["fmt", "--all", "--check"]))?;
    run(copy.cargo().args(chore).arg("tidy"))?;
    run(copy.cargo().args(["clippy", "--quiet", "--all-targets", "-p", PACKAGE, "--", "-D", "warnings"]))?;
    run(copy.cargo().args(["test", "--quiet", "-p", PACKAGE, "-p", "foliar-schema"]))?;
    run(copy.cargo().args(["test", "--quiet", "-p", "foliar-programs", "--lib", "--test", "e2e", "--"]).args(WALKS))?;
    let (tree, baked) = ("fixtures/linden/linden.obj", "target/trial.glb");
    let program = |name: &str| Command::new(copy.build_folder().join("debug").join(name));
    std::fs::create_dir_all(copy.folder().join("target"))?;
    let run = |name: &str, words: &[&str]| {
        run(repo::without_parameters(program(name).current_dir(copy.folder()).args(words)))
    };
    run("foliar", &["bake", tree, "-o", baked])?;
    run("foliar-check", &[baked, "--require", NAME])
}

/// Tests that walk over all rooms, programs and channels.
const WALKS: [&str; 4] = ["bake::", "conventions::", "generate::", "registry"];

fn run(command: &mut Command) -> Result<()> {
    let line = repo::line(command);
    let status = command.status().with_context(|| format!("{line} could not be started"))?;
    if !status.success() {
        bail!("in a copy with a new room, {line} ended with {status}");
    }
    Ok(())
}

/// Hard-links what cargo built of crates that are not ours, from one build folder into another: where that is not
/// possible, cargo builds them again.
fn seed(from: &Path, to: &Path) {
    for kind in [".fingerprint", "build", "deps"] {
        let (from, to) = (from.join("debug").join(kind), to.join("debug").join(kind));
        let entries = std::fs::read_dir(from).into_iter().flatten().flatten();
        for entry in entries.filter(|entry| !is_ours(&entry.file_name().to_string_lossy())) {
            link(&entry.path(), &to.join(entry.file_name()));
        }
    }
}

/// Whether a built file belongs to a package of the workspace, whose content differs in the copy.
fn is_ours(file: &str) -> bool {
    let name = file.strip_prefix("lib").unwrap_or(file);
    ["foliar", "xtask", "e2e"].iter().any(|ours| name.starts_with(ours))
}

fn link(from: &Path, to: &Path) {
    if from.is_dir() {
        for entry in std::fs::read_dir(from).into_iter().flatten().flatten() {
            link(&entry.path(), &to.join(entry.file_name()));
        }
    } else if !to.exists() {
        _ = to.parent().map(std::fs::create_dir_all);
        _ = std::fs::hard_link(from, to);
    }
}
