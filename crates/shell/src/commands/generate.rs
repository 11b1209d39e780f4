//! `foliar generate`: man pages, completions, help texts and schemas, all from the one definition.

use super::{Call, Program, commands};
use crate::Failure;
use crate::options::Options;
use crate::outputs::{pretty, write_text};
use crate::said;
use clap::Command;
use clap_complete::Shell;
use foliar_schema::{FoliageExtension, LATER_ROOMS};
use serde_json::{Map, Value, json};
use std::path::Path;

/// Columns of generated help texts.
const WIDTH: usize = 100;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let folder = options.inputs.first().cloned().unwrap_or_default();
    std::fs::create_dir_all(&folder).map_err(|e| Failure::output(folder.display(), e))?;
    let programs = Program::all(call.bakers).into_iter().map(|program| commands(&program, call.bakers, call.fields));
    match call.matches.get_one::<String>("kind").map(String::as_str) {
        Some("man") => programs.flat_map(with_subcommands).try_for_each(|command| man(&folder, command)),
        Some("help") => programs.flat_map(with_subcommands).try_for_each(|command| help(&folder, command)),
        Some("completions") => programs.into_iter().try_for_each(|command| completions(&folder, command)),
        _ => schemas(call, &folder),
    }
}

/// A command and its visible subcommands, each under the name that one types with dashes.
fn with_subcommands(command: Command) -> Vec<Command> {
    let name = command.get_name().to_owned();
    let inner: Vec<Command> = command.get_subcommands().filter(|sub| !sub.is_hide_set()).cloned().collect();
    let inner = inner.into_iter().map(|sub| {
        let full = format!("{name}-{}", sub.get_name());
        let typed = format!("{name} {}", sub.get_name());
        sub.name(full).bin_name(typed).version(env!("CARGO_PKG_VERSION"))
    });
    std::iter::once(command.clone()).chain(inner).collect()
}

fn man(folder: &Path, command: Command) -> Result<(), Failure> {
    let path = folder.join(format!("{}.1", command.get_name()));
    let mut page = Vec::new();
    clap_mangen::Man::new(command).render(&mut page).map_err(|e| Failure::output(path.display(), e))?;
    write_text(&path, String::from_utf8_lossy(&page).into_owned())
}

fn help(folder: &Path, command: Command) -> Result<(), Failure> {
    let path = folder.join(format!("{}.txt", command.get_name()));
    let text = command.term_width(WIDTH).render_long_help().to_string();
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    write_text(&path, lines.join("\n") + "\n")
}

fn completions(folder: &Path, mut command: Command) -> Result<(), Failure> {
    let name = command.get_name().to_owned();
    for (shell, file) in [
        (Shell::Bash, format!("{name}.bash")),
        (Shell::Zsh, format!("_{name}")),
        (Shell::Fish, format!("{name}.fish")),
        (Shell::PowerShell, format!("_{name}.ps1")),
    ] {
        let mut script = Vec::new();
        clap_complete::generate(shell, &mut command, &name, &mut script);
        write_text(&folder.join(file), String::from_utf8_lossy(&script).into_owned())?;
    }
    Ok(())
}

fn schemas(call: &Call, folder: &Path) -> Result<(), Failure> {
    write_text(&folder.join("foliar.toml.schema.json"), pretty(&configuration(call)?))?;
    let extension = schemars::schema_for!(FoliageExtension).to_value();
    write_text(&folder.join(format!("{}.schema.json", foliar_schema::names::EXTENSION)), pretty(&extension))?;
    said::schemas()
        .into_iter()
        .try_for_each(|(name, schema)| write_text(&folder.join(format!("{name}.schema.json")), pretty(&schema)))
}

/// JSON Schema of `foliar.toml`: one property per section, definitions of all sections together.
fn configuration(call: &Call) -> Result<Value, Failure> {
    let (mut properties, mut definitions) = (Map::new(), Map::new());
    for (section, schema) in call.fields.schemas() {
        let mut schema = schema.clone();
        if let Some(object) = schema.as_object_mut() {
            object.shift_remove("$schema");
            let own = object.shift_remove("$defs").and_then(|own| own.as_object().cloned()).unwrap_or_default();
            for (name, definition) in own {
                if definitions.insert(name.clone(), definition.clone()).is_some_and(|other| other != definition) {
                    let text = format!("two sections define {name} differently: give one of the types another name");
                    return Err(Failure::Fault(text));
                }
            }
        }
        properties.insert(section.clone(), schema);
    }
    Ok(json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "foliar.toml",
        "description": format!("Configuration of foliar; not in this version: {}", LATER_ROOMS.join(", ")),
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "$defs": definitions,
    }))
}
