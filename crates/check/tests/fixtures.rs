//! Every rule on its two fixtures: the one that triggers it gives its code and nothing else but what follows from the
//! same fault, the sound one gives nothing at all.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use foliar_carrier::survey::survey;
use foliar_check::{Settings, check};
use foliar_schema::{CODES, Import, Unit, Up};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Codes of these families are rules of checking, and have a fixture each. What import, structure and rooms say is
/// tested where it is said; where it has a fixture here, checking must say it too.
const FAMILIES: &[&str] = &[
    "ALPHA-",
    "CONTRACT-",
    "FILE-",
    "GEOMETRY-",
    "LEAF-NONE",
    "LEAF-UNBOUND",
    "LOST-",
    "MATERIAL-",
    "REQUIRED-",
    "TEXTURE-",
    "UNIT-",
    "WOOD-",
];

fn is_rule(code: &str) -> bool {
    let (bad, _) = pair(code);
    FAMILIES.iter().any(|family| code.starts_with(family)) || folder().join(bad).exists()
}

/// What else one fault gives, each with the reason.
const FOLLOWS: &[(&str, &[&str])] = &[
    // Blended leaves are one finding about the file, and another beside the master.
    ("LOST-ALPHA", &["ALPHA-BLENDED"]),
    // A tool that drops attributes, ids or tables drops our extension too; what its mirror names is missing then.
    // and its records speak of another file.
    ("LOST-CHANNEL", &["LOST-EXTENSION", "STALE"]),
    ("LOST-ID", &["LOST-EXTENSION", "STALE"]),
    ("LOST-TABLE", &["LOST-EXTENSION", "STALE"]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/check")
}

fn codes_of(file: &str, code: &str) -> BTreeSet<String> {
    let mut settings = Settings {
        import: Import { up: Some(Up::Y), unit: Some(Unit::M), ..Import::default() },
        ..Settings::default()
    };
    match code {
        "IMPORT-UP" => settings.import.up = None,
        "IMPORT-UNIT" => settings.import.unit = None,
        "REQUIRED-MISSING" => settings.check.require = vec!["wind".into()],
        _ => {}
    }
    let bytes = |name: &str| std::fs::read(folder().join(name)).unwrap();
    let master = survey(bytes("master.gltf"), "master.gltf", &folder(), &settings.import);
    let master = code.starts_with("LOST-").then_some(&master);
    let checked = check(bytes(file), file, &folder(), &settings, master).unwrap();
    checked.findings.into_iter().map(|finding| finding.code).collect()
}

/// The fixture of a code, and the sound file that it was made from.
fn pair(code: &str) -> (String, &'static str) {
    let name = code.to_lowercase();
    match code {
        "IMPORT-UP" | "IMPORT-UNIT" | "REQUIRED-MISSING" => ("sound.obj".into(), "master.gltf"),
        _ if folder().join(format!("{name}.obj")).exists() => (format!("{name}.obj"), "sound.obj"),
        _ => {
            let of_master =
                ["CONTRACT-", "LOST-", "STALE", "RECORD-", "LEAF-UNBOUND"].iter().any(|p| code.starts_with(p));
            (format!("{name}.gltf"), if of_master { "master.gltf" } else { "sound.gltf" })
        }
    }
}

#[test]
fn every_rule_is_exact_on_its_two_fixtures() {
    let mut wrong = Vec::new();
    for info in CODES.iter().filter(|info| is_rule(info.code)) {
        let (bad, good) = pair(info.code);
        let follows = FOLLOWS.iter().find(|(code, _)| *code == info.code).map_or(&[][..], |(_, follows)| follows);
        let expected: BTreeSet<String> = follows.iter().chain([&info.code]).map(|code| code.to_string()).collect();
        let found = codes_of(&bad, info.code);
        if found != expected {
            wrong.push(format!("{bad}: {found:?}, should be {expected:?}"));
        }
        let usual = if info.code == "REQUIRED-MISSING" { "" } else { info.code };
        let sound = codes_of(good, usual);
        if !sound.is_empty() {
            wrong.push(format!("{good} for {}: {sound:?}, should be none", info.code));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Found by mutation: JSON that is read, of a version that is not, leaves buffers that nobody loaded.
#[test]
fn a_document_that_is_given_up_early_is_a_finding() {
    for name in ["sound.gltf", "master.gltf"] {
        let text = std::fs::read_to_string(folder().join(name)).unwrap();
        let strange = text.replacen("\"version\": \"2.0\"", "\"version\": \"9.0\"", 1);
        let checked = check(strange.into_bytes(), name, &folder(), &Settings::default(), None).unwrap();
        assert_eq!(checked.findings[0].code, "FILE-BROKEN", "{:?}", checked.findings);
    }
}

#[test]
fn every_fixture_belongs_to_a_rule() {
    for entry in std::fs::read_dir(folder()).unwrap() {
        let stem = entry.unwrap().path().file_stem().unwrap().to_string_lossy().to_uppercase();
        let known = ["SOUND", "MASTER"].contains(&stem.as_str()) || CODES.iter().any(|info| info.code == stem);
        assert!(known, "{stem} is no code");
    }
}
