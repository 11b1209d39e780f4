//! Reads accessors of any component type, normalized, strided, sparse or without a buffer view
//! (glTF 2.0 section 3.6.2), every bound checked before memory is taken.

use crate::document::index_of;
use crate::{CarrierError, Document};
use serde_json::Value;

/// Most elements of an accessor that no bytes stand behind (zeros): they cost nothing in the file,
/// so only this keeps a forged count from taking all memory.
const MOST_ZEROS: usize = 1 << 24;
const EXPORT_AGAIN: &str = "export it again";

/// A document with the name that messages use.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub document: &'a Document,
    pub file: &'a str,
}

#[derive(Clone, Copy, PartialEq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(number: u64) -> Option<Self> {
        use Component::*;
        Some(match number {
            5120 => I8,
            5121 => U8,
            5122 => I16,
            5123 => U16,
            5125 => U32,
            5126 => F32,
            _ => return None,
        })
    }

    const fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }
}

/// An accessor whose bytes are known to be there.
struct Layout<'a> {
    place: String,
    count: usize,
    width: usize,
    component: Component,
    normalized: bool,
    stride: usize,
    /// From the first element on; `None` means zeros.
    bytes: Option<&'a [u8]>,
    sparse: Option<&'a Value>,
}

impl<'a> Source<'a> {
    /// An error at a place of this document.
    pub fn fail(&self, place: impl Into<String>, problem: impl Into<String>) -> CarrierError {
        CarrierError::input(self.file, place, problem, EXPORT_AGAIN)
    }

