//! `foliar diff`: how two bakes differ.

use super::Call;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::Options;
use crate::outputs::{Job, is_layer};
use crate::plan::columns;
use crate::report::Report;
use crate::runner;
use crate::{Failure, load};
use foliar_bake::Layer;
use foliar_check::Difference;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// Visible steps that a value may differ by unless another tolerance is given: what nobody sees.
const TOLERANCE: f64 = 1.0;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Import)?;
    let tolerance = call.matches.get_one::<f64>("tolerance").copied().unwrap_or(TOLERANCE);
    if !(tolerance >= 0.0 && tolerance.is_finite()) {
        return Err(Failure::usage(format!(
            "--tolerance {tolerance}: must be a finite number, at least 0 (visible steps)"
        )));
    }
    let [a, b] = options.inputs.as_slice() else { return Err(Failure::usage("diff A B")) };
    let job = Job { input: a.clone(), output: None };
    let mut beyond = Vec::new();
    runner::run(&options, &console, &[job], &mut |_, report| {
        let (first, one) = layers(&sources, &options, a, report)?;
        let (second, other) = layers(&sources, &options, b, report)?;
        console.log(&report.lap("read"));
        if first.is_empty() && second.is_empty() {
            let names = format!("{} and {}", a.display(), b.display());
            return Err(Failure::Input(format!("{names} hold no layer: there is nothing to compare; bake them first")));
        }
        let bases = one.zip(other).map(|(one, other)| Difference::of_bases(&one, &other));
        let differences: Vec<Difference> = bases.into_iter().chain(foliar_check::diff(&first, &second)).collect();
        let is_beyond = |d: &&Difference| d.exceeds(tolerance);
        beyond = differences.iter().filter(is_beyond).map(|d| d.name.clone()).collect();
        let parameters = parameters(&first, &second);
        let text = words(&differences, &parameters, tolerance);
        let [a, b] = [a, b].map(|path| path.display().to_string());
        let differs = !beyond.is_empty();
        report.answer(text, &Compared { a, b, tolerance, differs, channels: differences, parameters })
    })?;
    match beyond.as_slice() {
        [] => Ok(()),
        names => Err(Failure::Found(format!("differ by more than {tolerance} visible steps: {}", names.join(", ")))),
    }
}

/// How two bakes differ.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Compared {
    /// The first file.
    a: String,
    /// The second.
    b: String,
    /// Visible steps that a value may differ by.
    tolerance: f64,
    /// Whether anything differs by more: status 1.
    differs: bool,
    /// Base, roles, then every channel, column, map and picture of either.
    channels: Vec<Difference>,
    /// Parameters that were not the same, `room.key: A, B`.
    parameters: Vec<String>,
}

/// Layers of a file, and the hash of the base that they were put onto, where it has one.
fn layers(
    sources: &Sources,
    options: &Options,
    input: &Path,
    report: &mut Report,
) -> Result<(Vec<Layer>, Option<String>), Failure> {
    if is_layer(input) {
        report.read.push(input.to_path_buf());
        return Ok((vec![load::layer(input)?], None));
    }
    let asset = load::asset(sources, options, input)?;
    report.read.extend_from_slice(&asset.files);
    report.find(asset.findings);
    Ok((asset.layers, Some(asset.base_hash)))
}

/// Parameters that were not the same, `room.key: A, B`.
fn parameters(a: &[Layer], b: &[Layer]) -> Vec<String> {
    let mut all = Vec::new();
    for one in a {
        let Some(other) = b.iter().find(|layer| layer.record.room == one.record.room) else { continue };
        let (p, q) = (&one.record.resolved, &other.record.resolved);
        let mut keys: Vec<&String> = p.keys().chain(q.keys()).collect();
        keys.sort();
        keys.dedup();
        let word = |value: Option<&serde_json::Value>| value.map_or("-".to_owned(), ToString::to_string);
        let changed = keys.into_iter().filter(|key| p.get(*key) != q.get(*key));
        all.extend(changed.map(|key| format!("{}.{key}: {}, {}", one.record.room, word(p.get(key)), word(q.get(key)))));
    }
    all
}

fn words(differences: &[Difference], parameters: &[String], tolerance: f64) -> String {
    let number = |value: f64| format!("{value:.3}");
    let mut cells = vec![["room", "channel", "values", "rms", "p99.9", "max", "steps of an eye"].map(String::from)];
    for d in differences {
        let verdict = match &d.problem {
            Some(problem) => problem.clone(),
            None if d.exceeds(tolerance) => format!("differs at {}", d.worst.first().map_or("", |w| &w.place)),
            None => "same".into(),
        };
        let [rms, p999, max] = [d.rms_steps, d.p999_steps, d.max_steps].map(number);
        cells.push([d.room.clone(), d.name.clone(), d.count.to_string(), rms, p999, max, verdict]);
    }
    let mut text = columns(&cells);
    for d in differences.iter().filter(|d| d.exceeds(tolerance)) {
        for spot in &d.worst {
            text.push_str(&format!(
                "{}, {}: {:?}, {:?} ({:.2} steps)\n",
                d.name, spot.place, spot.a, spot.b, spot.steps
            ));
        }
    }
    parameters.iter().for_each(|line| text.push_str(&format!("{line}\n")));
    text.trim_end().into()
}
