//! `foliar-check`: rules over files, findings as the result.

use super::Call;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Options, is_dash};
use crate::outputs::{self, Job};
use crate::report::Report;
use crate::runner::{self, Product};
use crate::{Failure, console};
use clap::ArgMatches;
use foliar_carrier::survey::{Survey, survey};
use foliar_check::{Baseline, Checked, Settings};
use foliar_schema::{Finding, Severity};
use schemars::JsonSchema;
use serde::Serialize;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let typed = Options::from(call.matches);
    let limit = typed.fail_on.unwrap_or(Severity::Error);
    // Every file is looked at, and what was found decides once all have been.
    let options = Options { judges_at_the_end: true, keep_going: true, inputs: inputs(&typed, call.matches), ..typed };
    let console = options.console();
    let sources = Sources::new(call, Direct::Sections(&["check"]))?;
    let asked = Asked::from(call.matches)?;
    let jobs: Vec<Job> = options.inputs.iter().map(|input| Job { input: input.clone(), output: None }).collect();
    let mut found = Found { limit, all: Vec::new(), grave: 0 };
    let master = asked.master.as_deref().map(|path| Ok::<_, Failure>((path, bytes(path)?))).transpose()?;
    let mut seen: Option<Survey> = None;
    let done = runner::run(&options, &console, &jobs, &mut |job, report| {
        let given = sources.gather(&options, &job.input, crate::config::Settings::default())?;
        report.read.extend(given.files.iter().cloned());
        let settings = Settings {
            import: given.section("import")?,
            roles: given.section("roles")?,
            structure: given.section("structure")?,
            check: given.section("check")?,
        };
        if let (Some((path, bytes)), None) = (&master, &seen) {
            let master = survey(bytes.clone(), &path.display().to_string(), folder(path), &settings.import);
            if master.foliage().is_none() {
                let problem = master.problems.first().map(|problem| format!(" ({})", problem.text));
                return Err(Failure::usage(format!(
                    "--master {}: holds no layer of foliar{}, so that nothing can be lost from it: name the file that \
                     foliar baked",
                    path.display(),
                    problem.unwrap_or_default()
                )));
            }
            seen = Some(master);
        }
        report.read.extend(master.iter().map(|(path, _)| path.to_path_buf()));
        let checked = look(&job.input, (&settings, &given), seen.as_ref(), report)?;
        console.log(&report.lap("read"));
        tell(&job.input, checked, &asked, report, &mut found)
    });
    if let Some(path) = &asked.write_baseline {
        outputs::write_text(path, Baseline::of(&found.all, folder(path)).to_text())?;
        console.note(&format!("{}: written ({} known findings)", path.display(), found.all.len()));
        return done;
    }
    done?;
    match found.grave {
        0 => Ok(()),
        count => Err(Failure::Found(format!("{count} findings of severity {limit:?} or above").to_lowercase())),
    }
}

/// What is said of one file.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Looked {
    /// The file as it was named, or `standard input`.
    file: String,
    /// Findings of severity error.
    errors: usize,
    /// Findings of severity warning.
    warnings: usize,
    /// Findings of severity note.
    notes: usize,
    /// Findings that the baseline lists, left out below.
    known: usize,
    /// Triangles that were looked at.
    triangles: usize,
    /// Pictures that were looked at.
    pictures: usize,
    /// Rooms of its records.
    rooms: Vec<String>,
    /// What was found and is not known, in the order of the rules.
    findings: Vec<Finding>,
}

/// What was found in all files.
struct Found {
    limit: Severity,
    all: Vec<Finding>,
    grave: usize,
}

/// The files that are named, `--after` included.
fn inputs(options: &Options, matches: &ArgMatches) -> Vec<PathBuf> {
    let after = matches.get_one::<PathBuf>("after").cloned();
    options.inputs.iter().cloned().chain(after).collect()
}

/// Flags of this command alone.
struct Asked {
    master: Option<PathBuf>,
    baseline: Baseline,
    /// Folder of the baseline.
    home: PathBuf,
    write_baseline: Option<PathBuf>,
}

impl Asked {
    fn from(matches: &ArgMatches) -> Result<Self, Failure> {
        let path = |id| matches.get_one::<PathBuf>(id).cloned();
        let baseline = match path("baseline") {
            None => Baseline::default(),
            Some(file) => {
                let refuse = |e: String| Failure::usage(format!("--baseline {}: {e}", file.display()));
                let unread = |e| refuse(format!("cannot be read: {e}: write one with foliar-check --write-baseline"));
                let text = std::fs::read_to_string(&file).map_err(unread)?;
                Baseline::parse(&text).map_err(refuse)?
            }
        };
        let home = path("baseline").map(|file| folder(&file).to_path_buf()).unwrap_or_default();
        Ok(Asked { master: path("master"), baseline, home, write_baseline: path("write-baseline") })
    }
}

fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// The bytes of a file or of standard input: only where they cannot be had is there nothing to report about.
fn bytes(input: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |e| Failure::Input(format!("{}: cannot be read: {e}: name a readable file", input.display()));
    if !is_dash(input) {
        return std::fs::read(input).map_err(unreadable);
    }
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn name(input: &Path) -> String {
    if is_dash(input) { "standard input".into() } else { input.display().to_string() }
}

fn look(
    input: &Path,
    (settings, given): (&Settings, &crate::config::Settings),
    master: Option<&Survey>,
    report: &mut Report,
) -> Result<Checked, Failure> {
    let checked = foliar_check::check(bytes(input)?, &name(input), folder(input), settings, master);
    let checked = checked.map_err(|e| given.refused(e))?;
    report.read.push(input.to_path_buf());
    report.read.extend(checked.files.iter().cloned());
    Ok(checked)
}

fn tell(
    input: &Path,
    checked: Checked,
    asked: &Asked,
    report: &mut Report,
    found: &mut Found,
) -> Result<Product, Failure> {
    let name = name(input);
    found.all.extend(checked.findings.iter().cloned());
    let (new, known) = asked.baseline.filter(checked.findings, &asked.home);
    found.grave += new.iter().filter(|finding| finding.severity >= found.limit).count();
    let count = |severity| new.iter().filter(|finding| finding.severity == severity).count();
    let [errors, warnings, notes] = [Severity::Error, Severity::Warning, Severity::Note].map(count);
    let mut lines: Vec<String> = new.iter().map(console::finding_line).collect();
    let of_baseline = if known > 0 { format!(", {known} known from the baseline") } else { String::new() };
    lines.push(format!(
        "{name}: {errors} errors, {warnings} warnings, {notes} notes{of_baseline} ({} triangles, {} pictures)",
        checked.triangles, checked.pictures
    ));
    let (triangles, pictures, rooms) = (checked.triangles, checked.pictures, checked.rooms);
    let findings = new.clone();
    let looked = Looked { file: name, errors, warnings, notes, known, triangles, pictures, rooms, findings };
    report.tells_findings = true;
    report.find(new);
    report.answer(lines.join("\n"), &looked)
}
