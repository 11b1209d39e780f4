//! The layers of a master: every array that a record says it wrote, found by name.

use super::Contents;
use super::maps::MapReader;
use crate::accessor::{Source, type_width};
use crate::document::{index_of, primitives};
use crate::layer_file::damage;
use crate::notes::{PROPERTIES, TABLES, id_names};
use crate::{CarrierError, Document, neutral};
use foliar_bake::{Array, AttributeKey, ColumnKey, Layer};
use foliar_plant::Place;
use foliar_schema::{Finding, ROOMS, Record, Role, channel, code, names};
use serde_json::{Map, Value, json};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What is said of a layer that holds what no room can have written.
pub const DAMAGED: &str = "the layer is damaged and left out";

/// What reading layers needs.
struct Reader<'a> {
    source: Source<'a>,
    contents: &'a Contents,
    roles: BTreeMap<Place, Role>,
    files: &'a RefCell<Vec<PathBuf>>,
}

/// Reads the layers of all records, in their order.
pub(super) fn read(
    document: &Document,
    file: &str,
    contents: &Contents,
    findings: &mut Vec<Finding>,
    files: &RefCell<Vec<PathBuf>>,
) -> Result<Vec<Layer>, CarrierError> {
    let source = Source { document, file };
    let roles = primitives(document).filter_map(|(place, p)| Some((place, role_of(p)?))).collect();
    let reader = Reader { source, contents, roles, files };
    let mut layers = Vec::new();
    for record in &contents.extension.records {
        let layer = reader.layer(record, findings)?;
        match damage(&layer) {
            None => layers.push(layer),
            // What is found again from the base is worth more than numbers that nobody can have meant.
            Some(problem) => {
                let message = format!("{}: {problem}: {DAMAGED}: bake it again", record.room);
                findings.push(Finding::new(&code::STALE, message).in_file(file));
            }
        }
    }
    Ok(layers)
}

fn role_of(primitive: &Value) -> Option<Role> {
    ["extensions", "extras"].into_iter().find_map(|container| {
        let role = primitive.get(container)?.get(names::EXTENSION)?.get("role")?;
        serde_json::from_value(role.clone()).ok()
    })
}

/// The feature id set of a primitive that carries this label; the last one, where a leftover has it too.
pub(super) fn feature<'a>(primitive: &'a Value, label: &str) -> Option<&'a Value> {
    let features = primitive.get("extensions")?.get(names::MESH_FEATURES)?.get("featureIds")?.as_array()?;
    features.iter().rfind(|f| f.get("label").is_some_and(|l| l == label))
}

