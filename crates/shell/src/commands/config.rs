//! `foliar config`: every parameter, its value, and where that came from.

use super::Call;
use crate::config::{Field, Origin, Settings};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::options::Options;
use crate::outputs::Job;
use crate::report::Report;
use crate::runner::{self, Product};
use crate::{Failure, plan};
use foliar_bake::Facts;
use serde_json::{Value, json};
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
        let all: serde_json::Map<String, Value> =
            call.fields.all().iter().map(|field| (field.dotted(), to_json(field, &settings))).collect();
        report.set("configuration", all.clone());
        report.answer = Some(all.into());
        report.text = Some(table(call.fields.all(), &settings).trim_end().into());
        Ok(Product::Answer)
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

fn to_json(field: &Field, settings: &Settings) -> Value {
    match settings.get(&field.dotted()) {
        None => json!({ "value": field.default, "from": "default" }),
        Some(given) => {
            let mut line =
                json!({ "value": given.value, "from": given.origin.kind(), "place": given.origin.to_string() });
            if let Origin::File(path, number) = &given.origin {
                line["file"] = json!(path.display().to_string());
                line["line"] = json!(number);
            }
            line
        }
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
