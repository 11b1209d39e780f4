//! The scratch copy that faults are planted in: never the tree that someone works on.

use super::fault::Fault;
use crate::repo;
use anyhow::{Context, Result};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A copy of the repository's files below target/, with a build folder of its own.
pub struct Copy {
    folder: PathBuf,
}

impl Copy {
    /// Makes the copy equal to the work tree; files that are equal already keep their time stamps,
    /// so that cargo builds only what changed.
    pub fn refresh() -> Result<Copy> {
        let copy = Copy { folder: repo::root().join("target/faults/tree") };
        let files = repo::files()?;
        for file in &files {
            copy.take(file)?;
        }
        copy.drop_others(&files)?;
        Ok(copy)
    }

    /// Plants a fault; false where the patch does not apply.
    pub fn apply(&self, fault: &Fault) -> Result<bool> {
        let mut git = Command::new("git");
        git.args(["apply", "--recount"]).arg(&fault.path).current_dir(&self.folder).stderr(Stdio::null());
        // Without a ceiling git would find the repository around the copy and skip every file.
        git.env("GIT_CEILING_DIRECTORIES", repo::root().join("target/faults"));
        Ok(git.status().context("git could not be started")?.success())
    }

    /// Takes a fault out again.
    pub fn restore(&self, fault: &Fault) -> Result<()> {
        fault.files.iter().try_for_each(|file| self.take(file))
    }

    /// Whether everything that a command needs compiles.
    pub fn builds(&self, command: &[String]) -> Result<bool> {
        let mut build: Vec<&str> = command.iter().map(String::as_str).take_while(|a| *a != "--").collect();
        match build[0] {
            "test" => build.push("--no-run"),
            _ => build[0] = "build",
        }
        self.cargo(&build)
    }

    /// Whether a command ends with status 0.
    pub fn passes(&self, command: &[String]) -> Result<bool> {
        self.cargo(&command.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn cargo(&self, arguments: &[&str]) -> Result<bool> {
        let mut cargo = repo::cargo();
        cargo.args(arguments).current_dir(&self.folder).stdout(Stdio::null()).stderr(Stdio::null());
        cargo.env("CARGO_TARGET_DIR", repo::root().join("target/faults/build"));
        // cargo xtask sets these for us; inside the copy they would point back to the work tree.
        cargo.env_remove("CARGO_MANIFEST_DIR").env_remove("CARGO_MANIFEST_PATH");
        if std::env::var_os("FOLIAR_SHARED").is_none() {
            cargo.env("FOLIAR_SHARED", repo::shared());
        }
        Ok(cargo.status().context("cargo could not be started")?.success())
    }

    /// Takes a file over from the work tree unless it is the same already.
    fn take(&self, file: &str) -> Result<()> {
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
                    if !name.ends_with("node_modules") && name != "target" {
                        folders.push(path);
                    }
                } else if files.binary_search(&name).is_err() {
                    std::fs::remove_file(&path)?;
                }
            }
        }
        Ok(())
    }
}
