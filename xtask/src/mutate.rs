//! Mutates the shared trees and gives them to the programs (tests/fuzz/src).

#[path = "../../tests/fuzz/src/cases.rs"]
mod cases;
#[path = "../../tests/fuzz/src/mutate.rs"]
#[expect(clippy::module_inception, reason = "the file's name where it lives")]
mod mutate;

use crate::{repo, run_tests};
use anyhow::{Context, Result, bail};
use cases::{Ground, Seed, make, seeds};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The tree that a plant, layers and a master are made of.
const MADE_OF: &str = "proctree_default";

/// Runs so many cases over the shared trees, after each file as it is, and names those that went wrong.
pub fn run(count: u64) -> Result<()> {
    let trees = repo::shared().join("trees");
    if !trees.is_dir() {
        run_tests::skip("mutation of real files: no shared trees (FOLIAR_SHARED)");
        return Ok(());
    }
    repo::run(repo::cargo().args(["build", "--release", "--quiet", "--package", "foliar-programs", "--bins"]))?;
    let home = repo::root().join("target/mutate");
    _ = std::fs::remove_dir_all(&home);
    let ground = Ground { programs: repo::build_folder().join("release"), scratch: home.join("cases") };
    let mut folders: Vec<PathBuf> = std::fs::read_dir(&trees)?.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    folders.retain(|folder| folder.is_dir());
    folders.sort();
    let first = std::fs::read_dir(trees.join(MADE_OF))?.filter_map(|e| Some(e.ok()?.path()));
    let tree = first.filter(|f| f.extension().is_some_and(|e| e == "obj" || e == "glb")).min();
    make(&ground.programs, &tree.with_context(|| format!("{MADE_OF} holds no tree"))?, &home.join("made"))?;
    folders.extend([home.join("made"), home.join("made/master"), home.join("made/maps")]);
    let seeds = seeds(&folders)?;
    let found = walk(&ground, &seeds, count)?;
    found.iter().for_each(|wrong| println!("{wrong}"));
    if !found.is_empty() {
        bail!("{} of {count} cases went wrong; each can be repeated: cargo xtask mutate {count}", found.len());
    }
    println!("{count} mutated files: every program ended in time, in bounds and without a fault of its own");
    Ok(())
}

/// What went wrong, in the order of the cases.
fn walk(ground: &Ground, seeds: &[Seed], count: u64) -> Result<Vec<String>> {
    let (next, found) = (AtomicU64::new(0), Mutex::new(Vec::new()));
    let work = || -> Result<()> {
        loop {
            let case = next.fetch_add(1, Relaxed);
            if case >= seeds.len() as u64 + count {
                return Ok(());
            }
            // First every file as it is, then every case.
            let (number, seed) = match case.checked_sub(seeds.len() as u64) {
                None => (0, &seeds[case as usize]),
                Some(case) => (case + 1, &seeds[case as usize % seeds.len()]),
            };
            let other: &Path = &seeds[(case as usize * 7 + 3) % seeds.len()].file;
            if let Some(wrong) = ground.judge(seed, other, number, &format!("case-{case}"))? {
                println!("{wrong}");
                found
                    .lock()
                    .map(|mut found| found.push((case, wrong)))
                    .map_err(|_| anyhow::anyhow!("a thread died"))?;
            }
        }
    };
    let threads = std::thread::available_parallelism()?.get();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().try_for_each(|worker| worker.join().map_err(|_| anyhow::anyhow!("a thread died"))?)
    })?;
    let mut found = found.into_inner().map_err(|_| anyhow::anyhow!("a thread died"))?;
    found.sort();
    Ok(found.into_iter().map(|(_, wrong)| wrong).collect())
}
