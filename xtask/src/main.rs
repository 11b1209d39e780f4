//! Chores of the workspace: see `cargo xtask --help`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "xtask talks to a person; nothing reads it")]

#[cfg(feature = "foliar")]
mod accuracy;
#[cfg(feature = "foliar")]
mod bench;
mod cli;
#[cfg(feature = "foliar")]
#[path = "../../tests/expected_parts.rs"]
mod expected_parts;
mod faults;
mod fixtures;
mod fuzz;
#[cfg(feature = "foliar")]
mod gallery;
mod generated;
mod loaders;
mod mutate;
mod new_baker;
mod obj_text;
mod packages;
mod repo;
mod run_tests;
mod scratch;
#[cfg(feature = "foliar")]
mod second_reading;
#[cfg(feature = "foliar")]
mod shared_trees;
mod tidy;
#[cfg(feature = "foliar")]
mod tradeoff;
mod validator;
mod with_foliar;

fn main() -> std::process::ExitCode {
    cli::main()
}
