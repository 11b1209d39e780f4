//! `foliar-noise`, and every baker that needs nothing: what it makes belongs to a library, not to a tree.

use super::Call;
use crate::Failure;
use crate::config::Settings;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Mode, Options, is_dash};
use crate::outputs::{self, Job};
use crate::progress::Bar;
use crate::runner::{self, Product};
use foliar_bake::{Inputs, Layer, Maps, Request};
use foliar_carrier::OutputFile;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// Key of what a baker measured on its product, among the facts of its record.
const MEASURED: &str = "measured";

/// Runs the command.
pub fn run(call: &Call, room: &str) -> Result<(), Failure> {
    if let Some(baker) = call.bakers.iter().find(|baker| baker.room() == room && baker.needs().scan) {
        return super::scan::run(call, *baker);
    }
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Alone(room))?;
    let baker = call.bakers.iter().find(|baker| baker.room() == room);
    let baker = baker.ok_or_else(|| Failure::Fault(format!("{room} is declared and not built")))?;
    let output = output(&options)?;
    let job = Job { input: PathBuf::from(room), output: Some(output.clone()) };
    runner::run(&options, &console, &[job], &mut |_, report| {
        let settings = sources.gather(&options, Path::new(""), Settings::default())?;
        report.read.extend(settings.files.iter().cloned());
        console.log(&report.lap("read"));
        if options.mode == Mode::DryRun {
            return Ok(report.planned(&output, baker.about()));
        }
        let bar = Bar::new(console.draws_progress());
        let request = Request { given: settings.given(room), ..Request::default() };
        let inputs = Inputs { plant: None, maps: &Maps::new(), neighbors: &[] };
        let (layer, findings) = foliar_bake::run(*baker, &inputs, &request, &bar)?;
        report.find(findings);
        console.log(&report.lap(room));
        if call.matches.get_flag("measure") {
            report.text = Some(words(&layer.record.facts));
            report.told.measured = layer.record.facts.get(MEASURED).cloned();
        }
        Ok(Product::Files(vec![OutputFile { path: output.clone(), bytes: encode(&layer, &output)? }]))
    })
}

fn output(options: &Options) -> Result<PathBuf, Failure> {
    let Some(output) = &options.output else { return Err(Failure::usage("where to? say -o NAME.png or NAME.exr")) };
    let ending = output.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("png" | "exr" | foliar_schema::names::LAYER_ENDING) => Ok(output.clone()),
        _ if is_dash(output) => Ok(output.clone()),
        _ => Err(Failure::usage(format!("-o {}: must end in .png, .exr, .layer, or be -", output.display()))),
    }
}

/// One picture for the one raster; standard output takes a PNG.
fn encode(layer: &Layer, output: &Path) -> Result<Vec<u8>, Failure> {
    if outputs::is_layer(output) {
        return Ok(foliar_carrier::layer_to_bytes(layer)?);
    }
    match layer.rasters.iter().next() {
        Some((name, raster)) => Ok(foliar_carrier::encode_raster(raster, name, output)?),
        None => Err(Failure::Fault(format!("{} made no raster", layer.record.room))),
    }
}

/// Measured figures, one a line.
fn words(facts: &Map<String, Value>) -> String {
    let figures = facts.get(MEASURED).and_then(Value::as_object).into_iter().flatten();
    figures.map(|(name, value)| format!("{name}: {value}")).collect::<Vec<_>>().join("\n")
}
