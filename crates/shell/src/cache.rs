//! Layers by content: an unchanged room is not baked again. The key holds everything that a room can
//! see, never a time stamp.

use crate::Failure;
use foliar_bake::Layer;
use foliar_carrier::OutputFile;
use foliar_schema::{Finding, names};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where a cached layer keeps the findings of its bake: a later bake must decide as the first did.
const FINDINGS: &str = "cachedFindings";

/// A folder of layers.
pub struct Cache<'a> {
    folder: &'a Path,
}

impl<'a> Cache<'a> {
    /// The cache in this folder.
    pub fn new(folder: &'a Path) -> Self {
        Cache { folder }
    }

    /// File of a bake: blake3 of room, version, parameters and the hashes of what it reads.
    fn file(&self, room: &str, version: u32, params: &Map<String, Value>, reads: &BTreeMap<String, String>) -> PathBuf {
        let sorted: BTreeMap<_, _> = params.iter().collect();
        let key = serde_json::json!([foliar_schema::CONTRACT, room, version, sorted, reads]).to_string();
        self.folder.join(format!("{room}-{}.{}", blake3::hash(key.as_bytes()).to_hex(), names::LAYER_ENDING))
    }

    /// The layer of an earlier bake, and its findings. What cannot be read is baked again.
    pub fn get(
        &self,
        room: &str,
        version: u32,
        params: &Map<String, Value>,
        reads: &BTreeMap<String, String>,
    ) -> Option<(Layer, Vec<Finding>)> {
        let file = self.file(room, version, params, reads);
        let bytes = std::fs::read(&file).ok()?;
        let mut layer = foliar_carrier::layer_from_bytes(&bytes, &file.display().to_string()).ok()?;
        let findings = serde_json::from_value(layer.record.more.shift_remove(FINDINGS)?).ok()?;
        (layer.record.room == room && &layer.record.reads == reads).then_some((layer, findings))
    }

    /// Keeps a layer and its findings.
    ///
    /// # Errors
    /// [`Failure::Output`] where the folder cannot be written.
    pub fn put(&self, layer: &Layer, params: &Map<String, Value>, findings: &[Finding]) -> Result<(), Failure> {
        let record = &layer.record;
        let path = self.file(&record.room, record.version, params, &record.reads);
        std::fs::create_dir_all(self.folder).map_err(|e| Failure::output(self.folder.display(), e))?;
        let mut kept = layer.clone();
        kept.record.more.insert(FINDINGS.into(), serde_json::json!(findings));
        let bytes = foliar_carrier::layer_to_bytes(&kept)?;
        foliar_carrier::write_files(&[OutputFile { path, bytes }])?;
        Ok(())
    }
}
