//! The road that every command takes: flags that contradict each other are refused, inputs are worked on
//! one by one, findings judged, files put in place all or nothing, results told, lists written for build
//! systems (house rules, section 6).

use crate::console::Console;
use crate::options::{Mode, Options, is_dash};
use crate::outputs::{self, Job};
use crate::report::{Report, Told};
use crate::said::{AssetReport, Reports};
use crate::{Failure, finding_formats, telling};
use foliar_carrier::{Outcome, OutputFile};
use foliar_schema::Severity;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::json;
use std::path::PathBuf;

/// What a command made of one input.
pub enum Product {
    /// Files to put in place, the commit last.
    Files(Vec<OutputFile>),
    /// The plan, or the roles: nothing is to be written.
    Planned,
    /// An answer on standard output.
    Answer,
}

/// What became of an input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// New bytes are in place.
    Written,
    /// The same bytes were there already.
    Unchanged,
    /// `--check`: the bytes would change.
    Outdated,
    /// Only the plan or the roles were printed.
    Planned,
    /// What was asked was answered.
    Answered,
    /// It failed, or has not come to its end yet.
    #[default]
    Failed,
}

impl Status {
    /// The word in what people read.
    pub fn word(self) -> &'static str {
        match self {
            Status::Written => "written",
            Status::Unchanged => "unchanged",
            Status::Outdated => "outdated",
            Status::Planned => "planned",
            Status::Answered => "answered",
            Status::Failed => "failed",
        }
    }
}

/// What a command does with one input; everything before and after it is the runner's.
pub type Work<'a> = &'a mut dyn FnMut(&Job, &mut Report) -> Result<Product, Failure>;

/// Works on every input.
///
/// # Errors
/// The input's own failure where there is one, [`Failure::Batch`] where there are several.
pub fn run(options: &Options, console: &Console, jobs: &[Job], work: Work) -> Result<(), Failure> {
    outputs::refuse_duplicates(options, jobs)?;
    options.refuse_contradictions(jobs)?;
    options.start_threads()?;
    let several = jobs.len() > 1;
    let mut done = Done::default();
    let mut last = None;
    for job in jobs {
        let told = one(options, console, job, work, &mut done);
        if several {
            telling::tell(options, console, &told, several, &[])?;
            done.failures.last().filter(|_| told.failed()).into_iter().for_each(|failure| console.error(failure));
        }
        let stop = told.failed() && !options.keep_going;
        done.reports.push(told.report.clone());
        last = Some(told);
        if stop {
            break;
        }
    }
    let failure = options.fail_on.unwrap_or(Severity::Error);
    if let Some(text) = finding_formats::text(options.format, &done.reports, failure) {
        console.result(&text)?;
    }
    let (lists, written) = write_lists(options, &done);
    match last {
        Some(told) if !several => telling::tell(options, console, &told, several, &lists)?,
        _ => lists.iter().for_each(|list| console.note(&format!("{}: written", list.display()))),
    }
    written?;
    verdict(jobs.len(), done)
}

/// What became of a run.
#[derive(Default)]
struct Done {
    reports: Vec<AssetReport>,
    read: Vec<(PathBuf, Vec<PathBuf>)>,
    written: Vec<PathBuf>,
    failures: Vec<Failure>,
    outdated: Vec<String>,
}

/// Works on one input.
fn one(options: &Options, console: &Console, job: &Job, work: Work, done: &mut Done) -> Told {
    let mut report = Report::new(&job.input);
    report.told.output = job.output.as_ref().map(|path| path.display().to_string());
    let result = work(job, &mut report).and_then(|product| settle(options, console, product, &mut report));
    let result = result.map_err(|e| e.in_file(&job.input.display().to_string()));
    report.told.status = result.as_ref().map_or(Status::Failed, |status| *status);
    if let Some(target) = rule_target(options, job) {
        done.read.push((target, std::mem::take(&mut report.read)));
    }
    match result {
        Ok(status) => {
            report.told.outputs = Some(report.written.iter().map(|path| path.display().to_string()).collect());
            done.written.append(&mut report.written);
            if let (Status::Outdated, Some(output)) = (status, job.output.as_ref().or(options.surface.as_ref())) {
                done.outdated.push(output.display().to_string());
            }
        }
        Err(failure) => {
            report.told.exit = Some(failure.status());
            report.told.error = Some(failure.to_string());
            done.failures.push(failure);
        }
    }
    report.finish()
}

/// What a rule for make is about: the output, else the surface, or the report where there is no other.
fn rule_target(options: &Options, job: &Job) -> Option<PathBuf> {
    let output = job.output.as_ref().filter(|output| !is_dash(output));
    output.or(options.surface.as_ref()).or(options.report.as_ref()).cloned()
}

