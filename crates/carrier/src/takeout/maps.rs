//! Maps of a master: from the EXR beside it, else from the 8 bits in the file, with a finding.

use crate::accessor::Source;
use crate::document::index_of;
use crate::{CarrierError, coefficients, images, paths, sides};
use foliar_bake::{FloatRaster, Layer};
use foliar_schema::{Finding, MapLink, SheetLinks, code, names};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What reading maps needs.
pub(super) struct MapReader<'a> {
    pub source: Source<'a>,
    pub links: &'a BTreeMap<String, SheetLinks>,
    /// Side files that were read.
    pub files: &'a RefCell<Vec<PathBuf>>,
}

impl MapReader<'_> {
    /// Reads the raster `SHEET/NAME`; false where it is nowhere.
    pub fn raster(&self, name: &str, layer: &mut Layer, findings: &mut Vec<Finding>) -> Result<bool, CarrierError> {
        let link = name.rsplit_once('/').and_then(|(sheet, map)| self.links.get(sheet)?.maps.get(map));
        let Some(link) = link else { return Ok(false) };
        let mut found = self.exact(link)?;
        if found.is_none() {
            found = self.coarse(link)?;
            layer.in_8_bits.extend(found.is_some().then(|| (name.to_owned(), link.clone())));
            if let (Some(_), Some(exr)) = (&found, &link.exr) {
                let text = format!(
                    "{exr} is missing: its map was taken from the 8 bits in the file, which are off by {:.5}: put the \
                     folder beside the file, or run foliar rebake",
                    link.rms_error
                );
                findings.push(Finding::new(&code::STALE, text).in_file(self.source.file));
            }
        }
        let found = found.map(|raster| layer.rasters.insert(name.into(), raster));
        Ok(found.is_some())
    }

    /// The EXR, in memory or on disk.
    fn exact(&self, link: &MapLink) -> Result<Option<FloatRaster>, CarrierError> {
        let Some(uri) = &link.exr else { return Ok(None) };
        let document = self.source.document;
        if let Some(side) = document.sides.iter().find(|side| side.name == sides::last_name(uri)) {
            return images::read_exr(&side.bytes, &side.name).map(Some);
        }
        let Some(folder) = &document.folder else { return Ok(None) };
        let named = paths::resolve(uri, folder, &[], self.source.file)?;
        // A file that was renamed with its folder still finds it.
        let own = sides::folder(Path::new(self.source.file));
        let own = folder.join(own.file_name().unwrap_or_default()).join(sides::last_name(uri));
        let Some(file) = [named, own].into_iter().find(|file| file.is_file()) else { return Ok(None) };
        let name = file.display().to_string();
        let remedy = "make it readable, or run foliar rebake".to_owned();
        let bytes = std::fs::read(&file).map_err(|source| CarrierError::Open { file: name.clone(), source, remedy })?;
        let raster = images::read_exr(&bytes, &name)?;
        self.files.borrow_mut().push(file);
        Ok(Some(raster))
    }

    /// The 8 bits in the file.
    fn coarse(&self, link: &MapLink) -> Result<Option<FloatRaster>, CarrierError> {
        let Some(bytes) = link.texture.as_deref().and_then(|name| self.image(name)) else { return Ok(None) };
        let raster = images::decode(bytes, link.texture.as_deref().unwrap_or_default())?;
        Ok(Some(coefficients::from_png(&raster.rgba, raster.width, raster.height, link)))
    }

    /// Reads a picture that was passed on; false where it is nowhere.
    pub fn picture(&self, name: &str, layer: &mut Layer) -> Result<bool, CarrierError> {
        let color = name.rsplit_once('/').and_then(|(sheet, _)| self.links.get(sheet)?.color.as_ref());
        let bytes = color.and_then(|color| self.image(color.texture.as_deref()?));
        let found = bytes.map(|bytes| layer.pictures.insert(name.into(), bytes.to_vec()));
        Ok(found.is_some())
    }

    /// Bytes of the image of this name.
    fn image(&self, name: &str) -> Option<&[u8]> {
        let images = self.source.document.list("images");
        let image = images.iter().rfind(|image| image.get("name").is_some_and(|n| n == name))?;
        debug_assert!(name.starts_with(names::VIEW_PREFIX));
        self.source.view(index_of(image, "bufferView")?).ok()
    }
}
