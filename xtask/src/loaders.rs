//! Packed files in the hands of loaders that are not ours: three's GLTFLoader under node, and Blender (its
//! Python module bpy). Each compares what arrives with the numbers that a test wrote beside the file, as
//! `X.glb.expected.json`. What is not installed is said and skipped.

use crate::packages::{self, starts};
use crate::{repo, run_tests, validator};
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::process::Command;

const FOLDER: &str = "xtask/loaders";
/// Names the Python that has bpy; unset it is python3.
const PYTHON: &str = "BLENDER_PYTHON";
/// Blender 5.0.1 fails on some orders of a hash and not on others: so many are tried.
const HASH_SEEDS: [&str; 4] = ["0", "1", "2", "3"];

/// Loads every packed file that a test wrote.
pub fn run() -> Result<()> {
    let is_packed = |file: &PathBuf| PathBuf::from(format!("{}.expected.json", file.display())).exists();
    let files: Vec<PathBuf> = validator::outputs()?.into_iter().filter(is_packed).collect();
    if files.is_empty() {
        bail!("no test left a packed file in {}: run cargo test first", validator::OUTPUTS);
    }
    let mut bad = Vec::new();
    if starts(Command::new("node").arg("--version")) {
        packages::install(FOLDER, "three/package.json")?;
        let mut node = Command::new("node");
        if repo::run(node.arg(repo::root().join(FOLDER).join("three.mjs")).args(&files)).is_err() {
            bad.push("three");
        }
    } else {
        run_tests::skip("three: node is not installed (.ci/run installs it on Debian)");
    }
    let python = std::env::var(PYTHON).unwrap_or_else(|_| "python3".into());
    if !starts(Command::new(&python).args(["-c", "import bpy"])) {
        run_tests::skip(&format!(
            "Blender: {python} cannot import bpy: pip install bpy==5.0.1, for Python 3.11, or name another Python in {PYTHON}"
        ));
    } else if HASH_SEEDS.iter().any(|seed| blender(&python, seed, &files).is_err()) {
        bad.push("Blender");
    }
    if !bad.is_empty() {
        bail!("{} read something else than what was packed", bad.join(" and "));
    }
    Ok(())
}

/// Loads all files with Blender, its own chatter left out; what it says of them is printed for the first seed
/// and where it fails.
fn blender(python: &str, seed: &str, files: &[PathBuf]) -> Result<()> {
    let mut command = Command::new(python);
    command.arg(repo::root().join(FOLDER).join("blender.py")).args(files).env("PYTHONHASHSEED", seed);
    let output =
        command.current_dir(repo::root()).output().with_context(|| format!("{python} could not be started"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let failed = !output.status.success();
    let ours = |line: &&str| line.starts_with("Blender ") || (failed && line.contains("Error"));
    text.lines().filter(ours).filter(|_| failed || seed == HASH_SEEDS[0]).for_each(|line| println!("{line}"));
    if failed {
        let errors = String::from_utf8_lossy(&output.stderr);
        errors
            .lines()
            .rev()
            .find(|line| line.contains("Error"))
            .into_iter()
            .for_each(|line| println!("Blender: {line}"));
        bail!("Blender fails with PYTHONHASHSEED={seed}");
    }
    Ok(())
}
