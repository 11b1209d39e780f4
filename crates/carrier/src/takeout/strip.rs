//! Undoing what assembling did, by the notes that it left. Where a tool has rearranged the file since,
//! foliar's attributes, tables and extension go all the same; bytes that cannot be told apart stay.

use super::Contents;
use super::layers::feature;
use crate::Document;
use crate::document::index_of;
use crate::notes::{KEPT, LISTS, PICTURE_LISTS, id_names, metadata_pointer, root_pointer};
use crate::output::set_byte_lengths;
use foliar_schema::names;
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// Takes everything of foliar out of a document.
pub(super) fn strip(document: &mut Document, contents: &Contents) {
    let exact = is_as_assembled(document, contents);
    let writes: BTreeSet<&str> =
        contents.extension.records.iter().flat_map(|r| &r.writes).map(String::as_str).collect();
    let meshes = document.json.get_mut("meshes").and_then(Value::as_array_mut);
    for mesh in meshes.into_iter().flatten() {
        let primitives = mesh.get_mut("primitives").and_then(Value::as_array_mut);
        for primitive in primitives.into_iter().flatten() {
            strip_primitive(primitive, contents, &writes);
        }
    }
    strip_metadata(&mut document.json, contents, &writes);
    strip_materials(document);
    strip_root(&mut document.json);
    if exact {
        cut(document, contents);
    } else if let Some(used) = document.json.get_mut("extensionsUsed").and_then(Value::as_array_mut) {
        used.retain(|name| name != names::EXTENSION);
    }
    for pointer in contents.notes.created.iter().rev() {
        remove_if_empty(&mut document.json, pointer);
    }
}

/// Removes the root extension and, where it is a mirror and not somebody else's, what the extras hold.
fn strip_root(json: &mut Value) {
    let extensions = json.get_mut("extensions").and_then(Value::as_object_mut);
    let root = extensions.and_then(|e| e.shift_remove(names::EXTENSION));
    let extras = json.pointer_mut("/asset/extras").and_then(Value::as_object_mut);
    if let Some(extras) = extras
        && root.is_none_or(|root| extras.get(names::EXTENSION) == Some(&root))
    {
        extras.shift_remove(names::EXTENSION);
    }
}

/// Whether everything after the base's own items is foliar's, so that it can be cut off.
fn is_as_assembled(document: &Document, contents: &Contents) -> bool {
    let notes = &contents.notes;
    let length = |pointer: &str| notes.lengths.get(pointer).copied().unwrap_or(0);
    let (accessors, views) = (length("/accessors"), length("/bufferViews"));
    let ours = |view: &Value| {
        let name = view.get("name").and_then(Value::as_str);
        name.is_some_and(|n| n.starts_with(names::VIEW_PREFIX)) && index_of(view, "buffer") == Some(0)
    };
    let byte_length = notes.byte_length.unwrap_or(0);
    let inside = |view: &Value| {
        let end = index_of(view, "byteOffset").unwrap_or(0).checked_add(index_of(view, "byteLength").unwrap_or(0));
        index_of(view, "buffer") != Some(0) || end.is_some_and(|end| end <= byte_length)
    };
    let all_views = document.list("bufferViews");
    let all_accessors = document.list("accessors");
    contents.extension.base.contains_key("lengths")
        && notes.byte_length.is_some() == (length("/buffers") > 0)
        && accessors <= all_accessors.len()
        && views <= all_views.len()
        && document.buffers.first().is_none_or(|b| byte_length <= b.len())
        // A base without buffers gets one, unless nothing needed it.
        && length("/buffers").max(usize::from(!all_views.is_empty())) == document.list("buffers").len()
        && all_views[views..].iter().all(ours)
        && all_views[..views].iter().all(inside)
        && PICTURE_LISTS.iter().all(|list| notes.lengths.get(*list).is_none_or(|n| rest_is_ours(document, list, *n)))
        && all_accessors[accessors..].iter().all(|a| index_of(a, "bufferView").is_some_and(|v| v >= views))
}

/// Whether every picture or texture from `length` on is foliar's.
fn rest_is_ours(document: &Document, list: &str, length: usize) -> bool {
    let items = document.list(list.trim_start_matches('/'));
    items.get(length..).is_some_and(|rest| rest.iter().all(is_named_ours))
}

/// Whether an item bears a name of foliar.
fn is_named_ours(item: &Value) -> bool {
    item.get("name").and_then(Value::as_str).is_some_and(|name| name.starts_with(names::VIEW_PREFIX))
}

/// Takes diffuse transmission out of materials where its texture is foliar's.
fn strip_materials(document: &mut Document) {
    let ours: BTreeSet<usize> = document
        .list("textures")
        .iter()
        .enumerate()
        .filter(|(_, t)| is_named_ours(t))
        .map(|(index, _)| index)
        .collect();
    let materials = document.json.get_mut("materials").and_then(Value::as_array_mut);
    for material in materials.into_iter().flatten() {
        let Some(extensions) = material.get_mut("extensions").and_then(Value::as_object_mut) else { continue };
        let texture = extensions.get(names::DIFFUSE_TRANSMISSION).and_then(|e| e.get("diffuseTransmissionTexture"));
        if texture.and_then(|t| index_of(t, "index")).is_some_and(|index| ours.contains(&index)) {
            extensions.shift_remove(names::DIFFUSE_TRANSMISSION);
        }
    }
}

