//! `foliar-view`: pictures.

use super::Call;
use crate::Failure;
use crate::bake_one::view_params;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::neighbors;
use crate::options::{Mode, Options, is_dash};
use crate::outputs::Job;
use crate::runner::{self, Product};
use foliar_bake::Layer;
use foliar_carrier::OutputFile;
use foliar_view::{Standing, ViewError, ViewParams};
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Section("view"))?;
    let (input, output) = files(&options)?;
    let sheet = call.matches.get_flag("sheet");
    let job = Job { input, output: Some(output.clone()) };
    runner::run(&options, &console, &[job], &mut |job, report| {
        let mut loaded = load(&sources, &options, &job.input)?;
        let stands = neighbors::named(&mut loaded.settings)?.remove("view").unwrap_or_default();
        report.loaded(&loaded);
        let around = neighbors::standing(&sources, &options, &stands, report)?;
        console.log(&report.lap("read"));
        let params = view_params(&loaded.settings)?;
        if options.mode == Mode::DryRun {
            let what = if sheet { "a contact sheet" } else { "a picture" };
            return Ok(report.planned(&output, &format!("{what} of {} x {}", params.width_px, params.height_px)));
        }
        let bytes = draw(&loaded, &around, &job.input, sheet, &params)?;
        console.log(&report.lap("picture"));
        Ok(Product::Files(vec![OutputFile { path: output.clone(), bytes }]))
    })
}

fn files(options: &Options) -> Result<(PathBuf, PathBuf), Failure> {
    let (Some(input), Some(output)) = (options.inputs.first(), &options.output) else {
        return Err(Failure::usage("foliar-view FILE -o PICTURE.png"));
    };
    let is_png = output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if !is_png && !is_dash(output) {
        return Err(Failure::usage(format!("-o {}: must end in .png, or be -", output.display())));
    }
    Ok((input.clone(), output.clone()))
}

fn draw(
    loaded: &Loaded,
    around: &[Standing],
    input: &Path,
    sheet: bool,
    params: &ViewParams,
) -> Result<Vec<u8>, Failure> {
    let layers: Vec<&Layer> = std::iter::once(&loaded.structure).chain(&loaded.layers).collect();
    let title = input.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let refuse = |error: ViewError| match error {
        ViewError::Range(_) | ViewError::NotFinite | ViewError::Channel { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Input(format!("{}: {error}", input.display())),
    };
    let picture = if sheet {
        foliar_view::bake_sheet(&loaded.plant, &layers, &title, params)
    } else {
        foliar_view::render_among(&loaded.plant, &layers, around, &params.shading(), params)
    };
    foliar_view::png_bytes(&picture.map_err(refuse)?).map_err(refuse)
}
