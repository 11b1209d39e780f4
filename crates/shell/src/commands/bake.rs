//! `foliar bake`, `foliar-import` and `foliar-ROOM`: one road with different rooms on it.

use super::Call;
use crate::bake_one::{Baking, Status, bake_one};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Format, Mode, Options};
use crate::outputs::{self, Job};
use crate::report::Report;
use crate::{Failure, console::Console, finding_formats};
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// `foliar bake`.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let only = (!options.only.is_empty()).then_some(options.only.as_slice());
    bake(call, &options, Direct::Assets, only, false)
}

/// `foliar-import`: structure only.
pub fn import(call: &Call) -> Result<(), Failure> {
    bake(call, &Options::from(call.matches), Direct::Section("structure"), Some(&[]), false)
}

/// `foliar-ROOM`: one room.
pub fn room(call: &Call, room: &str) -> Result<(), Failure> {
    bake(call, &Options::from(call.matches), Direct::Section(room), Some(&[room.to_owned()]), false)
}

/// Bakes every input. `again` repeats what the files' records say, and nothing else.
///
/// # Errors
/// The asset's own failure where there is one input, [`Failure::Batch`] where there are several.
pub fn bake(
    call: &Call,
    options: &Options,
    direct: Direct,
    only: Option<&[String]>,
    again: bool,
) -> Result<(), Failure> {
    let console = options.console();
    let jobs = if again { in_place(options)? } else { outputs::jobs(options)? };
    check_outputs(options, &jobs)?;
    options.refuse_contradictions()?;
    options.start_threads()?;
    let sources = Sources::new(call, direct)?;
    let baking = Baking { bakers: call.bakers, only, sources: &sources, options, console: &console, again };
    let mut done = Done::default();
    for job in &jobs {
        let failed = !one(&baking, job, jobs.len() > 1, &mut done)?;
        if failed && !options.keep_going {
            break;
        }
    }
    if let Some(text) = finding_formats::text(options.format, &done.reports) {
        console.result(&text)?;
    }
    write_lists(options, &done)?;
    verdict(&jobs, done)
}

/// What became of a run.
#[derive(Default)]
struct Done {
    reports: Vec<Map<String, Value>>,
    read: Vec<(PathBuf, Vec<PathBuf>)>,
    written: Vec<PathBuf>,
    failures: Vec<Failure>,
    outdated: Vec<String>,
}

/// Bakes one input and says so; false where it failed.
fn one(baking: &Baking, job: &Job, several: bool, done: &mut Done) -> Result<bool, Failure> {
    let mut report = Report::new(&job.input);
    report.set("output", job.output.as_ref().map(|path| path.display().to_string()));
    let result = bake_one(baking, job, &mut report).map_err(|e| e.in_file(&job.input.display().to_string()));
    report.set("status", result.as_ref().map_or("failed", |status| status.word()));
    if let Err(failure) = &result {
        report.set("exit", failure.status());
        report.set("error", failure.to_string());
    }
    if let Some(output) = job.output.clone() {
        done.read.push((output, std::mem::take(&mut report.read)));
    }
    done.written.append(&mut report.written);
    let json = report.finish();
    tell(baking, &json, several)?;
    if let (Ok(Status::Outdated), Some(output)) = (&result, &job.output) {
        done.outdated.push(output.display().to_string());
    }
    done.reports.push(json);
    match result {
        Ok(_) => Ok(true),
        Err(failure) => {
            if several {
                baking.console.error(&failure);
            }
            done.failures.push(failure);
            Ok(false)
        }
    }
}

