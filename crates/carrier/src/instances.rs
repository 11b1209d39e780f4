//! A mesh per node: at import, before there is a base, every node but the first that draws a mesh
//! gets a copy of it. Accessors stay shared, so nothing but JSON grows.

use crate::accessor::Source;
use crate::document::index_of;
use crate::scene::walk_scene;
use crate::{CarrierError, Document};
use serde_json::Value;
use std::collections::BTreeSet;

/// Copies meshes until no two drawn nodes share one.
pub(crate) fn expand(document: &mut Document, file: &str) -> Result<(), CarrierError> {
    let selection = document.selection.clone();
    let source = Source { document, file };
    let drawn = walk_scene(source, &selection, &mut Vec::new())?.drawn;
    let mut seen = BTreeSet::new();
    let again: Vec<usize> = drawn.iter().filter(|d| !seen.insert(d.mesh)).map(|d| d.node).collect();
    for node in again {
        let Some(mesh) = index_of(&document.json["nodes"][node], "mesh") else { continue };
        let copy = document.json["meshes"][mesh].clone();
        let Some(meshes) = document.json["meshes"].as_array_mut() else { continue };
        meshes.push(copy);
        let last = meshes.len() - 1;
        document.json["nodes"][node]["mesh"] = Value::from(last);
    }
    Ok(())
}
