//! Chores of the workspace: see `cargo xtask --help`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "xtask talks to a person; nothing reads it")]

mod bench;
mod cli;
mod faults;
mod fixtures;
mod gallery;
mod generated;
mod obj_text;
mod repo;
mod run_tests;
mod second_reading;
mod shared_trees;
mod tidy;
mod validator;

fn main() -> std::process::ExitCode {
    cli::main()
}
