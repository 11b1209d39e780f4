//! A glTF as it is patched: the JSON with its order kept, and the bytes of its buffers.

use crate::{CarrierError, Selection, output};
use foliar_plant::Place;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;

/// A glTF document. Everything that foliar does not know stays in `json` as it was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The glTF JSON, members in the order of the file.
    pub json: Value,
    /// Bytes of `buffers[i]`, exactly `byteLength` long each.
    pub buffers: Vec<Vec<u8>>,
    /// Folder that relative URIs in `json` start from; `None` where nothing lies in files.
    pub folder: Option<PathBuf>,
    /// What of it is baked; a master remembers it.
    pub selection: Selection,
    /// Files that belong beside it, in the folder of its name.
    pub sides: Vec<Side>,
}

/// A file that belongs beside a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// Its name: what it is, and a hash of its bytes, so that an old file and a new one never share a name.
    pub name: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}

impl Side {
    /// A file that is named for what it holds.
    pub(crate) fn new(what: &str, ending: &str, bytes: Vec<u8>) -> Side {
        let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.') { c } else { '_' };
        let what: String = what.chars().map(plain).collect();
        let hash = blake3::hash(&bytes).to_hex();
        Side { name: format!("{what}-{}.{ending}", &hash[..HASH_DIGITS]), bytes: bytes.into() }
    }
}

/// Digits of a hash in the name of a side file.
const HASH_DIGITS: usize = 12;

/// No items: what a missing list reads as.
const NONE: &[Value] = &[];

impl Document {
    /// Items of a list at the root (`"meshes"`), none where it is missing.
    pub fn list(&self, name: &str) -> &[Value] {
        self.json.get(name).and_then(Value::as_array).map_or(NONE, Vec::as_slice)
    }

    /// The bytes of one GLB, URIs as they stand.
    ///
    /// # Errors
    /// [`CarrierError::Input`] above 4 GiB.
    pub fn to_glb(&self) -> Result<Vec<u8>, CarrierError> {
        output::glb(self.clone(), "GLB")
    }

    /// One item of a list at the root.
    pub fn item(&self, list: &str, index: usize) -> Option<&Value> {
        self.list(list).get(index)
    }
}

/// The number at `key`, where it is a whole number that an index or length can be.
pub(crate) fn index_of(value: &Value, key: &str) -> Option<usize> {
    value.get(key).and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok())
}

/// All primitives with their places.
pub(crate) fn primitives(document: &Document) -> impl Iterator<Item = (Place, &Value)> {
    document.list("meshes").iter().enumerate().flat_map(|(mesh, value)| {
        let list = value.get("primitives").and_then(Value::as_array);
        let place = move |primitive| Place { mesh: mesh as u32, primitive: primitive as u32 };
        list.into_iter().flatten().enumerate().map(move |(index, primitive)| (place(index), primitive))
    })
}
