//! Writes a new room that compiles, keeps every law and is baked: what rooms have in common, as files to start from.

mod lines;
mod trial;

use crate::{generated, repo};
use anyhow::{Result, bail};
use foliar_schema::CHANNELS;
use std::collections::BTreeMap;
use std::path::Path;
pub use trial::trial;

/// New files: where they go, and what they hold. `__room__`, `__Room__` and `__ROOM__` stand for the name.
const FILES: [(&str, &str); 9] = [
    ("crates/__room__/Cargo.toml", include_str!("template/manifest.toml")),
    ("crates/__room__/src/lib.rs", include_str!("template/lib.rs")),
    ("crates/__room__/src/params.rs", include_str!("template/params.rs")),
    ("crates/__room__/src/reference.rs", include_str!("template/reference.rs")),
    ("crates/__room__/src/fast.rs", include_str!("template/fast.rs")),
    ("crates/__room__/src/output.rs", include_str!("template/output.rs")),
    ("crates/__room__/src/tests.rs", include_str!("template/tests.rs")),
    ("crates/schema/src/rooms/__room__.rs", include_str!("template/contract.rs")),
    ("crates/programs/src/bin/foliar-__room__.rs", include_str!("template/program.rs")),
];

/// Names that are no room's: words of the language and of Rust's own crates, sections of the configuration.
const TAKEN: [&str; 26] = [
    "abstract", "as", "async", "await", "box", "const", "crate", "dyn", "else", "enum", "extern", "fn", "help", "impl",
    "import", "match", "mod", "move", "mut", "pub", "roles", "scene", "static", "test", "type", "use",
];

/// Texts by file, relative to the root.
type Texts = BTreeMap<String, String>;

/// Writes the room and brings the generated documents up to date.
pub fn run(name: &str) -> Result<()> {
    check(name)?;
    let texts = texts(name, repo::text)?;
    for (file, text) in &texts {
        let path = repo::root().join(file);
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new("")))?;
        std::fs::write(&path, text)?;
        println!("{file}: written");
    }
    // Names of other lengths break lines elsewhere.
    repo::run(
        repo::cargo()
            .args(["fmt", "--package", "foliar-schema", "--package", "foliar-programs", "--package"])
            .arg(format!("foliar-{name}")),
    )?;
    generated::run(false)?;
    println!("{name} compiles and is baked; docs/adding-a-baker.md says what is left to do");
    Ok(())
}

/// Refuses a name that is none, or that something else has.
fn check(name: &str) -> Result<()> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit();
    if !(name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(plain) && name.len() > 1) {
        bail!("{name:?} names no room: lowercase letters and digits, a letter first, two or more (wind, density)");
    }
    let files = [&FILES[0], &FILES[7], &FILES[8]].map(|(file, _)| named(file, name));
    if let Some(file) = files.into_iter().find(|file| repo::root().join(file).exists()) {
        bail!("{name} is taken: {file} is there already");
    }
    let channel = named("___ROOM___SHARE", name);
    if TAKEN.contains(&name) || CHANNELS.iter().any(|c| c.name == channel) {
        bail!("{name} is taken by something that is no room: choose another name");
    }
    Ok(())
}

/// Every file that the room needs, and every file that must know of it, as they are to be.
fn texts(name: &str, read: impl Fn(&str) -> Result<String>) -> Result<Texts> {
    let mut texts: Texts = FILES.iter().map(|(file, text)| (named(file, name), named(text, name))).collect();
    for joined in lines::JOINED {
        texts.insert(joined.file.into(), joined.with(&read(joined.file)?, name)?);
    }
    Ok(texts)
}

/// A text of the template with the room's name in its place.
fn named(text: &str, name: &str) -> String {
    let mut letters = name.chars();
    let type_name: String = letters.next().iter().map(char::to_ascii_uppercase).chain(letters).collect();
    text.replace("__room__", name).replace("__Room__", &type_name).replace("__ROOM__", &name.to_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_that_must_know_of_a_room_says_its_name() {
        let texts = texts("moss", repo::text).unwrap();
        assert!(texts["crates/programs/src/lib.rs"].contains("&foliar_moss::Moss,\n    // Bakers of libraries."));
        let rooms = &texts["crates/schema/src/rooms/mod.rs"];
        assert!(rooms.contains("mod moss;") && rooms.contains(" moss;\n    library:"), "{rooms}");
        assert!(texts["Cargo.toml"].contains("foliar-moss = { path = \"crates/moss\" }"));
        let programs = &texts["crates/programs/Cargo.toml"];
        assert!(programs.contains("foliar-moss.workspace = true") && programs.contains("name = \"foliar-moss\""));
        let left = texts.iter().find(|(file, text)| file.contains("__") || text.to_lowercase().contains("__room__"));
        assert_eq!(left, None, "a place for the name that holds none");
    }

    #[test]
    fn a_room_that_was_to_come_is_no_longer_to_come() {
        let rooms = |name| texts(name, repo::text).unwrap().remove("crates/schema/src/rooms/mod.rs").unwrap();
        let later = foliar_schema::LATER_ROOMS.first().unwrap();
        assert!(rooms("moss").contains(&format!("\"{later}\"")) && !rooms(later).contains(&format!("\"{later}\"")));
    }

    #[test]
    fn names_that_are_none_or_taken_are_refused() {
        for (name, why) in [
            ("Moss", "names no room"),
            ("two-words", "names no room"),
            ("", "names no room"),
            ("density", "crates/density/Cargo.toml"),
            ("noise", "rooms/noise.rs"),
            ("view", "crates/view/Cargo.toml"),
            ("match", "no room"),
        ] {
            let error = check(name).unwrap_err().to_string();
            assert!(error.contains(why), "{name}: {error}");
        }
        check("moss").unwrap();
    }
}
