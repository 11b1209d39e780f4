//! A look at a glTF: every buffer, accessor, primitive and image by itself, so that one that is broken
//! leaves the others readable.

use super::picture::{self, Bytes, Found, Picture};
use super::{Problem, Survey, Trouble};
use crate::accessor::{Source, type_width};
use crate::container::{self, BufferSource};
use crate::document::{index_of, primitives};
use crate::extract::Extraction;
use crate::{CarrierError, Selection, SourceKind, materials};
use foliar_schema::{CHANNELS, Import};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Component type of floats.
const FLOAT: u64 = 5126;

pub(super) fn look(
    bytes: Vec<u8>,
    name: &str,
    folder: &Path,
    import: &Import,
    seen: &mut Survey,
) -> Result<(), CarrierError> {
    let mut bin = None;
    if seen.source == Some(SourceKind::Glb) {
        let (json, found, findings) = container::split_glb(&bytes, name)?;
        seen.document.json = container::parse_json(json, name)?;
        seen.findings.extend(findings);
        let (start, end) = (container::bin_start(json.len()), container::bin_start(json.len()) + found.len());
        bin = Some(part_of(bytes, start, end));
    } else {
        seen.document.json = container::parse_json(&bytes, name)?;
    }
    seen.document.selection = Selection { scene: import.scene, node: import.node.clone() };
    container::check_version(&seen.document.json, name)?;
    let compressed = container::check_compression(&seen.document.json, name);
    let is_compressed = compressed.is_err();
    let readable = buffers(bin, name, folder, import, is_compressed, seen);
    seen.problems.extend(compressed.err().map(|error| Problem::new(Trouble::Compressed, error)));
    images(name, folder, import, seen);
    if readable && !is_compressed {
        geometry(name, import, seen);
    }
    Ok(())
}

/// A part of bytes in their own memory: copying a large file would take it twice.
fn part_of(mut bytes: Vec<u8>, start: usize, end: usize) -> Vec<u8> {
    bytes.truncate(end);
    bytes.drain(..start.min(end));
    bytes
}

/// Reads all buffers; whether each could be.
fn buffers(
    bin: Option<Vec<u8>>,
    name: &str,
    folder: &Path,
    import: &Import,
    is_compressed: bool,
    seen: &mut Survey,
) -> bool {
    let mut own = bin;
    let listed = seen.document.list("buffers").to_vec();
    for (index, buffer) in listed.iter().enumerate() {
        let length = index_of(buffer, "byteLength");
        // Room for what a decoder makes: no file holds it.
        if is_compressed && buffer.get("uri").is_none() && buffer.get("extensions").is_some() {
            seen.document.buffers.push(Vec::new());
            continue;
        }
        let embedded = index == 0 && buffer.get("uri").is_none();
        let loaded = match (length, own.take_if(|bin| embedded && length.is_some_and(|l| l <= bin.len()))) {
            (Some(length), Some(mut bin)) => {
                bin.truncate(length);
                Ok(bin)
            }
            _ => {
                let source = BufferSource { index, bin: own.as_deref(), file: name, folder, import };
                source.load(buffer, &mut seen.files)
            }
        };
        let bytes = loaded.map_err(|error| seen.problems.push(Problem::new(Trouble::Broken, error)));
        seen.document.buffers.push(bytes.unwrap_or_default());
    }
    seen.problems.is_empty()
}

fn geometry(name: &str, import: &Import, seen: &mut Survey) {
    let source = Source { document: &seen.document, file: name };
    let bad = not_finite(source, seen.foliage().is_some());
    let extraction = Extraction { source, selection: &seen.document.selection, import, ids: None };
    let mut findings = Vec::new();
    let read = extraction.readable_parts(&mut findings);
    seen.findings.append(&mut findings);
    match read {
        Err(error) => seen.problems.push(Problem::new(Trouble::Broken, error)),
        Ok(read) => {
            (seen.base.parts, seen.base.position_count) = (read.parts, read.position_count);
            let known = |problem: &Problem| {
                let accessor = problem.place.strip_prefix("/accessors/").and_then(|p| p.split(' ').next());
                accessor.and_then(|a| a.parse().ok()).is_some_and(|a: usize| bad.contains_key(&a))
            };
            let trouble = |error: &CarrierError| match error {
                CarrierError::Input { place, .. } if place.ends_with("/indices") => Trouble::Index,
                _ => Trouble::Broken,
            };
            let problems = read.errors.into_iter().map(|error| Problem::new(trouble(&error), error));
            seen.problems.extend(problems.filter(|problem| !known(problem)));
        }
    }
    seen.problems.extend(bad.into_values());
}

