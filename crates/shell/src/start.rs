//! From the process to a command and back to an exit status.

use crate::Failure;
use crate::commands::{Call, Program, commands, run};
use crate::config::{Fields, from_environment};
use crate::console::Console;
use foliar_bake::Baker;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::Mutex;

/// The program `foliar`.
pub fn foliar(bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Foliar, bakers)
}

/// The program `foliar-import`.
pub fn foliar_import(bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Import, bakers)
}

/// The program `foliar-ROOM`.
pub fn foliar_room(room: &str, bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Room(room.into()), bakers)
}

/// The program `foliar-NAME` of a baker that needs nothing.
pub fn foliar_library(room: &str, bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Library(room.into()), bakers)
}

/// The program `foliar-view`.
pub fn foliar_view(bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::View, bakers)
}

/// The program `foliar-pack`.
pub fn foliar_pack(bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Pack, bakers)
}

/// The program `foliar-check`.
pub fn foliar_check(bakers: &[&dyn Baker]) -> ExitCode {
    start(&Program::Check, bakers)
}

fn start(program: &Program, bakers: &[&dyn Baker]) -> ExitCode {
    let result = guard(|| work(program, bakers));
    let Err(failure) = result else { return ExitCode::SUCCESS };
    Console::default().error(&failure);
    ExitCode::from(failure.status())
}

fn work(program: &Program, bakers: &[&dyn Baker]) -> Result<(), Failure> {
    let fields = Fields::new(bakers).map_err(Failure::Fault)?;
    let matches = commands(program, bakers, &fields).try_get_matches()?;
    let variables =
        std::env::vars_os().map(|(k, v)| (k.to_string_lossy().into_owned(), v.to_string_lossy().into_owned()));
    let environment = from_environment(&fields, variables)?;
    run(program, &Call { bakers, fields: &fields, environment: &environment, matches: &matches })
}

/// Where a panic was, and what it said: the hook hears it on whichever thread it happens.
static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Turns a panic into a failure that asks for a report.
fn guard(work: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    std::panic::set_hook(Box::new(|info| {
        if let Ok(mut panic) = PANIC.lock() {
            panic.get_or_insert(info.to_string());
        }
    }));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let said = PANIC.lock().ok().and_then(|mut panic| panic.take()).unwrap_or_default();
        Err(Failure::Fault(format!(
            "a fault of foliar, not of your files: {}; outputs are as they were. Please report it with this text and the command line",
            said.replace('\n', " ")
        )))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_fault_of_ours() {
        let failure = guard(|| {
            rayon::join(|| (), || panic!("a leaf too many"));
            Ok(())
        });
        let failure = failure.unwrap_err();
        assert_eq!(failure.status(), 70);
        assert!(failure.to_string().contains("a leaf too many"), "{failure}");
        assert!(failure.to_string().contains("report"), "{failure}");
    }
}
