//! A document that grows at its ends.

use crate::notes::Notes;
use crate::output::set_byte_lengths;
use crate::{CarrierError, Document};
use foliar_plant::Place;
use foliar_schema::{Finding, code};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// GPU buffer that attributes are meant for (glTF 2.0 section 5.11.5).
const ARRAY_BUFFER: u32 = 34_962;
/// GPU buffer that indices are meant for.
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// What a buffer view holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    /// Values per vertex, `stride` bytes each.
    Attribute {
        /// Bytes per vertex.
        stride: usize,
    },
    /// A column of a property table.
    Column,
    /// Indices of triangles.
    Indices,
    /// Bytes of a picture.
    Picture,
}

impl Content {
    /// Says in a view what it is for.
    pub fn mark(self, view: &mut Value) {
        match self {
            Content::Attribute { stride } => {
                view["byteStride"] = stride.into();
                view["target"] = ARRAY_BUFFER.into();
            }
            Content::Indices => view["target"] = ELEMENT_ARRAY_BUFFER.into(),
            Content::Column | Content::Picture => {}
        }
    }
}

/// The document under assembly, and what is said of it.
pub(crate) struct Builder {
    pub document: Document,
    pub notes: Notes,
    pub findings: Vec<Finding>,
    /// Names that were taken, and what stands for them.
    pub renamed: BTreeMap<String, String>,
    /// Further members of the root extension.
    pub more: Map<String, Value>,
    /// Index of each class's property table.
    pub tables: BTreeMap<String, usize>,
    /// Primitives whose `extensions` were there, and empty.
    pub kept_extensions: BTreeSet<Place>,
}

impl Builder {
    pub fn new(base: &Document) -> Self {
        let mut notes = Notes::before(&base.json);
        notes.scene = base.selection.scene;
        notes.node.clone_from(&base.selection.node);
        Builder {
            document: base.clone(),
            notes,
            findings: Vec::new(),
            renamed: BTreeMap::new(),
            more: Map::new(),
            tables: BTreeMap::new(),
            kept_extensions: BTreeSet::new(),
        }
    }

    pub fn finish(mut self) -> (Document, Vec<Finding>) {
        set_byte_lengths(&mut self.document);
        (self.document, self.findings)
    }

    /// The object at `path`, made where it is missing; `None` where something else stands there.
    pub fn object(&mut self, path: &[&str]) -> Option<&mut Map<String, Value>> {
        let mut at = self.document.json.as_object_mut()?;
        for (depth, key) in path.iter().enumerate() {
            if !at.contains_key(*key) {
                at.insert((*key).into(), json!({}));
                self.notes.created.push(format!("/{}", path[..=depth].join("/")));
            }
            at = at.get_mut(*key)?.as_object_mut()?;
        }
        Some(at)
    }

    /// As [`Builder::object`], where nothing else will do.
    pub fn require_object(&mut self, path: &[&str]) -> Result<&mut Map<String, Value>, CarrierError> {
        let place = format!("/{}", path.join("/"));
        self.object(path).ok_or_else(|| CarrierError::input("base", place, "is no object", "export it again"))
    }

    /// Adds to a list inside an object that is there, and says at which index.
    pub fn push(&mut self, path: &[&str], list: &str, item: Value) -> Result<usize, CarrierError> {
        let place = format!("/{}", [path, &[list]].concat().join("/"));
        let items = self.require_object(path)?.entry(list).or_insert_with(|| json!([])).as_array_mut();
        let items = items.ok_or_else(|| CarrierError::input("base", place, "is no list", "export it again"))?;
        items.push(item);
        Ok(items.len() - 1)
    }

    /// Lists an extension as used.
    pub fn use_extension(&mut self, name: &str) -> Result<(), CarrierError> {
        let used = self.document.list("extensionsUsed");
        if used.iter().any(|n| n == name) {
            return Ok(());
        }
        self.push(&[], "extensionsUsed", name.into()).map(|_| ())
    }

    /// Appends bytes to the first buffer as a named view.
    pub fn view(&mut self, name: &str, bytes: &[u8], content: Content) -> Result<usize, CarrierError> {
        if self.document.buffers.is_empty() {
            self.document.buffers.push(Vec::new());
            self.push(&[], "buffers", json!({"byteLength": 0}))?;
        }
        let buffer = &mut self.document.buffers[0];
        let alignment = if content == Content::Column { 8 } else { 4 };
        buffer.resize(buffer.len().next_multiple_of(alignment), 0);
        let mut view = json!({"buffer": 0, "byteOffset": buffer.len(), "byteLength": bytes.len()});
        buffer.extend_from_slice(bytes);
        content.mark(&mut view);
        view["name"] = name.into();
        self.push(&[], "bufferViews", view)
    }

    /// The first of `name`, `name_1`, `name_2` ... that is free; a finding where it is not the first.
    pub fn free_name(&mut self, name: &str, place: &str, taken: impl Fn(&str) -> bool) -> String {
        if !taken(name) {
            return name.into();
        }
        // One more than there can be: a free one is always among them.
        let free = (1..).map(|n| format!("{name}_{n}")).find(|n| !taken(n)).unwrap_or_default();
        let message = format!("{name} is taken by the base: {free} was used");
        self.findings.push(Finding::new(&code::NAME_TAKEN, message).at(place));
        self.renamed.insert(name.into(), free.clone());
        free
    }
}

/// A primitive as an object.
pub(crate) fn primitive_mut(json: &mut Value, place: Place) -> Option<&mut Map<String, Value>> {
    let mesh = json.get_mut("meshes")?.get_mut(place.mesh as usize)?;
    mesh.get_mut("primitives")?.get_mut(place.primitive as usize)?.as_object_mut()
}
