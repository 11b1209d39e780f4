//! The command lines of all programs.

use crate::config::Fields;
use crate::flags::{self, Direct, Leaves};
use clap::{Arg, Command, value_parser};
use foliar_bake::Baker;
use foliar_schema::names;

/// A program of this house.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Program {
    /// `foliar`: all commands.
    Foliar,
    /// `foliar-import`: import and structure.
    Import,
    /// `foliar-ROOM`: one room.
    Room(String),
    /// `foliar-NAME` of a baker that needs nothing: a file for a library.
    Library(String),
    /// `foliar-view`: pictures.
    View,
    /// `foliar-pack`: files that ship.
    Pack,
    /// `foliar-check`: rules over files.
    Check,
}

impl Program {
    /// Every program that these bakers make.
    pub fn all(bakers: &[&dyn Baker]) -> Vec<Program> {
        let program = |room: String, alone| if alone { Program::Library(room) } else { Program::Room(room) };
        let rooms = bakers.iter().map(|baker| program(baker.room().into(), baker.needs().nothing()));
        [Program::Foliar, Program::Import]
            .into_iter()
            .chain(rooms)
            .chain([Program::View, Program::Pack, Program::Check])
            .collect()
    }

    /// Name of the binary.
    pub fn name(&self) -> String {
        match self {
            Program::Foliar => "foliar".into(),
            Program::Import => "foliar-import".into(),
            Program::Room(room) | Program::Library(room) => format!("foliar-{room}"),
            Program::View => "foliar-view".into(),
            Program::Pack => "foliar-pack".into(),
            Program::Check => "foliar-check".into(),
        }
    }
}

/// The command line of a program: flags, help, man pages and completions all come from it.
pub fn commands(program: &Program, bakers: &[&dyn Baker], fields: &Fields) -> Command {
    let command = Command::new(program.name()).version(env!("CARGO_PKG_VERSION"));
    let about = |room: &str| bakers.iter().find(|baker| baker.room() == room).map_or("", |baker| baker.about());
    match program {
        Program::Foliar => foliar(command, bakers, fields),
        Program::Import => {
            let about = "Reads an OBJ, glTF or GLB, finds wood and leaves, and writes both into a glTF";
            baking(command.about(about), fields, Direct::Sections(&["structure"]))
        }
        Program::Room(room) => {
            let own: Vec<&dyn Baker> = bakers.iter().copied().filter(|baker| baker.room() == room).collect();
            let command = command.about(format!("Bakes one room: {}", about(room)));
            let command =
                flags::with_surface(baking(command, fields, Direct::Sections(&room_sections(bakers, room))), &own);
            if own.iter().any(|baker| lives_on_maps(*baker)) { on_maps(command) } else { command }
        }
        Program::Library(room) if bakers.iter().any(|b| b.room() == *room && b.needs().scan) => {
            scan(command.about(format!("Bakes {}", about(room))), fields, room)
        }
        Program::Library(room) => library(command.about(format!("Bakes {}", about(room))), fields, room),
        Program::View => view(command, fields),
        Program::Pack => pack(command, fields),
        Program::Check => check(command, fields),
    }
}

/// Sections whose parameters are direct flags of a room's program: its own, and that of the branches it needs.
pub fn room_sections<'a>(bakers: &[&dyn Baker], room: &'a str) -> Vec<&'a str> {
    let needs = bakers.iter().any(|baker| baker.room() == room && baker.needs().branches);
    [room].into_iter().chain(needs.then_some(names::ROOM_BRANCHES)).collect()
}

/// Whether a room needs maps and no tree: its program bakes them alone as well.
pub fn lives_on_maps(baker: &dyn Baker) -> bool {
    !baker.needs().maps.is_empty() && !baker.needs().plant
}

/// A program whose tree may be missing.
fn on_maps(command: Command) -> Command {
    command
        .mut_arg("inputs", |arg| {
            let help = "OBJ, glTF or GLB files that the maps go onto; - is standard input; none: the maps are baked alone";
            arg.num_args(0..).required(false).help(help)
        })
        .mut_arg("output", |arg| {
            let help = "Output: .glb, .gltf, .layer or - with a tree; without one .exr (with a PNG and a JSON beside it), .png, \
                        .layer or -";
            arg.help(help)
        })
}

fn foliar(command: Command, bakers: &[&dyn Baker], fields: &Fields) -> Command {
    command
        .about("Bakes what real-time foliage needs into glTF trees")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(bake(bakers, fields))
        .subcommand(rebake(fields))
        .subcommand(assemble(fields))
        .subcommand(strip(fields))
        .subcommand(config(fields))
        .subcommand(inspect(fields))
        .subcommand(diff(fields))
        .subcommand(explain(fields))
        .subcommand(generate())
}