/// Float accessors of primitives that hold numbers which are not finite. Channels of a master are the
/// contract's to judge.
fn not_finite(source: Source, is_master: bool) -> BTreeMap<usize, Problem> {
    let own = |name: &str| is_master && CHANNELS.iter().any(|channel| channel.name == name);
    let named = primitives(source.document).flat_map(|(_, primitive)| {
        let attributes = primitive.get("attributes").and_then(Value::as_object).into_iter().flatten();
        attributes
            .filter(|(name, _)| !own(name))
            .filter_map(|(name, accessor)| Some((accessor.as_u64()? as usize, name)))
    });
    let accessors: BTreeMap<usize, &String> = named.collect();
    let look = |(accessor, name): (&usize, &&String)| {
        let value = source.document.item("accessors", *accessor)?;
        if value.get("componentType").and_then(Value::as_u64) != Some(FLOAT) {
            return None;
        }
        let width = type_width(value.get("type")?.as_str()?)?;
        let data = source.floats(*accessor, width).ok()?;
        let count = data.iter().filter(|v| !v.is_finite()).count();
        let first = data.iter().position(|v| !v.is_finite())?;
        let text = format!(
            "{count} of {} numbers of {name} are not finite, the first is {} at vertex {}",
            data.len(),
            data[first],
            first / width
        );
        let place = format!("/accessors/{accessor}");
        Some((*accessor, Problem { trouble: Trouble::NotFinite, place, text, file: None }))
    };
    accessors.par_iter().filter_map(look).collect()
}

fn images(name: &str, folder: &Path, import: &Import, seen: &mut Survey) {
    let json = &seen.document;
    let list = json.list("images").to_vec();
    let textures = json.list("textures").to_vec();
    let core: BTreeSet<usize> = textures.iter().filter_map(|texture| index_of(texture, "source")).collect();
    for (index, image) in list.iter().enumerate() {
        let picture = one(index, image, name, folder, import, seen);
        seen.pictures.push(Picture { in_core: core.contains(&index), ..picture });
    }
    let values = seen.document.list("materials");
    let of = |value: &Value| {
        let texture = index_of(materials::base_color_info(value)?, "index")?;
        let texture = textures.get(texture)?;
        let extended = texture.get("extensions").and_then(Value::as_object).into_iter().flatten();
        let image = index_of(texture, "source").or_else(|| extended.filter_map(|(_, e)| index_of(e, "source")).next());
        image.filter(|image| *image < list.len())
    };
    seen.base_pictures = values.iter().map(of).collect();
    seen.base.materials = values.iter().map(|value| materials::material(value, None)).collect();
}

fn one(index: usize, image: &Value, file: &str, folder: &Path, import: &Import, seen: &mut Survey) -> Picture {
    let place = format!("/images/{index}");
    let uri = image.get("uri").and_then(Value::as_str);
    let beside = uri.filter(|uri| !uri.starts_with("data:"));
    let name = beside.or_else(|| image.get("name").and_then(Value::as_str)).unwrap_or(&place).to_string();
    let mime = image.get("mimeType").and_then(Value::as_str);
    let inside = uri.and_then(|uri| uri.strip_prefix("data:")).and_then(|data| data.split([';', ',']).next());
    let claims = [mime, inside].into_iter().flatten();
    let claims = claims.filter_map(|mime| Some((format!("its type {mime:?}"), picture::claim(mime)?)));
    let claims = claims.chain(beside.and_then(picture::name_claim)).collect();
    let (found, bytes) = match (index_of(image, "bufferView"), uri) {
        (Some(view), _) => match (Source { document: &seen.document, file }).view(view) {
            Ok(bytes) => (picture::look(bytes), Bytes::View(view)),
            Err(error) => (Found::Broken(Problem::new(Trouble::Broken, error).text), Bytes::None),
        },
        (None, Some(uri)) => match container::read_uri(uri, &place, file, folder, import, &mut seen.files) {
            Ok(bytes) => {
                let path = beside.and_then(|_| seen.files.last().cloned());
                (picture::look(&bytes), path.map_or(Bytes::None, Bytes::File))
            }
            Err(CarrierError::Open { source, .. }) => (Found::Missing(source.to_string()), Bytes::None),
            Err(error) => (Found::Missing(Problem::new(Trouble::Broken, error).text), Bytes::None),
        },
        (None, None) => (Found::Missing("it has neither uri nor bufferView".into()), Bytes::None),
    };
    Picture { name, place, file: file.into(), claims, in_core: false, found, bytes }
}
