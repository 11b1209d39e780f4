//! What xtask is asked.

use crate::{faults, fixtures, fuzz, generated, loaders, mutate, new_baker, run_tests, tidy, validator, with_foliar};
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Chores of the workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Args {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Debug, Subcommand)]
enum Chore {
    /// House rules as code: floors, lengths, first lines, names, references, planted faults that still apply
    Tidy,
    /// Writes the generated documents (channel and issue tables, schemas, man pages, completions, README help)
    Gen {
        /// Only says what would change, with status 1
        #[arg(long)]
        check: bool,
    },
    /// Writes fixtures/ from plant::sample
    Fixtures {
        /// Only says whether the committed files are what the generator gives, with status 1
        #[arg(long, conflicts_with = "large")]
        check: bool,
        /// Writes an OBJ of 60 MB or more to target/large/ instead, for the reading benchmark
        #[arg(long)]
        large: bool,
    },
    /// Measures every figure of xtask/gates.toml, in release
    Bench {
        /// Only those whose name contains this
        name: Option<String>,
    },
    /// Prints how much of known branch hierarchies is found, the paper's own words beside the robust method
    Accuracy {
        /// Only trees whose name contains this
        name: Option<String>,
    },
    /// Bakes every shared tree: plain, baked, difference on one page in target/gallery
    Gallery {
        /// Only trees whose name contains this
        name: Option<String>,
    },
    /// Runs the Khronos validator over every output of the tests
    Validator,
    /// Compares a room's modes with traced light, on four trees, and writes docs/tradeoff
    Tradeoff {
        /// The room
        name: String,
    },
    /// Reads every output of the tests by a reader that shares no code with the writer
    SecondReader,
    /// Loads every packed output of the tests with three and Blender
    Loaders,
    /// Mutates the shared trees and demands that every program ends by itself, in time and in bounds
    Mutate {
        /// How many cases
        #[arg(default_value_t = 2000)]
        cases: u64,
    },
    /// Runs the fuzz targets of tests/fuzz, where they can be built
    Fuzz {
        /// Seconds for each
        #[arg(default_value_t = 120)]
        seconds: u64,
        /// Only those whose name contains this
        name: Option<String>,
    },
    /// Writes a new room: its crate, its part of the contract, its program, and the lines that join them
    NewBaker {
        /// Name of room, section, layer and program: lowercase letters and digits
        #[arg(required_unless_present = "trial")]
        name: Option<String>,
        /// Does it in a scratch copy instead, and demands that what it wrote keeps the laws and is baked
        #[arg(long, conflicts_with = "name")]
        trial: bool,
    },
    /// Plants small faults in a scratch copy and demands that the tests they name go red
    Faults {
        /// Only those whose name contains one of these
        names: Vec<String>,
    },
    /// Everything that must pass before work is handed in
    Test,
}

/// Runs the chore that the command line names.
pub fn main() -> ExitCode {
    let done = match Args::parse().chore {
        Chore::Tidy => tidy::run(),
        Chore::Gen { check } => generated::run(check),
        Chore::Fixtures { check: true, .. } => fixtures::check(),
        Chore::Fixtures { large: true, .. } => fixtures::write_large().map(|path| println!("{}", path.display())),
        Chore::Fixtures { .. } => fixtures::write(),
        Chore::Bench { name } => with_foliar::run("bench", name.as_deref()),
        Chore::Accuracy { name } => with_foliar::run("accuracy", name.as_deref()),
        Chore::Gallery { name } => with_foliar::run("gallery", name.as_deref()),
        Chore::Validator => validator::run(),
        Chore::Tradeoff { name } => with_foliar::run("tradeoff", Some(&name)),
        Chore::SecondReader => with_foliar::run("second-reader", None),
        Chore::Loaders => loaders::run(),
        Chore::Fuzz { seconds, name } => fuzz::run(seconds, name.as_deref()),
        Chore::Mutate { cases } => mutate::run(cases),
        Chore::NewBaker { name: Some(name), .. } => new_baker::run(&name),
        Chore::NewBaker { name: None, .. } => new_baker::trial(),
        Chore::Faults { names } => faults::run(&names),
        Chore::Test => run_tests::run(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
