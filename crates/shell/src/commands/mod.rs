//! The commands: what each accepts and what it does, one file per command.

mod alone;
mod assemble;
mod bake;
mod check;
mod config;
mod diff;
mod explain;
mod generate;
mod inspect;
mod library;
mod pack;
mod rebake;
mod scan;
mod strip;
mod tree;
mod view;
mod view_leaf;

pub use check::Looked;
pub use config::Valued;
pub use diff::Compared;
pub use explain::Explained;
pub use inspect::Held;
pub use tree::{Program, commands};

use crate::Failure;
use crate::config::{Fields, Settings};
use clap::ArgMatches;
use foliar_bake::Baker;

/// What every command is handed.
pub(crate) struct Call<'a> {
    /// Rooms that there are.
    pub bakers: &'a [&'a dyn Baker],
    /// All parameters.
    pub fields: &'a Fields,
    /// What the environment gives.
    pub environment: &'a Settings,
    /// What was typed.
    pub matches: &'a ArgMatches,
}

/// Runs the command that was typed.
///
/// # Errors
/// [`Failure`] with its exit status.
pub(crate) fn run(program: &Program, call: &Call) -> Result<(), Failure> {
    match program {
        Program::Import => bake::import(call),
        Program::Room(room) => bake::room(call, room),
        Program::Library(room) => library::run(call, room),
        Program::View => view::run(call),
        Program::Pack => pack::run(call),
        Program::Check => check::run(call),
        Program::Foliar => {
            let (name, matches) = call.matches.subcommand().unwrap_or(("", call.matches));
            let call = Call { matches, ..*call };
            match name {
                "bake" => bake::run(&call),
                "rebake" => rebake::run(&call),
                "assemble" => assemble::run(&call),
                "strip" => strip::run(&call),
                "config" => config::run(&call),
                "explain" => explain::run(&call),
                "diff" => diff::run(&call),
                "inspect" => inspect::run(&call),
                "generate" => generate::run(&call),
                other => Err(Failure::Fault(format!("command {other:?} is declared and not built"))),
            }
        }
    }
}
