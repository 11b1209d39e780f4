//! Pictures of OBJ materials as glTF images: PNG and JPEG bytes as they are, other formats as PNG,
//! alpha joined, heights made normals. What cannot be read becomes a finding, and no texture.

use super::library::{BESIDE, Source};
use super::mtl::Map;
use crate::images::{self, Format};
use crate::{CarrierError, paths};
use foliar_plant::Raster;
use foliar_schema::{Finding, code};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A picture file, read and decoded.
#[derive(Debug)]
pub(crate) struct Picture {
    name: String,
    format: Format,
    bytes: Vec<u8>,
    raster: Raster,
}

/// A picture that something names.
#[derive(Clone, Debug)]
pub(crate) struct Named {
    /// Where it lies, or should.
    pub path: PathBuf,
    /// The file that names it.
    pub file: String,
    /// Where in that file.
    pub place: String,
}

/// An image of the glTF.
#[derive(Debug, PartialEq)]
pub(crate) struct Image {
    /// Name: the file's, without its folder.
    pub name: String,
    /// `image/png` or `image/jpeg`.
    pub mime: &'static str,
    /// Encoded.
    pub bytes: Vec<u8>,
    /// Whether a pixel has alpha below 255.
    pub has_alpha: bool,
}

/// What an image is made of; equal keys share one image.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Recipe {
    File(PathBuf),
    Joined(Option<PathBuf>, PathBuf),
    /// Heights, and the bits of their strength.
    Normals(PathBuf, u64),
}

/// Pictures that were read and images that were made.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    /// Images in the order of first use.
    pub images: Vec<Image>,
    /// Files that were read.
    pub files: Vec<PathBuf>,
    /// What was noticed.
    pub findings: Vec<Finding>,
    pictures: BTreeMap<PathBuf, Option<Picture>>,
    made: BTreeMap<Recipe, usize>,
}

impl Textures {
    /// A picture that a library names.
    ///
    /// # Errors
    /// [`CarrierError::Input`] where it lies outside the allowed folders.
    pub fn locate(&self, map: &Map, library: &Path, source: &Source) -> Result<Named, CarrierError> {
        // Names count from the library's own folder, which may be a searched one.
        let folder = library.parent().unwrap_or(source.folder);
        let (file, place) = (library.display().to_string(), format!("line {}", map.line));
        let find = |folder| paths::resolve_at(&map.file, folder, &source.import.search, &file, &place);
        let beside = find(folder)?;
        let path = if beside.is_file() || folder == source.folder { beside } else { find(source.folder)? };
        Ok(Named { path, file, place })
    }

    /// Reads a picture once. Says whether there is one.
    pub fn read(&mut self, named: &Named, material: &str) -> bool {
        let Named { path, file, place } = named;
        if let Some(known) = self.pictures.get(path) {
            return known.is_some();
        }
        let picture = match load(path) {
            Ok(picture) => {
                self.files.push(path.clone());
                Some(picture)
            }
            Err(why) => {
                let message = format!("texture of material {material:?}: {why}; the material goes without it");
                self.findings.push(Finding::new(&code::IMPORT_TEXTURE, message).at(place).in_file(file));
                None
            }
        };
        let found = picture.is_some();
        self.pictures.insert(path.clone(), picture);
        found
    }

    /// Whether a picture that was read has alpha.
    pub fn has_alpha(&self, path: &Path) -> bool {
        self.picture(path).is_some_and(|p| p.raster.has_alpha)
    }

    /// Whether a picture that was read is a tangent-space normal map.
    pub fn is_normal_map(&self, path: &Path) -> bool {
        self.picture(path).is_some_and(|p| images::is_normal_map(&p.raster))
    }

    /// The image of a picture as it is.
    pub fn as_it_is(&mut self, path: &Path) -> Result<usize, CarrierError> {
        self.make(Recipe::File(path.to_path_buf()))
    }

    /// The image of a color picture (or white) with the alpha of a mask.
    pub fn joined(&mut self, color: Option<&Path>, mask: &Path) -> Result<usize, CarrierError> {
        self.make(Recipe::Joined(color.map(Path::to_path_buf), mask.to_path_buf()))
    }

    /// The image of the normals of a height map.
    pub fn normals(&mut self, heights: &Path, strength: f64) -> Result<usize, CarrierError> {
        self.make(Recipe::Normals(heights.to_path_buf(), strength.to_bits()))
    }

    fn picture(&self, path: &Path) -> Option<&Picture> {
        self.pictures.get(path).and_then(Option::as_ref)
    }

    fn make(&mut self, recipe: Recipe) -> Result<usize, CarrierError> {
        if let Some(&known) = self.made.get(&recipe) {
            return Ok(known);
        }
        let image = self.cook(&recipe)?;
        self.images.push(image);
        self.made.insert(recipe, self.images.len() - 1);
        Ok(self.images.len() - 1)
    }

    fn cook(&self, recipe: &Recipe) -> Result<Image, CarrierError> {
        let get = |path: &PathBuf| {
            let unread = || CarrierError::input(path.display().to_string(), "", "was not read", "report it");
            self.picture(path).ok_or_else(unread)
        };
        match recipe {
            Recipe::File(path) => unchanged(get(path)?),
            Recipe::Joined(color, mask) => {
                let color = color.as_ref().map(&get).transpose()?;
                let name = format!("{} with alpha", color.unwrap_or(get(mask)?).name);
                encoded(name, &images::alpha_joined(color.map(|c| &c.raster), &get(mask)?.raster))
            }
            Recipe::Normals(path, strength) => {
                let heights = get(path)?;
                let normals = images::normals_from_heights(&heights.raster, f64::from_bits(*strength));
                encoded(format!("{} as normals", heights.name), &normals)
            }
        }
    }
}

/// Reads and decodes; the reason in words where that fails.
fn load(path: &Path) -> Result<Picture, String> {
    let name = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    if !path.is_file() {
        return Err(format!("{} is missing: {BESIDE}", path.display()));
    }
    let bytes = std::fs::read(path).map_err(|error| format!("{name} cannot be read ({error}): make it readable"))?;
    let format = images::sniff(&bytes);
    let raster = images::decode(&bytes, &name).map_err(|error| error.to_string())?;
    Ok(Picture { name, format, bytes, raster })
}

fn unchanged(picture: &Picture) -> Result<Image, CarrierError> {
    let Some(mime) = picture.format.gltf_mime() else { return encoded(picture.name.clone(), &picture.raster) };
    let has_alpha = picture.raster.has_alpha;
    Ok(Image { name: picture.name.clone(), mime, bytes: picture.bytes.clone(), has_alpha })
}

fn encoded(name: String, raster: &Raster) -> Result<Image, CarrierError> {
    Ok(Image { name, mime: "image/png", bytes: images::encode_png(raster)?, has_alpha: raster.has_alpha })
}
