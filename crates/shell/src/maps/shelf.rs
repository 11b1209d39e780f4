//! Files of maps, each read once, and the sets that they make.

use super::{Entry, Gathering, Sheet, Source, Wanted, from_photo};
use crate::Failure;
use crate::config::Origin;
use crate::options::is_dash;
use foliar_bake::{FloatRaster, MapRaster};
use foliar_schema::{Finding, Import, code, names};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A file that was read.
pub(super) struct Found {
    hash: String,
    bytes: Vec<u8>,
}

/// Files, each read once.
pub(super) struct Shelf<'a> {
    pub gathering: &'a Gathering<'a>,
    pub read: BTreeMap<PathBuf, Found>,
}

impl Shelf<'_> {
    /// Where a map lies: as it was given, or, by its name, in the asset's folder or a searched one.
    pub fn find(&self, entry: &Entry) -> Result<PathBuf, Failure> {
        if !matches!(entry.origin, Origin::Record(_)) {
            return Ok(entry.file.clone());
        }
        let input = self.gathering.input;
        let folder = if is_dash(input) { Path::new("") } else { input.parent().unwrap_or(Path::new("")) };
        let search = self.gathering.settings.section::<Import>("import")?.search;
        let file = foliar_carrier::paths::resolve(&entry.name, folder, &search, &entry.origin.to_string())?;
        if file.is_file() {
            return Ok(file);
        }
        let remedy = format!("put it there, name its folder with --search, or give it again with --{}", entry.map);
        Err(Failure::Input(format!("map {} ({}) is not there: {remedy}", file.display(), entry.origin)))
    }

    fn read(&mut self, file: &Path) -> Result<&Found, Failure> {
        if !self.read.contains_key(file) {
            let unreadable = |e| {
                let remedy = "name a readable PNG, TIFF or EXR";
                Failure::Input(format!("{}: cannot be read: {e}: {remedy}", file.display()))
            };
            let bytes = std::fs::read(file).map_err(unreadable)?;
            let hash = blake3::hash(&bytes).to_hex().to_string();
            self.read.insert(file.to_path_buf(), Found { hash, bytes });
        }
        Ok(&self.read[file])
    }

    /// Reads one set.
    pub fn sheet(&mut self, wanted: &Wanted, source: &Source, findings: &mut Vec<Finding>) -> Result<Sheet, Failure> {
        let mut sheet = Sheet {
            name: wanted.name.clone(),
            materials: vec![wanted.name.clone()],
            given: wanted.given.clone(),
            files: source.files.iter().cloned().collect(),
            ..Sheet::default()
        };
        for (map, file) in &source.files {
            let found = self.read(file)?;
            let entry = wanted.entries.get(map.as_str());
            sheet.reads.insert(format!("map/{}", entry.map_or(map.as_str(), |e| &e.name)), found.hash.clone());
        }
        let bytes = |file: &PathBuf| (self.read[file].bytes.as_slice(), file.display().to_string());
        let (photographs, files): (Vec<_>, Vec<_>) =
            source.files.iter().partition(|(map, _)| map == names::MAP_BACKLIT);
        for (_, file) in photographs {
            let (bytes, name) = bytes(file);
            sheet.pictures.insert(names::PICTURE_COLOR.into(), photograph(bytes, &name)?);
            if wanted.given.get("normalize").is_none_or(|by| by != "diffuse") {
                let text = "the photograph holds how much light comes through, and so do the coefficients: say --normalize diffuse, \
                            unless its brightness was taken out of it";
                findings.push(Finding::new(&code::MAP_TWICE, text).in_file(name));
            }
        }
        let decode = |(_, file): &&(String, PathBuf)| {
            let (bytes, name) = bytes(file);
            foliar_carrier::images::read_map(bytes, &name)
        };
        // All of them, so that the first of several bad maps is named, whichever thread met its own first.
        let decoded: Vec<_> = files.par_iter().map(decode).collect();
        let mut alpha = None;
        for ((map, _), read) in files.into_iter().zip(decoded) {
            let read = read?;
            let is_photo = map == names::MAP_THICKNESS && from_photo(&wanted.given);
            // Colors are what a photograph is for.
            findings.extend(read.findings.into_iter().filter(|_| !is_photo));
            if map == names::MAP_THICKNESS {
                alpha = read.alpha;
            }
            sheet.maps.insert(map.clone(), read.map);
        }
        if let Some(own) = source.own.clone() {
            sheet.maps.insert(names::MAP_ALBEDO.into(), own.albedo);
            if from_photo(&wanted.given) && !sheet.maps.contains_key(names::MAP_THICKNESS) {
                sheet.maps.extend(own.color.map(|color| (names::MAP_THICKNESS.to_owned(), color)));
            }
            alpha = alpha.or(own.alpha);
        }
        if let Some(thickness) =
            sheet.maps.get(names::MAP_THICKNESS).filter(|_| !sheet.maps.contains_key(names::MAP_ALPHA))
        {
            let (width, height) = (thickness.raster.width, thickness.raster.height);
            let alpha = alpha.map(|alpha| (names::MAP_ALPHA.to_owned(), resampled(alpha, width, height)));
            sheet.maps.extend(alpha);
        }
        Ok(sheet)
    }
}

/// A photograph that a glTF can hold as it is.
fn photograph(bytes: &[u8], name: &str) -> Result<Vec<u8>, Failure> {
    let format = foliar_carrier::images::sniff(bytes);
    if format.gltf_mime().is_none() {
        let text = format!("{name}: is {}, and a glTF holds PNG or JPEG: convert the photograph to PNG", format.name());
        return Err(Failure::Input(text));
    }
    foliar_carrier::images::decode(bytes, name)?;
    Ok(bytes.to_vec())
}

/// A mask at another size: the texel in the middle of each.
fn resampled(mask: MapRaster, width: u32, height: u32) -> MapRaster {
    let own = &mask.raster;
    if (own.width, own.height) == (width, height) {
        return mask;
    }
    let at = |to: u32, size: u32, from: u32| (u64::from(2 * to + 1) * u64::from(from) / u64::from(2 * size)) as usize;
    let texel = |y: u32, x: u32| own.data[at(y, height, own.height) * own.width as usize + at(x, width, own.width)];
    let data = (0..height).flat_map(|y| (0..width).map(move |x| texel(y, x))).collect();
    MapRaster { raster: FloatRaster { width, height, channels: 1, data }, bits: mask.bits }
}
