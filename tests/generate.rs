//! `foliar generate`: what is never written by hand.

use crate::common::{FOLIAR, folder, run, text};

fn generated(kind: &str) -> Vec<(String, String)> {
    let here = folder();
    run(FOLIAR, &["generate", kind, text(here.path())]).expect(0, &[]);
    let files = std::fs::read_dir(here.path()).unwrap().map(|file| file.unwrap().path());
    let mut files: Vec<_> = files
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(path).unwrap()))
        .collect();
    files.sort();
    files
}

#[test]
fn each_program_has_its_page_its_help_and_its_completions() {
    for (kind, names) in [
        (
            "man",
            ["foliar-bake.1", "foliar-density.1", "foliar-import.1", "foliar-noise.1", "foliar-view.1", "foliar.1"],
        ),
        (
            "help",
            [
                "foliar-bake.txt",
                "foliar-density.txt",
                "foliar-import.txt",
                "foliar-noise.txt",
                "foliar-view.txt",
                "foliar.txt",
            ],
        ),
        (
            "completions",
            ["foliar.bash", "foliar-density.fish", "_foliar", "_foliar-noise", "_foliar-view", "foliar-import.bash"],
        ),
    ] {
        let files = generated(kind);
        for name in names {
            assert!(files.iter().any(|(file, text)| file == name && text.len() > 100), "{kind}: no {name}");
        }
        assert!(files == generated(kind), "{kind}: the same on every run");
    }
}

#[test]
fn schemas_hold_every_section() {
    let files = generated("schema");
    let (_, text) = files.iter().find(|(name, _)| name == "foliar.toml.schema.json").unwrap();
    let schema: serde_json::Value = serde_json::from_str(text).unwrap();
    for section in ["import", "roles", "structure", "scene", "pack", "view", "density"] {
        assert!(schema["properties"][section]["properties"].is_object(), "{section}");
    }
    assert!(files.iter().any(|(name, _)| name == "FOLIAR_foliage.schema.json"));
}
