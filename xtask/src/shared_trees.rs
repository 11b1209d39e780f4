//! The shared trees of expected.json, read and structured as its notes say.

use crate::repo;
use anyhow::{Context, Result};
use foliar_bake::Layer;
use foliar_plant::Plant;
use foliar_schema::{Import, Roles, Unit, Up};
use foliar_structure::{StructureParams, analyze};
use serde_json::Value;
use std::path::PathBuf;

/// One shared tree.
pub struct SharedTree {
    /// Folder and file, as expected.json names it.
    pub name: String,
    /// Where it lies.
    pub path: PathBuf,
    /// Flags that its notes give.
    pub import: Import,
    /// What expected.json says of it.
    pub expected: Value,
}

/// A tree that was read.
pub struct Read {
    /// Base and structure.
    pub plant: Plant,
    /// The layer of structure.
    pub layer: Layer,
}

/// Every tree of expected.json, in its order.
pub fn all() -> Result<Vec<SharedTree>> {
    let folder = repo::shared().join("trees");
    let list = folder.join("expected.json");
    let text = std::fs::read_to_string(&list)
        .with_context(|| format!("{}: no shared trees; set FOLIAR_SHARED to their folder", list.display()))?;
    let expected: Value = serde_json::from_str(&text)?;
    let files = expected["files"].as_object().context("expected.json lists no files")?;
    files.iter().map(|(name, notes)| tree(name, notes, folder.join(name))).collect()
}

/// Name of the linden of fixtures/.
pub const LINDEN: &str = "linden";

/// The linden of fixtures/.
pub fn linden() -> SharedTree {
    let import = Import { up: Some(Up::Y), unit: Some(Unit::M), ..Import::default() };
    SharedTree {
        name: LINDEN.into(),
        path: repo::root().join("fixtures/linden/linden.obj"),
        import,
        expected: Value::Null,
    }
}

fn tree(name: &str, notes: &Value, path: PathBuf) -> Result<SharedTree> {
    let is_obj = name.ends_with(".obj");
    let flag = |key: &str| notes[key].as_str().filter(|v| is_obj && *v != "none");
    let up = flag("up").map(|v| serde_json::from_value(v.into())).transpose()?;
    let unit = flag("unit").map(|v| serde_json::from_value(v.into())).transpose()?;
    Ok(SharedTree {
        name: name.into(),
        path,
        import: Import { up, unit, ..Import::default() },
        expected: notes.clone(),
    })
}

impl SharedTree {
    /// Reads it and finds its structure.
    pub fn read(&self) -> Result<Read> {
        let asset = foliar_carrier::read(&self.path, &self.import)?;
        let analysis = analyze(&asset.base, &Roles::default(), &StructureParams::default())?;
        let plant = Plant::new(asset.base, analysis.structure)?;
        Ok(Read { plant, layer: analysis.layer })
    }

    /// The name as a file name.
    pub fn slug(&self) -> String {
        self.name.replace(['/', '.'], "_")
    }
}
