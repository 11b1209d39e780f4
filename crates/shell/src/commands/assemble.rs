//! `foliar assemble`: a plant and layer files make one file.

use super::Call;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Mode, Options};
use crate::outputs::{self, Job};
use crate::report::Report;
use crate::runner::{self, Product};
use crate::said::{Put, RoomTold};
use crate::{Failure, load};
use foliar_bake::Layer;
use foliar_carrier::Document;
use std::path::Path;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Import)?;
    let Some((plant, files)) = options.inputs.split_first() else {
        return Err(Failure::usage("assemble PLANT LAYER... -o OUT"));
    };
    let output = output(&options)?;
    let job = Job { input: plant.clone(), output: Some(output.to_path_buf()) };
    runner::run(&options, &console, &[job], &mut |job, report| {
        let asset = load::asset(&sources, &options, &job.input)?;
        report.asset(&asset);
        let mut layers = asset.layers;
        for file in files {
            let layer = load::layer(file)?;
            report.read.push(file.clone());
            foliar_carrier::check_layer(&layer, &asset.base_hash)
                .map_err(|e| Failure::Input(format!("{}: {e}", file.display())))?;
            layers.retain(|old| old.record.room != layer.record.room);
            layers.push(layer);
        }
        console.log(&report.lap("read"));
        let (document, findings) = foliar_carrier::assemble(&asset.document, &layers)?;
        report.find(findings);
        report.told.rooms = Some(rooms(&layers));
        console.log(&report.lap("assemble"));
        let names: Vec<&str> = layers.iter().map(|layer| layer.record.room.as_str()).collect();
        product(&options, report, &document, output, &format!("the base with {}", names.join(", ")))
    })
}

fn rooms(layers: &[Layer]) -> Vec<RoomTold> {
    let put = |layer: &Layer| RoomTold::Put(Put { room: layer.record.room.clone(), version: layer.record.version });
    layers.iter().map(put).collect()
}

/// Where the one document that a command makes goes.
///
/// # Errors
/// [`Failure::Usage`] for a name whose ending says nothing.
pub fn output(options: &Options) -> Result<&Path, Failure> {
    let Some(output) = &options.output else { return Err(Failure::usage("where to? say -o OUT")) };
    outputs::check_ending(output, false)?;
    Ok(output)
}

/// The one document that a command makes, or what it would be.
///
/// # Errors
/// As the carrier's.
pub fn product(
    options: &Options,
    report: &mut Report,
    document: &Document,
    output: &Path,
    what: &str,
) -> Result<Product, Failure> {
    if options.mode == Mode::DryRun {
        return Ok(report.planned(output, what));
    }
    Ok(Product::Files(outputs::encode(document, output)?))
}
