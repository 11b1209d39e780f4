//! Names that stand in files are spelled in crate `schema` and nowhere else.

use super::source::literals;
use foliar_schema::{CHANNELS, CODES, names};

/// Complaints about one Rust file.
pub fn check(file: &str, text: &str) -> Vec<String> {
    if file.starts_with("crates/schema/") || is_test_file(file) {
        return Vec::new();
    }
    // Unit tests stand at the end of a file and may spell what they expect.
    let code = text.find("#[cfg(test)]").map_or(text, |end| &text[..end]);
    let reserved = reserved();
    let spelled = |literal: &str| reserved.iter().copied().find(|name| holds(literal, name));
    literals(code)
        .into_iter()
        .filter_map(|(line, literal)| Some((line, spelled(&literal)?)))
        .map(|(line, name)| format!("{file}:{line}: spells \"{name}\": take it from crate schema"))
        .collect()
}

/// Tests spell what they expect, and so do the functions that make fixtures: a name that changes must break them.
fn is_test_file(file: &str) -> bool {
    file.split('/').any(|folder| ["tests", "benches", "fixtures"].contains(&folder)) || file.ends_with("tests.rs")
}

fn reserved() -> Vec<&'static str> {
    let mut names = vec![
        names::EXTENSION,
        names::MESH_FEATURES,
        names::STRUCTURAL_METADATA,
        names::FEATURE_ID_PREFIX,
        names::LABEL_LEAF,
        names::LABEL_BRANCH,
        names::VIEW_PREFIX,
        names::CLASS_LEAF,
    ];
    names.extend(CHANNELS.iter().map(|c| c.name));
    names.extend(CODES.iter().map(|c| c.code).filter(|code| code.contains('-')));
    names
}

/// Whether the name stands in a literal as a word of its own.
fn holds(literal: &str, name: &str) -> bool {
    let word = |c: Option<char>| c.is_some_and(|c| c.is_ascii_alphanumeric());
    literal.match_indices(name).any(|(at, _)| {
        let after = literal[at + name.len()..].chars().next();
        !word(literal[..at].chars().next_back())
            && match name.chars().next_back() {
                // A prefix stands before more of a name.
                Some(':' | '_') => after != Some(' '),
                _ => !(word(after) || after == Some('_')),
            }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spelled_channel_is_found_and_a_test_may_spell_it() {
        let text = "fn f() { g(\"_AMBIENT\"); }\n#[cfg(test)]\nmod tests { const A: &str = \"_AMBIENT\"; }";
        assert_eq!(check("crates/view/src/lib.rs", text).len(), 1);
        assert!(check("crates/schema/src/names.rs", text).is_empty());
        assert!(check("tests/bake.rs", text).is_empty());
    }

    #[test]
    fn longer_words_are_not_ours() {
        assert!(!holds("\"_AMBIENT_OCCLUSION\"", "_AMBIENT"));
        assert!(holds("\"_FEATURE_ID_0\"", "_FEATURE_ID_"));
        assert!(!holds("\"foliar: every tree\"", "foliar:") && holds("\"foliar:density\"", "foliar:"));
    }
}
