//! `foliar-view LEAF.layer`, `foliar-view TREE.glb --light-through`: a leaf by itself, lit from behind, and beside another
//! bake of it.

use crate::load::Loaded;
use crate::options::Options;
use crate::report::Report;
use crate::{Failure, load};
use foliar_bake::Layer;
use foliar_schema::names;
use serde_json::Value;
use std::path::Path;

/// Whether a file is a layer, which a leaf by itself is kept in.
pub fn is_layer(input: &Path) -> bool {
    input.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(names::LAYER_ENDING))
}

/// PNG bytes of a leaf's sheet, or of two bakes of it.
///
/// # Errors
/// [`Failure::Input`] for files that are no layers of light through leaves.
pub fn draw(input: &Path, against: Option<&Path>, report: &mut Report) -> Result<Vec<u8>, Failure> {
    let layer = load::layer(input)?;
    report.read.push(input.to_path_buf());
    let refuse = |error: foliar_view::ViewError| Failure::Input(format!("{}: {error}", input.display()));
    let picture = match against {
        None => foliar_view::leaf_sheet(&layer, "", &name(input)),
        Some(other) if !is_layer(other) => {
            let text = format!("--against {}: must be a layer as {} is", other.display(), input.display());
            return Err(Failure::usage(text));
        }
        Some(other) => {
            let beside = load::layer(other)?;
            report.read.push(other.to_path_buf());
            foliar_view::leaf_comparison([(&layer, "", &name(input)), (&beside, "", &name(other))])
        }
    };
    foliar_view::png_bytes(&picture.map_err(refuse)?).map_err(refuse)
}

fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The same of a leaf material of a tree; "" is the only one.
///
/// # Errors
/// [`Failure::Usage`] with the leaves that there are.
pub fn of_tree(wanted: &str, tree: (&Loaded, &Path), against: Option<(&Loaded, &Path)>) -> Result<Vec<u8>, Failure> {
    let (layer, leaf) = leaf_of(wanted, tree)?;
    let title = format!("{} {leaf}", name(tree.1));
    let picture = match against {
        None => foliar_view::leaf_sheet(layer, &leaf, &title),
        Some(other) => {
            let (beside, other_leaf) = leaf_of(wanted, other)?;
            let other_title = format!("{} {other_leaf}", name(other.1));
            foliar_view::leaf_comparison([(layer, &leaf, &title), (beside, &other_leaf, &other_title)])
        }
    };
    let refuse = |error: foliar_view::ViewError| Failure::Input(format!("{}: {error}", tree.1.display()));
    foliar_view::png_bytes(&picture.map_err(refuse)?).map_err(refuse)
}

/// The layer with the maps of a leaf, and what they are called there: maps that several materials share have one name.
fn leaf_of<'a>(wanted: &str, (loaded, file): (&'a Loaded, &Path)) -> Result<(&'a Layer, String), Failure> {
    let layer = loaded.layers.iter().find(|layer| layer.record.room == names::ROOM_TRANSLUCENCY);
    let none = || {
        let text = "holds no maps of light through a leaf: bake them first (foliar-translucency)";
        Failure::usage(format!("{}: {text}", file.display()))
    };
    let layer = layer.ok_or_else(none)?;
    let leaves = foliar_view::leaf_names(layer);
    let materials = |leaf: &String| -> Vec<&str> {
        let facts = layer.record.facts.get(names::FACT_SHEETS).and_then(|sheets| sheets.get(leaf)?.get("materials"));
        facts.and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect()
    };
    let found = match leaves.as_slice() {
        [] => return Err(none()),
        [only] if wanted.is_empty() => Some(only),
        _ => leaves.iter().find(|leaf| *leaf == wanted || materials(leaf).contains(&wanted)),
    };
    let listed = || leaves.iter().flat_map(materials).collect::<Vec<_>>().join(", ");
    let text = || format!("{}: which leaf? say --light-through=MATERIAL; there are: {}", file.display(), listed());
    Ok((layer, found.cloned().ok_or_else(|| Failure::usage(text()))?))
}

/// What a layer cannot be drawn as.
///
/// # Errors
/// [`Failure::Usage`].
pub fn refuse_others(options: &Options, wanted: &str) -> Result<(), Failure> {
    match options.inputs.first() {
        Some(input) if wanted == "an animated picture" => {
            Err(Failure::usage(format!("{}: a leaf by itself is drawn as a sheet only", input.display())))
        }
        _ => Ok(()),
    }
}
