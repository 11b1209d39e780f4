//! Planted faults fit the code that they break: a patch that does not apply any more proves nothing, and
//! `cargo xtask faults` is too slow to say so every day.

use anyhow::{Context, Result};
use std::path::Path;
use std::process::Command;

/// Complaints about the patches below `root`.
pub fn check(root: &Path, files: &[String]) -> Result<Vec<String>> {
    let patches = files.iter().filter(|file| file.starts_with("xtask/faults/") && file.ends_with(".patch"));
    let checked: Result<Vec<Option<String>>> = patches.map(|patch| complaint(root, patch)).collect();
    Ok(checked?.into_iter().flatten().collect())
}

fn complaint(root: &Path, patch: &str) -> Result<Option<String>> {
    let mut git = Command::new("git");
    git.args(["apply", "--check", "--recount", patch]).current_dir(root);
    let output = git.output().context("git could not be started")?;
    let said = String::from_utf8_lossy(&output.stderr);
    let why = said.lines().next().unwrap_or_default().trim_start_matches("error: ");
    Ok((!output.status.success()).then(|| format!("{patch}: does not apply any more ({why}): mend it to the code")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stale_patch_is_named_and_a_fitting_one_is_not() {
        let here = tempfile::tempdir().unwrap();
        let patch = |old: &str| format!("law: x\n\n--- a/code.rs\n+++ b/code.rs\n@@ -1,1 +1,1 @@\n-{old}\n+broken\n");
        std::fs::create_dir_all(here.path().join("xtask/faults")).unwrap();
        std::fs::write(here.path().join("code.rs"), "right\n").unwrap();
        std::fs::write(here.path().join("xtask/faults/fits.patch"), patch("right")).unwrap();
        std::fs::write(here.path().join("xtask/faults/stale.patch"), patch("other")).unwrap();
        let files = ["code.rs", "xtask/faults/fits.patch", "xtask/faults/stale.patch"].map(String::from);
        let complaints = check(here.path(), &files).unwrap();
        assert_eq!(complaints.len(), 1, "{complaints:?}");
        assert!(complaints[0].starts_with("xtask/faults/stale.patch: does not apply any more"), "{complaints:?}");
    }
}
