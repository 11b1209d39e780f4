//! The only crate that knows file bytes: OBJ, glTF, images and layers in; glTF and layers out.
//!
//! Reading gives an [`Asset`]: the base glTF with every foliar layer taken out, the role-free
//! [`Base`] that rooms see, and the layers that a master held. Writing goes the
//! other way: [`assemble`] puts layers onto the base, additively, and [`write()`] commits the bytes,
//! all or nothing.

mod accessor;
mod assemble;
mod coefficients;
mod container;
mod document;
pub mod edit;
mod error;
mod extract;
mod hull;
pub mod images;
mod instances;
mod layer_file;
mod lod;
mod loose;
mod materials;
mod neutral;
mod notes;
pub mod obj;
mod output;
pub mod paths;
mod pictures;
mod raster_file;
mod read;
mod rebase;
mod scene;
pub mod second_reader;
mod sides;
pub mod survey;
mod takeout;
mod trees;
mod triangles;
mod uvs;

pub use document::{Document, Side};
pub use error::CarrierError;
pub use hull::hull_document;
pub use output::{Step, write_files_with};
pub use takeout::DAMAGED;

use foliar_bake::{FloatRaster, Layer};
use foliar_plant::Base;
use foliar_schema::{Finding, Import};
use std::path::{Path, PathBuf};

/// What of a document is baked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Scene by number; nothing said means the file's default scene.
    pub scene: Option<u32>,
    /// Node by name, with everything below it; nothing said means all of the scene.
    pub node: Option<String>,
}

/// What kind of file an asset came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceKind {
    /// Wavefront OBJ, converted to a glTF document.
    Obj,
    /// glTF as JSON with buffers beside it or inside it.
    Gltf,
    /// Binary glTF.
    Glb,
}

/// What reading gives.
#[derive(Clone, Debug)]
pub struct Asset {
    /// The base: every layer of foliar taken out.
    pub document: Document,
    /// What rooms see of the base.
    pub base: Base,
    /// blake3 of the base ([`foliar_bake::base_hash`]).
    pub base_hash: String,
    /// Layers that a master held, in the order of its records.
    pub layers: Vec<Layer>,
    /// What a person may want to know.
    pub findings: Vec<Finding>,
    /// Every file that was really read, in the order of reading.
    pub files: Vec<PathBuf>,
    /// What kind of file it came from.
    pub source: SourceKind,
}

/// Whether a file had to be touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// New bytes are in place.
    Written,
    /// The bytes on disk were the same already: untouched.
    Unchanged,
}

/// One file of an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Where it goes.
    pub path: PathBuf,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// Reads an OBJ, glTF or GLB file, told apart by content, then by ending.
///
/// # Errors
/// [`CarrierError`] with file, place and remedy.
pub fn read(path: &Path, import: &Import) -> Result<Asset, CarrierError> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|source| CarrierError::Open {
        file: name.clone(),
        source,
        remedy: "name a readable .obj, .gltf or .glb file".into(),
    })?;
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let mut asset = read_bytes(bytes, &name, &folder, import)?;
    asset.files.insert(0, path.to_path_buf());
    Ok(asset)
}

/// Reads an asset from memory (standard input). `name` stands in messages, and its ending helps
/// where the content does not tell; relative URIs start from `folder`.
///
/// # Errors
/// [`CarrierError`] with file, place and remedy.
pub fn read_bytes(bytes: Vec<u8>, name: &str, folder: &Path, import: &Import) -> Result<Asset, CarrierError> {
    read::asset(&bytes, name, folder, import)
}

/// Puts layers onto a base: additive, in one canonical order whatever the order of `layers`. Rows
/// and places are checked against the base, and records against the layers that they read.
///
/// # Errors
/// [`CarrierError::Mismatch`] for a layer that does not fit.
pub fn assemble(base: &Document, layers: &[Layer]) -> Result<(Document, Vec<Finding>), CarrierError> {
    assemble::assemble(base, layers)
}

