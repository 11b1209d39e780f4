//! What a document holds of one attribute, as stored.

use crate::accessor::{Source, type_width};
use crate::assemble::vertices_of;
use crate::document::{index_of, primitives};
use crate::{CarrierError, Document};
use foliar_plant::Place;
use serde_json::Value;

/// An attribute as it stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// Numbers per vertex.
    pub width: usize,
    /// Component type (glTF 2.0 section 3.6.2.2): 5126 float, 5121 byte, 5123 16 bits ...
    pub component: u64,
    /// Numbers as a reader takes them: normalized ones between 0 (or -1) and 1.
    pub values: Vec<f32>,
}

/// An attribute of one primitive; `None` where it has none of that name.
///
/// # Errors
/// [`CarrierError::Input`] where its accessor is damaged.
pub fn attribute(document: &Document, place: Place, name: &str) -> Result<Option<Stored>, CarrierError> {
    let found = primitives(document).find(|(at, _)| *at == place);
    let accessor = found.and_then(|(_, p)| index_of(p.get("attributes")?, name));
    let Some(index) = accessor else { return Ok(None) };
    let source = Source { document, file: "file" };
    let item = document.item("accessors", index);
    let text = item.and_then(|a| a.get("type")?.as_str());
    let width = text.and_then(type_width).ok_or_else(|| {
        source.fail(format!("/accessors/{index}"), format!("type {text:?} where numbers per vertex are wanted"))
    })?;
    let component = item.and_then(|a| a.get("componentType")?.as_u64()).unwrap_or(0);
    Ok(Some(Stored { width, component, values: source.floats(index, width)? }))
}

/// Names of the attributes of one primitive.
pub fn attribute_names(document: &Document, place: Place) -> Vec<String> {
    let found = primitives(document).find(|(at, _)| *at == place);
    let attributes = found.and_then(|(_, p)| p.get("attributes")?.as_object());
    attributes.map_or(Vec::new(), |a| a.keys().cloned().collect())
}

/// Bytes per vertex of one attribute: its stride where its view says one, else its own size in steps of four.
pub fn bytes_per_vertex(document: &Document, place: Place, name: &str) -> usize {
    let found = primitives(document).find(|(at, _)| *at == place);
    let accessor = found.and_then(|(_, p)| document.item("accessors", index_of(p.get("attributes")?, name)?));
    let Some(accessor) = accessor else { return 0 };
    let width = accessor.get("type").and_then(Value::as_str).and_then(type_width).unwrap_or(0);
    let component = match accessor.get("componentType").and_then(Value::as_u64) {
        Some(5120 | 5121) => 1,
        Some(5122 | 5123) => 2,
        _ => 4,
    };
    (width * component).next_multiple_of(4)
}

/// Vertices of a primitive.
pub(super) fn vertices(document: &Document, place: Place) -> Result<usize, CarrierError> {
    vertices_of(document, place, "pack")
}
