//! The one place that prints: results on standard output, everything else on standard error. A
//! closed pipe ends the printing, not the work.

use crate::Failure;
use foliar_schema::{Finding, Severity};
use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// How much a program says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// Errors only.
    Quiet,
    /// Findings as well.
    #[default]
    Normal,
    /// Each step and its time as well.
    Verbose,
}

/// Standard output and standard error.
#[derive(Debug, Default)]
pub struct Console {
    verbosity: Verbosity,
    /// Standard output is taken by the asset itself (`-o -`).
    data_only: bool,
    closed: AtomicBool,
}

impl Console {
    /// A console that says so much; with `data_only`, standard output carries nothing but the asset.
    pub fn new(verbosity: Verbosity, data_only: bool) -> Self {
        Console { verbosity, data_only, closed: AtomicBool::new(false) }
    }

    /// Whether progress may be drawn: on a terminal, unless quiet.
    pub fn draws_progress(&self) -> bool {
        self.verbosity >= Verbosity::Normal && std::io::stderr().is_terminal()
    }

    /// One result, on standard output.
    ///
    /// # Errors
    /// [`Failure::Output`] where standard output cannot be written (a closed pipe is none).
    pub fn result(&self, text: &str) -> Result<(), Failure> {
        if self.data_only {
            return Ok(());
        }
        self.data(format!("{text}\n").as_bytes())
    }

    /// What became of the work, for people: on standard output, unless quiet.
    ///
    /// # Errors
    /// As [`Console::result`].
    pub fn outcome(&self, text: &str) -> Result<(), Failure> {
        if self.verbosity == Verbosity::Quiet { Ok(()) } else { self.result(text) }
    }

    /// Lines for people, as [`Console::outcome`].
    ///
    /// # Errors
    /// As [`Console::result`].
    pub fn outcome_lines(&self, lines: &[String]) -> Result<(), Failure> {
        if lines.is_empty() { Ok(()) } else { self.outcome(&lines.join("\n")) }
    }

    /// Raw bytes on standard output.
    ///
    /// # Errors
    /// As [`Console::result`].
    pub fn data(&self, bytes: &[u8]) -> Result<(), Failure> {
        if self.closed.load(Ordering::Relaxed) {
            return Ok(());
        }
        let mut out = std::io::stdout().lock();
        match out.write_all(bytes).and_then(|()| out.flush()) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed.store(true, Ordering::Relaxed);
                Ok(())
            }
            Err(error) => Err(Failure::Output(format!("standard output cannot be written: {error}"))),
            Ok(()) => Ok(()),
        }
    }

    /// What a program does and how long it took, with `-v`.
    pub fn log(&self, text: &str) {
        if self.verbosity >= Verbosity::Verbose {
            log_line(text);
        }
    }

    /// What a person may want to know beside the results.
    pub fn note(&self, text: &str) {
        if self.verbosity >= Verbosity::Normal {
            log_line(text);
        }
    }

    /// A finding.
    pub fn finding(&self, finding: &Finding) {
        if self.verbosity >= Verbosity::Normal {
            log_line(&finding_text(finding));
        }
    }

    /// Why the program, or one asset, fails.
    pub fn error(&self, failure: &Failure) {
        match failure {
            // Writing to a closed pipe changes nothing any more.
            Failure::Clap(error) => _ = error.print(),
            other => log_line(&format!("{}: {other}", painted("error", RED))),
        }
    }
}

/// `warning[ROLE-UNSURE] tree.obj, /meshes/0: message`, plain.
pub fn finding_line(finding: &Finding) -> String {
    finding_with(finding, |text, _| text.into())
}

/// The same as people see it on a terminal.
fn finding_text(finding: &Finding) -> String {
    finding_with(finding, painted)
}

fn finding_with(finding: &Finding, paint: impl Fn(&str, u8) -> String) -> String {
    let (word, color) = match finding.severity {
        Severity::Note => ("note", CYAN),
        Severity::Warning => ("warning", YELLOW),
        Severity::Error => ("error", RED),
    };
    let place: Vec<&str> = [&finding.file, &finding.place].into_iter().flatten().map(String::as_str).collect();
    let place = if place.is_empty() { String::new() } else { format!(" {}", place.join(", ")) };
    format!("{}{place}: {}", paint(&format!("{word}[{}]", finding.code), color), finding.message)
}

const RED: u8 = 31;
const YELLOW: u8 = 33;
const CYAN: u8 = 36;

/// Colored on a terminal, unless NO_COLOR says otherwise.
fn painted(text: &str, color: u8) -> String {
    let plain = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty()) || !std::io::stderr().is_terminal();
    if plain { text.into() } else { format!("\u{1b}[{color}m{text}\u{1b}[0m") }
}

/// One line on standard error. Where nobody can hear it, nobody needs to.
fn log_line(text: &str) {
    _ = writeln!(std::io::stderr().lock(), "{text}");
}
