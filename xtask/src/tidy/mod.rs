//! House rules as code. Each rule is a function from files to complaints.

mod floors;
mod lengths;
mod names;
mod patches;
mod references;
mod source;
mod texts;

use crate::repo;
use anyhow::{Result, bail};

/// Checks every rule and prints every complaint.
pub fn run() -> Result<()> {
    let files = repo::files()?;
    let mut complaints = floors::check(&files)?;
    complaints.extend(texts::top_level(&files));
    for file in &files {
        let Ok(text) = repo::text(file) else { continue };
        complaints.extend(texts::check(file, &text));
        if file.ends_with(".rs") {
            complaints.extend(lengths::check(file, &text));
            complaints.extend(names::check(file, &text));
        }
    }
    complaints.extend(references::check(&files)?);
    complaints.extend(patches::check(&repo::root(), &files)?);
    complaints.iter().for_each(|c| println!("{c}"));
    if !complaints.is_empty() {
        bail!("tidy: {} complaints", complaints.len());
    }
    println!("tidy: {} files keep the house rules", files.len());
    Ok(())
}
