//! Relative URIs of a document that moves: they name the same files from the new folder.

use crate::{CarrierError, Document};
use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, utf8_percent_encode};
use serde_json::Value;
use std::path::{Component, Path, PathBuf};

/// What a URI's path must not hold unencoded.
const ENCODED: &AsciiSet = &CONTROLS
    .add(b' ')
    .add(b'"')
    .add(b'#')
    .add(b'%')
    .add(b'<')
    .add(b'>')
    .add(b'?')
    .add(b'`')
    .add(b'{')
    .add(b'}')
    .add(b'\\');

/// Percent-encodes a relative path.
pub(crate) fn encode_uri(path: &str) -> String {
    utf8_percent_encode(path, ENCODED).to_string()
}

/// Rewrites the URIs of images and buffers for a document that is written to `path`.
pub(crate) fn move_to(document: &mut Document, path: &Path) -> Result<(), CarrierError> {
    let Some(from) = document.folder.clone() else { return Ok(()) };
    let to = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let (from, to) = (absolute(&from), absolute(&to));
    document.folder = Some(to.clone());
    if from == to {
        return Ok(());
    }
    for list in ["images", "buffers"] {
        let items = document.json.get_mut(list).and_then(Value::as_array_mut);
        for (index, item) in items.into_iter().flatten().enumerate() {
            // The first buffer is written beside the file, or into it.
            if list == "buffers" && index == 0 {
                continue;
            }
            if let Some(uri) = item.get("uri").and_then(Value::as_str).filter(|uri| !is_elsewhere(uri)) {
                let moved = relative(&from.join(percent_decode_str(uri).decode_utf8_lossy().as_ref()), &to);
                let moved = moved.ok_or_else(|| {
                    let place = format!("/{list}/{index}/uri");
                    let problem = format!("{uri:?} cannot be named from {}", to.display());
                    CarrierError::input(path.display().to_string(), place, problem, "write to the same drive")
                })?;
                item["uri"] = encode_uri(&moved).into();
            }
        }
    }
    Ok(())
}

/// Whether a document is written as JSON with its buffer beside it.
pub(crate) fn is_gltf(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gltf"))
}

/// Whether a document that is written to `path` leaves the folder that its URIs start from.
pub(crate) fn moves(document: &Document, path: &Path) -> bool {
    let to = absolute(path.parent().unwrap_or(Path::new("")));
    document.folder.as_deref().is_some_and(|from| absolute(from) != to)
}

/// Images whose files lie outside the folder of `path`: index and file.
pub(crate) fn outside(document: &Document, path: &Path) -> Vec<(usize, PathBuf)> {
    let Some(from) = document.folder.as_deref().map(absolute) else { return Vec::new() };
    let to = absolute(path.parent().unwrap_or(Path::new("")));
    let file = |(index, image): (usize, &Value)| {
        let uri = image.get("uri").and_then(Value::as_str).filter(|uri| !is_elsewhere(uri))?;
        let file = from.join(percent_decode_str(uri).decode_utf8_lossy().as_ref());
        relative(&file, &to).is_none_or(|r| r.starts_with("..")).then_some((index, file))
    };
    document.list("images").iter().enumerate().filter_map(file).collect()
}

/// Data and network URIs stay as they are.
fn is_elsewhere(uri: &str) -> bool {
    uri.split_once(':').is_some_and(|(scheme, _)| scheme.len() > 1 && scheme.chars().all(|c| c.is_ascii_alphanumeric()))
}

/// An absolute path without `.` and `..`, links resolved as far as it exists.
fn absolute(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    std::fs::canonicalize(path).or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_path_buf())
}

/// `target` seen from `folder`, both absolute, with slashes; `None` across drives.
fn relative(target: &Path, folder: &Path) -> Option<String> {
    let mut clean: Vec<Component> = Vec::new();
    for part in target.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if matches!(clean.last(), Some(Component::Normal(_))) => {
                clean.pop();
            }
            other => clean.push(other),
        }
    }
    let base: Vec<Component> = folder.components().collect();
    let shared = clean.iter().zip(&base).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return None;
    }
    let up = std::iter::repeat_n("..".to_string(), base.len() - shared);
    let down = clean[shared..].iter().map(|c| c.as_os_str().to_string_lossy().into_owned());
    Some(up.chain(down).collect::<Vec<_>>().join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_seen_from_another_folder() {
        let see = |target: &str, folder: &str| relative(Path::new(target), Path::new(folder));
        assert_eq!(see("/a/b/t.png", "/a/b").as_deref(), Some("t.png"));
        assert_eq!(see("/a/b/../t.png", "/a/c/d").as_deref(), Some("../../t.png"));
        assert_eq!(see("/a/b/t.png", "/x").as_deref(), Some("../a/b/t.png"));
    }

    #[test]
    fn data_and_network_uris_are_told_from_paths() {
        assert!(is_elsewhere("data:image/png;base64,AA") && is_elsewhere("https://example.org/y"));
        assert!(!is_elsewhere("a b.png") && !is_elsewhere("folder/c.png"));
    }
}
