//! npm packages that checks use: each folder pins its own by package.json and lock.

use crate::repo;
use anyhow::{Context, Result};
use std::process::{Command, Stdio};

/// Folders whose packages the tests use, with a file that is there once they are installed.
const OF_TESTS: [(&str, &str); 2] =
    [("xtask/outsiders", "libxml2-wasm/package.json"), ("docs/examples/minimal", "three/package.json")];

/// Installs what a folder pins, unless this file of it is there.
pub fn install(folder: &str, file: &str) -> Result<()> {
    let at = repo::root().join(folder);
    if at.join("node_modules").join(file).exists() {
        return Ok(());
    }
    let mut npm = Command::new("npm");
    npm.args(["ci", "--no-audit", "--no-fund", "--silent", "--prefix"]).arg(&at);
    repo::run(&mut npm).with_context(|| format!("the npm packages of {folder} could not be installed"))
}

/// Installs what tests use; without it they say that they are skipped.
pub fn for_tests() -> Result<()> {
    for (folder, file) in OF_TESTS {
        if let Err(error) = install(folder, file) {
            println!("{error:#}: tests that use them will be skipped");
        }
    }
    Ok(())
}

/// Whether a command can be started and ends well.
pub fn starts(command: &mut Command) -> bool {
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|status| status.success())
}
