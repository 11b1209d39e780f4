//! What is told of one input: JSON for several or where asked for, words else.

use crate::Failure;
use crate::console::Console;
use crate::options::{Format, Mode, Options};
use crate::report::Told;
use serde_json::{Map, Value};
use std::path::PathBuf;

/// Tells what became of an input, with every file that was written for it, `lists` included.
///
/// # Errors
/// [`Failure::Output`] where standard output cannot be written.
pub fn tell(
    options: &Options,
    console: &Console,
    told: &Told,
    several: bool,
    lists: &[PathBuf],
) -> Result<(), Failure> {
    let line = || line(&told.json, options, lists).to_string();
    match (options.format, &told.text) {
        (Format::Json, _) => match &told.answer {
            Some(answer) if !told.failed() => console.result(&answer.to_string()),
            _ => console.result(&line()),
        },
        (Format::Human, Some(text)) => {
            if !text.is_empty() {
                console.result(text)?;
            }
            console.outcome_lines(&human(&told.json, lists))
        }
        (Format::Human, None) if several => console.outcome(&line()),
        (Format::Human, None) => console.outcome_lines(&human(&told.json, lists)),
        // Findings for machines are told once, all together.
        _ => Ok(()),
    }
}

/// What a JSON line holds of a report; the plan and the roles where they were asked for.
fn line(report: &Map<String, Value>, options: &Options, lists: &[PathBuf]) -> Value {
    const KEPT: [&str; 11] =
        ["asset", "output", "status", "exit", "error", "outputs", "leaves", "pack", "measured", "findings", "seconds"];
    let plan = (options.mode == Mode::DryRun).then_some("plan");
    let parts = options.explain_roles.then_some("parts");
    let names = KEPT.into_iter().chain(plan).chain(parts);
    let mut line: Map<String, Value> =
        names.filter_map(|name| Some((name.to_owned(), report.get(name)?.clone()))).collect();
    if !lists.is_empty() {
        line.insert("lists".into(), lists.iter().map(|list| list.display().to_string()).collect());
    }
    line.into()
}

/// The output with what it holds, then every other file, a line each.
fn human(report: &Map<String, Value>, lists: &[PathBuf]) -> Vec<String> {
    let text = |name: &str| report.get(name).and_then(Value::as_str).unwrap_or_default();
    let (output, status) = (text("output"), text("status"));
    let mut lines = Vec::new();
    if !matches!(status, "failed" | "planned" | "answered") {
        lines.push(format!("{output}: {status} ({})", details(report)));
        let others = list(report, "outputs").iter().filter_map(Value::as_str).filter(|name| *name != output);
        lines.extend(others.map(|name| format!("{name}: {status}")));
    }
    lines.extend(lists.iter().map(|list| format!("{}: written", list.display())));
    lines
}

fn details(report: &Map<String, Value>) -> String {
    let leaves = report.get("leaves").and_then(Value::as_u64).map(|leaves| format!("{leaves} leaves"));
    let rooms: Vec<&str> = list(report, "rooms").iter().filter_map(|room| room["room"].as_str()).collect();
    let rooms = match rooms.as_slice() {
        [] => report.get("rooms").map(|_| "no room".to_owned()),
        names => Some(names.join(", ")),
    };
    let seconds = report.get("seconds").and_then(Value::as_f64).unwrap_or(0.0);
    let packed = report.get("packed").and_then(Value::as_str).map(str::to_owned);
    let all = [leaves, rooms, packed, Some(format!("{seconds:.2} s"))];
    all.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

fn list<'a>(report: &'a Map<String, Value>, name: &str) -> &'a [Value] {
    report.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}
