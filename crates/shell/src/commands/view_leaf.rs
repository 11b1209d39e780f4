//! `foliar-view LEAF.layer`: a leaf by itself, lit from behind, and beside another bake of it.

use crate::options::Options;
use crate::report::Report;
use crate::{Failure, load};
use foliar_schema::names;
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
    let name = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let refuse = |error: foliar_view::ViewError| Failure::Input(format!("{}: {error}", input.display()));
    let picture = match against {
        None => foliar_view::leaf_sheet(&layer, &name(input)),
        Some(other) if !is_layer(other) => {
            let text = format!("--against {}: must be a layer as {} is", other.display(), input.display());
            return Err(Failure::usage(text));
        }
        Some(other) => {
            let beside = load::layer(other)?;
            report.read.push(other.to_path_buf());
            foliar_view::leaf_comparison([(&layer, &name(input)), (&beside, &name(other))])
        }
    };
    foliar_view::png_bytes(&picture.map_err(refuse)?).map_err(refuse)
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
