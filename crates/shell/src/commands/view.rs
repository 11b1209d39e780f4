//! `foliar-view`: pictures.

use super::{Call, assemble};
use crate::bake_one::view_params;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::options::{Options, is_dash};
use crate::{Failure, outputs::Job};
use foliar_bake::Layer;
use foliar_carrier::OutputFile;
use foliar_view::ViewError;
use std::path::PathBuf;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let job = job(&options)?;
    options.start_threads()?;
    let console = options.console();
    let sources = Sources::new(call, Direct::Section("view"))?;
    let loaded = load(&sources, &options, &job.input).map_err(|e| e.in_file(&job.input.display().to_string()))?;
    for finding in &loaded.findings {
        console.finding(finding);
    }
    let sheet = call.matches.get_flag("sheet");
    let output = job.output.unwrap_or_default();
    let bytes = draw(&loaded, &job.input, sheet)?;
    assemble::write_files(&options, &console, &output, &[OutputFile { path: output.clone(), bytes }])
}

fn job(options: &Options) -> Result<Job, Failure> {
    let (Some(input), Some(output)) = (options.inputs.first(), &options.output) else {
        return Err(Failure::usage("foliar-view FILE -o PICTURE.png"));
    };
    let is_png = output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if !is_png && !is_dash(output) {
        return Err(Failure::usage(format!("-o {}: must end in .png, or be -", output.display())));
    }
    Ok(Job { input: input.clone(), output: Some(PathBuf::from(output)) })
}

fn draw(loaded: &Loaded, input: &std::path::Path, sheet: bool) -> Result<Vec<u8>, Failure> {
    let params = view_params(&loaded.settings)?;
    let layers: Vec<&Layer> = std::iter::once(&loaded.structure).chain(&loaded.layers).collect();
    let title = input.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let refuse = |error: ViewError| match error {
        ViewError::Range(_) | ViewError::NotFinite | ViewError::Channel { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Input(format!("{}: {error}", input.display())),
    };
    let picture = if sheet {
        foliar_view::bake_sheet(&loaded.plant, &layers, &title, &params)
    } else {
        foliar_view::render(&loaded.plant, &layers, &params.shading(), &params)
    };
    foliar_view::png_bytes(&picture.map_err(refuse)?).map_err(refuse)
}
