//! Rules over foliage files, ours or not: what is broken, what costs, what a tool lost. Every finding has a
//! stable code and a place. A broken file is no failure: it is what is reported.

mod baseline;
mod contract;
mod diff;
mod faces;
mod geometry;
mod lost;
mod materials;
mod pictures;
mod plant;
mod severity;

pub use baseline::Baseline;
pub use diff::{Difference, Spot, diff};
pub use lost::lost;

use foliar_carrier::survey::{Survey, Trouble, survey};
use foliar_plant::Part;
use foliar_schema::{Check, CodeInfo, Finding, Import, Role, Roles, code};
use foliar_structure::StructureParams;
use std::path::{Path, PathBuf};

/// Why nothing was checked: what was asked for makes no sense.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// An entry of section `check`.
    #[error("{0}")]
    Setting(String),
    /// Patterns of section `roles`, or parameters of `structure`.
    #[error(transparent)]
    Structure(#[from] foliar_structure::StructureError),
}

/// How a file is checked.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// How it is read.
    pub import: Import,
    /// Patterns that decide roles.
    pub roles: Roles,
    /// How roles are found.
    pub structure: StructureParams,
    /// What is required, and how serious codes are.
    pub check: Check,
}

/// What checking gave.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// What was found, in the order of the rules.
    pub findings: Vec<Finding>,
    /// Files that were read beside the asset.
    pub files: Vec<PathBuf>,
    /// Triangles that were looked at.
    pub triangles: usize,
    /// Pictures that were looked at.
    pub pictures: usize,
    /// Rooms of the file's records.
    pub rooms: Vec<String>,
}

/// Checks one file. `name` stands in messages; files beside it are looked for in `folder`. With a `master`, also
/// what has been lost since.
///
/// # Errors
/// [`CheckError`] for settings alone: whatever the bytes are, they give findings.
pub fn check(
    bytes: Vec<u8>,
    name: &str,
    folder: &Path,
    settings: &Settings,
    master: Option<&Survey>,
) -> Result<Checked, CheckError> {
    let overrides = severity::Overrides::new(&settings.check.severity)?;
    let required = contract::Required::new(&settings.check.require)?;
    let seen = survey(bytes, name, folder, &settings.import);
    let mut report = Report { file: name, findings: Vec::new() };
    problems(&seen, &mut report);
    let roles = plant::roles(&seen, settings, &mut report)?;
    let subject = Subject { seen: &seen, roles };
    let facts = geometry::check(&subject, &mut report);
    pictures::check(&subject, &mut report);
    materials::check(&subject, &facts, &mut report);
    plant::check(&subject, &mut report);
    required.check(&seen, &mut report);
    let rooms = contract::check(&subject, &mut report);
    if let Some(master) = master {
        lost::compare(&seen, master, &mut report);
    }
    let beside = contract::beside(&seen, folder, &settings.import, &mut report);
    let mut checked = Checked {
        findings: Vec::new(),
        files: seen.files.iter().cloned().chain(beside).collect(),
        triangles: seen.base.parts.iter().map(|part| part.triangles.len()).sum(),
        pictures: seen.pictures.len(),
        rooms,
    };
    // What a tool changed beside its master is said already, and was meant.
    if master.is_none() {
        contract::stale(seen, &settings.import, &mut report);
    }
    checked.findings = overrides.apply(report.findings);
    Ok(checked)
}

/// Findings as they count in a project.
///
/// # Errors
/// [`CheckError::Setting`] for an entry that names no code or no severity.
pub fn judged(findings: Vec<Finding>, check: &Check) -> Result<Vec<Finding>, CheckError> {
    Ok(severity::Overrides::new(&check.severity)?.apply(findings))
}

/// What rules look at.
struct Subject<'a> {
    seen: &'a Survey,
    /// Role of each part of the base.
    roles: Vec<Role>,
}

impl Subject<'_> {
    /// Parts with their roles.
    fn parts(&self) -> impl Iterator<Item = (&Part, Role)> {
        self.seen.base.parts.iter().zip(self.roles.iter().copied())
    }
}

/// Findings about one file.
struct Report<'a> {
    file: &'a str,
    findings: Vec<Finding>,
}

impl Report<'_> {
    fn say(&mut self, info: &CodeInfo, place: impl Into<String>, message: impl Into<String>) {
        let place: String = place.into();
        let finding = Finding::new(info, message).in_file(self.file);
        self.findings.push(if place.is_empty() { finding } else { finding.at(place) });
    }

    /// As [`Report::say`], where something was counted.
    fn count(&mut self, info: &CodeInfo, place: impl Into<String>, number: usize, what: &str) {
        if number > 0 {
            self.say(info, place, format!("{number} {what}"));
        }
    }

    fn has(&self, info: &CodeInfo) -> bool {
        self.findings.iter().any(|finding| finding.code == info.code)
    }
}

/// What could not be read, and what import would say.
fn problems(seen: &Survey, report: &mut Report) {
    for problem in &seen.problems {
        let info = match problem.trouble {
            Trouble::Broken => &code::FILE_BROKEN,
            Trouble::NotFinite => &code::GEOMETRY_NAN,
            Trouble::Index => &code::GEOMETRY_INDEX,
            Trouble::Compressed => &code::FILE_COMPRESSED,
        };
        report.say(info, &problem.place, &problem.text);
        if let (Some(file), Some(last)) = (&problem.file, report.findings.last_mut()) {
            last.file = Some(file.clone());
        }
    }
    report.findings.extend(seen.findings.iter().cloned());
    if seen.problems.is_empty() && seen.base.parts.iter().all(|part| part.triangles.is_empty()) {
        report.say(&code::FILE_EMPTY, "", "nothing in it draws a triangle: export the tree with its faces");
    }
}
