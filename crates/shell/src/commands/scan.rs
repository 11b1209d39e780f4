//! `foliar-leafscan`, and every baker of a mesh that is no tree: maps for a library, one file per map.

use super::Call;
use super::alone::{Encoded, OnMaps};
use crate::Failure;
use crate::config::Settings;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load;
use crate::maps;
use crate::options::{Mode, Options};
use crate::outputs::{self, Job};
use crate::progress::Bar;
use crate::runner::{self, Product};
use foliar_bake::{Baker, Inputs, Layer, Maps, Request};
use foliar_carrier::OutputFile;
use foliar_plant::{Base, Plant, Structure};
use foliar_schema::{Role, names};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(call: &Call, baker: &dyn Baker) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Scan(baker.room()))?;
    let jobs = outputs::jobs(&options)?;
    let Some(output) = options.output.clone() else { return Err(Failure::usage(WHERE)) };
    check_ending(&output)?;
    if options.inputs.is_empty() {
        return super::alone::bake(call, baker, &sources, &output, &HEIGHTS);
    }
    runner::run(&options, &console, &jobs, &mut |job: &Job, report| {
        let asset = load::asset(&sources, &options, &job.input)?;
        report.asset(&asset);
        let mut settings = sources.gather(&options, &job.input, Settings::default())?;
        if maps::named(call.fields, &mut settings, &job.input)?.values().any(|entries| !entries.is_empty()) {
            return Err(Failure::usage("a mesh or two height maps, and not both: leave one of them out"));
        }
        console.log(&report.lap("read"));
        if options.mode == Mode::DryRun {
            return Ok(report.planned(&output, baker.about()));
        }
        let reads = BTreeMap::from([("base".to_owned(), asset.base_hash.clone())]);
        let plant = bare(asset.base).map_err(|e| Failure::Input(format!("{}: {e}", job.input.display())))?;
        let bar = Bar::new(console.draws_progress());
        let request = Request { given: settings.given(baker.room()), reads, ..Request::default() };
        let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
        let (layer, findings) = foliar_bake::run(baker, &inputs, &request, &bar)?;
        report.find(findings);
        console.log(&report.lap(baker.room()));
        report.told.facts = Some(layer.record.facts.clone());
        words(&layer, &output).iter().for_each(|line| console.note(line));
        let (files, findings) = encode(&layer, &output)?;
        report.find(findings);
        Ok(Product::Files(files))
    })
}

/// Two height maps in place of a mesh.
const HEIGHTS: OnMaps = OnMaps {
    needs: &[names::MAP_HEIGHT_FRONT, names::MAP_HEIGHT_BACK],
    otherwise: "or name the mesh of a leaf",
    encode,
    words,
};

const WHERE: &str = "where to? say -o NAME.exr or NAME.png: thickness goes there, every other map beside it";

fn check_ending(output: &Path) -> Result<(), Failure> {
    let ending = output.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("png" | "exr" | names::LAYER_ENDING) => Ok(()),
        _ => Err(Failure::usage(format!("-o {}: must end in .exr, .png or .layer", output.display()))),
    }
}

/// A plant of which nothing is known but its triangles.
fn bare(base: Base) -> Result<Plant, foliar_plant::PlantError> {
    let parts = base.parts.len();
    Plant::new(
        base,
        Structure { roles: vec![Role::Other; parts], leaves: Vec::new(), leaf_ids: vec![Vec::new(); parts] },
    )
}

/// Thickness at the path itself, every other map beside it, and a JSON that says what their numbers mean; the path is the
/// last: it is the commit.
fn encode(layer: &Layer, output: &Path) -> Result<Encoded, Failure> {
    if outputs::is_layer(output) {
        return Ok((outputs::encode_layer(layer, output)?, Vec::new()));
    }
    let file = |(name, raster): (&String, &foliar_bake::FloatRaster)| {
        let path = place(name, output);
        let bytes = foliar_carrier::encode_raster_between(raster, name, stored(layer, name), &path)?;
        Ok(OutputFile { path, bytes })
    };
    let (commit, beside): (Vec<_>, Vec<_>) = layer.rasters.iter().partition(|(name, _)| *name == names::MAP_THICKNESS);
    let mut files = beside.into_iter().map(file).collect::<Result<Vec<_>, Failure>>()?;
    let about = json!({ "record": layer.record });
    files.push(OutputFile { path: output.with_extension("json"), bytes: outputs::pretty(&about).into_bytes() });
    files.extend(commit.into_iter().map(file).collect::<Result<Vec<_>, Failure>>()?);
    Ok((files, Vec::new()))
}

/// Where a map goes: `leaf.exr`, `leaf-height-front.exr`.
fn place(name: &str, output: &Path) -> PathBuf {
    if name == names::MAP_THICKNESS {
        return output.to_path_buf();
    }
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let ending = output.extension().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!("{stem}-{name}.{ending}"))
}

/// What black and white are in a picture of whole numbers.
fn stored(layer: &Layer, name: &str) -> Option<(f64, f64)> {
    let range = layer.record.facts.get("stored")?.get(name)?;
    Some((range.get("black")?.as_f64()?, range.get("white")?.as_f64()?))
}

/// The size of a texel, and what black and white of pictures stand for.
fn words(layer: &Layer, output: &Path) -> Vec<String> {
    let facts = &layer.record.facts;
    let number = |value: &Value| value.as_f64().map_or_else(|| "?".into(), |v| format!("{v:.6}"));
    let texel: Vec<String> = facts["texelMm"].as_array().into_iter().flatten().map(number).collect();
    let d = &facts["thicknessMm"];
    let mut lines = vec![format!(
        "a texel is {} mm; thickness {} to {} mm, median {}",
        texel.join(" x "),
        number(&d["least"]),
        number(&d["greatest"]),
        number(&d["median"])
    )];
    if output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        let range = |name: &String| {
            let (black, white) = stored(layer, name)?;
            Some(format!("{}: black is {black:.6}, white {white:.6}", place(name, output).display()))
        };
        lines.extend(layer.rasters.keys().filter_map(range));
        lines.extend(read_back(layer));
    }
    lines
}

/// How heights in pictures of whole numbers are said to who reads them.
fn read_back(layer: &Layer) -> Option<String> {
    let (black, white) = stored(layer, names::MAP_HEIGHT_FRONT)?;
    let span = white - black;
    Some(format!(
        "heights are read again with --height-scale-mm {span:.6} --height-offset-mm {black:.6} (the offset in foliar-leafscan alone)"
    ))
}