/// Refuses a layer that was baked from another base: its record's `reads.base` must be `base_hash`.
///
/// # Errors
/// [`CarrierError::Mismatch`].
pub fn check_layer(layer: &Layer, base_hash: &str) -> Result<(), CarrierError> {
    match layer.record.reads.get("base") {
        Some(read) if read != base_hash => Err(CarrierError::mismatch(
            &layer.record.room,
            "",
            format!("it was baked from the base {read}, this one is {base_hash}"),
            "bake it again from this base",
        )),
        _ => Ok(()),
    }
}

/// The bytes of a document at `path`, by its ending: `.gltf` gives `STEM.bin` and the JSON after it,
/// anything else one GLB. The last file is the commit. Relative URIs are rebased to the folder of `path`;
/// pictures that it would have to climb out of that folder for join its buffer, and further buffers become
/// data URIs: what is written can be read where it lies. A `.gltf` that stays in its folder keeps its URIs.
///
/// # Errors
/// [`CarrierError`] where a URI cannot be rebased.
pub fn encode(document: &Document, path: &Path) -> Result<Vec<OutputFile>, CarrierError> {
    output::encode(document, path)
}

/// Writes files all or nothing: each to a temporary file beside its target, fsync, then renamed in
/// order. Where all bytes equal those on disk, nothing is touched.
///
/// # Errors
/// [`CarrierError::Output`]; what was there before is intact.
pub fn write_files(files: &[OutputFile]) -> Result<Outcome, CarrierError> {
    output::write_files(files)
}

/// Whether [`write_files`] would leave everything untouched.
pub fn is_unchanged(files: &[OutputFile]) -> bool {
    output::is_unchanged(files)
}

/// Side files that the file at `path` names now, in the folder of its name: asked before it is written over, they say
/// what is to be removed after it.
pub fn side_files(path: &Path) -> Vec<PathBuf> {
    sides::named_by(path)
}

/// Removes side files that nothing names any more, and their folders where these are empty then. What cannot be removed
/// is in nobody's way.
pub fn remove_sides(files: &[PathBuf]) {
    sides::remove(files);
}

/// [`encode`] and [`write_files`] in one.
///
/// # Errors
/// As they have.
pub fn write(document: &Document, path: &Path) -> Result<Outcome, CarrierError> {
    write_files(&encode(document, path)?)
}

/// The bytes of a raster as a picture, by the ending of `path`: `.exr` holds every bit, anything else is a PNG whose
/// 16-bit numbers span the range that the contract declares for `name`.
///
/// # Errors
/// [`CarrierError::Input`] for a raster of no or more than four channels.
pub fn encode_raster(raster: &FloatRaster, name: &str, path: &Path) -> Result<Vec<u8>, CarrierError> {
    raster_file::encode(raster, name, None, path)
}

/// The same; a PNG's numbers span `range` where it is given.
///
/// # Errors
/// As [`encode_raster`].
pub fn encode_raster_between(
    raster: &FloatRaster,
    name: &str,
    range: Option<(f64, f64)>,
    path: &Path,
) -> Result<Vec<u8>, CarrierError> {
    raster_file::encode(raster, name, range, path)
}

/// The maps of a layer that belongs to no tree, as files beside `path`: `.exr` gives an EXR of each and the shown one as
/// PNG, anything else a PNG of each; `STEM.json` says what the numbers mean. The last file is `path`.
///
/// # Errors
/// [`CarrierError::Input`] for a layer without maps.
pub fn encode_maps(layer: &Layer, path: &Path) -> Result<(Vec<OutputFile>, Vec<Finding>), CarrierError> {
    loose::encode(layer, path)
}

/// A layer as a safetensors file: arrays by name, the record as canonical JSON in its metadata.
/// The same layer gives the same bytes.
///
/// # Errors
/// [`CarrierError::Input`] where a record cannot be serialized.
pub fn layer_to_bytes(layer: &Layer) -> Result<Vec<u8>, CarrierError> {
    layer_file::to_bytes(layer)
}

/// Reads a layer file; `name` stands in messages.
///
/// # Errors
/// [`CarrierError::Input`] with what is wrong and what would be right.
pub fn layer_from_bytes(bytes: &[u8], name: &str) -> Result<Layer, CarrierError> {
    layer_file::from_bytes(bytes, name)
}
