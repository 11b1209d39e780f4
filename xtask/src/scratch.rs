//! Scratch copies of the repository, for what must not happen to the tree that someone works on.

use crate::repo;
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A copy of the repository's files below target/, with a build folder of its own: cargo tells packages apart by
/// their places inside a workspace, and would take those of the copy for the originals.
pub struct Copy {
    home: PathBuf,
    folder: PathBuf,
}

impl Copy {
    /// Makes the copy `target/NAME/tree` equal to the work tree; files that are equal already keep their time stamps,
    /// so that cargo builds only what changed.
    pub fn refresh(name: &str) -> Result<Copy> {
        let home = repo::root().join("target").join(name);
        let copy = Copy { folder: home.join("tree"), home };
        let files = repo::files()?;
        for file in &files {
            copy.take(file)?;
        }
        copy.drop_others(&files)?;
        Ok(copy)
    }

    /// Where its files are.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Where cargo builds it.
    pub fn build_folder(&self) -> PathBuf {
        self.home.join("build")
    }

    /// A git that sees this copy and not the repository around it, whose ignored files these would be.
    pub fn git(&self) -> Command {
        let mut git = Command::new("git");
        git.current_dir(&self.folder).env("GIT_CEILING_DIRECTORIES", &self.home);
        git
    }

    /// A cargo that builds the copy.
    pub fn cargo(&self) -> Command {
        let mut cargo = repo::cargo();
        cargo.current_dir(&self.folder).env("CARGO_TARGET_DIR", self.build_folder());
        // cargo xtask sets these for us; inside the copy they would point back to the work tree.
        cargo.env_remove("CARGO_MANIFEST_DIR").env_remove("CARGO_MANIFEST_PATH");
        if std::env::var_os("FOLIAR_SHARED").is_none() {
            cargo.env("FOLIAR_SHARED", repo::shared());
        }
        cargo
    }

    /// Takes a file over from the work tree unless it is the same already.
    pub fn take(&self, file: &str) -> Result<()> {
        let bytes = std::fs::read(repo::root().join(file)).with_context(|| format!("{file} cannot be read"))?;
        let target = self.folder.join(file);
        if std::fs::read(&target).ok().as_ref() != Some(&bytes) {
            std::fs::create_dir_all(target.parent().context("a file lies in a folder")?)?;
            std::fs::write(&target, bytes).with_context(|| format!("{} cannot be written", target.display()))?;
        }
        Ok(())
    }

    /// Removes what the work tree does not have any more.
    fn drop_others(&self, files: &[String]) -> Result<()> {
        let mut folders = vec![self.folder.clone()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder)? {
                let path = entry?.path();
                let name = path.strip_prefix(&self.folder)?.to_string_lossy().into_owned();
                if path.is_dir() {
                    if !name.ends_with("node_modules") && name != "target" && name != ".git" {
                        folders.push(path);
                    }
                } else if files.binary_search(&name).is_err() {
                    std::fs::remove_file(&path)?;
                    // A folder that is left empty would still be a crate to cargo.
                    path.ancestors().skip(1).take_while(|above| std::fs::remove_dir(above).is_ok()).for_each(drop);
                }
            }
        }
        Ok(())
    }
}
