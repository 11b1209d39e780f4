//! What was typed, taken out of clap's hands once.

use crate::Failure;
use crate::console::{Console, Verbosity};
use crate::outputs::Job;
use clap::ArgMatches;
use foliar_schema::Severity;
use std::path::{Path, PathBuf};

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// For people.
    #[default]
    Human,
    /// JSON.
    Json,
    /// Findings as SARIF 2.1.0.
    Sarif,
    /// Findings as JUnit XML.
    Junit,
    /// Findings as commands of GitHub's workflow log.
    Github,
}

/// What a run does about its output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Writes it.
    #[default]
    Write,
    /// Says whether it would change.
    Check,
    /// Prints the plan.
    DryRun,
}

/// The flags that are no parameters.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Input files; `-` is standard input.
    pub inputs: Vec<PathBuf>,
    /// `-o`.
    pub output: Option<PathBuf>,
    /// `-d`.
    pub directory: Option<PathBuf>,
    /// `--keep-going`.
    pub keep_going: bool,
    /// `--picture`.
    pub picture: Option<PathBuf>,
    /// `--surface`.
    pub surface: Option<PathBuf>,
    /// `--dry-run`, `--check`, or neither.
    pub mode: Mode,
    /// `--report`.
    pub report: Option<PathBuf>,
    /// `--depfile`.
    pub depfile: Option<PathBuf>,
    /// `--outputs`.
    pub outputs: Option<PathBuf>,
    /// `--fail-on`.
    pub fail_on: Option<Severity>,
    /// Whether findings decide when all inputs have been looked at, not one by one.
    pub judges_at_the_end: bool,
    /// `--threads`.
    pub threads: Option<usize>,
    /// `--cache`.
    pub cache: Option<PathBuf>,
    /// `--only`.
    pub only: Vec<String>,
    /// `--explain-roles`.
    pub explain_roles: bool,
    /// `--config`.
    pub config: Option<PathBuf>,
    /// `--no-config`.
    pub no_config: bool,
    /// `--format`.
    pub format: Format,
    /// `--quiet`, `-v`, or neither.
    pub verbosity: Verbosity,
}

impl Options {
    /// Reads what a command has of them; what it has not was not given.
    pub fn from(matches: &ArgMatches) -> Self {
        let path = |id| matches.try_get_one::<PathBuf>(id).ok().flatten().cloned();
        let word = |id| matches.try_get_one::<String>(id).ok().flatten().map(String::as_str);
        let is = |id| matches.try_get_one::<bool>(id).ok().flatten().copied().unwrap_or(false);
        Options {
            inputs: matches.try_get_many("inputs").ok().flatten().into_iter().flatten().cloned().collect(),
            output: path("output"),
            directory: path("directory"),
            keep_going: is("keep-going"),
            picture: path("picture"),
            surface: path("surface"),
            mode: match (is("check"), is("dry-run")) {
                (true, _) => Mode::Check,
                (_, true) => Mode::DryRun,
                _ => Mode::Write,
            },
            report: path("report"),
            depfile: path("depfile"),
            outputs: path("outputs"),
            fail_on: word("fail-on").map(severity),
            judges_at_the_end: false,
            threads: matches.try_get_one::<u16>("threads").ok().flatten().map(|&n| n.into()),
            cache: path("cache"),
            only: matches.try_get_many("only").ok().flatten().into_iter().flatten().cloned().collect(),
            explain_roles: is("explain-roles"),
            config: path("config"),
            no_config: is("no-config"),
            format: match word("format") {
                Some("json") => Format::Json,
                Some("sarif") => Format::Sarif,
                Some("junit") => Format::Junit,
                Some("github") => Format::Github,
                _ => Format::Human,
            },
            verbosity: match (is("quiet"), is("verbose")) {
                (true, _) => Verbosity::Quiet,
                (_, true) => Verbosity::Verbose,
                _ => Verbosity::Normal,
            },
        }
    }

    /// Refuses flags that contradict each other by their values.
    ///
    /// # Errors
    /// [`Failure::Usage`] for `-` named twice, for `-o -` with `--check`, and for a rule about no file.
    pub fn refuse_contradictions(&self, jobs: &[Job]) -> Result<(), Failure> {
        if self.inputs.iter().filter(|input| is_dash(input)).count() > 1 {
            return Err(Failure::usage("- stands twice, and standard input can be read once: name the other file"));
        }
        if self.mode == Mode::Check && self.output.as_deref().is_some_and(is_dash) {
            let text = "--check with -o -: standard output holds nothing to compare with: name the file with -o FILE";
            return Err(Failure::usage(text));
        }
        let has_target = |job: &Job| job.output.as_deref().is_some_and(|output| !is_dash(output));
        if self.depfile.is_some() && self.report.is_none() && !jobs.iter().all(has_target) {
            let text =
                "--depfile without a file that is made: name one with -o, or the report of it with --report FILE";
            return Err(Failure::usage(text));
        }
        Ok(())
    }

    /// Starts as many threads as were asked for.
    ///
    /// # Errors
    /// [`Failure::Fault`] where threads run already.
    pub fn start_threads(&self) -> Result<(), Failure> {
        let Some(threads) = self.threads else { return Ok(()) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
        pool.map_err(|e| Failure::Fault(format!("--threads {threads}: {e}")))
    }

    /// The console that these options ask for.
    pub fn console(&self) -> Console {
        Console::new(self.verbosity, self.output.as_deref().is_some_and(is_dash))
    }
}

fn severity(word: &str) -> Severity {
    match word {
        "note" => Severity::Note,
        "warning" => Severity::Warning,
        _ => Severity::Error,
    }
}

/// Whether a path means standard input or output.
pub fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}