impl Reader<'_> {
    fn maps(&self) -> MapReader<'_> {
        MapReader { source: self.source, links: &self.contents.extension.translucency, files: self.files }
    }

    fn layer(&self, record: &Record, findings: &mut Vec<Finding>) -> Result<Layer, CarrierError> {
        let known = ROOMS.contains(&record.room.as_str());
        let mut layer = Layer { record: record.clone(), ..Layer::default() };
        if record.room == names::ROOM_STRUCTURE {
            layer.roles.clone_from(&self.roles);
        }
        let mut properties = Map::new();
        for name in &record.writes {
            let map = name.strip_prefix(names::WRITES_RASTER);
            let picture = name.strip_prefix(names::WRITES_PICTURE);
            let found = match name.split_once('/') {
                _ if map.is_some() => self.maps().raster(map.unwrap_or_default(), &mut layer, findings)?,
                _ if picture.is_some() => self.maps().picture(picture.unwrap_or_default(), &mut layer)?,
                Some((class, property)) => self.column(class, property, &mut layer, &mut properties)?,
                None => self.attribute(name, &mut layer)?,
            };
            if !found {
                let message = format!("{name} of {} is missing, a tool has dropped it: run foliar rebake", record.room);
                findings.push(Finding::new(&code::STALE, message).in_file(self.source.file));
            }
        }
        if !known {
            let message = format!("{} is no room of this version: its layer is kept as it is", record.room);
            findings.push(Finding::new(&code::RECORD_UNKNOWN, message).in_file(self.source.file));
            if !properties.is_empty() {
                layer.record.more.insert(PROPERTIES.into(), properties.into());
            }
        }
        Ok(layer)
    }

    /// Values per vertex of all primitives that have them, but for what is mere filling.
    fn attribute(&self, name: &str, layer: &mut Layer) -> Result<bool, CarrierError> {
        let ids = id_names(name);
        let mut found = false;
        for (place, primitive) in primitives(self.source.document) {
            let (attribute, null) = match &ids {
                Some((label, _)) => match feature(primitive, label) {
                    Some(feature) => {
                        let number = index_of(feature, "attribute").unwrap_or(0);
                        let null = feature.get("nullFeatureId").and_then(Value::as_f64).unwrap_or(0.0);
                        (format!("{}{number}", names::FEATURE_ID_PREFIX), null as f32)
                    }
                    None => continue,
                },
                None => (self.contents.name(name).to_string(), 0.0),
            };
            let Some(accessor) = primitive.get("attributes").and_then(|a| index_of(a, &attribute)) else { continue };
            found = true;
            let kind =
                self.source.document.item("accessors", accessor).and_then(|a| a.get("type")).and_then(Value::as_str);
            let width = kind.and_then(type_width).unwrap_or(1);
            let data = self.source.floats(accessor, width)?;
            if !self.is_filling(name, place, primitive, &data, null)? {
                let key = AttributeKey { place, name: name.into() };
                layer.attributes.insert(key, Array::F32 { width, data });
            }
        }
        Ok(found)
    }

    /// Whether all values are the neutral ones, on a primitive that the channel says nothing about.
    fn is_filling(
        &self,
        name: &str,
        place: Place,
        primitive: &Value,
        data: &[f32],
        null_id: f32,
    ) -> Result<bool, CarrierError> {
        let Some(channel) = channel(name) else { return Ok(false) };
        if self.roles.get(&place).is_some_and(|role| channel.roles.contains(role)) {
            return Ok(false);
        }
        let filling = neutral::fill(self.source, primitive, channel, data.len() / channel.width, null_id)?;
        Ok(bytemuck::cast_slice::<f32, u8>(&filling) == bytemuck::cast_slice::<f32, u8>(data))
    }

    /// One column, from EXT_structural_metadata or, where that could not hold it, by view name.
    fn column(
        &self,
        class: &str,
        property: &str,
        layer: &mut Layer,
        properties: &mut Map<String, Value>,
    ) -> Result<bool, CarrierError> {
        let found = match self.metadata_column(class, property) {
            Some(found) => Some(found),
            None => self.named_column(class, property),
        };
        let Some((rows, view, definition)) = found else { return Ok(false) };
        let place = format!("table {class}, property {property}");
        let kind = definition.get("type").and_then(Value::as_str).unwrap_or("");
        let length = definition.get("count").and_then(Value::as_u64).map(|n| n as usize);
        let width = type_width(kind).map(|w| w * length.unwrap_or(1)).filter(|w| *w > 0);
        let width = width.ok_or_else(|| self.source.fail(place.clone(), format!("type {kind:?} is not read")))?;
        let bytes = match view {
            Some(view) => self.source.view(view)?,
            None => &[],
        };
        let needed = rows.checked_mul(width * 4).filter(|n| *n <= bytes.len());
        let Some(needed) = needed else {
            return Err(self.source.fail(place, format!("{rows} rows do not fit {} bytes", bytes.len())));
        };
        let words = bytes[..needed].chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
        let array = match definition.get("componentType").and_then(Value::as_str) {
            Some("FLOAT32") => Array::F32 { width, data: words.map(f32::from_le_bytes).collect() },
            Some("INT32") => Array::I32 { width, data: words.map(i32::from_le_bytes).collect() },
            other => return Err(self.source.fail(place, format!("component type {other:?} is not read"))),
        };
        layer.columns.insert(ColumnKey { class: class.into(), property: property.into() }, array);
        properties.insert(format!("{class}/{property}"), definition);
        Ok(true)
    }

    fn metadata_column(&self, class: &str, property: &str) -> Option<(usize, Option<usize>, Value)> {
        let metadata = self.source.document.json.get("extensions")?.get(names::STRUCTURAL_METADATA)?;
        let name = self.contents.name(class);
        let tables = metadata.get("propertyTables")?.as_array()?;
        let table = tables.iter().find(|t| t.get("class").is_some_and(|c| c == name))?;
        let view = index_of(table.get("properties")?.get(property)?, "values")?;
        let definition = metadata.get("schema")?.get("classes")?.get(name)?.get("properties")?.get(property)?;
        Some((index_of(table, "count")?, Some(view), definition.clone()))
    }

    /// A table that FOLIAR_foliage lists: by the names of its views, or as empty.
    fn named_column(&self, class: &str, property: &str) -> Option<(usize, Option<usize>, Value)> {
        let table = self.contents.extension.more.get(TABLES)?.get(class)?;
        let count = index_of(table, "count")?;
        let definition = table.get("properties")?.get(property)?;
        if count == 0 {
            return Some((0, None, definition.clone()));
        }
        let name = definition.get("bufferView")?;
        let views = self.source.document.list("bufferViews");
        let view = views.iter().position(|v| v.get("name").unwrap_or(&json!(null)) == name)?;
        let mut definition = definition.clone();
        definition.as_object_mut()?.shift_remove("bufferView");
        Some((count, Some(view), definition))
    }
}
