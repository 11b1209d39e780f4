//! Replacing what a base holds, for files that ship: attributes, and the side that a triangle is seen
//! from. In place where the bytes belong to nothing else, so that a packed file is no longer than it
//! must be; appended where they do not.

mod read;
mod slot;

pub use read::{Stored, attribute, attribute_names, bytes_per_vertex};

use crate::accessor::Source;
use crate::assemble::{Builder, Content, primitive_mut};
use crate::document::{index_of, primitives};
use crate::notes::view_name;
use crate::triangles::{self, Mode};
use crate::{CarrierError, Document};
use foliar_plant::Place;
use serde_json::{Value, json};
use slot::Slot;
use std::collections::{BTreeMap, BTreeSet};

/// The word where a room's name stands in the names of buffer views.
const PACK: &str = "pack";
const A_FAULT: &str = "report it: a fault of foliar";

/// Numbers of an attribute as they go into a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Floats.
    F32(Vec<f32>),
    /// Bytes, normalized: 255 is 1.
    U8(Vec<u8>),
    /// 16-bit integers, normalized: 65,535 is 1.
    U16(Vec<u16>),
}

impl Numbers {
    /// Component type (glTF 2.0 section 3.6.2.2).
    const fn component(&self) -> u32 {
        match self {
            Numbers::F32(_) => 5126,
            Numbers::U8(_) => 5121,
            Numbers::U16(_) => 5123,
        }
    }

    const fn is_normalized(&self) -> bool {
        !matches!(self, Numbers::F32(_))
    }

    fn bytes(&self) -> &[u8] {
        match self {
            Numbers::F32(data) => bytemuck::cast_slice(data),
            Numbers::U8(data) => data,
            Numbers::U16(data) => bytemuck::cast_slice(data),
        }
    }

    const fn size(&self) -> usize {
        match self {
            Numbers::F32(_) => 4,
            Numbers::U8(_) => 1,
            Numbers::U16(_) => 2,
        }
    }
}

/// An attribute of one primitive that is new or replaces another of its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NewAttribute {
    /// Which primitive.
    pub place: Place,
    /// Name in the file.
    pub name: String,
    /// Numbers per vertex.
    pub width: usize,
    /// The numbers, vertex after vertex.
    pub numbers: Numbers,
}

/// What is to change.
#[derive(Clone, Debug, Default)]
pub struct Edits {
    /// Attributes that are new or replaced.
    pub attributes: Vec<NewAttribute>,
    /// Attributes that go, by primitive and name.
    pub removed: Vec<(Place, String)>,
    /// Per primitive, which of its triangles show their other side as their front.
    pub turned: BTreeMap<Place, Vec<bool>>,
}

/// Makes the changes.
///
/// # Errors
/// [`CarrierError::Input`] where the document is not what the changes are about.
pub fn edit(document: &Document, edits: &Edits) -> Result<Document, CarrierError> {
    let mut builder = Builder::new(document);
    for (place, name) in &edits.removed {
        attributes_mut(&mut builder.document.json, *place).and_then(|a| a.shift_remove(name));
    }
    let names: BTreeSet<&str> = edits.attributes.iter().map(|a| a.name.as_str()).collect();
    for name in names {
        let group: Vec<&NewAttribute> = edits.attributes.iter().filter(|a| a.name == name).collect();
        set_attributes(&mut builder, name, &group)?;
    }
    for (place, turned) in &edits.turned {
        turn(&mut builder, *place, turned)?;
    }
    Ok(builder.finish().0)
}

fn attributes_mut(json: &mut Value, place: Place) -> Option<&mut serde_json::Map<String, Value>> {
    primitive_mut(json, place)?.get_mut("attributes")?.as_object_mut()
}

/// Sets one attribute of several primitives: in place, else as one new view for all.
fn set_attributes(builder: &mut Builder, name: &str, group: &[&NewAttribute]) -> Result<(), CarrierError> {
    let mut appended: BTreeMap<(u32, usize), Vec<&NewAttribute>> = BTreeMap::new();
    for new in group {
        check(&builder.document, new)?;
        let old = attributes_mut(&mut builder.document.json, new.place).and_then(|a| a.get(name)?.as_u64());
        let kind = (new.numbers.component(), kind(new.width), new.numbers.is_normalized());
        let slot = old.and_then(|accessor| Slot::find(&builder.document, accessor as usize, kind));
        match slot {
            Some(slot) => slot.write(&mut builder.document, new.numbers.bytes(), new.width * new.numbers.size()),
            None => appended.entry((new.numbers.component(), new.width)).or_default().push(new),
        }
    }
    appended.into_values().try_for_each(|group| append(builder, name, &group))
}

