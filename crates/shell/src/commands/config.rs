//! `foliar config`: every parameter, its value, and where that came from.

use super::Call;
use crate::config::{Field, Origin, Settings};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::options::Options;
use crate::outputs::{self, Job};
use crate::report::Report;
use crate::runner;
use crate::{Failure, plan};
use foliar_bake::Facts;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::path::Path;

/// What a configuration is called that belongs to no asset.
const NO_ASSET: &str = "configuration";

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Assets)?;
    let input = options.inputs.first().cloned().unwrap_or_else(|| NO_ASSET.into());
    runner::run(&options, &console, &[Job { input, output: None }], &mut |job, report| {
        let settings = match options.inputs.first() {
            None => sources.gather(&options, Path::new(""), Settings::default())?,
            Some(_) => with_implied(call, load(&sources, &options, &job.input)?, report)?,
        };
        report.read.extend(settings.files.iter().cloned());
        console.log(&report.lap("read"));
        let one = |field: &Field| Ok((field.dotted(), outputs::value(&Valued::of(field, &settings))?));
        let all = call.fields.all().iter().map(one).collect::<Result<Map<String, Value>, Failure>>()?;
        report.told.configuration = Some(all.clone());
        report.answer(table(call.fields.all(), &settings).trim_end(), &all)
    })
}

/// What was given for an asset, over what the scene implies for it.
fn with_implied(call: &Call, loaded: Loaded, report: &mut Report) -> Result<Settings, Failure> {
    report.loaded(&loaded);
    let mut all = Settings::default();
    for row in plan::make(call.bakers, &loaded.settings, None, &Facts::of(&loaded.plant))? {
        for (name, value) in &row.implied {
            if let Ok(field) = call.fields.find(&format!("{}.{name}", row.baker.room())) {
                all.set(field, value.clone(), Origin::Scene(row.because.clone()));
            }
        }
    }
    all.overlay(loaded.settings);
    Ok(all)
}

/// A parameter's value, and where it came from.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Valued {
    /// Its value; null where a room settles it.
    value: Value,
    /// `default`, `scene`, `file`, `record`, `environment` or `flag`.
    from: &'static str,
    /// The same with its name.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
    /// The file that gave it.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    /// Its line there.
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
}

impl Valued {
    fn of(field: &Field, settings: &Settings) -> Self {
        let Some(given) = settings.get(&field.dotted()) else {
            return Valued { value: field.default.clone(), from: "default", place: None, file: None, line: None };
        };
        let (file, line) = match &given.origin {
            Origin::File(path, line) => (Some(path.display().to_string()), Some(*line)),
            _ => (None, None),
        };
        let (value, from, place) = (given.value.clone(), given.origin.kind(), Some(given.origin.to_string()));
        Valued { value, from, place, file, line }
    }
}

fn table(fields: &[Field], settings: &Settings) -> String {
    let shown = |value: &Value| if value.is_null() { "-".into() } else { value.to_string() };
    let row = |field: &Field| match settings.get(&field.dotted()) {
        None => [field.dotted(), shown(&field.default), "default".into()],
        Some(given) => [field.dotted(), shown(&given.value), given.origin.to_string()],
    };
    plan::columns(&fields.iter().map(row).collect::<Vec<_>>())
}
