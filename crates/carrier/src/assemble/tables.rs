//! Property tables of EXT_structural_metadata: classes join the schema of the file. Where that schema
//! lies in another file (`schemaUri`, which excludes a schema here) the tables are named in
//! FOLIAR_foliage instead, by buffer view, and a finding says so.

use super::builder::{Builder, Content};
use super::check;
use crate::notes::{PROPERTIES, TABLES, metadata_pointer, view_name};
use crate::{CarrierError, Document};
use foliar_bake::{Array, ColumnKey, Layer};
use foliar_schema::{COLUMNS, Element, Finding, code, column, names};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// A column with the room that wrote it.
struct Written<'a> {
    key: &'a ColumnKey,
    array: &'a Array,
    layer: &'a Layer,
}

/// Writes the tables of all layers, one per class.
pub(super) fn write(builder: &mut Builder, layers: &[&Layer]) -> Result<(), CarrierError> {
    let rows = check::table_rows(layers)?;
    let mut classes: BTreeMap<&str, Vec<Written>> = BTreeMap::new();
    for layer in layers {
        for (key, array) in &layer.columns {
            classes.entry(&key.class).or_default().push(Written { key, array, layer });
        }
    }
    for (class, mut columns) in classes {
        // EXT_structural_metadata wants at least one row: an empty table is listed in our own extension.
        let count = rows.get(class).copied().unwrap_or(0);
        columns.sort_by_key(|w| rank(w.key));
        if count == 0 {
            let definitions = columns.iter().map(|w| (w.key.property.clone(), definition(w))).collect();
            list(builder, class, 0, definitions);
            continue;
        }
        let mut definitions = Map::new();
        let mut values = Map::new();
        for written in &columns {
            let name = format!("{class}/{}", written.key.property);
            let name = view_name(&written.layer.record.room, &name);
            let view = builder.view(&name, written.array.bytes(), Content::Column)?;
            definitions.insert(written.key.property.clone(), definition(written));
            values.insert(written.key.property.clone(), json!({ "values": view }));
        }
        if has_schema_uri(&builder.document) {
            name_views(builder, class, count, &columns, definitions);
        } else {
            add_table(builder, class, count, definitions, values)?;
        }
    }
    Ok(())
}

/// Order of properties: as the schema lists them, unknown ones after them by name.
fn rank(key: &ColumnKey) -> (usize, String) {
    let known = COLUMNS.iter().position(|c| c.class == key.class && c.name == key.property);
    (known.unwrap_or(COLUMNS.len()), key.property.clone())
}

/// A property as a class defines it.
fn definition(written: &Written) -> Value {
    let ColumnKey { class, property } = written.key;
    let kept = written.layer.record.more.get(PROPERTIES).and_then(|p| p.get(format!("{class}/{property}")));
    if let Some(kept) = kept {
        return kept.clone();
    }
    let known = column(class, property);
    let width = written.array.width();
    let float = known.map_or(written.array.as_f32().is_some(), |c| c.element == Element::F32);
    let array = known.map_or(width > 4, |c| c.array);
    let kind = match width {
        2..=4 if !array => format!("VEC{width}"),
        _ => "SCALAR".into(),
    };
    let mut out = json!({ "type": kind, "componentType": if float { "FLOAT32" } else { "INT32" } });
    if array {
        out["array"] = true.into();
        out["count"] = width.into();
    }
    out["required"] = true.into();
    if let Some(known) = known {
        out["description"] = format!("{} ({})", known.doc, known.unit).into();
    }
    out
}

fn has_schema_uri(document: &Document) -> bool {
    let metadata = document.json.get("extensions").and_then(|e| e.get(names::STRUCTURAL_METADATA));
    metadata.is_some_and(|m| m.get("schemaUri").is_some())
}

fn add_table(
    builder: &mut Builder,
    class: &str,
    count: usize,
    definitions: Map<String, Value>,
    values: Map<String, Value>,
) -> Result<(), CarrierError> {
    const METADATA: &[&str] = &["extensions", names::STRUCTURAL_METADATA];
    const SCHEMA: &[&str] = &["extensions", names::STRUCTURAL_METADATA, "schema"];
    const CLASSES: &[&str] = &["extensions", names::STRUCTURAL_METADATA, "schema", "classes"];
    builder.use_extension(names::STRUCTURAL_METADATA)?;
    let own = builder.document.json.pointer(&metadata_pointer("/schema")).is_none();
    let schema = builder.require_object(SCHEMA)?;
    if own {
        schema.insert("id".into(), names::METADATA_SCHEMA_ID.into());
    }
    let taken: Vec<String> = builder.require_object(CLASSES)?.keys().cloned().collect();
    let name = builder.free_name(class, &metadata_pointer("/schema/classes"), |n| taken.iter().any(|t| t == n));
    builder.require_object(CLASSES)?.insert(name.clone(), json!({ "properties": definitions }));
    let table = json!({ "class": name, "count": count, "properties": values });
    let index = builder.push(METADATA, "propertyTables", table)?;
    builder.tables.insert(class.into(), index);
    Ok(())
}

/// Lists a table in our own extension, its columns by the names of their buffer views.
fn name_views(builder: &mut Builder, class: &str, count: usize, columns: &[Written], definitions: Map<String, Value>) {
    let mut properties = definitions;
    for written in columns {
        let view = view_name(&written.layer.record.room, &format!("{class}/{}", written.key.property));
        if let Some(property) = properties.get_mut(&written.key.property).and_then(Value::as_object_mut) {
            property.insert("bufferView".into(), view.into());
        }
    }
    list(builder, class, count, properties);
    let message =
        format!("the file's metadata schema lies in another file: table {class} is listed in {}", names::EXTENSION);
    let place = metadata_pointer("/schemaUri");
    builder.findings.push(Finding::new(&code::NAME_TAKEN, message).at(place));
}

/// Lists a table in the root extension.
fn list(builder: &mut Builder, class: &str, count: usize, properties: Map<String, Value>) {
    let tables = builder.more.entry(TABLES).or_insert_with(|| json!({}));
    if let Some(tables) = tables.as_object_mut() {
        tables.insert(class.into(), json!({ "count": count, "properties": properties }));
    }
}