    /// The bytes of a buffer view.
    pub fn view(&self, index: usize) -> Result<&'a [u8], CarrierError> {
        let place = format!("/bufferViews/{index}");
        let Some(view) = self.document.item("bufferViews", index) else {
            let count = self.document.list("bufferViews").len();
            return Err(self.fail(place, format!("does not exist: there are {count}")));
        };
        let buffer = index_of(view, "buffer").and_then(|b| self.document.buffers.get(b));
        let buffer = buffer.ok_or_else(|| self.fail(format!("{place}/buffer"), "names no buffer"))?;
        let offset = index_of(view, "byteOffset").unwrap_or(0);
        let length = index_of(view, "byteLength").ok_or_else(|| self.fail(place.clone(), "has no byteLength"))?;
        let end = offset.checked_add(length).filter(|end| *end <= buffer.len());
        end.map(|end| &buffer[offset..end]).ok_or_else(|| {
            self.fail(place, format!("{offset} + {length} bytes reach past the {} of its buffer", buffer.len()))
        })
    }

    /// Number of elements of an accessor, as it says.
    pub fn count(&self, index: usize) -> Result<usize, CarrierError> {
        let accessor = self.document.item("accessors", index);
        accessor
            .and_then(|a| index_of(a, "count"))
            .ok_or_else(|| self.fail(format!("/accessors/{index}"), "does not exist or has no count"))
    }

    /// All numbers of an accessor as floats, `width` per element; normalized integers as glTF says.
    pub fn floats(&self, index: usize, width: usize) -> Result<Vec<f32>, CarrierError> {
        let layout = self.layout(index, width)?;
        let (component, normalized) = (layout.component, layout.normalized);
        self.collect(&layout, |bytes| to_float(component, normalized, bytes))
    }

    /// All numbers of a SCALAR accessor of unsigned integers.
    pub fn indices(&self, index: usize) -> Result<Vec<u32>, CarrierError> {
        let layout = self.layout(index, 1)?;
        if !matches!(layout.component, Component::U8 | Component::U16 | Component::U32) {
            return Err(self.fail(layout.place, "indices must be unsigned integers (5121, 5123 or 5125)"));
        }
        let component = layout.component;
        self.collect(&layout, |bytes| to_index(component, bytes))
    }

    fn layout(&self, index: usize, width: usize) -> Result<Layout<'a>, CarrierError> {
        let place = format!("/accessors/{index}");
        let count = self.count(index)?;
        let Some(accessor) = self.document.item("accessors", index) else {
            return Err(self.fail(place, "does not exist"));
        };
        let kind = accessor.get("type").and_then(Value::as_str).unwrap_or("");
        if type_width(kind) != Some(width) {
            return Err(self.fail(place, format!("type {kind:?} where {} numbers are wanted", width)));
        }
        let component = accessor.get("componentType").and_then(Value::as_u64).and_then(Component::of);
        let Some(component) = component else { return Err(self.fail(place, "componentType is none of glTF's")) };
        let element = component.size() * width;
        let mut layout = Layout {
            count,
            width,
            component,
            normalized: accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false),
            stride: element,
            bytes: None,
            sparse: accessor.get("sparse"),
            place,
        };
        match index_of(accessor, "bufferView") {
            Some(view) => self.fit(&mut layout, accessor, view, element)?,
            None if count > MOST_ZEROS => {
                let problem = format!("count {count} with no buffer view (most: {MOST_ZEROS})");
                return Err(self.fail(layout.place, problem));
            }
            None => {}
        }
        Ok(layout)
    }

    /// Puts the bytes of `view` behind an accessor, where all its elements fit.
    fn fit(&self, layout: &mut Layout<'a>, accessor: &Value, view: usize, element: usize) -> Result<(), CarrierError> {
        let bytes = self.view(view)?;
        let offset = index_of(accessor, "byteOffset").unwrap_or(0);
        layout.stride = index_of(&self.document.list("bufferViews")[view], "byteStride").unwrap_or(element);
        let needed = match layout.count {
            0 => Some(0),
            n => (n - 1).checked_mul(layout.stride).and_then(|b| b.checked_add(element)),
        };
        let end = needed.and_then(|n| n.checked_add(offset)).filter(|end| *end <= bytes.len());
        if layout.stride < element || end.is_none() {
            let (count, stride, place) = (layout.count, layout.stride, &layout.place);
            let problem = format!(
                "{count} elements at stride {stride} from {offset} do not fit the {} bytes of its view",
                bytes.len()
            );
            return Err(self.fail(place.clone(), problem));
        }
        layout.bytes = Some(&bytes[offset..]);
        Ok(())
    }

    fn collect<T: Copy + Default>(&self, layout: &Layout, read: impl Fn(&[u8]) -> T) -> Result<Vec<T>, CarrierError> {
        let size = layout.component.size();
        let mut out = Vec::new();
        match layout.bytes {
            Some(bytes) => {
                out.reserve_exact(layout.count * layout.width);
                for element in 0..layout.count {
                    let start = element * layout.stride;
                    let numbers = bytes[start..start + size * layout.width].chunks_exact(size);
                    out.extend(numbers.map(&read));
                }
            }
            None => out.resize(layout.count * layout.width, T::default()),
        }
        if let Some(sparse) = layout.sparse {
            self.apply_sparse(layout, sparse, &mut out, read)?;
        }
        Ok(out)
    }

    fn apply_sparse<T: Copy>(
        &self,
        layout: &Layout,
        sparse: &Value,
        out: &mut [T],
        read: impl Fn(&[u8]) -> T,
    ) -> Result<(), CarrierError> {
        let place = format!("{}/sparse", layout.place);
        let fail = |problem: &str| self.fail(place.clone(), problem);
        let count = index_of(sparse, "count").ok_or_else(|| fail("has no count"))?;
        let component = sparse.pointer("/indices/componentType").and_then(Value::as_u64).and_then(Component::of);
        let component = component.ok_or_else(|| fail("indices have no componentType"))?;
        let element = layout.component.size() * layout.width;
        let indices = self.packed(&sparse["indices"], count, component.size(), &place)?;
        let values = self.packed(&sparse["values"], count, element, &place)?;
        for (index, value) in indices.chunks_exact(component.size()).zip(values.chunks_exact(element)) {
            let at = to_index(component, index) as usize;
            if at >= layout.count {
                return Err(fail(&format!("index {at} is not below the accessor's count {}", layout.count)));
            }
            let numbers = value.chunks_exact(layout.component.size()).map(&read);
            out[at * layout.width..(at + 1) * layout.width].iter_mut().zip(numbers).for_each(|(o, n)| *o = n);
        }
        Ok(())
    }

    /// `count` elements of `size` bytes each, without gaps, as sparse accessors have them.
    fn packed(&self, part: &Value, count: usize, size: usize, place: &str) -> Result<&'a [u8], CarrierError> {
        let view = index_of(part, "bufferView").ok_or_else(|| self.fail(place, "has no bufferView"))?;
        let bytes = self.view(view)?;
        let offset = index_of(part, "byteOffset").unwrap_or(0);
        let end = count.checked_mul(size).and_then(|n| n.checked_add(offset)).filter(|end| *end <= bytes.len());
        end.map(|end| &bytes[offset..end]).ok_or_else(|| {
            self.fail(place, format!("{count} elements do not fit the {} bytes of view {view}", bytes.len()))
        })
    }
}

/// Numbers per element of an accessor type; matrices, whose columns are padded, are not read here.
pub(crate) fn type_width(kind: &str) -> Option<usize> {
    Some(match kind {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => return None,
    })
}

fn word<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut word = [0; N];
    word.copy_from_slice(&bytes[..N]);
    word
}

/// Normalized integers as glTF 2.0 section 3.11 converts them.
fn to_float(component: Component, normalized: bool, bytes: &[u8]) -> f32 {
    let (number, largest) = match component {
        Component::I8 => (f32::from(i8::from_le_bytes(word(bytes))), 127.0),
        Component::U8 => (f32::from(bytes[0]), 255.0),
        Component::I16 => (f32::from(i16::from_le_bytes(word(bytes))), 32_767.0),
        Component::U16 => (f32::from(u16::from_le_bytes(word(bytes))), 65_535.0),
        Component::U32 => (u32::from_le_bytes(word(bytes)) as f32, 4_294_967_295.0),
        Component::F32 => return f32::from_le_bytes(word(bytes)),
    };
    if normalized { (number / largest).max(-1.0) } else { number }
}

fn to_index(component: Component, bytes: &[u8]) -> u32 {
    match component.size() {
        1 => u32::from(bytes[0]),
        2 => u32::from(u16::from_le_bytes(word(bytes))),
        _ => u32::from_le_bytes(word(bytes)),
    }
}
