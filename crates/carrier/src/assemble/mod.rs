//! Assembling: layers onto a base. Additive: lists grow at their end, objects get members at theirs,
//! nothing that exists is replaced; a name that is taken gives way to the next free one, with a finding.

mod attributes;
mod builder;
mod check;
mod tables;
mod textures;

use crate::notes::{KEPT, PROPERTIES, RENAMED, root_pointer};
use crate::{CarrierError, Document};
pub(crate) use builder::{Builder, Content, primitive_mut};
pub(crate) use check::vertices as vertices_of;
use foliar_bake::Layer;
use foliar_plant::Place;
use foliar_schema::{
    CONTRACT, Finding, FoliageExtension, PrimitiveExtension, ROOMS, Record, Role, SheetLinks, code, names,
};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
pub(crate) use textures::{Encoded, encode_map, rounding, shown_of};

/// Program and version that assembled the file.
const GENERATOR: &str = concat!("foliar ", env!("CARGO_PKG_VERSION"));

/// Puts layers onto a base.
pub(crate) fn assemble(base: &Document, layers: &[Layer]) -> Result<(Document, Vec<Finding>), CarrierError> {
    if layers.is_empty() {
        return Ok((base.clone(), Vec::new()));
    }
    if base.json.pointer("/extensions").and_then(|e| e.get(names::EXTENSION)).is_some() {
        let remedy = "update foliar, or start from the file that it was baked from";
        return Err(CarrierError::input("base", root_pointer(), "holds layers of a newer foliar", remedy));
    }
    let layers = in_order(layers);
    check::layers(base, &layers)?;
    let mut builder = Builder::new(base);
    tables::write(&mut builder, &layers)?;
    attributes::write(&mut builder, base, &layers)?;
    for layer in &layers {
        for (place, role) in &layer.roles {
            write_role(&mut builder, *place, *role)?;
        }
    }
    let links = textures::write(&mut builder, &layers)?;
    write_root(&mut builder, &layers, links)?;
    Ok(builder.finish())
}

/// Structure, then rooms as the schema lists them, then unknown ones by name.
fn in_order(layers: &[Layer]) -> Vec<&Layer> {
    let rank = |room: &str| ROOMS.iter().position(|r| *r == room).unwrap_or(ROOMS.len());
    let mut sorted: Vec<&Layer> = layers.iter().collect();
    sorted.sort_by_key(|layer| (rank(&layer.record.room), layer.record.room.clone()));
    sorted
}

/// The role of a primitive, as an extension and, where they are an object, in its extras.
fn write_role(builder: &mut Builder, place: Place, role: Role) -> Result<(), CarrierError> {
    let pointer = format!("/meshes/{}/primitives/{}", place.mesh, place.primitive);
    let value = serde_json::to_value(PrimitiveExtension { role }).unwrap_or_default();
    let Some(primitive) = primitive_mut(&mut builder.document.json, place) else {
        return Err(CarrierError::input("base", pointer, "is no object", "export it again"));
    };
    // Only what was there and empty cannot be told afterwards; feature ids may be in there already.
    let was_empty = |key: &str| primitive.get(key).and_then(Value::as_object).is_some_and(Map::is_empty);
    let mut kept: Vec<&str> = ["extensions", "extras"].into_iter().filter(|key| was_empty(key)).collect();
    if builder.kept_extensions.contains(&place) {
        kept.insert(0, "extensions");
    }
    let mut extension = value.clone();
    if let (false, Some(object)) = (kept.is_empty(), extension.as_object_mut()) {
        object.insert(KEPT.into(), json!(kept));
    }
    let extensions = primitive.entry("extensions").or_insert_with(|| json!({}));
    let Some(extensions) = extensions.as_object_mut() else {
        return Err(CarrierError::input("base", format!("{pointer}/extensions"), "is no object", "export it again"));
    };
    extensions.insert(names::EXTENSION.into(), extension);
    let extras = primitive.entry("extras").or_insert_with(|| json!({}));
    let mirrored = extras.as_object_mut().filter(|extras| !extras.contains_key(names::EXTENSION));
    match mirrored {
        Some(extras) => {
            extras.insert(names::EXTENSION.into(), value);
        }
        None => {
            let message = "extras are no object or hold the name already: the role stands in the extension alone";
            builder.findings.push(Finding::new(&code::NAME_TAKEN, message).at(format!("{pointer}/extras")));
        }
    }
    Ok(())
}

/// Root extension, its mirror in `asset.extras`, and `extensionsUsed`.
fn write_root(
    builder: &mut Builder,
    layers: &[&Layer],
    translucency: BTreeMap<String, SheetLinks>,
) -> Result<(), CarrierError> {
    builder.use_extension(names::EXTENSION)?;
    // Both containers are made before the notes are taken, which name them.
    builder.require_object(&["extensions"])?;
    let mirror = builder.object(&["asset", "extras"]).is_some_and(|extras| !extras.contains_key(names::EXTENSION));
    if !mirror {
        let message = "asset.extras are no object or hold the name already: there is no mirror of the extension";
        builder.findings.push(Finding::new(&code::NAME_TAKEN, message).at("/asset/extras"));
    }
    let mut more = std::mem::take(&mut builder.more);
    if !builder.renamed.is_empty() {
        more.insert(RENAMED.into(), json!(builder.renamed));
    }
    let extension = FoliageExtension {
        contract: CONTRACT,
        generator: GENERATOR.into(),
        records: layers.iter().map(|layer| written(&layer.record)).collect(),
        translucency,
        base: builder.notes.to_map(),
        more,
    };
    let value = serde_json::to_value(extension).map_err(|error| {
        CarrierError::input(names::EXTENSION, "", error.to_string(), "report it: a fault of foliar")
    })?;
    builder.require_object(&["extensions"])?.insert(names::EXTENSION.into(), value.clone());
    if let Some(extras) = builder.object(&["asset", "extras"]).filter(|_| mirror) {
        extras.insert(names::EXTENSION.into(), value);
    }
    Ok(())
}

/// A record as it is written: definitions of properties stand in the schema again.
fn written(record: &Record) -> Record {
    let mut record = record.clone();
    record.more.shift_remove(PROPERTIES);
    record
}
