//! Maps of a leaf without a tree: EXR and PNG files, and a JSON that says what their numbers mean.

use crate::assemble::{Encoded, encode_map, rounding, shown_of};
use crate::{CarrierError, OutputFile};
use foliar_bake::Layer;
use foliar_schema::{CONTRACT, Finding, SheetLinks};
use rayon::prelude::*;
use serde_json::json;
use std::path::{Path, PathBuf};

/// All files, the named one last, and what a person should know of them.
pub(crate) fn encode(layer: &Layer, path: &Path) -> Result<(Vec<OutputFile>, Vec<Finding>), CarrierError> {
    let exact = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    let half = layer.record.resolved.get("exr") != Some(&json!("float"));
    let rasters = layer.rasters.iter().map(|(name, raster)| (name.as_str(), raster)).collect();
    let Some(shown) = shown_of(&rasters) else {
        return Err(CarrierError::mismatch(&layer.record.room, "", "holds no map", "bake it again"));
    };
    let encoded: Result<Vec<(&str, Encoded)>, CarrierError> = rasters
        .par_iter()
        .map(|(name, raster)| {
            let shown = *name == shown;
            Ok((*name, encode_map(raster, shown || !exact, exact.then_some(half))?))
        })
        .collect();
    let mut links = SheetLinks { shown: shown.to_owned(), ..SheetLinks::default() };
    let mut files = Vec::new();
    for (name, Encoded { mut link, png, exr }) in encoded? {
        let place = if name == shown { path.to_path_buf() } else { named(path, name) };
        for (bytes, ending, slot) in [(png, "png", &mut link.texture), (exr, "exr", &mut link.exr)] {
            let Some(bytes) = bytes else { continue };
            let path = place.with_extension(ending);
            *slot = path.file_name().map(|name| name.to_string_lossy().into_owned());
            files.push(OutputFile { path, bytes });
        }
        links.maps.insert(name.to_owned(), link);
    }
    let findings = rounding(&links).into_iter().collect();
    let about = json!({ "contract": CONTRACT, "record": layer.record, "translucency": links });
    files.push(OutputFile { path: path.with_extension("json"), bytes: format!("{about:#}\n").into_bytes() });
    // The named file is the commit, whatever the case of its ending.
    let commit =
        files.iter().position(|file| file.path.with_extension("") == path.with_extension("") && same_kind(file, path));
    if let Some(at) = commit {
        let mut file = files.remove(at);
        file.path = path.to_path_buf();
        files.push(file);
    }
    Ok((files, findings))
}

fn same_kind(file: &OutputFile, path: &Path) -> bool {
    match (file.path.extension(), path.extension()) {
        (Some(a), Some(b)) => a.eq_ignore_ascii_case(b),
        _ => false,
    }
}

/// `leaf.exr` and `translucencyBackRed`: `leaf-back-red.exr`.
fn named(path: &Path, name: &str) -> PathBuf {
    let words = name.chars().fold(String::new(), |mut words, c| {
        if c.is_ascii_uppercase() {
            words.push('-');
        }
        words.push(c.to_ascii_lowercase());
        words
    });
    let what = words.split_once('-').map_or(words.as_str(), |(_, what)| what);
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let ending = path.extension().map(|ending| ending.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!("{stem}-{what}.{ending}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_named_after_side_and_band() {
        let name = |map| named(Path::new("out/leaf.v2.exr"), map).display().to_string();
        assert_eq!(name("translucencyBackRed"), "out/leaf.v2-back-red.exr");
        assert_eq!(name("translucencyFront"), "out/leaf.v2-front.exr");
    }
}
