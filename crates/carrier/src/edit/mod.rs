//! Replacing what a base holds, for files that ship: attributes, and the back sides of leaves. In place
//! where the bytes belong to nothing else, so that a packed file is no longer than it must be; appended
//! where they do not.

mod owned;
mod read;
mod sheets;
mod slot;

pub use read::{Stored, attribute, attribute_names, bytes_per_vertex};

use crate::assemble::{Builder, Content, primitive_mut};
use crate::notes::view_name;
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
    /// Primitives of two-sided materials that become two one-sided sheets over the same vertices: neither
    /// has a back whose normals a viewer would turn over.
    pub sheets: BTreeSet<Place>,
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
    sheets::add(&mut builder, &edits.sheets)?;
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
        let old = old.map(|accessor| accessor as usize);
        if let Some(slot) = old.and_then(|accessor| Slot::find(&builder.document, accessor, kind)) {
            slot.write(&mut builder.document, new.numbers.bytes(), new.width * new.numbers.size());
        } else if let Some(old) = old.filter(|accessor| slot::is_sole(&builder.document, *accessor)) {
            let (bytes, stride) = aligned(new);
            owned::replace(&mut builder.document, old, definition(new), &bytes, Content::Attribute { stride });
        } else {
            appended.entry((new.numbers.component(), new.width)).or_default().push(new);
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

/// Bytes with each vertex on a multiple of four (glTF 2.0 section 3.6.2.4), and how many each takes.
fn aligned(new: &NewAttribute) -> (Vec<u8>, usize) {
    let size = new.width * new.numbers.size();
    let stride = size.next_multiple_of(4);
    let padding = [0; 4];
    let vertices = new.numbers.bytes().chunks_exact(size);
    (vertices.flat_map(|vertex| vertex.iter().chain(&padding[..stride - size])).copied().collect(), stride)
}

/// An accessor but for its place.
fn definition(new: &NewAttribute) -> Value {
    let count = new.numbers.bytes().len() / (new.width * new.numbers.size());
    let mut accessor = json!({"componentType": new.numbers.component(), "count": count, "type": kind(new.width)});
    if new.numbers.is_normalized() {
        accessor["normalized"] = true.into();
    }
    accessor
}

/// One view for all.
fn append(builder: &mut Builder, name: &str, group: &[&NewAttribute]) -> Result<(), CarrierError> {
    let parts: Vec<(Vec<u8>, usize)> = group.iter().map(|new| aligned(new)).collect();
    let Some((_, stride)) = parts.first() else { return Ok(()) };
    let content = Content::Attribute { stride: *stride };
    let bytes: Vec<u8> = parts.iter().flat_map(|(bytes, _)| bytes).copied().collect();
    let view = builder.view(&view_name(PACK, name), &bytes, content)?;
    let mut offset = 0;
    for (new, (bytes, _)) in group.iter().zip(&parts) {
        let mut accessor = owned::with_view(definition(new), view);
        accessor["byteOffset"] = offset.into();
        offset += bytes.len();
        let index = builder.push(&[], "accessors", accessor)?;
        if let Some(attributes) = attributes_mut(&mut builder.document.json, new.place) {
            attributes.insert(name.into(), index.into());
        }
    }
    Ok(())
}
