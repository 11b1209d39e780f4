//! `foliar explain`: what a code means, and how serious it is here.

use super::Call;
use crate::Failure;
use crate::config::{Settings, nearest};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::Options;
use crate::outputs::Job;
use crate::plan::columns;
use crate::runner;
use foliar_check::CheckError;
use foliar_schema::{CODES, Check, CodeInfo, Finding, Severity};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Alone("check"))?;
    let name = call.matches.get_one::<String>("code");
    let chosen: Vec<&CodeInfo> = match name {
        None => CODES.iter().collect(),
        Some(name) => vec![find(name)?],
    };
    let job = Job { input: PathBuf::from(name.map_or("codes", String::as_str)), output: None };
    runner::run(&options, &console, &[job], &mut |_, report| {
        let settings = sources.gather(&options, Path::new(""), Settings::default())?;
        report.read.extend(settings.files.iter().cloned());
        let check: Check = settings.section("check")?;
        console.log(&report.lap("read"));
        let rows =
            chosen.iter().map(|info| Ok((*info, severity(info, &check)?))).collect::<Result<Vec<_>, CheckError>>();
        let rows = rows.map_err(|e| settings.refused(e))?;
        report.answer(words(&rows, name.is_some()), &rows.iter().map(Explained::of).collect::<Vec<_>>())
    })
}

fn find(name: &str) -> Result<&'static CodeInfo, Failure> {
    let found = CODES.iter().find(|info| info.code.eq_ignore_ascii_case(name));
    found.ok_or_else(|| {
        let near = nearest(&name.to_uppercase(), CODES.iter().map(|info| info.code));
        let near = if near.starts_with("; did") { near } else { "; `foliar explain` lists all".into() };
        Failure::usage(format!("{name}: no such code{near}"))
    })
}

fn word(severity: Severity) -> String {
    format!("{severity:?}").to_lowercase()
}

/// How serious a code is in this project.
fn severity(info: &CodeInfo, check: &Check) -> Result<String, CheckError> {
    let judged = foliar_check::judged(vec![Finding::new(info, "")], check)?;
    Ok(judged.first().map_or("off".into(), |finding| word(finding.severity)))
}

/// What is said of a code.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Explained {
    /// The code.
    code: &'static str,
    /// How serious it is unless a project says otherwise.
    severity: Severity,
    /// How serious it is here: a severity, or `off`.
    here: String,
    /// What it means.
    meaning: &'static str,
}

impl Explained {
    fn of((info, here): &(&CodeInfo, String)) -> Self {
        Explained { code: info.code, severity: info.severity, here: here.clone(), meaning: info.doc }
    }
}

fn words(rows: &[(&CodeInfo, String)], in_full: bool) -> String {
    if !in_full {
        let cells: Vec<[String; 3]> =
            rows.iter().map(|(info, here)| [info.code.into(), here.clone(), info.doc.into()]).collect();
        return columns(&cells).trim_end().into();
    }
    let one = |(info, here): &(&CodeInfo, String)| {
        let usual = word(info.severity);
        let here = if *here == usual { String::new() } else { format!(", here {here} (check.severity)") };
        format!("{}: {usual}{here}\n{}", info.code, info.doc)
    };
    rows.iter().map(one).collect::<Vec<_>>().join("\n")
}
