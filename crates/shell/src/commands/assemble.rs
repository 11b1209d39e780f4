//! `foliar assemble`: a plant and layer files make one file.

use super::Call;
use crate::bake_one::Status;
use crate::console::Console;
use crate::options::{Mode, Options, is_dash};
use crate::{Failure, load, outputs};
use foliar_bake::Layer;
use foliar_carrier::{Document, Outcome, OutputFile};
use foliar_schema::Import;
use std::path::Path;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let Some((plant, files)) = options.inputs.split_first() else {
        return Err(Failure::usage("assemble PLANT LAYER... -o OUT"));
    };
    let asset = load::read(plant, &Import::default())?;
    let mut layers = asset.layers;
    for file in files {
        let layer = read_layer(file)?;
        foliar_carrier::check_layer(&layer, &asset.base_hash)
            .map_err(|e| Failure::Input(format!("{}: {e}", file.display())))?;
        layers.retain(|old| old.record.room != layer.record.room);
        layers.push(layer);
    }
    let (document, findings) = foliar_carrier::assemble(&asset.document, &layers)?;
    for finding in asset.findings.iter().chain(&findings) {
        console.finding(finding);
    }
    write(&options, &console, &document)
}

/// Reads a layer file.
///
/// # Errors
/// [`Failure::Input`].
pub fn read_layer(file: &Path) -> Result<Layer, Failure> {
    let name = file.display().to_string();
    let unreadable = |e| Failure::Input(format!("{name}: cannot be read: {e}: name a .layer file"));
    let bytes = std::fs::read(file).map_err(unreadable)?;
    Ok(foliar_carrier::layer_from_bytes(&bytes, &name)?)
}

/// Writes the one document that a command makes, or checks it, and says so.
///
/// # Errors
/// [`Failure::Output`]; [`Failure::Found`] where `--check` would change it.
pub fn write(options: &Options, console: &Console, document: &Document) -> Result<(), Failure> {
    let Some(output) = &options.output else { return Err(Failure::usage("where to? say -o OUT")) };
    options.refuse_contradictions()?;
    outputs::check_ending(output, false)?;
    write_files(options, console, output, &outputs::encode(document, output)?)
}

/// Writes the files of one output, or checks them, and says so.
///
/// # Errors
/// As [`write`].
pub fn write_files(options: &Options, console: &Console, output: &Path, files: &[OutputFile]) -> Result<(), Failure> {
    if is_dash(output) {
        return files.iter().try_for_each(|file| console.data(&file.bytes));
    }
    if options.mode == Mode::Check {
        let same = foliar_carrier::is_unchanged(files);
        return if same { Ok(()) } else { Err(Failure::Found(format!("would change: {}", output.display()))) };
    }
    let status = match foliar_carrier::write_files(files)? {
        Outcome::Written => Status::Written,
        Outcome::Unchanged => Status::Unchanged,
    };
    super::bake::tell_written(console, options, output, status)
}