/// Cuts lists and buffer back to what they were.
fn cut(document: &mut Document, contents: &Contents) {
    for pointer in LISTS {
        let key = pointer.trim_start_matches('/');
        let Some(root) = document.json.as_object_mut() else { return };
        match contents.notes.lengths.get(*pointer) {
            Some(length) => {
                if let Some(list) = root.get_mut(key).and_then(Value::as_array_mut) {
                    list.truncate(*length);
                }
            }
            None => {
                root.shift_remove(key);
            }
        }
    }
    for pointer in PICTURE_LISTS {
        let key = pointer.trim_start_matches('/');
        let (Some(root), Some(&length)) = (document.json.as_object_mut(), contents.notes.lengths.get(*pointer)) else {
            continue;
        };
        match root.get_mut(key).and_then(Value::as_array_mut) {
            Some(list) if length > 0 => list.truncate(length),
            _ => _ = root.shift_remove(key),
        }
    }
    match contents.notes.byte_length {
        Some(length) => {
            document.buffers.iter_mut().take(1).for_each(|b| b.truncate(length));
            set_byte_lengths(document);
        }
        None => document.buffers.clear(),
    }
}

fn strip_primitive(primitive: &mut Value, contents: &Contents, writes: &BTreeSet<&str>) {
    let extension = primitive.get("extensions").and_then(|e| e.get(names::EXTENSION));
    let kept: Vec<String> = extension
        .and_then(|e| e.get(KEPT)?.as_array())
        .into_iter()
        .flatten()
        .filter_map(|k| k.as_str().map(str::to_string))
        .collect();
    for name in writes {
        let attribute = match id_names(name) {
            Some((label, _)) => take_feature(primitive, &label),
            None => Some(contents.name(name).to_string()),
        };
        let attributes = primitive.get_mut("attributes").and_then(Value::as_object_mut);
        if let (Some(attributes), Some(attribute)) = (attributes, attribute) {
            attributes.shift_remove(&attribute);
        }
    }
    let role = primitive.pointer(&format!("{}/role", root_pointer())).cloned();
    let Some(primitive) = primitive.as_object_mut() else { return };
    for container in ["extensions", "extras"] {
        let Some(object) = primitive.get_mut(container).and_then(Value::as_object_mut) else { continue };
        // Extras may hold the name on somebody else's behalf: only a role is ours.
        let found = object.get(names::EXTENSION).and_then(|e| e.get("role"));
        let ours = found.is_some() && (role.is_none() || found == role.as_ref());
        let mut touched = ours && object.shift_remove(names::EXTENSION).is_some();
        if container == "extensions" {
            touched |= remove_member_if_empty(object, names::MESH_FEATURES);
        }
        if touched && object.is_empty() && !kept.iter().any(|k| k == container) {
            primitive.shift_remove(container);
        }
    }
}

/// Removes the feature ids of a label; gives the name of their attribute.
fn take_feature(primitive: &mut Value, label: &str) -> Option<String> {
    let number = index_of(feature(primitive, label)?, "attribute")?;
    let features = primitive.get_mut("extensions")?.get_mut(names::MESH_FEATURES)?.as_object_mut()?;
    let list = features.get_mut("featureIds")?.as_array_mut()?;
    let last = list.iter().rposition(|f| f.get("label").is_some_and(|l| l == label))?;
    list.remove(last);
    if list.is_empty() {
        features.shift_remove("featureIds");
    }
    Some(format!("{}{number}", names::FEATURE_ID_PREFIX))
}

fn remove_member_if_empty(object: &mut Map<String, Value>, key: &str) -> bool {
    let empty = object.get(key).and_then(Value::as_object).is_some_and(Map::is_empty);
    if empty {
        object.shift_remove(key);
    }
    empty
}

fn remove_if_empty(json: &mut Value, pointer: &str) {
    let Some((parent, key)) = pointer.rsplit_once('/') else { return };
    if let Some(object) = json.pointer_mut(parent).and_then(Value::as_object_mut) {
        remove_member_if_empty(object, key);
    }
}

/// Whether what a record says it wrote is a map.
fn is_map(written: &str) -> bool {
    [names::WRITES_RASTER, names::WRITES_PICTURE].into_iter().any(|prefix| written.starts_with(prefix))
}

/// Removes foliar's classes and tables.
fn strip_metadata(json: &mut Value, contents: &Contents, writes: &BTreeSet<&str>) {
    let columns = writes.iter().filter(|w| !is_map(w));
    let classes: BTreeSet<&str> =
        columns.filter_map(|w| w.split_once('/')).map(|(class, _)| contents.name(class)).collect();
    let ours = |class: Option<&Value>| class.and_then(Value::as_str).is_some_and(|c| classes.contains(c));
    let Some(metadata) = json.pointer_mut(&metadata_pointer("")).and_then(Value::as_object_mut) else {
        return;
    };
    if let Some(tables) = metadata.get_mut("propertyTables").and_then(Value::as_array_mut) {
        tables.retain(|table| !ours(table.get("class")));
        if tables.is_empty() && !contents.notes.lengths.contains_key(&metadata_pointer("/propertyTables")) {
            metadata.shift_remove("propertyTables");
        }
    }
    let Some(schema) = metadata.get_mut("schema").and_then(Value::as_object_mut) else { return };
    if let Some(all) = schema.get_mut("classes").and_then(Value::as_object_mut) {
        classes.iter().for_each(|class| {
            all.shift_remove(*class);
        });
    }
    if contents.notes.created.contains(&metadata_pointer("/schema")) {
        schema.shift_remove("id");
    }
}
