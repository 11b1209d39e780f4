//! Pictures of docs/translucency.md: the leaf made by rule lit from behind, its coefficients, and the direct gather beside
//! the bank.

use crate::bench::translucency::{inputs_of, maps};
use crate::repo;
use anyhow::{Context, Result};
use foliar_bake::{Baker, Layer, Quiet, Request, run};
use foliar_translucency::Translucency;
use foliar_translucency::map::by_rule::{WIDTH_MM, leaf_by_rule};
use foliar_view::{leaf_comparison, leaf_sheet, png_bytes};
use serde_json::{Value, json};

const SHEET: &str = "docs/pictures/translucency.png";
const REFERENCE: &str = "docs/pictures/translucency-reference.png";
/// Texels of the leaf that is lit, and of the one that every texel's own kernel is summed for.
const SIZE: usize = 840;
const SMALL: usize = 105;

/// Draws both.
pub fn draw() -> Result<()> {
    let whole = bake(SIZE, &json!({"bands": "rgb", "sides": "front"}))?;
    save(SHEET, &png_bytes(&leaf_sheet(&whole, "", "a leaf made by rule, 80 mm, light from behind")?)?)?;
    // Colors of one band: the reference takes its time.
    let given = json!({"sides": "front", "wavelength_nm": 550.0});
    let fast = bake(SMALL, &given)?;
    let maps = maps(leaf_by_rule(SMALL));
    let exact = Translucency.reference(&inputs_of(&maps), &fast.record.resolved)?;
    let exact = Layer { rasters: exact.rasters, ..fast.clone() };
    save(REFERENCE, &png_bytes(&leaf_comparison([(&exact, "", "direct gather"), (&fast, "", "bank")])?)?)
}

fn bake(size: usize, given: &Value) -> Result<Layer> {
    let mut given = given.as_object().cloned().unwrap_or_default();
    given.insert("leaf_width_mm".into(), json!(WIDTH_MM));
    let maps = maps(leaf_by_rule(size));
    Ok(run(&Translucency, &inputs_of(&maps), &Request { given, ..Request::default() }, &Quiet)?.0)
}

fn save(path: &str, bytes: &[u8]) -> Result<()> {
    std::fs::write(repo::root().join(path), bytes).context(path.to_owned())
}