/// A command that bakes: inputs, outputs, direct parameters.
fn baking(command: Command, fields: &Fields, direct: Direct) -> Command {
    let command = command
        .arg(flags::inputs("INPUT", "OBJ, glTF or GLB files; - is standard input").required(true))
        .arg(flags::output("Output: .glb, .gltf, .layer (one room alone), or - for standard output"));
    common(flags::with_baking(command), fields, direct, Leaves::Files)
}

/// What every command has: parameters, and the flags of the house.
fn common(command: Command, fields: &Fields, direct: Direct, leaves: Leaves) -> Command {
    flags::with_conventions(flags::with_fields(command, fields, direct), leaves)
}

fn bake(bakers: &[&dyn Baker], fields: &Fields) -> Command {
    let about = "Bakes trees all the way: import, structure, every room that the scene needs, one glTF";
    let command = baking(Command::new("bake").about(about), fields, Direct::Assets).arg(flags::only(bakers));
    flags::with_surface(command, bakers)
}

fn rebake(fields: &Fields) -> Command {
    let about = "Repeats a bake from the records inside the files, in place, starting from what was given";
    baking(Command::new("rebake").about(about), fields, Direct::Assets)
}

fn assemble(fields: &Fields) -> Command {
    let command = Command::new("assemble")
        .about("Puts layer files onto a plant; a layer of the same room is replaced")
        .arg(flags::inputs("PLANT LAYER", "The plant (OBJ, glTF or GLB), then its layers").num_args(2..).required(true))
        .arg(flags::output("Output: .glb, .gltf, or - for standard output").required(true));
    common(command, fields, Direct::Import, Leaves::Files)
}

fn strip(fields: &Fields) -> Command {
    let command = Command::new("strip")
        .about("Takes every layer out of a file again: what comes back is the base")
        .arg(flags::inputs("FILE", "A baked .glb or .gltf; - is standard input").num_args(1).required(true))
        .arg(flags::output("Output: .glb, .gltf, or - for standard output").required(true));
    common(command, fields, Direct::Import, Leaves::Files)
}

fn config(fields: &Fields) -> Command {
    let command = Command::new("config").about("Prints every parameter with its value and where that came from").arg(
        flags::inputs("INPUT", "The asset that it is about: its own file and what the scene implies count").num_args(1),
    );
    common(command, fields, Direct::Assets, Leaves::Answer)
}

fn inspect(fields: &Fields) -> Command {
    let command = Command::new("inspect")
        .about("Prints what a file holds: parts, roles, leaves, channels, records")
        .arg(flags::inputs("FILE", "OBJ, glTF, GLB or layer files").required(true));
    common(command, fields, Direct::Assets, Leaves::Answer)
}

fn generate() -> Command {
    let kinds = ["man", "completions", "help", "schema"];
    Command::new("generate")
        .about("Writes man pages, shell completions, help texts or JSON schemas into a folder")
        .hide(true)
        .arg(Arg::new("kind").value_name("KIND").value_parser(kinds).required(true).help("What to write"))
        .arg(flags::inputs("DIR", "Folder to write into").num_args(1).required(true))
}

/// A command without input.
fn library(command: Command, fields: &Fields, room: &str) -> Command {
    let command = command
        .arg(
            flags::output("Output: .png (16 bits), .exr (every bit), .layer, or - for a PNG on standard output")
                .required(true),
        )
        .arg(flags::switch("measure", "Prints what was measured on it"));
    common(command, fields, Direct::Alone(room), Leaves::Files)
}

/// A command whose input is a mesh that is no tree.
fn scan(command: Command, fields: &Fields, room: &str) -> Command {
    let command = command
        .arg(
            flags::inputs(
                "MESH",
                "OBJ, glTF or GLB file of one closed leaf; - is standard input; none: two height maps",
            )
            .num_args(0..=1),
        )
        .arg(
            flags::output("Output: .exr (every bit), .png (16 bits) of thickness, the other maps beside it; or .layer")
                .required(true),
        );
    common(command, fields, Direct::Scan(room), Leaves::Files)
}

