//! Whether layers belong to a base, and to each other.

use crate::CarrierError;
use crate::Document;
use crate::accessor::Source;
use crate::document::index_of;
use crate::notes::id_names;
use foliar_bake::{Array, Layer};
use foliar_plant::Place;
use foliar_schema::{Element, channel, column, names};
use serde_json::Value;
use std::collections::BTreeMap;

const BAKE_AGAIN: &str = "bake it again from this base";

/// Refuses what does not fit.
pub(super) fn layers(base: &Document, layers: &[&Layer]) -> Result<(), CarrierError> {
    if let Some(pair) = layers.windows(2).find(|w| w[0].record.room == w[1].record.room) {
        return Err(CarrierError::mismatch(&pair[0].record.room, "", "is given twice", "give it once"));
    }
    let rows = table_rows(layers)?;
    for layer in layers {
        let room = &layer.record.room;
        reads(layer, layers)?;
        for place in layer.roles.keys() {
            vertices(base, *place, room)?;
        }
        for (key, array) in &layer.attributes {
            attribute(base, layer, key.place, &key.name, array, &rows)?;
        }
        for (key, array) in &layer.columns {
            let name = format!("{}/{}", key.class, key.property);
            written(layer, &name)?;
            let known = column(&key.class, &key.property);
            let fits = known
                .is_none_or(|c| c.width == array.width() && (c.element == Element::F32) == array.as_f32().is_some());
            if !fits || array.width() == 0 {
                return Err(CarrierError::mismatch(room, name, "has another type than the contract says", BAKE_AGAIN));
            }
        }
    }
    Ok(())
}

/// Rows of each class; all its columns have the same.
pub(super) fn table_rows(layers: &[&Layer]) -> Result<BTreeMap<String, usize>, CarrierError> {
    let mut rows: BTreeMap<String, usize> = BTreeMap::new();
    for layer in layers {
        for (key, array) in &layer.columns {
            let wanted = *rows.entry(key.class.clone()).or_insert(array.rows());
            if wanted != array.rows() {
                let problem = format!("{} rows where the table has {wanted}", array.rows());
                let name = format!("{}/{}", key.class, key.property);
                return Err(CarrierError::mismatch(&layer.record.room, name, problem, BAKE_AGAIN));
            }
        }
    }
    Ok(rows)
}

/// A record names the layers that it was baked from: they must be these.
fn reads(layer: &Layer, layers: &[&Layer]) -> Result<(), CarrierError> {
    for (name, hash) in &layer.record.reads {
        let Some(other) = layers.iter().find(|other| other.record.room == *name) else {
            if name == names::ROOM_BRANCHES {
                let remedy = "give that layer too (foliar bake --only branches writes it)";
                let problem = "it was baked from the layer branches, which is not here";
                return Err(CarrierError::mismatch(&layer.record.room, "", problem, remedy));
            }
            continue;
        };
        let found = other.content_hash();
        if found != *hash {
            let problem = format!("it was baked from the layer {name} {hash}, this one is {found}");
            return Err(CarrierError::mismatch(&layer.record.room, "", problem, "bake it again from this layer"));
        }
    }
    Ok(())
}

fn written(layer: &Layer, name: &str) -> Result<(), CarrierError> {
    if layer.record.writes.iter().any(|w| w == name) {
        return Ok(());
    }
    Err(CarrierError::mismatch(
        &layer.record.room,
        name,
        "is not among what its record writes",
        "report it: a fault of foliar",
    ))
}

fn attribute(
    base: &Document,
    layer: &Layer,
    place: Place,
    name: &str,
    array: &Array,
    rows: &BTreeMap<String, usize>,
) -> Result<(), CarrierError> {
    let room = &layer.record.room;
    let at = format!("{name} of mesh {} primitive {}", place.mesh, place.primitive);
    let fail = |problem: String| Err(CarrierError::mismatch(room, &at, problem, BAKE_AGAIN));
    written(layer, name)?;
    let count = vertices(base, place, room)?;
    let Some(values) = array.as_f32() else { return fail("integers, where attributes are floats".into()) };
    if array.rows() != count || values.len() != count * array.width() {
        return fail(format!("{} rows, the primitive has {count} vertices", array.rows()));
    }
    let width = channel(name).map_or(array.width().clamp(1, 4), |c| c.width);
    if array.width() != width {
        return fail(format!("{} numbers per vertex, must be {width}", array.width()));
    }
    if let Some((_, class)) = id_names(name) {
        let null = rows.get(&class).copied().unwrap_or(0) as f32;
        if let Some(bad) = values.iter().find(|v| !(**v >= 0.0 && **v <= null && v.fract() == 0.0)) {
            return fail(format!("id {bad} is no row of {class} (0 to {null})"));
        }
    }
    Ok(())
}

/// Vertices of a primitive.
pub(crate) fn vertices(base: &Document, place: Place, room: &str) -> Result<usize, CarrierError> {
    let primitive = primitive(base, place);
    let position = primitive.and_then(|p| p.get("attributes")).and_then(|a| index_of(a, "POSITION"));
    match position {
        Some(accessor) => Source { document: base, file: "base" }.count(accessor),
        None => {
            let at = format!("mesh {} primitive {}", place.mesh, place.primitive);
            Err(CarrierError::mismatch(room, at, "does not exist in the base", BAKE_AGAIN))
        }
    }
}

/// A primitive of a document.
pub(super) fn primitive(document: &Document, place: Place) -> Option<&Value> {
    document.item("meshes", place.mesh as usize)?.get("primitives")?.get(place.primitive as usize)
}
