//! Files beside a document: `tree.foliar/NAME` beside `tree.glb`. Their names hold a hash of their bytes, so that new ones
//! never take the place of old ones that a file on disk still names; the document is renamed last, then what only the
//! old one named is removed (law 9).

use crate::rebase::encode_uri;
use crate::{Document, OutputFile, container};
use foliar_schema::names;
use percent_encoding::percent_decode_str;
use serde_json::Value;
use std::collections::BTreeSet;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Largest JSON chunk that is looked through for names of side files.
const MOST_JSON: usize = 1 << 30;

/// The folder beside a file.
pub(crate) fn folder(path: &Path) -> PathBuf {
    path.with_extension(names::SIDE_ENDING)
}

/// The side files of a document that goes to `path`; its links name them from there.
pub(crate) fn files(document: &mut Document, path: &Path) -> Vec<OutputFile> {
    let folder = folder(path);
    let prefix = folder.file_name().map(|name| encode_uri(&name.to_string_lossy())).unwrap_or_default();
    let moved = |uri: &str| format!("{prefix}/{}", last_name(uri));
    for link in links(&mut document.json) {
        if let Some(uri) = link.as_str().map(moved) {
            *link = uri.into();
        }
    }
    let file = |side: crate::Side| OutputFile { path: folder.join(&side.name), bytes: side.bytes.to_vec() };
    std::mem::take(&mut document.sides).into_iter().map(file).collect()
}

/// What follows the last slash of a URI.
pub(crate) fn last_name(uri: &str) -> &str {
    uri.rsplit('/').next().unwrap_or(uri)
}

/// Every place that names a side file: in the extension and in its mirror.
fn links(json: &mut Value) -> Vec<&mut Value> {
    let Some(root) = json.as_object_mut() else { return Vec::new() };
    let mut found = Vec::new();
    for (key, value) in root.iter_mut() {
        let holder = match key.as_str() {
            "extensions" => Some(value),
            "asset" => value.get_mut("extras"),
            _ => None,
        };
        let sheets =
            holder.and_then(|h| h.get_mut(names::EXTENSION)?.get_mut(names::ROOM_TRANSLUCENCY)?.as_object_mut());
        for sheet in sheets.into_iter().flat_map(|sheets| sheets.values_mut()) {
            let maps = sheet.get_mut("maps").and_then(Value::as_object_mut);
            found.extend(maps.into_iter().flat_map(|maps| maps.values_mut()).filter_map(|map| map.get_mut("exr")));
        }
    }
    found
}

/// Side files that a file on disk names, of its own folder only.
pub(crate) fn named_by(path: &Path) -> Vec<PathBuf> {
    if path.extension().is_some_and(|ending| ending == "json") {
        return loose_named_by(path);
    }
    let folder = folder(path);
    if !folder.is_dir() {
        return Vec::new();
    }
    let Some(mut json) = json_of(path) else { return Vec::new() };
    let name = |uri: &str| percent_decode_str(last_name(uri)).decode_utf8_lossy().into_owned();
    let names: BTreeSet<String> = links(&mut json).into_iter().filter_map(|link| link.as_str().map(name)).collect();
    names.into_iter().map(|name| folder.join(name)).collect()
}

/// The same of the JSON beside maps without a tree.
fn loose_named_by(path: &Path) -> Vec<PathBuf> {
    let text = std::fs::read(path).ok();
    let json: Option<Value> = text.and_then(|text| serde_json::from_slice(&text).ok());
    let is_ours = |json: &Value| json["record"]["room"] == names::ROOM_TRANSLUCENCY && !json["contract"].is_null();
    let Some(json) = json.filter(is_ours) else { return Vec::new() };
    let maps = json[names::ROOM_TRANSLUCENCY]["maps"].as_object().into_iter().flat_map(|maps| maps.values());
    let named = maps.flat_map(|map| [&map["exr"], &map["texture"]]).filter_map(Value::as_str);
    // Only names: nothing elsewhere is ours.
    named.filter(|name| last_name(name) == *name).map(|name| path.with_file_name(name)).collect()
}

/// The JSON of a .glb or .gltf.
fn json_of(path: &Path) -> Option<Value> {
    let mut file = std::fs::File::open(path).ok()?;
    let mut header = [0; 20];
    file.read_exact(&mut header).ok()?;
    if !header.starts_with(container::GLB_MAGIC) {
        return serde_json::from_slice(&std::fs::read(path).ok()?).ok();
    }
    let length = u32::from_le_bytes(header[12..16].try_into().ok()?) as usize;
    let mut json = Vec::new();
    file.take(length.min(MOST_JSON) as u64).read_to_end(&mut json).ok()?;
    serde_json::from_slice(&json).ok()
}

/// Folders of side files that are not there yet, made; those that were made.
pub(crate) fn make_folders(files: &[&OutputFile]) -> Result<Vec<PathBuf>, (PathBuf, std::io::Error)> {
    let mut made = Vec::new();
    for file in files {
        let folder = file.path.parent().filter(|folder| is_side(folder) && !folder.exists());
        if let Some(folder) = folder {
            std::fs::create_dir(folder).map_err(|error| (file.path.clone(), error))?;
            made.push(folder.to_path_buf());
        }
    }
    Ok(made)
}

fn is_side(folder: &Path) -> bool {
    folder.extension().is_some_and(|ending| ending == names::SIDE_ENDING)
}

/// Removes folders that are empty.
pub(crate) fn remove_folders(folders: &[PathBuf]) {
    for folder in folders {
        let _ = std::fs::remove_dir(folder);
    }
}

/// Removes files that nothing names any more, and side folders where these are empty then. `tree.glb` and `tree.gltf` have
/// one folder: what the other names stays.
pub(crate) fn remove(files: &[PathBuf]) {
    let folders: BTreeSet<&Path> = files.iter().filter_map(|file| file.parent()).filter(|f| is_side(f)).collect();
    let siblings = folders.iter().flat_map(|folder| ["glb", "gltf"].map(|ending| folder.with_extension(ending)));
    let named: BTreeSet<PathBuf> = siblings.flat_map(|path| named_by(&path)).collect();
    for file in files.iter().filter(|file| !named.contains(*file)) {
        let _ = std::fs::remove_file(file);
    }
    remove_folders(&folders.into_iter().map(Path::to_path_buf).collect::<Vec<_>>());
}