fn kind(width: usize) -> &'static str {
    ["SCALAR", "VEC2", "VEC3", "VEC4"][width.clamp(1, 4) - 1]
}

fn check(document: &Document, new: &NewAttribute) -> Result<(), CarrierError> {
    let count = read::vertices(document, new.place)?;
    let bytes = new.width * new.numbers.size();
    if new.numbers.bytes().len() == count * bytes {
        return Ok(());
    }
    let problem = format!("{} has {} bytes, must be {count} x {bytes}", new.name, new.numbers.bytes().len());
    Err(CarrierError::input("base", pointer(new.place), problem, A_FAULT))
}

fn pointer(place: Place) -> String {
    format!("/meshes/{}/primitives/{}", place.mesh, place.primitive)
}

/// One view for all, each vertex on a multiple of four bytes (glTF 2.0 section 3.6.2.4).
fn append(builder: &mut Builder, name: &str, group: &[&NewAttribute]) -> Result<(), CarrierError> {
    let Some(first) = group.first() else { return Ok(()) };
    let size = first.width * first.numbers.size();
    let stride = size.next_multiple_of(4);
    let mut bytes = Vec::new();
    let mut offsets = Vec::new();
    for new in group {
        offsets.push(bytes.len());
        for vertex in new.numbers.bytes().chunks_exact(size) {
            bytes.extend_from_slice(vertex);
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
    }
    let view = builder.view(&view_name(PACK, name), &bytes, Content::Attribute { stride })?;
    for (new, offset) in group.iter().zip(offsets) {
        let count = new.numbers.bytes().len() / size;
        let mut accessor = json!({
            "bufferView": view, "byteOffset": offset, "componentType": new.numbers.component(),
            "count": count, "type": kind(new.width)
        });
        if new.numbers.is_normalized() {
            accessor["normalized"] = true.into();
        }
        let index = builder.push(&[], "accessors", accessor)?;
        if let Some(attributes) = attributes_mut(&mut builder.document.json, new.place) {
            attributes.insert(name.into(), index.into());
        }
    }
    Ok(())
}

/// Turns triangles of one primitive to their other side; strips and fans become lists.
fn turn(builder: &mut Builder, place: Place, turned: &[bool]) -> Result<(), CarrierError> {
    let document = &builder.document;
    let fail = |problem: String| CarrierError::input("base", pointer(place), problem, A_FAULT);
    let Some(primitive) = primitives(document).find_map(|(at, p)| (at == place).then_some(p)) else {
        return Err(fail("does not exist".into()));
    };
    let mode = Mode::of(primitive).ok_or_else(|| fail("has no triangles".into()))?;
    let source = Source { document, file: "base" };
    let vertices = read::vertices(document, place)?;
    let mut list = triangles::read(source, primitive, mode, vertices, false, &pointer(place))?;
    if list.len() != turned.len() {
        return Err(fail(format!("{} triangles, {} are to be turned or not", list.len(), turned.len())));
    }
    list.iter_mut().zip(turned).filter(|(_, turned)| **turned).for_each(|(t, _)| t.swap(1, 2));
    let flat: Vec<u32> = list.into_iter().flatten().collect();
    let old = index_of(primitive, "indices").filter(|_| mode == Mode::List);
    let component = old.and_then(|a| document.item("accessors", a)?.get("componentType")?.as_u64());
    // 65,535 starts a strip anew, so that many vertices need wider indices.
    let component = component.unwrap_or(if vertices < usize::from(u16::MAX) { 5123 } else { 5125 }) as u32;
    let (bytes, size) = index_bytes(&flat, component);
    if let Some(slot) = old.and_then(|a| Slot::find(document, a, (component, "SCALAR", false))) {
        slot.write(&mut builder.document, &bytes, size);
        return Ok(());
    }
    let view = builder.view(&view_name(PACK, "indices"), &bytes, Content::Indices)?;
    let accessor = json!({"bufferView": view, "componentType": component, "count": flat.len(), "type": "SCALAR"});
    let index = builder.push(&[], "accessors", accessor)?;
    if let Some(primitive) = primitive_mut(&mut builder.document.json, place) {
        primitive.insert("indices".into(), index.into());
        primitive.shift_remove("mode");
    }
    Ok(())
}

/// Indices as a component type has them, and how many bytes each takes.
fn index_bytes(indices: &[u32], component: u32) -> (Vec<u8>, usize) {
    match component {
        5121 => (indices.iter().map(|i| *i as u8).collect(), 1),
        5123 => (indices.iter().flat_map(|i| (*i as u16).to_le_bytes()).collect(), 2),
        _ => (indices.iter().flat_map(|i| i.to_le_bytes()).collect(), 4),
    }
}
