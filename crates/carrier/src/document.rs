//! A glTF as it is patched: the JSON with its order kept, and the bytes of its buffers.

use serde_json::Value;
use std::path::PathBuf;

/// A glTF document. Everything that foliar does not know stays in `json` as it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The glTF JSON, members in the order of the file.
    pub json: Value,
    /// Bytes of `buffers[i]`, exactly `byteLength` long each.
    pub buffers: Vec<Vec<u8>>,
    /// Folder that relative URIs in `json` start from; `None` where nothing lies in files.
    pub folder: Option<PathBuf>,
}

/// No items: what a missing list reads as.
const NONE: &[Value] = &[];

impl Document {
    /// Items of a list at the root (`"meshes"`), none where it is missing.
    pub fn list(&self, name: &str) -> &[Value] {
        self.json.get(name).and_then(Value::as_array).map_or(NONE, Vec::as_slice)
    }

    /// One item of a list at the root.
    pub fn item(&self, list: &str, index: usize) -> Option<&Value> {
        self.list(list).get(index)
    }
}
