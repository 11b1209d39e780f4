//! New bytes for an accessor that has a buffer view to itself: the old bytes are cut out of the buffer, the
//! new ones join its end, and accessor and view keep their indices.

use crate::Document;
use crate::assemble::Content;
use crate::document::index_of;
use serde_json::{Value, json};

/// Every view stays on a multiple of so many bytes.
const ALIGNMENT: usize = 8;

/// An accessor's definition with its view.
pub(super) fn with_view(mut accessor: Value, view: usize) -> Value {
    accessor["bufferView"] = view.into();
    accessor
}

/// Replaces the definition and the bytes of an accessor that [`super::slot::is_sole`] holds of; its index.
pub(super) fn replace(
    document: &mut Document,
    accessor: usize,
    definition: Value,
    bytes: &[u8],
    content: Content,
) -> usize {
    let Some(view) = document.item("accessors", accessor).and_then(|a| index_of(a, "bufferView")) else {
        return accessor;
    };
    cut(document, view);
    let Some(buffer) = document.buffers.first_mut() else { return accessor };
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let mut new = json!({"buffer": 0, "byteOffset": buffer.len(), "byteLength": bytes.len()});
    buffer.extend_from_slice(bytes);
    content.mark(&mut new);
    let name = document.item("bufferViews", view).and_then(|v| v.get("name")).cloned();
    if let Some(name) = name {
        new["name"] = name;
    }
    document.json["bufferViews"][view] = new;
    document.json["accessors"][accessor] = with_view(definition, view);
    accessor
}

/// Takes the bytes of a view out of the first buffer and moves what follows, as far as alignment lets it.
fn cut(document: &mut Document, view: usize) {
    let compressed = document.list("bufferViews").iter().any(|view| view.get("extensions").is_some());
    let Some(item) = document.item("bufferViews", view).filter(|_| !compressed) else { return };
    let start = index_of(item, "byteOffset").unwrap_or(0);
    let length = index_of(item, "byteLength").unwrap_or(0);
    let Some(buffer) = document.buffers.first_mut() else { return };
    // Padding up to the next view goes with it; a length that is no multiple leaves some.
    let gone = length - length % ALIGNMENT;
    if start + gone > buffer.len() {
        return;
    }
    buffer.drain(start..start + gone);
    let list = document.json.get_mut("bufferViews").and_then(Value::as_array_mut);
    for other in list.into_iter().flatten().filter(|other| index_of(other, "buffer") == Some(0)) {
        let offset = index_of(other, "byteOffset").unwrap_or(0);
        if offset >= start + length {
            other["byteOffset"] = (offset - gone).into();
        }
    }
}
