//! What a master says about itself beside its records: how long the lists of its base were, which
//! containers foliar made, and under which names things stand. `takeout` undoes by it what
//! `assemble` did.

use foliar_schema::names;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Member `base` of the root extension. Lengths of lists that did not exist are missing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Notes {
    /// `byteLength` of the first buffer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub byte_length: Option<usize>,
    /// Length of each list that foliar may have lengthened, by JSON pointer.
    pub lengths: BTreeMap<String, usize>,
    /// Objects that foliar made, by JSON pointer, outermost first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub created: Vec<String>,
    /// Scene that was chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<u32>,
    /// Node that was chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<String>,
}

/// Lists at the root at whose end foliar adds.
pub(crate) const LISTS: &[&str] = &["/accessors", "/bufferViews", "/buffers", "/extensionsUsed"];
/// Lists at the root that only maps lengthen: noted where they did, with length 0 where there was none.
pub(crate) const PICTURE_LISTS: &[&str] = &["/images", "/textures"];
/// Member of the root extension: names that were taken, and what stands for them.
pub(crate) const RENAMED: &str = "renamed";
/// Member of the root extension: tables that EXT_structural_metadata cannot hold, by buffer view name.
pub(crate) const TABLES: &str = "tables";
/// Member of a primitive's extension: containers of the primitive that were there, and empty.
pub(crate) const KEPT: &str = "kept";
/// Member of a record of an unknown room: definitions of the properties that it wrote.
pub(crate) const PROPERTIES: &str = "properties";

impl Notes {
    /// What can be noted before anything is added.
    pub fn before(json: &Value) -> Self {
        let length = |pointer: &str| Some((pointer.to_string(), json.pointer(pointer)?.as_array()?.len()));
        let byte_length = json.pointer("/buffers/0/byteLength").and_then(Value::as_u64).map(|n| n as usize);
        let tables = metadata_pointer("/propertyTables");
        let lists = LISTS.iter().copied().chain([tables.as_str()]);
        Notes { byte_length, lengths: lists.filter_map(length).collect(), ..Notes::default() }
    }

    /// As the member `base` has it.
    pub fn to_map(&self) -> Map<String, Value> {
        match serde_json::to_value(self) {
            Ok(Value::Object(map)) => map,
            _ => Map::new(),
        }
    }
}

/// The label and table class of an id channel (`LEAF_ID`: `foliar_leaf`, `foliarLeaf`); `None` for
/// attributes that are no ids.
pub(crate) fn id_names(channel: &str) -> Option<(String, String)> {
    let word = channel.strip_suffix("_ID").filter(|word| !word.is_empty() && !word.starts_with('_'))?;
    let lower = word.to_lowercase();
    let (first, rest) = lower.split_at_checked(1)?;
    Some((format!("foliar_{lower}"), format!("foliar{}{rest}", first.to_uppercase())))
}

/// Pointer to the root extension.
pub(crate) fn root_pointer() -> String {
    format!("/extensions/{}", names::EXTENSION)
}

/// Pointer to a member (`/schema`) of the file's structural metadata.
pub(crate) fn metadata_pointer(member: &str) -> String {
    format!("/extensions/{}{member}", names::STRUCTURAL_METADATA)
}

/// Name of a buffer view of foliar.
pub(crate) fn view_name(room: &str, name: &str) -> String {
    format!("{}{room}:{name}", names::VIEW_PREFIX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_leaves_and_branches_are_named_as_the_contract_says() {
        let (label, class) = id_names(names::LEAF_ID).unwrap();
        assert_eq!((label.as_str(), class.as_str()), (names::LABEL_LEAF, names::CLASS_LEAF));
        let (label, class) = id_names(names::BRANCH_ID).unwrap();
        assert_eq!((label.as_str(), class.as_str()), (names::LABEL_BRANCH, names::CLASS_BRANCH));
        assert_eq!(id_names(names::AMBIENT), None);
    }
}