/// Prints and judges the findings, then puts the product in place.
fn settle(options: &Options, console: &Console, product: Product, report: &mut Report) -> Result<Status, Failure> {
    fail_on(options, console, report)?;
    let files = match product {
        Product::Planned => return Ok(Status::Planned),
        Product::Answer => return Ok(Status::Answered),
        Product::Files(files) => files,
    };
    let status = commit(options, console, &files)?;
    report.written = files.into_iter().map(|file| file.path).filter(|path| !is_dash(path)).collect();
    console.log(&report.lap("write"));
    Ok(status)
}

/// Prints the findings, and refuses those that are too serious.
fn fail_on(options: &Options, console: &Console, report: &Report) -> Result<(), Failure> {
    for finding in report.findings.iter().filter(|_| !report.tells_findings) {
        console.finding(finding);
    }
    let Some(limit) = options.fail_on.filter(|_| !options.judges_at_the_end) else { return Ok(()) };
    let bad: Vec<&str> = report.findings.iter().filter(|f| f.severity >= limit).map(|f| f.code.as_str()).collect();
    match bad.as_slice() {
        [] => Ok(()),
        _ => Err(Failure::Found(format!("--fail-on: found {}; nothing was written", bad.join(", ")))),
    }
}

fn commit(options: &Options, console: &Console, files: &[OutputFile]) -> Result<Status, Failure> {
    let (data, files): (Vec<&OutputFile>, Vec<&OutputFile>) = files.iter().partition(|file| is_dash(&file.path));
    let files: Vec<OutputFile> = files.into_iter().cloned().collect();
    if options.mode == Mode::Check {
        let same = foliar_carrier::is_unchanged(&files);
        return Ok(if same { Status::Unchanged } else { Status::Outdated });
    }
    make_folders(options)?;
    let before: Vec<PathBuf> = files.iter().flat_map(|file| foliar_carrier::side_files(&file.path)).collect();
    let outcome = foliar_carrier::write_files(&files)?;
    let old: Vec<PathBuf> = before.into_iter().filter(|old| files.iter().all(|file| file.path != *old)).collect();
    foliar_carrier::remove_sides(&old);
    for file in &data {
        console.data(&file.bytes)?;
    }
    match outcome {
        Outcome::Unchanged if data.is_empty() => Ok(Status::Unchanged),
        _ => Ok(Status::Written),
    }
}

/// `-d DIR` makes its folder; `-o` expects one.
fn make_folders(options: &Options) -> Result<(), Failure> {
    let Some(directory) = &options.directory else { return Ok(()) };
    std::fs::create_dir_all(directory).map_err(|e| Failure::output(directory.display(), e))
}

/// Writes report, rules and list of outputs; those that are written, and whether all are.
fn write_lists(options: &Options, done: &Done) -> (Vec<PathBuf>, Result<(), Failure>) {
    let mut lists = Vec::new();
    if let Some(path) = &options.report {
        match outputs::value(&Reports { foliar: env!("CARGO_PKG_VERSION"), assets: &done.reports }) {
            Ok(reports) => lists.push((path, outputs::pretty(&reports))),
            Err(failure) => return (Vec::new(), Err(failure)),
        }
    }
    let complete = options.mode == Mode::Write && done.failures.is_empty();
    if let Some(path) = options.depfile.as_ref().filter(|_| complete) {
        lists.push((path, outputs::depfile(&done.read)));
    }
    if let Some(path) = options.outputs.as_ref().filter(|_| complete) {
        let names: Vec<String> = done.written.iter().map(|file| file.display().to_string()).collect();
        lists.push((path, outputs::pretty(&json!(names))));
    }
    let mut written = Vec::new();
    for (path, text) in lists {
        if let Err(failure) = outputs::write_text(path, text) {
            return (written, Err(failure));
        }
        written.push(path.clone());
    }
    (written, Ok(()))
}

fn verdict(total: usize, mut done: Done) -> Result<(), Failure> {
    let untried = total - done.reports.len();
    match done.failures.pop() {
        Some(failure) if total == 1 => Err(failure),
        Some(_) => Err(Failure::Batch {
            failed: done.failures.len() + 1,
            total,
            rest: if untried == 0 { String::new() } else { format!(", {untried} not tried (--keep-going tries all)") },
        }),
        None if !done.outdated.is_empty() => Err(Failure::Found(format!("would change: {}", done.outdated.join(", ")))),
        None => Ok(()),
    }
}
