//! Bytes of an accessor that nothing else reads: they can be replaced where they stand.

use crate::Document;
use crate::document::index_of;
use serde_json::Value;
use std::ops::Range;

/// Where the elements of an accessor stand in the first buffer.
pub(super) struct Slot {
    accessor: usize,
    start: usize,
    stride: usize,
}

/// An accessor's bytes, as far as they matter to others.
struct Span {
    view: usize,
    bytes: Range<usize>,
    /// Of each element inside its stride, where elements of others may stand between them.
    inside: Option<(usize, Range<usize>)>,
    size: usize,
    stride: usize,
}

impl Span {
    fn of(document: &Document, accessor: &Value) -> Option<Span> {
        let view = index_of(accessor, "bufferView")?;
        let of_view = document.item("bufferViews", view)?;
        let component = match accessor.get("componentType")?.as_u64()? {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let width = match accessor.get("type")?.as_str()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            // Matrices as well: their columns are padded, and more than that is asked for here.
            _ => 4,
        };
        let size = component * width;
        let own = index_of(of_view, "byteStride");
        let stride = own.unwrap_or(size);
        let offset = index_of(accessor, "byteOffset").unwrap_or(0);
        let count = index_of(accessor, "count").filter(|count| *count > 0)?;
        let start = index_of(of_view, "byteOffset").unwrap_or(0).checked_add(offset)?;
        let end = (count - 1).checked_mul(stride)?.checked_add(size)?.checked_add(start)?;
        let inside = own.map(|stride| (stride, offset % stride..offset % stride + size));
        Some(Span { view, bytes: start..end, inside, size, stride })
    }

    /// Whether two accessors may read the same byte.
    fn meets(&self, other: &Span) -> bool {
        let apart = self.bytes.end <= other.bytes.start || other.bytes.end <= self.bytes.start;
        let interleaved = match (&self.inside, &other.inside) {
            (Some((a, one)), Some((b, two))) => {
                let fit = a == b && one.end <= *a && two.end <= *b;
                self.view == other.view && fit && (one.end <= two.start || two.end <= one.start)
            }
            _ => false,
        };
        !apart && !interleaved
    }
}

impl Slot {
    /// The place of an accessor of this component type, type and normalization, where it can be written.
    pub fn find(document: &Document, accessor: usize, kind: (u32, &str, bool)) -> Option<Slot> {
        let item = document.item("accessors", accessor)?;
        let same = item.get("componentType")?.as_u64() == Some(kind.0.into())
            && item.get("type")?.as_str() == Some(kind.1)
            && item.get("normalized").and_then(Value::as_bool).unwrap_or(false) == kind.2;
        let span = Span::of(document, item)?;
        let view = document.item("bufferViews", span.view)?;
        let plain = same && item.get("sparse").is_none() && view.get("extensions").is_none();
        let first_buffer = index_of(view, "buffer") == Some(0) && span.bytes.end <= document.buffers.first()?.len();
        let free = plain && first_buffer && uses(document, accessor) == 1 && is_alone(document, accessor, &span);
        free.then_some(Slot { accessor, start: span.bytes.start, stride: span.stride.max(span.size) })
    }

    /// Replaces all elements, `size` bytes each. Bounds of the old ones go.
    pub fn write(&self, document: &mut Document, bytes: &[u8], size: usize) {
        let Some(buffer) = document.buffers.first_mut() else { return };
        for (index, element) in bytes.chunks_exact(size).enumerate() {
            let at = self.start + index * self.stride;
            buffer[at..at + size].copy_from_slice(element);
        }
        let list = document.json.get_mut("accessors");
        if let Some(accessor) = list.and_then(|list| list.get_mut(self.accessor)?.as_object_mut()) {
            accessor.shift_remove("min");
            accessor.shift_remove("max");
        }
    }
}

/// Whether an accessor has a view of the first buffer to itself, and is named once.
pub(super) fn is_sole(document: &Document, accessor: usize) -> bool {
    let Some(item) = document.item("accessors", accessor) else { return false };
    let Some(span) = Span::of(document, item).filter(|_| item.get("sparse").is_none()) else { return false };
    let view = document.item("bufferViews", span.view);
    let plain = view.is_some_and(|v| index_of(v, "buffer") == Some(0) && v.get("extensions").is_none());
    plain
        && uses(document, accessor) == 1
        && view_uses(document, span.view) == 1
        && is_alone(document, accessor, &view_span(document, span))
}

/// A span that reaches over all of its view.
fn view_span(document: &Document, span: Span) -> Span {
    let view = document.item("bufferViews", span.view);
    let number = |key: &str| view.and_then(|v| index_of(v, key)).unwrap_or(0);
    let start = number("byteOffset");
    Span { bytes: start..start.saturating_add(number("byteLength")), inside: None, ..span }
}

/// How often meshes, skins and animations name an accessor.
fn uses(document: &Document, accessor: usize) -> usize {
    let is = |value: &Value| usize::from(value.as_u64() == Some(accessor as u64));
    let each = |object: Option<&Value>| object.and_then(Value::as_object).map_or(0, |o| o.values().map(is).sum());
    let in_primitive = |primitive: &Value| {
        let targets = primitive.get("targets").and_then(Value::as_array).into_iter().flatten();
        each(primitive.get("attributes"))
            + targets.map(|target| each(Some(target))).sum::<usize>()
            + primitive.get("indices").map_or(0, is)
    };
    let meshes: usize = crate::document::primitives(document).map(|(_, primitive)| in_primitive(primitive)).sum();
    let skins: usize = document.list("skins").iter().filter_map(|s| s.get("inverseBindMatrices")).map(is).sum();
    let samplers = document.list("animations").iter().filter_map(|a| a.get("samplers")?.as_array()).flatten();
    meshes + skins + samplers.map(|sampler| each(Some(sampler))).sum::<usize>()
}

/// How often accessors and images name a view.
fn view_uses(document: &Document, view: usize) -> usize {
    let of_accessor = |accessor: &Value| {
        let sparse = ["/sparse/indices", "/sparse/values"].into_iter().filter_map(|part| accessor.pointer(part));
        sparse.chain([accessor]).filter(|part| index_of(part, "bufferView") == Some(view)).count()
    };
    let images = document.list("images").iter().filter(|image| index_of(image, "bufferView") == Some(view)).count();
    document.list("accessors").iter().map(of_accessor).sum::<usize>() + images
}

/// Whether no other accessor and no other view reads a byte of it.
fn is_alone(document: &Document, accessor: usize, span: &Span) -> bool {
    let others = document.list("accessors").iter().enumerate().filter(|(index, _)| *index != accessor);
    let met = others.filter_map(|(_, other)| Span::of(document, other)).any(|other| {
        let view = document.item("bufferViews", other.view);
        view.and_then(|v| index_of(v, "buffer")) == Some(0) && span.meets(&other)
    });
    let views = document.list("bufferViews").iter().enumerate().filter(|(index, _)| *index != span.view);
    let covered = views.filter(|(_, view)| index_of(view, "buffer") == Some(0)).any(|(_, view)| {
        let start = index_of(view, "byteOffset").unwrap_or(0);
        let end = start.saturating_add(index_of(view, "byteLength").unwrap_or(0));
        start < span.bytes.end && span.bytes.start < end
    });
    !met && !covered
}
