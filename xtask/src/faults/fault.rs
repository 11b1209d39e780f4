//! One planted fault: a patch whose head names the law it breaks and the commands of which the last must go red.

use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// A planted fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// File name without its ending.
    pub name: String,
    /// The law or gate that it breaks.
    pub law: String,
    /// Arguments of cargo, one list per command: the last must fail, those before it prepare what it judges
    /// and must not see the fault.
    pub commands: Vec<Vec<String>>,
    /// The patch.
    pub path: PathBuf,
    /// Files that it touches, relative to the root.
    pub files: Vec<String>,
}

impl Fault {
    /// Reads a patch and its head: `law: ...` and one or more `command: test -p ...`.
    pub fn read(path: &Path) -> Result<Fault> {
        let text = std::fs::read_to_string(path).with_context(|| format!("{} cannot be read", path.display()))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        parse(&text, name, path).with_context(|| {
            format!("{}: a fault starts with the lines `law: ...` and `command: ...`, then its diff", path.display())
        })
    }
}

fn parse(text: &str, name: String, path: &Path) -> Option<Fault> {
    let all = |key: &'static str| text.lines().filter_map(move |line| line.strip_prefix(key)).map(str::trim);
    let files: Vec<String> = all("--- a/").map(Into::into).collect();
    let words = |command: &str| command.split_whitespace().map(Into::into).collect();
    let commands: Vec<Vec<String>> = all("command:").map(words).collect();
    let law = all("law:").next()?.into();
    (!files.is_empty() && !commands.is_empty()).then_some(Fault { name, law, commands, path: path.into(), files })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_names_law_and_command() {
        let text = "law: 2 own room\ncommand: test -p foliar-bake own\n\n--- a/crates/x.rs\n+++ b/crates/x.rs\n";
        let fault = parse(text, "x".into(), Path::new("x.patch")).unwrap();
        assert_eq!((fault.law.as_str(), fault.commands[0].len(), fault.files.len()), ("2 own room", 4, 1));
        assert_eq!(parse("--- a/x\n", "x".into(), Path::new("x.patch")), None);
    }
}
