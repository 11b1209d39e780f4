//! Command lines, built from the list of all parameters. clap gets no defaults and no environment:
//! what is present was given.

use crate::Failure;
use crate::config::{Field, Fields, Kind, Origin, Settings, from_text};
use crate::neighbors;
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Arg, ArgAction, ArgMatches, Command, ValueHint, value_parser};
use foliar_bake::Baker;
use foliar_schema::{LATER_ROOMS, names};
use std::path::PathBuf;

/// Which parameters are direct flags of a command; the others go by `--set section.key=value`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direct<'a> {
    /// Import, roles and `--quality`.
    Assets,
    /// Import and roles, and the parameters of these sections.
    Sections(&'a [&'a str]),
    /// Import only.
    Import,
    /// Import, and what is packed.
    Pack,
    /// The parameters of one section and no others.
    Alone(&'a str),
    /// Import, and the parameters of one section.
    Scan(&'a str),
}

impl Direct<'_> {
    /// The fields in question.
    pub fn fields<'f>(&'f self, fields: &'f Fields) -> impl Iterator<Item = &'f Field> {
        fields.all().iter().filter(move |field| match self {
            Direct::Import => field.section == "import",
            Direct::Pack => field.section == "import" || field.section == "pack",
            Direct::Alone(section) => field.section == *section,
            Direct::Scan(section) => field.section == "import" || field.section == *section,
            Direct::Assets => is_asset(field) || is_shared(field),
            Direct::Sections(sections) => is_asset(field) || sections.contains(&field.section.as_str()),
        })
    }
}

/// Parameters that every bake has as a flag, whatever their section.
fn is_shared(field: &Field) -> bool {
    let of_a_room = field.section != "view" && field.dotted().ends_with(neighbors::ENDING);
    of_a_room || field.dotted() == "scene.budget.quality"
}

fn is_asset(field: &Field) -> bool {
    field.section == "import" || field.section == "roles"
}

/// A flag for a parameter.
fn field_arg(field: &Field) -> Arg {
    let arg = Arg::new(field.dotted())
        .long(field.flag())
        .help(field.help())
        .help_heading(format!("Section [{}]", field.section))
        .value_name(value_name(field));
    match &field.kind {
        Kind::Bool => {
            arg.num_args(0..=1).require_equals(true).default_missing_value("true").value_parser(["true", "false"])
        }
        Kind::Choice(words) => {
            let values = words.iter().map(|(word, doc)| PossibleValue::new(word.clone()).help(doc.clone()));
            arg.value_parser(PossibleValuesParser::new(values))
        }
        Kind::List(_) => arg.action(ArgAction::Append),
        Kind::Number | Kind::Integer | Kind::Array(..) => arg.allow_negative_numbers(true),
        Kind::Text => arg,
    }
}

fn value_name(field: &Field) -> String {
    match (&field.kind, field.section.as_str()) {
        (Kind::List(_), "roles") => "PATTERN".into(),
        (Kind::List(_), _) if field.map.is_some() => "[MATERIAL=]FILE".into(),
        (Kind::List(_), _) if field.dotted().ends_with(neighbors::ENDING) => "FILE@X,Y,Z[,YAW_DEG[,SCALE]]".into(),
        (Kind::Bool, _) => "true|false".into(),
        (Kind::Number, _) => "NUMBER".into(),
        (Kind::Integer, _) => "WHOLE NUMBER".into(),
        _ => field.flag().to_uppercase(),
    }
}

/// Gives a command the flags of these parameters, and `--set` for all others.
pub fn with_fields(command: Command, fields: &Fields, direct: Direct) -> Command {
    let command = command.args(direct.fields(fields).map(field_arg));
    let command = match direct {
        Direct::Alone(_) => command,
        _ => command.mut_arg("import.unit", |arg| arg.conflicts_with("import.height_m")),
    };
    command
        .arg(
            Arg::new("set")
                .long("set")
                .value_name("SECTION.KEY=VALUE")
                .action(ArgAction::Append)
                .help("Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all"),
        )
        .arg(path("config", "FILE", "Reads this configuration instead of the project's foliar.toml"))
        .arg(switch("no-config", "Reads neither foliar.toml nor the asset's own file").conflicts_with("config"))
}

/// What the command line gives.
///
/// # Errors
/// [`Failure::Usage`] for an unknown or bad parameter.
pub fn given(fields: &Fields, direct: Direct, matches: &ArgMatches) -> Result<Settings, Failure> {
    let mut settings = Settings::default();
    for text in many(matches, "set") {
        let (name, value) =
            text.split_once('=').ok_or_else(|| Failure::usage(format!("--set {text}: must be SECTION.KEY=VALUE")))?;
        let refuse = |e| Failure::usage(format!("--set {text}: {e}"));
        let field = fields.find(name.trim()).map_err(refuse)?;
        settings.set(field, from_text(field, value).map_err(refuse)?, Origin::Flag(format!("--set {text}")));
    }
    for field in direct.fields(fields) {
        let texts = many(matches, &field.dotted());
        if !texts.is_empty() {
            let flag = format!("--{}", field.flag());
            let value = flag_value(field, &texts).map_err(|e| Failure::usage(format!("{flag}: {e}")))?;
            settings.set(field, value, Origin::Flag(flag));
        }
    }
    Ok(settings)
}

