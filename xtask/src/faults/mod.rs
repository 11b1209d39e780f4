//! Planted faults: applies each patch of xtask/faults in a scratch copy, and demands that the command
//! it names goes red, and is green without it. A law without a planted fault does not count as tested.

mod fault;

use crate::repo;
use crate::scratch::Copy;
use anyhow::{Context, Result, bail};
use fault::Fault;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// What came of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    /// The command went red: the fault was seen.
    Caught,
    /// The command stayed green.
    Missed,
    /// The patch does not apply any more.
    Stale,
    /// The code with the fault does not build: that proves nothing.
    Unbuilt,
    /// A command before the last goes red: the last is not what sees the fault.
    Early,
    /// The command is red without the fault.
    RedBefore,
}

impl Verdict {
    fn words(self) -> &'static str {
        match self {
            Verdict::Caught => "caught",
            Verdict::Missed => "MISSED: the command stays green",
            Verdict::Stale => "STALE: the patch does not apply",
            Verdict::Unbuilt => "UNBUILT: does not compile, so proves nothing",
            Verdict::Early => "EARLY: a command before the last one goes red",
            Verdict::RedBefore => "RED BEFORE: the command fails without the fault",
        }
    }
}

/// Plants every fault whose name contains one of `names` (all where there are none), and prints what came of it.
pub fn run(names: &[String]) -> Result<()> {
    let faults = all()?;
    let is_named = |f: &&Fault| names.is_empty() || names.iter().any(|name| f.name.contains(name.as_str()));
    let chosen: Vec<&Fault> = faults.iter().filter(is_named).collect();
    if chosen.is_empty() {
        let all: Vec<&str> = faults.iter().map(|f| f.name.as_str()).collect();
        bail!("no fault is named like {}; there are {}", names.join(", "), all.join(", "));
    }
    let copy = Copy::refresh("faults")?;
    let mut green: BTreeMap<&[Vec<String>], bool> = BTreeMap::new();
    let mut verdicts = Vec::new();
    for fault in chosen {
        let is_green = match green.get(fault.commands.as_slice()) {
            Some(known) => *known,
            None => first_red(&copy, fault)?.is_none(),
        };
        green.insert(&fault.commands, is_green);
        let verdict = if is_green { plant(&copy, fault)? } else { Verdict::RedBefore };
        println!("{:<32} {:<28} {}", fault.name, fault.law, verdict.words());
        verdicts.push(verdict);
    }
    let caught = verdicts.iter().filter(|v| **v == Verdict::Caught).count();
    if caught < verdicts.len() {
        bail!("{} of {} planted faults were not caught", verdicts.len() - caught, verdicts.len());
    }
    println!("all {caught} planted faults were caught");
    Ok(())
}

/// Every fault, by name.
fn all() -> Result<Vec<Fault>> {
    let folder = repo::root().join("xtask/faults");
    let entries = std::fs::read_dir(&folder).context("xtask/faults cannot be listed")?;
    let mut patches: Vec<PathBuf> = entries.map(|e| Ok(e?.path())).collect::<Result<_>>()?;
    patches.retain(|p| p.extension().is_some_and(|e| e == "patch"));
    patches.sort();
    patches.iter().map(|path: &PathBuf| Fault::read(Path::new(path))).collect()
}

fn plant(copy: &Copy, fault: &Fault) -> Result<Verdict> {
    let mut git = copy.git();
    git.args(["apply", "--recount"]).arg(&fault.path).stderr(Stdio::null());
    if !git.status().context("git could not be started")?.success() {
        return Ok(Verdict::Stale);
    }
    let verdict = judge(copy, fault);
    fault.files.iter().try_for_each(|file| copy.take(file))?;
    verdict
}

fn judge(copy: &Copy, fault: &Fault) -> Result<Verdict> {
    for command in &fault.commands {
        if !builds(copy, command)? {
            return Ok(Verdict::Unbuilt);
        }
    }
    Ok(match first_red(copy, fault)? {
        None => Verdict::Missed,
        Some(at) if at + 1 < fault.commands.len() => Verdict::Early,
        Some(_) => Verdict::Caught,
    })
}

/// The first of a fault's commands that fails.
fn first_red(copy: &Copy, fault: &Fault) -> Result<Option<usize>> {
    for (index, command) in fault.commands.iter().enumerate() {
        if !passes(copy, command)? {
            return Ok(Some(index));
        }
    }
    Ok(None)
}

/// Whether everything that a command needs compiles.
fn builds(copy: &Copy, command: &[String]) -> Result<bool> {
    let mut build: Vec<String> = command.iter().take_while(|a| *a != "--").cloned().collect();
    match build[0].as_str() {
        "test" => build.push("--no-run".into()),
        _ => build[0] = "build".into(),
    }
    passes(copy, &build)
}

/// Whether a command ends with status 0.
fn passes(copy: &Copy, command: &[String]) -> Result<bool> {
    let mut cargo = copy.cargo();
    cargo.args(command).stdout(Stdio::null()).stderr(Stdio::null());
    Ok(cargo.status().context("cargo could not be started")?.success())
}
