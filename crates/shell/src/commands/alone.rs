//! A room that lives on maps, without a tree: maps in, EXR and PNG out.

use super::Call;
use crate::Failure;
use crate::config::Settings;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::maps::{self, Gathering};
use crate::options::{Mode, Options, is_dash};
use crate::outputs::{self, Job};
use crate::progress::Bar;
use crate::runner::{self, Product};
use foliar_bake::{Baker, Inputs, Layer, Request};
use foliar_carrier::OutputFile;
use foliar_schema::{Finding, names};
use std::path::{Path, PathBuf};

/// Files, and what a person should know of them.
pub(super) type Encoded = (Vec<OutputFile>, Vec<Finding>);

/// What differs from program to program where maps are all that is given.
pub(super) struct OnMaps<'a> {
    /// Maps without which nothing can be made.
    pub needs: &'a [&'a str],
    /// What else one may have meant.
    pub otherwise: &'a str,
    /// Files of what was baked.
    pub encode: fn(&Layer, &Path) -> Result<Encoded, Failure>,
    /// What is said of them.
    pub words: fn(&Layer, &Path) -> Vec<String>,
}

/// Runs the command.
pub fn run(call: &Call, baker: &dyn Baker) -> Result<(), Failure> {
    let room = baker.room();
    let sources = Sources::new(call, Direct::Sections(&[room]))?;
    let output = output(&Options::from(call.matches), room)?;
    let needs = baker.needs().maps;
    bake(
        call,
        baker,
        &sources,
        &output,
        &OnMaps { needs, otherwise: "for a tree name the tree too", encode, words: |_, _| Vec::new() },
    )
}

/// Bakes maps, and nothing else.
pub(super) fn bake(
    call: &Call,
    baker: &dyn Baker,
    sources: &Sources,
    output: &Path,
    on_maps: &OnMaps,
) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let room = baker.room();
    refuse_what_is_of_a_tree(&options, sources, room, on_maps.otherwise)?;
    let job = Job { input: PathBuf::from(room), output: Some(output.to_path_buf()) };
    runner::run(&options, &console, &[job], &mut |_, report| {
        let mut settings = sources.gather(&options, Path::new(""), Settings::default())?;
        report.read.extend(settings.files.iter().cloned());
        let entries = maps::named(call.fields, &mut settings, Path::new(""))?;
        let gathering = Gathering { fields: call.fields, settings: &settings, input: Path::new(""), plant: None };
        let own = entries.get(room).cloned().unwrap_or_default();
        if let Some(missing) = on_maps.needs.iter().find(|map| !own.iter().any(|entry| entry.is(map))) {
            let otherwise = on_maps.otherwise;
            let text = format!("{room} needs a map of {missing}: give it with --{missing} FILE; {otherwise}");
            return Err(Failure::usage(text));
        }
        let gathered = maps::gather(&gathering, baker, &own)?;
        if options.mode == Mode::DryRun {
            return Ok(report.planned(output, baker.about()));
        }
        report.find(gathered.findings);
        report.read.extend(gathered.files);
        console.log(&report.lap("read"));
        let Some(sheet) = gathered.sheets.first() else { return Err(Failure::Fault("no maps were gathered".into())) };
        let bar = Bar::new(console.draws_progress());
        let request = Request { given: sheet.given.clone(), reads: sheet.reads.clone(), ..Request::default() };
        let inputs = Inputs { plant: None, maps: &sheet.maps, neighbors: &[] };
        let (mut layer, findings) =
            foliar_bake::run(baker, &inputs, &request, &bar).map_err(|e| sheet.blame(e.into()))?;
        layer.record.given = settings.given(room);
        report.find(findings.into_iter().map(|finding| sheet.placed(finding)));
        report.told.facts = Some(layer.record.facts.clone());
        console.log(&report.lap(room));
        (on_maps.words)(&layer, output).iter().for_each(|line| console.note(line));
        let (files, findings) = (on_maps.encode)(&layer, output)?;
        outputs::refuse_inputs(&files, &report.read)?;
        report.find(findings);
        console.log(&report.lap("encode"));
        Ok(Product::Files(files))
    })
}

/// Flags of which nothing would be read, for there is no tree or mesh.
fn refuse_what_is_of_a_tree(options: &Options, sources: &Sources, room: &str, otherwise: &str) -> Result<(), Failure> {
    let switches = [("--cache", options.cache.is_some()), ("--explain-roles", options.explain_roles)];
    let switch = switches.into_iter().find_map(|(name, given)| given.then(|| name.to_owned()));
    match switch.or_else(|| sources.flags.outside(room).map(|given| given.origin.to_string())) {
        Some(flag) => Err(Failure::usage(format!(
            "{flag} has no say where maps are all that is given: leave it out; {otherwise}"
        ))),
        None => Ok(()),
    }
}

fn output(options: &Options, room: &str) -> Result<PathBuf, Failure> {
    let endings = format!("without a tree it must end in .exr, .png or .{}, or be -", names::LAYER_ENDING);
    if options.directory.is_some() || options.picture.is_some() {
        return Err(Failure::usage(format!("-d and --picture are for trees: name a tree, or say -o {room}.exr")));
    }
    let Some(output) = &options.output else {
        return Err(Failure::usage(format!(
            "where to? say -o leaf.exr, or name the tree that the maps go onto; {endings}"
        )));
    };
    let ending = output.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("png" | "exr" | names::LAYER_ENDING) => Ok(output.clone()),
        _ if is_dash(output) => Ok(output.clone()),
        _ => Err(Failure::usage(format!("-o {}: {endings}", output.display()))),
    }
}

/// Files of the maps; standard output takes the EXR of the one that is seen.
fn encode(layer: &Layer, output: &Path) -> Result<Encoded, Failure> {
    if outputs::is_layer(output) {
        return Ok((outputs::encode_layer(layer, output)?, Vec::new()));
    }
    if !is_dash(output) {
        return Ok(foliar_carrier::encode_maps(layer, output)?);
    }
    // Of one file alone the one that needs no other to be read.
    let (mut files, _) = foliar_carrier::encode_maps(layer, Path::new("standard-output.exr"))?;
    let shown = files.pop().map(|file| OutputFile { path: output.to_path_buf(), ..file });
    Ok((shown.into_iter().collect(), Vec::new()))
}
