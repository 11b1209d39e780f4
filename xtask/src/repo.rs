//! The repository: its root, its files, and commands run in it.

use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder that holds the workspace's Cargo.toml.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

/// Files of the repository, tracked or about to be, relative to [`root`], sorted.
pub fn files() -> Result<Vec<String>> {
    let listed = output(Command::new("git").args(["ls-files", "-z", "-co", "--exclude-standard"]))?;
    let mut files: Vec<String> = listed.split('\0').filter(|f| !f.is_empty()).map(Into::into).collect();
    files.retain(|file| root().join(file).is_file());
    files.sort();
    files.dedup();
    Ok(files)
}

/// The text of a file of the repository.
pub fn text(file: &str) -> Result<String> {
    std::fs::read_to_string(root().join(file)).with_context(|| format!("{file} cannot be read"))
}

/// Runs a command in the root, its output going to the terminal.
pub fn run(command: &mut Command) -> Result<()> {
    let status = command.current_dir(root()).status().with_context(|| missing(command))?;
    if !status.success() {
        bail!("{} ended with {status}", line(command));
    }
    Ok(())
}

/// Runs a command in the root and gives what it printed.
pub fn output(command: &mut Command) -> Result<String> {
    let output = command.current_dir(root()).output().with_context(|| missing(command))?;
    if !output.status.success() {
        bail!("{} ended with {}: {}", line(command), output.status, String::from_utf8_lossy(&output.stderr));
    }
    String::from_utf8(output.stdout).with_context(|| format!("{} did not print UTF-8", line(command)))
}

/// A command to run cargo with: the one that runs us.
pub fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A command that hears nothing of foliar's parameters in the environment: what it makes is the same everywhere.
pub fn without_parameters(command: &mut Command) -> &mut Command {
    let ours = std::env::vars_os().map(|(name, _)| name).filter(|name| name.to_string_lossy().starts_with("FOLIAR_"));
    ours.fold(command, |command, name| command.env_remove(name))
}

/// The command as one would type it.
pub fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|w| w.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ")
}

fn missing(command: &Command) -> String {
    let program = command.get_program().to_string_lossy().into_owned();
    format!("{program} could not be started: is it installed? (.ci/run installs what is missing on Debian)")
}

/// Folder that cargo builds into: CARGO_TARGET_DIR, else target.
pub fn build_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// Folder of shared test data: FOLIAR_SHARED, else ../shared beside the repository.
pub fn shared() -> PathBuf {
    std::env::var_os("FOLIAR_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from)
}
