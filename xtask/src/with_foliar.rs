//! Chores that run foliar itself: they need this program built with the feature `foliar`, in release where
//! they measure or draw.

use crate::repo;
use anyhow::Result;

/// Runs a chore; a program without the feature builds and runs one that has it.
#[cfg(not(feature = "foliar"))]
pub fn run(chore: &str, name: Option<&str>) -> Result<()> {
    let mut cargo = repo::cargo();
    cargo.args(["run", "--quiet", "--package", "xtask", "--features", "foliar"]);
    if chore != "second-reader" && chore != "accuracy" {
        cargo.arg("--release");
    }
    repo::run(cargo.args(["--", chore]).args(name))
}

/// Runs a chore.
#[cfg(feature = "foliar")]
pub fn run(chore: &str, name: Option<&str>) -> Result<()> {
    use crate::{accuracy, bench, gallery, second_reading, tradeoff};
    match chore {
        // Figures of an unoptimized build say nothing.
        "bench" | "gallery" | "tradeoff" if cfg!(debug_assertions) => {
            let mut cargo = repo::cargo();
            cargo.args(["run", "--quiet", "--release", "--package", "xtask", "--features", "foliar", "--", chore]);
            repo::run(cargo.args(name))
        }
        "accuracy" => accuracy::run(name),
        "bench" => bench::run(name),
        "gallery" => gallery::run(name),
        "tradeoff" => tradeoff::run(name),
        _ => second_reading::run(),
    }
}
