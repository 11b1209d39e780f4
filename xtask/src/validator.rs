//! The Khronos validator over every glTF that a test wrote. A file `X.glb.input` beside `X.glb` holds
//! the path of the foreign file that X was made from: X may then earn each complaint as often as it does.

use crate::{packages, repo};
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where tests leave what they wrote.
pub const OUTPUTS: &str = "target/foliar-test-outputs";
const FOLDER: &str = "xtask/validator";

/// Errors and warnings of one file: how often each code.
type Complaints = BTreeMap<String, u64>;

/// Validates every output of the tests.
pub fn run() -> Result<()> {
    let outputs = outputs()?;
    if outputs.is_empty() {
        bail!("no test left a .glb or .gltf in {OUTPUTS}: run cargo test first");
    }
    packages::install(FOLDER, "gltf-validator/package.json")?;
    let inputs: BTreeMap<&PathBuf, PathBuf> = outputs.iter().filter_map(|o| Some((o, input_of(o)?))).collect();
    let mut all: Vec<PathBuf> = outputs.iter().chain(inputs.values()).cloned().collect();
    all.sort();
    all.dedup();
    let complaints = validate(&all)?;
    let none = Complaints::new();
    let of = |file: &PathBuf| complaints.get(file).unwrap_or(&none);
    let mut bad = 0;
    for output in &outputs {
        let allowed = inputs.get(output).map_or(&none, of);
        for (code, count) in of(output).iter().filter(|(code, count)| allowed.get(*code).unwrap_or(&0) < count) {
            println!("{}: {count} x {code}", output.display());
            bad += 1;
        }
    }
    if bad > 0 {
        bail!("the validator complains {bad} times");
    }
    println!("validator: 0 errors, 0 warnings in {} files", outputs.len());
    Ok(())
}

/// Every .glb and .gltf below [`OUTPUTS`], sorted.
pub fn outputs() -> Result<Vec<PathBuf>> {
    let (mut found, mut folders) = (Vec::new(), vec![repo::root().join(OUTPUTS)]);
    while let Some(folder) = folders.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        for entry in entries {
            let path = entry.with_context(|| format!("{} cannot be listed", folder.display()))?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "glb" || e == "gltf") {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

fn input_of(output: &Path) -> Option<PathBuf> {
    let note = std::fs::read_to_string(format!("{}.input", output.display())).ok()?;
    Some(PathBuf::from(note.trim()))
}

fn validate(files: &[PathBuf]) -> Result<BTreeMap<PathBuf, Complaints>> {
    let mut node = Command::new("node");
    node.arg(repo::root().join(FOLDER).join("validate.mjs")).args(files);
    let printed = repo::output(&mut node)?;
    printed.lines().map(parse).collect()
}

fn parse(line: &str) -> Result<(PathBuf, Complaints)> {
    let report: Value = serde_json::from_str(line).context("the validator printed no JSON")?;
    let file = report["file"].as_str().context("the validator names no file")?;
    let counts = report["complaints"].as_object().into_iter().flatten();
    Ok((file.into(), counts.map(|(code, n)| (code.clone(), n.as_u64().unwrap_or(1))).collect()))
}