fn view(command: Command, fields: &Fields) -> Command {
    let command = command
        .about("Draws a tree as it is lit, or a channel in false colors")
        .arg(flags::inputs("FILE", "OBJ, glTF or GLB file, or a .layer of light through a leaf; - is standard input").num_args(1).required(true))
        .arg(flags::output("Output: .png, or - for standard output").required(true))
        .arg(flags::switch("sheet", "Draws a contact sheet: plain, baked, difference, ambient coefficient; with --look light two suns by model and by paths"))
        .arg(
            flags::switch("channels", "Draws a contact sheet of everything that the file holds, each with its legend")
                .conflicts_with("sheet"),
        )
        .arg(
            flags::path("against", "FILE", "Draws FILE beside it, and what differs")
                .conflicts_with_all(["sheet", "channels"]),
        )
        .arg(
            Arg::new("light-through")
                .long("light-through")
                .value_name("MATERIAL")
                .num_args(0..=1)
                .require_equals(true)
                .default_missing_value("")
                .conflicts_with_all(["sheet", "channels", "turntable"])
                .help("Draws a leaf material by itself, both sides lit from behind, with its coefficient maps; with --against beside another bake of it"),
        )
        .arg(
            Arg::new("turntable")
                .long("turntable")
                .value_name("FRAMES")
                .value_parser(value_parser!(u32).range(2..=720))
                .conflicts_with_all(["sheet", "channels", "against"])
                .help("Draws an animated PNG: the plant turns once in so many pictures, 24 a second"),
        )
        .arg(
            Arg::new("sway")
                .long("sway")
                .value_name("FRAMES")
                .value_parser(value_parser!(u32).range(1..=720))
                .conflicts_with_all(["against", "channels", "turntable", "light-through"])
                .help("Draws an animated PNG: the plant in a storm, 24 pictures a second; with --sheet levels, weights, phases and six times"),
        );
    common(command, fields, Direct::Sections(&["view"]), Leaves::Files)
}

fn pack(command: Command, fields: &Fields) -> Command {
    let command = command
        .about("Packs a master for an engine: what that needs, and nothing else")
        .arg(flags::inputs("FILE", "Baked .glb or .gltf files; - is standard input").required(true))
        .arg(flags::output("Output: .glb, .gltf, or - for standard output; not the master itself"));
    common(flags::with_batches(command), fields, Direct::Pack, Leaves::Files)
}

fn check(command: Command, fields: &Fields) -> Command {
    let command = command
        .about("Checks foliage files, ours or not: what is broken, what costs, what a tool lost; status 1 at errors")
        .arg(
            flags::inputs("FILE", "OBJ, glTF or GLB files; - is standard input")
                .num_args(0..)
                .required_unless_present("after"),
        )
        .arg(
            flags::path("after", "OPTIMIZED.glb", "Checks what another tool made of --master, and says what it lost")
                .requires("master"),
        )
        .arg(flags::path("master", "MASTER.glb", "The file that the checked ones were made from"))
        .arg(flags::path("baseline", "FILE.json", "Leaves out the findings that this file lists"))
        .arg(
            flags::path("write-baseline", "FILE.json", "Writes everything that was found as a baseline; status 0")
                .conflicts_with("baseline"),
        );
    common(command, fields, Direct::Sections(&["check"]), Leaves::Answer)
}

fn diff(fields: &Fields) -> Command {
    let command = Command::new("diff")
        .about("Says how two bakes differ, channel by channel; status 1 beyond the tolerance")
        .arg(
            flags::inputs("A", "Two baked files: GLB, glTF or layers")
                .value_names(["A", "B"])
                .num_args(2)
                .required(true),
        )
        .arg(
            Arg::new("tolerance")
                .long("tolerance")
                .value_name("STEPS")
                .value_parser(clap::value_parser!(f64))
                .help("Visible steps that a value may differ by [default: 1]"),
        );
    common(command, fields, Direct::Import, Leaves::Answer)
}

fn explain(fields: &Fields) -> Command {
    let command = Command::new("explain")
        .about("Says what a finding's code means, and how serious it is here; without a code, lists all")
        .arg(Arg::new("code").value_name("CODE").help("A code, as findings show it in brackets"));
    common(command, fields, Direct::Alone("check"), Leaves::Answer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_line_is_consistent() {
        let fields = Fields::new(&[]).unwrap();
        for program in Program::all(&[]) {
            // clap checks for flags that clash, here rather than in front of a user.
            commands(&program, &[], &fields).debug_assert();
        }
    }

    #[test]
    fn every_direct_parameter_has_a_flag_with_help_and_no_default() {
        let fields = Fields::new(&[]).unwrap();
        let command = commands(&Program::View, &[], &fields);
        for field in Direct::Sections(&["view"]).fields(&fields) {
            let arg = command.get_arguments().find(|arg| arg.get_id().as_str() == field.dotted());
            let arg = arg.unwrap_or_else(|| panic!("{} has no flag", field.dotted()));
            assert!(arg.get_help().is_some(), "{}", field.dotted());
            assert!(arg.get_default_values().is_empty(), "{}: what is present was given", field.dotted());
        }
    }
}
