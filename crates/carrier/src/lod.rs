//! Levels of detail in one file: only the finest is baked, since all of them together would count
//! every leaf several times. They are told by MSFT_lod, or by names that end in a level
//! (`oak_LOD0`, `oak-lod1`, `oak LOD2.001`).

use crate::accessor::Source;
use crate::scene::Visit;
use foliar_schema::{Finding, code};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Nodes that hold a coarser level of something: they and all below them are not baked.
pub(crate) fn coarse_nodes(
    source: Source,
    visits: &[Visit],
    chosen: &[bool],
    findings: &mut Vec<Finding>,
) -> BTreeSet<usize> {
    let nodes = source.document.list("nodes");
    let mut coarse = BTreeSet::new();
    let mut by_stem: BTreeMap<String, BTreeMap<u32, Vec<usize>>> = BTreeMap::new();
    for (node, _) in visits.iter().map(|v| v.node).zip(chosen).filter(|(_, chosen)| **chosen) {
        let ids = nodes[node].pointer("/extensions/MSFT_lod/ids").and_then(Value::as_array);
        coarse.extend(ids.into_iter().flatten().filter_map(Value::as_u64).map(|n| n as usize));
        let names = [name_of(&nodes[node]), mesh_name(source, &nodes[node])];
        if let Some((stem, level)) = names.into_iter().flatten().find_map(level_of) {
            by_stem.entry(stem).or_default().entry(level).or_default().push(node);
        }
    }
    for levels in by_stem.into_values() {
        coarse.extend(levels.into_values().skip(1).flatten());
    }
    if !coarse.is_empty() {
        let message = format!("{} nodes hold coarser levels of detail and are not baked", coarse.len());
        let place = format!("/nodes/{}", coarse.first().copied().unwrap_or(0));
        findings.push(Finding::new(&code::IMPORT_LOD, message).at(place).in_file(source.file));
    }
    coarse
}

fn name_of(value: &Value) -> Option<&str> {
    value.get("name").and_then(Value::as_str)
}

fn mesh_name<'a>(source: Source<'a>, node: &Value) -> Option<&'a str> {
    let mesh = node.get("mesh").and_then(Value::as_u64)?;
    source.document.item("meshes", mesh as usize).and_then(name_of)
}

/// Stem and level of a name that ends in one, case ignored; a trailing `.001` of Blender does not count.
fn level_of(name: &str) -> Option<(String, u32)> {
    let lower = name.to_lowercase();
    let digits = |text: &str| text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let copy = digits(&lower);
    let bare = match lower[..lower.len() - copy].strip_suffix('.') {
        Some(front) if copy == 3 => front,
        _ => &lower,
    };
    let (front, level) = bare.split_at(bare.len() - digits(bare));
    let front = front.strip_suffix(['_', '-', ' ']).unwrap_or(front);
    let stem = front.strip_suffix("lod")?.trim_end_matches(['_', '-', ' ', '.']);
    Some((stem.into(), level.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::level_of;

    #[test]
    fn levels_are_told_by_the_end_of_a_name() {
        let level = |name: &str| level_of(name);
        assert_eq!(level("Oak_LOD0"), Some(("oak".into(), 0)));
        assert_eq!(level("oak-lod12"), Some(("oak".into(), 12)));
        assert_eq!(level("oak lod_2"), Some(("oak".into(), 2)));
        assert_eq!(level("oak_LOD1.003"), Some(("oak".into(), 1)));
        assert_eq!(level("LOD0"), Some((String::new(), 0)));
        assert_eq!(level("oak1"), None);
        assert_eq!(level("oak.001"), None);
        assert_eq!(level("oak_lod"), None);
        assert_eq!(level("Ä"), None);
    }
}
