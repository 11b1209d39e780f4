//! Runs the fuzz targets of tests/fuzz for a while each. What they need of a compiler is stable (the coverage pass of
//! LLVM); `cargo +nightly fuzz run --fuzz-dir tests/fuzz TARGET` does the same with the address sanitizer.

use crate::{repo, run_tests};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Each target, and the endings of files that it starts from.
const TARGETS: [(&str, &[&str]); 6] = [
    ("obj", &["obj"]),
    ("mtl", &["mtl"]),
    ("gltf", &["gltf", "glb"]),
    ("layer", &["layer"]),
    ("toml", &["toml"]),
    ("map", &["png", "exr", "tif"]),
];

/// Where files to start from lie.
const SEEDS: [&str; 4] = ["fixtures/check", "fixtures/linden", "tests/fuzz/found", "tests/fuzz/seeds"];

/// Longest input that is made up.
const MOST_BYTES: u64 = 64 << 10;

/// What makes a program tell libFuzzer where it has been.
const COVERAGE: &str = "--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Cdebug-assertions=yes -Coverflow-checks=yes";

/// Runs every target whose name contains `name` for so many seconds. What it finds lies in target/fuzz/found.
pub fn run(seconds: u64, name: Option<&str>) -> Result<()> {
    let host = repo::output(repo::cargo().arg("-vV"))?;
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).unwrap_or_default();
    let compiler = Command::new("c++").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    if !compiler.is_ok_and(|status| status.success()) || !host.contains("linux") {
        run_tests::skip("fuzzing: libFuzzer needs a C++ compiler, on Linux");
        return Ok(());
    }
    let home = repo::root().join("target/fuzz");
    let mut build = repo::cargo();
    build.args(["build", "--release", "--bins", "--target", host]).env("RUSTFLAGS", COVERAGE);
    build.env("CARGO_TARGET_DIR", &home).current_dir(repo::root().join("tests/fuzz"));
    if !build.status()?.success() {
        bail!("the fuzz targets do not build");
    }
    let mut crashed = Vec::new();
    for (target, endings) in TARGETS.iter().filter(|(target, _)| name.is_none_or(|name| target.contains(name))) {
        let program = home.join(host).join("release").join(target);
        if !fuzz(&program, &home, target, endings, seconds)? {
            crashed.push(*target);
        }
    }
    if !crashed.is_empty() {
        bail!("{} found inputs: mend what they break, and keep them in tests/fuzz/found", crashed.join(", "));
    }
    println!("fuzzing: nothing was found");
    Ok(())
}

/// Whether a target ran to its end.
fn fuzz(program: &Path, home: &Path, target: &str, endings: &[&str], seconds: u64) -> Result<bool> {
    let (corpus, found) = (home.join("corpus").join(target), home.join("found"));
    std::fs::create_dir_all(&corpus)?;
    std::fs::create_dir_all(&found)?;
    for seed in seeds(endings)? {
        std::fs::copy(&seed, corpus.join(seed.file_name().unwrap_or_default()))?;
    }
    println!("== {target}, {seconds} s");
    let mut command = Command::new(program);
    command.arg(&corpus).arg(format!("-artifact_prefix={}/{target}-", found.display()));
    command.arg(format!("-max_total_time={seconds}")).arg(format!("-max_len={MOST_BYTES}"));
    command.args(["-timeout=10", "-rss_limit_mb=1024", "-print_final_stats=1", "-verbosity=0"]);
    Ok(command.status()?.success())
}

/// Files to start from that are short enough.
fn seeds(endings: &[&str]) -> Result<Vec<PathBuf>> {
    let mut seeds = Vec::new();
    for folder in SEEDS {
        let entries = std::fs::read_dir(repo::root().join(folder)).into_iter().flatten().flatten();
        let files = entries.map(|entry| entry.path());
        let is_one = |file: &PathBuf| {
            file.extension().and_then(|e| e.to_str()).is_some_and(|ending| endings.contains(&ending))
                && file.metadata().is_ok_and(|data| data.is_file() && data.len() <= MOST_BYTES)
        };
        seeds.extend(files.filter(is_one));
    }
    seeds.sort();
    Ok(seeds)
}
