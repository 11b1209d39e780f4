//! Values per vertex: one buffer view per channel, one accessor per primitive. Where one primitive of
//! a mesh has a channel all get it, since engines want one vertex layout per mesh.

use super::builder::{Builder, Content, primitive_mut};
use super::check;
use crate::accessor::Source;
use crate::document::primitives;
use crate::notes::{id_names, view_name};
use crate::{CarrierError, Document, neutral};
use foliar_bake::Layer;
use foliar_plant::Place;
use foliar_schema::{Finding, channel, code, names};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Component type of floats (glTF 2.0 section 3.6.2.2).
const FLOAT: u32 = 5126;

/// One channel's values of one primitive.
struct Values {
    place: Place,
    width: usize,
    data: Vec<f32>,
}

/// Writes all attributes of all layers.
pub(super) fn write(builder: &mut Builder, base: &Document, layers: &[&Layer]) -> Result<(), CarrierError> {
    let rows = check::table_rows(layers)?;
    for layer in layers {
        let channels: BTreeSet<&str> = layer.attributes.keys().map(|k| k.name.as_str()).collect();
        for name in channels {
            let ids = id_names(name);
            let rows = ids.as_ref().and_then(|(_, class)| rows.get(class)).copied().unwrap_or(0);
            let values = values_of(base, layer, name, rows)?;
            let written = match &ids {
                Some((label, class)) => declare_ids(builder, &values, label, class, rows)?,
                None => free_attribute(builder, name, &values),
            };
            append(builder, &layer.record.room, name, &values, &written)?;
        }
    }
    Ok(())
}

/// All primitives of all meshes that carry the channel, neutral where the layer has nothing.
fn values_of(base: &Document, layer: &Layer, name: &str, rows: usize) -> Result<Vec<Values>, CarrierError> {
    let meshes: BTreeSet<u32> = layer.attributes.keys().filter(|k| k.name == name).map(|k| k.place.mesh).collect();
    let source = Source { document: base, file: "base" };
    let mut out = Vec::new();
    for mesh in meshes {
        let primitives = base.item("meshes", mesh as usize).and_then(|m| m.get("primitives")).and_then(Value::as_array);
        for (index, primitive) in primitives.into_iter().flatten().enumerate() {
            let place = Place { mesh, primitive: index as u32 };
            if let Some(array) = layer.attribute(place, name) {
                let data = array.as_f32().unwrap_or_default().to_vec();
                out.push(Values { place, width: array.width(), data });
            } else if let (Some(channel), Ok(count)) = (channel(name), check::vertices(base, place, "")) {
                let data = neutral::fill(source, primitive, channel, count, rows as f32)?;
                out.push(Values { place, width: channel.width, data });
            }
        }
    }
    Ok(out)
}

/// Name of an attribute that no primitive of the file has yet: a reader knows foliar's by name.
fn free_attribute(builder: &mut Builder, name: &str, values: &[Values]) -> BTreeMap<u32, String> {
    let all = primitives(&builder.document).map(|(place, _)| place);
    let taken: BTreeSet<String> = all.flat_map(|place| attribute_names(&builder.document, place)).collect();
    let place = values.first().map_or(String::new(), |v| format!("/meshes/{}", v.place.mesh));
    let free = builder.free_name(name, &place, |n| taken.contains(n));
    values.iter().map(|v| (v.place.mesh, free.clone())).collect()
}

fn attribute_names(document: &Document, place: Place) -> Vec<String> {
    let attributes = check::primitive(document, place).and_then(|p| p.get("attributes")).and_then(Value::as_object);
    attributes.map_or(Vec::new(), |a| a.keys().cloned().collect())
}

