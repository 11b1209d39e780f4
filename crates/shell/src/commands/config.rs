//! `foliar config`: every parameter, its value, and where that came from.

use super::Call;
use crate::config::{Field, Origin, Settings};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::load;
use crate::options::{Format, Options};
use crate::{Failure, plan};
use foliar_bake::Facts;
use serde_json::{Value, json};
use std::path::Path;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let sources = Sources::new(call, Direct::Assets)?;
    let settings = match options.inputs.first() {
        None => sources.gather(&options, Path::new(""), Settings::default())?,
        Some(input) => with_implied(call, &sources, &options, input)?,
    };
    let console = options.console();
    match options.format {
        Format::Json => {
            let lines: serde_json::Map<String, Value> =
                call.fields.all().iter().map(|field| (field.dotted(), to_json(field, &settings))).collect();
            console.result(&format!("{:#}", Value::from(lines)))
        }
        _ => console.result(table(call.fields.all(), &settings).trim_end()),
    }
}

/// What was given for an asset, over what the scene implies for it.
fn with_implied(call: &Call, sources: &Sources, options: &Options, input: &Path) -> Result<Settings, Failure> {
    let loaded = load(sources, options, input)?;
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
