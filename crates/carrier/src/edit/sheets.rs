//! A second sheet of triangles, wound the other way, for materials that are seen from both sides. A viewer
//! turns the normals of back faces over (glTF 2.0 section 3.9.6), which is wrong for a normal that says how
//! the crown stands to the light. Two one-sided sheets over the same vertices show the same picture, and
//! neither has a back to be turned.

use super::{A_FAULT, PACK, owned, pointer, read, slot};
use crate::accessor::Source;
use crate::assemble::{Builder, Content, primitive_mut};
use crate::document::{index_of, primitives};
use crate::notes::view_name;
use crate::triangles::{self, Mode};
use crate::{CarrierError, Document};
use foliar_plant::Place;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

const VARIANTS: &str = "KHR_materials_variants";

/// Gives each of these primitives its second sheet, and a material that is seen from the front only.
pub(super) fn add(builder: &mut Builder, places: &BTreeSet<Place>) -> Result<(), CarrierError> {
    places.iter().try_for_each(|place| double(builder, *place))?;
    let mut others = BTreeSet::new();
    for (place, primitive) in primitives(&builder.document) {
        if !places.contains(&place) {
            others.extend(materials(primitive));
        }
    }
    let mut made = BTreeMap::new();
    for place in places {
        let wanted = primitive_mut(&mut builder.document.json, *place).map(|p| materials(&Value::Object(p.clone())));
        for material in wanted.into_iter().flatten() {
            let index = match made.get(&material) {
                Some(index) => *index,
                None => one_sided(builder, material, others.contains(&material))?,
            };
            made.insert(material, index);
        }
        if let Some(primitive) = primitive_mut(&mut builder.document.json, *place) {
            rename(primitive, &made);
        }
    }
    Ok(())
}

/// All materials that a primitive may be drawn with.
fn materials(primitive: &Value) -> Vec<usize> {
    let mappings = primitive.get("extensions").and_then(|e| e.get(VARIANTS)?.get("mappings")?.as_array());
    let variants = mappings.into_iter().flatten().filter_map(|mapping| index_of(mapping, "material"));
    index_of(primitive, "material").into_iter().chain(variants).collect()
}

fn rename(primitive: &mut serde_json::Map<String, Value>, made: &BTreeMap<usize, usize>) {
    let new = |value: &mut Value| {
        if let Some(index) = value.as_u64().and_then(|old| made.get(&(old as usize))) {
            *value = (*index).into();
        }
    };
    primitive.get_mut("material").into_iter().for_each(new);
    let variants =
        primitive.get_mut("extensions").and_then(|e| e.get_mut(VARIANTS)?.get_mut("mappings")?.as_array_mut());
    variants.into_iter().flatten().filter_map(|mapping| mapping.get_mut("material")).for_each(new);
}

/// The same material seen from its front only: itself, or a copy where others need it as it is.
fn one_sided(builder: &mut Builder, material: usize, copy: bool) -> Result<usize, CarrierError> {
    let index = match builder.document.item("materials", material).cloned().filter(|_| copy) {
        Some(item) => builder.push(&[], "materials", item)?,
        None => material,
    };
    let list = builder.document.json.get_mut("materials");
    if let Some(item) = list.and_then(|list| list.get_mut(index)?.as_object_mut()) {
        item.shift_remove("doubleSided");
    }
    Ok(index)
}

/// Writes all triangles, then all again the other way round; strips and fans become lists.
fn double(builder: &mut Builder, place: Place) -> Result<(), CarrierError> {
    let document = &builder.document;
    let fail = |problem: &str| CarrierError::input("base", pointer(place), problem, A_FAULT);
    let found = primitives(document).find(|(at, _)| *at == place);
    let primitive = found.map(|(_, primitive)| primitive).ok_or_else(|| fail("does not exist"))?;
    let mode = Mode::of(primitive).ok_or_else(|| fail("has no triangles"))?;
    let vertices = read::vertices(document, place)?;
    let source = Source { document, file: "base" };
    let front = triangles::read(source, primitive, mode, vertices, false, &pointer(place))?;
    let back = front.iter().map(|[a, b, c]| [*a, *c, *b]);
    let indices: Vec<u32> = front.iter().copied().chain(back).flatten().collect();
    let old = index_of(primitive, "indices");
    let (component, bytes) = stored(document, old, &indices, vertices);
    let accessor = json!({"componentType": component, "count": indices.len(), "type": "SCALAR"});
    let index = match old.filter(|old| slot::is_sole(document, *old)) {
        Some(old) => owned::replace(&mut builder.document, old, accessor, &bytes, Content::Indices),
        None => {
            let view = builder.view(&view_name(PACK, "indices"), &bytes, Content::Indices)?;
            builder.push(&[], "accessors", owned::with_view(accessor, view))?
        }
    };
    if let Some(primitive) = primitive_mut(&mut builder.document.json, place) {
        primitive.insert("indices".into(), index.into());
        primitive.shift_remove("mode");
    }
    Ok(())
}

/// Indices in the component type that they had, or the smallest that engines like.
fn stored(document: &Document, old: Option<usize>, indices: &[u32], vertices: usize) -> (u64, Vec<u8>) {
    let component = old.and_then(|a| document.item("accessors", a)?.get("componentType")?.as_u64());
    match component.unwrap_or(if vertices < usize::from(u16::MAX) { 5123 } else { 5125 }) {
        5121 => (5121, indices.iter().map(|i| *i as u8).collect()),
        5123 => (5123, indices.iter().flat_map(|i| (*i as u16).to_le_bytes()).collect()),
        _ => (5125, indices.iter().flat_map(|i| i.to_le_bytes()).collect()),
    }
}