/// One line per asset: JSON for several or where asked for, words else.
fn tell(baking: &Baking, report: &Map<String, Value>, several: bool) -> Result<(), Failure> {
    if !matches!(baking.options.format, Format::Human | Format::Json) {
        return Ok(());
    }
    if baking.options.format == Format::Json {
        return baking.console.result(&Value::from(line(report, baking.options)).to_string());
    }
    if several {
        return baking.console.outcome(&Value::from(line(report, baking.options)).to_string());
    }
    let text = |name: &str| report.get(name).and_then(Value::as_str).unwrap_or_default().to_owned();
    match text("status").as_str() {
        "failed" | "planned" => Ok(()),
        status => {
            let leaves = report.get("leaves").and_then(Value::as_u64).unwrap_or(0);
            let rooms = report.get("rooms").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
            let names: Vec<&str> = rooms.iter().filter_map(|room| room["room"].as_str()).collect();
            let baked = if names.is_empty() { "no room".to_owned() } else { names.join(", ") };
            let seconds = report.get("seconds").and_then(Value::as_f64).unwrap_or(0.0);
            baking.console.outcome(&format!("{}: {status} ({leaves} leaves; {baked}; {seconds:.2} s)", text("output")))
        }
    }
}

/// What a JSON line holds of a report; the plan and the roles where they were asked for.
fn line(report: &Map<String, Value>, options: &Options) -> Map<String, Value> {
    const KEPT: [&str; 8] = ["asset", "output", "status", "exit", "error", "leaves", "findings", "seconds"];
    let plan = (options.mode == Mode::DryRun).then_some("plan");
    let parts = options.explain_roles.then_some("parts");
    let names = KEPT.into_iter().chain(plan).chain(parts);
    names.filter_map(|name| Some((name.to_owned(), report.get(name)?.clone()))).collect()
}

/// `foliar rebake` writes where it reads.
fn in_place(options: &Options) -> Result<Vec<Job>, Failure> {
    if options.output.is_some() || options.directory.is_some() {
        return outputs::jobs(options);
    }
    Ok(options.inputs.iter().map(|input| Job { input: input.clone(), output: Some(input.clone()) }).collect())
}

fn check_outputs(options: &Options, jobs: &[Job]) -> Result<(), Failure> {
    for job in jobs {
        match &job.output {
            Some(output) => outputs::check_ending(output, true)?,
            None if options.mode == Mode::DryRun || options.explain_roles => {}
            None => return Err(Failure::usage("where to? say -o OUT for one input, -d DIR for several")),
        }
    }
    Ok(())
}

fn write_lists(options: &Options, done: &Done) -> Result<(), Failure> {
    if let Some(path) = &options.report {
        let report = json!({ "foliar": env!("CARGO_PKG_VERSION"), "assets": done.reports });
        outputs::write_text(path, outputs::pretty(&report))?;
    }
    if options.mode != Mode::Write || !done.failures.is_empty() {
        return Ok(());
    }
    if let Some(path) = &options.depfile {
        outputs::write_text(path, outputs::depfile(&done.read))?;
    }
    if let Some(path) = &options.outputs {
        let names: Vec<String> = done.written.iter().map(|file| file.display().to_string()).collect();
        outputs::write_text(path, outputs::pretty(&json!(names)))?;
    }
    Ok(())
}

fn verdict(jobs: &[Job], mut done: Done) -> Result<(), Failure> {
    let untried = jobs.len() - done.reports.len();
    match done.failures.pop() {
        Some(failure) if jobs.len() == 1 => Err(failure),
        Some(_) => Err(Failure::Batch {
            failed: done.failures.len() + 1,
            total: jobs.len(),
            rest: if untried == 0 { String::new() } else { format!(", {untried} not tried (--keep-going tries all)") },
        }),
        None if !done.outdated.is_empty() => Err(Failure::Found(format!("would change: {}", done.outdated.join(", ")))),
        None => Ok(()),
    }
}

/// Tells the plain end of a command that writes one file.
pub fn tell_written(
    console: &Console,
    options: &Options,
    output: &std::path::Path,
    status: Status,
) -> Result<(), Failure> {
    let name = output.display().to_string();
    match options.format {
        Format::Json => console.result(&json!({"output": name, "status": status.word()}).to_string()),
        _ => console.outcome(&format!("{name}: {}", status.word())),
    }
}