/// Declares ids in EXT_mesh_features under the first number that is free in all primitives of a mesh.
fn declare_ids(
    builder: &mut Builder,
    values: &[Values],
    label: &str,
    class: &str,
    rows: usize,
) -> Result<BTreeMap<u32, String>, CarrierError> {
    builder.use_extension(names::MESH_FEATURES)?;
    let mut taken: BTreeMap<u32, BTreeSet<String>> = BTreeMap::new();
    for value in values {
        taken.entry(value.place.mesh).or_default().extend(attribute_names(&builder.document, value.place));
    }
    let mut written = BTreeMap::new();
    for (mesh, taken) in taken {
        let attribute = |n: usize| format!("{}{n}", names::FEATURE_ID_PREFIX);
        // There are fewer names than numbers up to their count.
        let number = (0..=taken.len()).find(|n| !taken.contains(&attribute(*n))).unwrap_or(taken.len());
        if foreign_ids(&builder.document, mesh) && number > 0 {
            let message = format!("{} is taken by the base: {} holds {label}", attribute(0), attribute(number));
            builder.findings.push(Finding::new(&code::NAME_TAKEN, message).at(format!("/meshes/{mesh}")));
        }
        written.insert(mesh, attribute(number));
        for value in values.iter().filter(|v| v.place.mesh == mesh) {
            let mut feature = json!({
                "featureCount": rows.max(1), "nullFeatureId": rows, "label": label, "attribute": number
            });
            if let Some(table) = builder.tables.get(class) {
                feature["propertyTable"] = (*table).into();
            }
            push_feature(builder, value.place, feature)?;
        }
    }
    Ok(written)
}

/// Whether the base has feature ids of its own in a mesh.
fn foreign_ids(document: &Document, mesh: u32) -> bool {
    let primitives = document.item("meshes", mesh as usize).and_then(|m| m.get("primitives")).and_then(Value::as_array);
    let ours = |feature: &Value| feature.get("label").and_then(Value::as_str).is_some_and(|l| l.starts_with("foliar_"));
    let declared = |p: &Value| {
        let features = p.get("extensions").and_then(|e| e.get(names::MESH_FEATURES)).and_then(|e| e.get("featureIds"));
        features.and_then(Value::as_array).is_some_and(|f| f.iter().all(ours))
    };
    !primitives.into_iter().flatten().all(declared)
}

fn push_feature(builder: &mut Builder, place: Place, feature: Value) -> Result<(), CarrierError> {
    let pointer = format!("/meshes/{}/primitives/{}/extensions", place.mesh, place.primitive);
    let problem = format!("is not as {} has it", names::MESH_FEATURES);
    let fail = || CarrierError::input("base", pointer.clone(), problem.clone(), "export it again");
    let primitive = primitive_mut(&mut builder.document.json, place).ok_or_else(fail)?;
    let extensions = primitive.get("extensions").and_then(Value::as_object);
    if extensions.is_some_and(Map::is_empty) {
        builder.kept_extensions.insert(place);
    }
    let extensions = primitive.entry("extensions").or_insert_with(|| json!({})).as_object_mut().ok_or_else(fail)?;
    let features =
        extensions.entry(names::MESH_FEATURES).or_insert_with(|| json!({})).as_object_mut().ok_or_else(fail)?;
    features.entry("featureIds").or_insert_with(|| json!([])).as_array_mut().ok_or_else(fail)?.push(feature);
    Ok(())
}

/// One view with the values of all primitives, one accessor each.
fn append(
    builder: &mut Builder,
    room: &str,
    channel: &str,
    values: &[Values],
    names: &BTreeMap<u32, String>,
) -> Result<(), CarrierError> {
    let Some(width) = values.first().map(|v| v.width) else { return Ok(()) };
    let stride = width * size_of::<f32>();
    let bytes: Vec<u8> = values.iter().flat_map(|v| bytemuck::cast_slice::<f32, u8>(&v.data)).copied().collect();
    let view = builder.view(&view_name(room, channel), &bytes, Content::Attribute { stride })?;
    let mut offset = 0;
    for value in values {
        let count = value.data.len() / width;
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][width.clamp(1, 4) - 1];
        let accessor = json!({
            "bufferView": view, "byteOffset": offset, "componentType": FLOAT, "count": count, "type": kind
        });
        let accessor = builder.push(&[], "accessors", accessor)?;
        let attributes = primitive_mut(&mut builder.document.json, value.place)
            .and_then(|p| p.get_mut("attributes")?.as_object_mut());
        if let (Some(attributes), Some(name)) = (attributes, names.get(&value.place.mesh)) {
            attributes.insert(name.clone(), accessor.into());
        }
        offset += count * stride;
    }
    Ok(())
}
