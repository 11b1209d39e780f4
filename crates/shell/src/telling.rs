//! What is told of one input: JSON for several or where asked for, words else.

use crate::console::Console;
use crate::options::{Format, Options};
use crate::report::Told;
use crate::runner::Status;
use crate::said::{AssetReport, Line, RoomTold};
use crate::{Failure, outputs};
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
    let line = || Ok::<_, Failure>(outputs::value(&Line::of(&told.report, options, lists))?.to_string());
    match (options.format, &told.text) {
        (Format::Json, _) => match &told.answer {
            Some(answer) if !told.failed() => console.result(&answer.to_string()),
            _ => console.result(&line()?),
        },
        (Format::Human, Some(text)) => {
            if !text.is_empty() {
                console.result(text)?;
            }
            console.outcome_lines(&human(&told.report, lists))
        }
        (Format::Human, None) if several => console.outcome(&line()?),
        (Format::Human, None) => console.outcome_lines(&human(&told.report, lists)),
        // Findings for machines are told once, all together.
        _ => Ok(()),
    }
}

/// The output with what it holds, then every other file, a line each.
fn human(report: &AssetReport, lists: &[PathBuf]) -> Vec<String> {
    let (output, status) = (report.output.as_deref().unwrap_or_default(), report.status);
    let mut lines = Vec::new();
    if !matches!(status, Status::Failed | Status::Planned | Status::Answered) {
        let status = status.word();
        lines.push(format!("{output}: {status} ({})", details(report)));
        let others = report.outputs.iter().flatten().filter(|name| *name != output);
        lines.extend(others.map(|name| format!("{name}: {status}")));
    }
    lines.extend(lists.iter().map(|list| format!("{}: written", list.display())));
    lines
}

fn details(report: &AssetReport) -> String {
    let leaves = report.leaves.map(|leaves| format!("{leaves} leaves"));
    let rooms = report.rooms.as_ref().map(|rooms| match rooms.as_slice() {
        [] => "no room".to_owned(),
        rooms => rooms.iter().map(RoomTold::name).collect::<Vec<_>>().join(", "),
    });
    let all = [leaves, rooms, report.packed.clone(), Some(format!("{:.2} s", report.seconds))];
    all.into_iter().flatten().collect::<Vec<_>>().join("; ")
}