/// Each occurrence of a list's flag is one entry, commas and all.
fn flag_value(field: &Field, texts: &[String]) -> Result<serde_json::Value, String> {
    match (&field.kind, texts) {
        (Kind::List(_), _) => Ok(texts.to_vec().into()),
        (_, [.., last]) => from_text(field, last),
        (_, []) => Ok(serde_json::Value::Null),
    }
}

/// Every text of a flag that a command may not even have.
fn many(matches: &ArgMatches, id: &str) -> Vec<String> {
    matches.try_get_many::<String>(id).ok().flatten().into_iter().flatten().cloned().collect()
}

/// A flag without value.
pub fn switch(name: &'static str, help: &'static str) -> Arg {
    Arg::new(name).long(name).action(ArgAction::SetTrue).help(help)
}

/// A flag that names a file or folder.
pub fn path(name: &'static str, value: &'static str, help: &'static str) -> Arg {
    Arg::new(name)
        .long(name)
        .value_name(value)
        .value_parser(value_parser!(PathBuf))
        .value_hint(ValueHint::AnyPath)
        .help(help)
}

/// The input files of a command.
pub fn inputs(name: &'static str, help: &'static str) -> Arg {
    Arg::new("inputs")
        .value_name(name)
        .value_parser(value_parser!(PathBuf))
        .value_hint(ValueHint::FilePath)
        .num_args(1..)
        .help(help)
}

/// `-o OUT`.
pub fn output(help: &'static str) -> Arg {
    path("output", "OUT", help).short('o')
}

/// What a command leaves behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaves {
    /// Files.
    Files,
    /// An answer on standard output.
    Answer,
}

/// The flags of every program (house rules, section 6). One that only answers has nothing to check, to
/// plan or to list.
pub fn with_conventions(command: Command, leaves: Leaves) -> Command {
    let command = match leaves {
        Leaves::Answer => command,
        Leaves::Files => command
            .arg(switch("dry-run", "Prints what would be done and stops").conflicts_with("check"))
            .arg(switch("check", "Writes nothing; status 1 where the output would change"))
            .arg(path("outputs", "FILE.json", "Writes the list of files that belong to the output")),
    };
    command
        .arg(path("report", "FILE.json", "Writes what was read, found, made and measured"))
        .arg(path("depfile", "FILE", "Writes every file that was really read, as a rule for make or ninja"))
        .arg(
            Arg::new("fail-on")
                .long("fail-on")
                .value_name("SEVERITY")
                .value_parser(["note", "warning", "error"])
                .help("Findings as serious as this end the work with status 1, the old output left as it is"),
        )
        .arg(
            Arg::new("threads")
                .long("threads")
                .value_name("N")
                .value_parser(value_parser!(u16).range(1..))
                .help("Works in so many threads; the result is the same for any number"),
        )
        .arg(switch("quiet", "Prints errors only").short('q').conflicts_with("verbose"))
        .arg(switch("verbose", "Prints each step with its time").short('v'))
        .arg(
            Arg::new("format")
                .long("format")
                .value_name("FORMAT")
                .value_parser(["human", "json", "sarif", "junit", "github"])
                .help(
                    "How results are printed: for people, as JSON lines, or the findings for machines that show them",
                ),
        )
}

/// Flags of everything that takes several inputs and makes a file of each.
pub fn with_batches(command: Command) -> Command {
    command
        .arg(path("directory", "DIR", "Writes DIR/NAME.glb for each input").short('d').conflicts_with("output"))
        .arg(switch("keep-going", "Goes on with the other inputs where one fails"))
}

/// Flags of everything that bakes.
pub fn with_baking(command: Command) -> Command {
    with_batches(command)
        .arg(path("picture", "FILE.png", "Draws what was baked"))
        .arg(path("cache", "DIR", "Keeps layers by content: an unchanged room is not baked again"))
        .arg(switch("explain-roles", "Prints each part with its role and the evidence; without an output, stops there"))
}

/// `--surface FILE.glb`, where a room knows a surface.
pub fn with_surface(command: Command, bakers: &[&dyn Baker]) -> Command {
    if bakers.iter().all(|baker| baker.hull().is_none()) {
        return command;
    }
    let help = "Writes the closed surface around the foliage (crown hull, collision, impostor); needs no other output";
    command.arg(path("surface", "FILE.glb", help))
}

/// `--only ROOM`.
pub fn only(bakers: &[&dyn Baker]) -> Arg {
    let of_trees = bakers.iter().filter(|baker| !baker.needs().nothing()).map(|baker| baker.room());
    let rooms: Vec<&'static str> = of_trees.chain([names::ROOM_BRANCHES]).collect();
    Arg::new("only")
        .long("only")
        .value_name("ROOM")
        .action(ArgAction::Append)
        .value_parser(move |text: &str| match (rooms.contains(&text), LATER_ROOMS.contains(&text)) {
            (true, _) => Ok(text.to_owned()),
            (_, true) => Err(format!("{text}: not in this version")),
            _ => Err(format!("{text}: no such room; there are {}", rooms.join(", "))),
        })
        .help("Bakes this room only, whatever the scene requires; repeatable")
}
