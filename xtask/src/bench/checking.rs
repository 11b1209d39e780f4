//! Checking a large GLB.

use super::{Figure, allocations, least_seconds};
use crate::{fixtures, repo};
use anyhow::{Context, Result};
use foliar_check::{Settings, check};
use std::path::PathBuf;
use std::process::Command;

/// The size that the gates speak of.
const BYTES: f64 = 100e6;
/// What checking may take beside twice the file.
const MORE_BYTES: f64 = 200.0 * 1024.0 * 1024.0;

/// Seconds for each 100 MB of a baked tree, from bytes to findings.
pub fn seconds() -> Result<Figure> {
    let path = baked()?;
    let bytes = std::fs::read(&path)?;
    let size = bytes.len() as f64;
    let mut findings = 0;
    let seconds = least_seconds(3, || {
        findings = check(bytes.clone(), "large.glb", &path, &Settings::default(), None)?.findings.len();
        Ok(())
    })?;
    let peer = format!("none; {seconds:.3} s for {:.1} MB, {findings} findings", size / 1e6);
    Ok(Figure::new(seconds * BYTES / size, peer))
}

/// Peak memory over what is allowed, the file's own bytes included.
pub fn memory() -> Result<Figure> {
    let path = baked()?;
    let mut done = None;
    let peak = allocations::peak_bytes(|| {
        let read = std::fs::read(&path).context("the baked tree cannot be read");
        done = Some(read.and_then(|bytes| Ok(check(bytes, "large.glb", &path, &Settings::default(), None)?)));
    });
    done.context("nothing was checked")??;
    let size = std::fs::metadata(&path)?.len() as f64;
    let peer = format!("none; {:.1} MB for {:.1} MB", peak as f64 / 1e6, size / 1e6);
    Ok(Figure::new(peak as f64 / (2.0 * size + MORE_BYTES), peer))
}

/// The large tree of the reading benchmark with everything that a bake writes.
fn baked() -> Result<PathBuf> {
    let input = fixtures::write_large()?;
    let output = repo::root().join("target/bench/large.glb");
    std::fs::create_dir_all(repo::root().join("target/bench"))?;
    repo::run(repo::cargo().args(["build", "--release", "--quiet", "-p", "foliar-programs", "--bin", "foliar"]))?;
    let mut foliar = Command::new(repo::build_folder().join("release/foliar"));
    foliar.args(["bake", "--quiet", "--unit", "m", "--up", "y"]).arg(input).arg("-o").arg(&output);
    repo::run(repo::without_parameters(&mut foliar))?;
    Ok(output)
}
