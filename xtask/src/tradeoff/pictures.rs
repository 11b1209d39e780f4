//! Before and after: plain normals beside the default bake, small, for the documents.

use super::{room, trees::Tree};
use crate::repo;
use anyhow::{Context, Result};
use foliar_view::{Panel, Shading, ViewParams, contact_sheet, png_bytes, render};
use serde_json::json;

/// Draws a tree into docs/pictures.
pub fn draw(tree: &Tree) -> Result<()> {
    let params = ViewParams { width_px: 300, height_px: 300, samples: 16, ..ViewParams::default() };
    let layer = room::bake(&tree.plant, &json!({}))?;
    let luft = room::bake(&tree.plant, &json!({"ambient": "luft", "channels": "ambient"}))?;
    let panels = [
        Panel::new("plain normals", render(&tree.plant, &[&layer], &Shading::Plain, &params)?),
        Panel::new("k_a of eq. 4", render(&tree.plant, &[&luft], &Shading::Baked, &params)?),
        Panel::new("default: sky", render(&tree.plant, &[&layer], &Shading::Baked, &params)?),
    ];
    let file = format!("docs/pictures/density_{}.png", tree.name);
    std::fs::write(repo::root().join(&file), png_bytes(&contact_sheet(&panels, &[], panels.len()))?).context(file)
}
