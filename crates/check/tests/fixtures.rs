//! Every rule on its two fixtures: the one that triggers it gives its code and nothing else but what follows from the
//! same fault, the sound one gives nothing at all.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use foliar_carrier::survey::survey;
use foliar_check::{Settings, check};
use foliar_schema::{CODES, Import, Unit, Up};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Codes that checking never says, each with who does; all others have two fixtures here.
const SAID_ELSEWHERE: &[(&str, &str)] = &[
    ("BRANCH-", "baking branches"),
    ("IMPORT-BUMP", "converting an OBJ"),
    ("IMPORT-DEGENERATE", "baking: GEOMETRY-UNUSED and GEOMETRY-ZERO-AREA say it of each part here"),
    ("IMPORT-TEXTURE", "converting an OBJ: TEXTURE-MISSING and its like say it here"),
    ("LEAF-ZERO-AREA", "baking structure"),
    ("MAP-", "baking maps"),
    ("NAME-TAKEN", "assembling"),
    ("NEIGHBOR-", "baking beside neighbors"),
    ("PACK-", "packing"),
    ("PARAM-", "baking a room"),
    ("QUALITY-MISSED", "baking a room"),
    ("SCAN-", "scanning a leaf"),
];

fn is_rule(code: &str) -> bool {
    !SAID_ELSEWHERE.iter().any(|(family, _)| code.starts_with(family))
}

/// What else one fault gives, each with the reason.
const FOLLOWS: &[(&str, &[&str])] = &[
    // Blended leaves are one finding about the file, and another beside the master.
    ("LOST-ALPHA", &["ALPHA-BLENDED"]),
    // What is mixed counts as wood here, so that no leaf is left.
    ("ROLE-MIXED", &["LEAF-NONE"]),
    // A tool that drops attributes, ids or tables drops our extension too.
    ("LOST-CHANNEL", &["LOST-EXTENSION"]),
    ("LOST-ID", &["LOST-EXTENSION"]),
    ("LOST-TABLE", &["LOST-EXTENSION"]),
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
        "ROLE-UNMATCHED" => settings.roles.leaf = vec!["needles*".into()],
        // Two patterns that claim one part.
        "ROLE-UNSURE" => (settings.roles.leaf, settings.roles.other) = (vec!["leaves".into()], vec!["leav*".into()]),
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
        "ROLE-UNMATCHED" | "ROLE-UNSURE" => ("sound.gltf".into(), "sound.gltf"),
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
        let usual =
            if ["REQUIRED-MISSING", "ROLE-UNMATCHED", "ROLE-UNSURE"].contains(&info.code) { "" } else { info.code };
        let sound = codes_of(good, usual);
        if !sound.is_empty() {
            wrong.push(format!("{good} for {}: {sound:?}, should be none", info.code));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What all but breaks a rule does not.
#[test]
fn near_misses_are_none() {
    let files = std::fs::read_dir(folder().join("near")).unwrap();
    let mut names: Vec<String> = files.map(|file| file.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let wrong = names.iter().filter_map(|name| {
        let code = name.split('.').next()?.to_uppercase();
        assert!(CODES.iter().any(|info| info.code == code), "{code} is no code");
        let found = codes_of(&format!("near/{name}"), &code);
        found.contains(&code).then(|| format!("{name}: {found:?}"))
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty() && names.len() > 20, "{}", wrong.join("\n"));
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

/// Accessors of compressed attributes have no bytes, which reads as zeros.
#[test]
fn nothing_is_said_of_values_that_only_a_decoder_can_read() {
    let text = std::fs::read_to_string(folder().join("master.gltf")).unwrap();
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    for mesh in 0..2 {
        let primitive = &mut json["meshes"][mesh]["primitives"][0];
        primitive["extensions"]["KHR_draco_mesh_compression"] = serde_json::json!({"bufferView": 0, "attributes": {}});
        let accessors: Vec<u64> =
            primitive["attributes"].as_object().unwrap().values().filter_map(serde_json::Value::as_u64).collect();
        accessors.iter().for_each(|a| {
            json["accessors"][*a as usize].as_object_mut().unwrap().remove("bufferView");
        });
    }
    let import = Import::default();
    let master = survey(text.into_bytes(), "master.gltf", &folder(), &import);
    let checked =
        check(json.to_string().into_bytes(), "a.gltf", &folder(), &Settings::default(), Some(&master)).unwrap();
    let codes: BTreeSet<&str> = checked.findings.iter().map(|finding| finding.code.as_str()).collect();
    assert!(codes.contains("FILE-COMPRESSED") && !codes.iter().any(|code| code.starts_with("LOST-")), "{codes:?}");
}

#[test]
fn whoever_says_a_code_elsewhere_has_one() {
    for (family, _) in SAID_ELSEWHERE {
        assert!(CODES.iter().any(|info| info.code.starts_with(family)), "{family}");
        let fixtures = CODES.iter().filter(|info| info.code.starts_with(family)).map(|info| pair(info.code).0);
        assert!(
            fixtures.into_iter().all(|file| !folder().join(file).exists()),
            "{family} has a fixture: it is said here"
        );
    }
}

#[test]
fn every_fixture_belongs_to_a_rule() {
    for path in std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file()) {
        let stem = path.file_stem().unwrap().to_string_lossy().to_uppercase();
        let known = ["SOUND", "MASTER"].contains(&stem.as_str()) || CODES.iter().any(|info| info.code == stem);
        assert!(known, "{stem} is no code");
    }
}
