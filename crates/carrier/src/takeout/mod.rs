//! Taking layers out of a master again: the layers as they were assembled, and the base as it was
//! before. Reading prefers the root extension and falls back to its mirror in `asset.extras`, which
//! survives tools that drop what they do not know.

mod layers;
mod maps;
mod strip;

use crate::notes::{Notes, RENAMED, root_pointer};
use crate::{CarrierError, Document};
use foliar_bake::Layer;
use foliar_schema::{CONTRACT, Finding, FoliageExtension, code, names};
pub use layers::DAMAGED;
use serde_json::Value;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A document without its layers, and the layers.
pub(crate) struct Taken {
    pub document: Document,
    pub layers: Vec<Layer>,
    pub findings: Vec<Finding>,
    /// Side files that were read.
    pub files: Vec<PathBuf>,
}

/// What the root extension of a master says.
struct Contents {
    extension: FoliageExtension,
    notes: Notes,
    renamed: BTreeMap<String, String>,
}

impl Contents {
    /// The name under which an attribute or class stands in the file.
    fn name<'a>(&'a self, name: &'a str) -> &'a str {
        self.renamed.get(name).map_or(name, String::as_str)
    }
}

/// Takes all layers out of a document.
pub(crate) fn take_out(mut document: Document, file: &str) -> Result<Taken, CarrierError> {
    let root = document.json.get("extensions").and_then(|e| e.get(names::EXTENSION));
    let mirror = document.json.pointer("/asset/extras").and_then(|e| e.get(names::EXTENSION));
    let Some(value) = root.or(mirror).cloned() else {
        return Ok(Taken { document, layers: Vec::new(), findings: Vec::new(), files: Vec::new() });
    };
    let place = if root.is_some() { root_pointer() } else { format!("/asset/extras/{}", names::EXTENSION) };
    let contract = value.get("contract").and_then(Value::as_u64);
    if contract.is_some_and(|c| c > u64::from(CONTRACT)) {
        let message = format!("contract {} is newer than {CONTRACT}: all of it stays as it is", contract.unwrap_or(0));
        let finding = Finding::new(&code::RECORD_UNKNOWN, message).at(place).in_file(file);
        return Ok(Taken { document, layers: Vec::new(), findings: vec![finding], files: Vec::new() });
    }
    let extension: FoliageExtension = serde_json::from_value(value).map_err(|error| {
        CarrierError::input(file, place, format!("is damaged: {error}"), "bake again from the file it was made from")
    })?;
    let notes: Notes = serde_json::from_value(Value::Object(extension.base.clone())).unwrap_or_default();
    let renamed = extension.more.get(RENAMED).cloned().and_then(|r| serde_json::from_value(r).ok()).unwrap_or_default();
    let contents = Contents { extension, notes, renamed };
    let mut findings = Vec::new();
    let files = RefCell::default();
    let layers = layers::read(&document, file, &contents, &mut findings, &files)?;
    document.selection.scene = contents.notes.scene;
    document.selection.node.clone_from(&contents.notes.node);
    strip::strip(&mut document, &contents);
    document.sides.clear();
    Ok(Taken { document, layers, findings, files: files.into_inner() })
}
