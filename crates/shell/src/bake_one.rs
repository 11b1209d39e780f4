//! One asset all the way: read, structure, plan, rooms, assemble, write.

use crate::cache::Cache;
use crate::console::Console;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::options::{Format, Mode, Options, is_dash};
use crate::outputs::{self, Job};
use crate::plan::{self, Row};
use crate::progress::Bar;
use crate::report::Report;
use crate::rooms::{self, Room};
use crate::{Failure, config::Settings};
use foliar_bake::{Baker, Facts, Layer};
use foliar_carrier::{Document, Outcome, OutputFile};
use foliar_schema::{Finding, code, names};
use foliar_view::ViewParams;
use std::path::Path;

/// What every asset of a run shares.
pub struct Baking<'a> {
    /// Rooms that there are.
    pub bakers: &'a [&'a dyn Baker],
    /// Rooms asked for by name; `None` leaves it to the scene.
    pub only: Option<&'a [String]>,
    /// Where parameters come from.
    pub sources: &'a Sources<'a>,
    /// Other flags.
    pub options: &'a Options,
    /// Where to speak.
    pub console: &'a Console,
    /// Bakes again what the file's records name, and nothing else.
    pub again: bool,
}

/// What became of an asset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// New bytes are in place.
    Written,
    /// The same bytes were there already.
    Unchanged,
    /// `--check`: the bytes would change.
    Outdated,
    /// Only the plan or the roles were printed.
    Planned,
}

impl Status {
    /// The word in JSON lines.
    pub fn word(self) -> &'static str {
        match self {
            Status::Written => "written",
            Status::Unchanged => "unchanged",
            Status::Outdated => "outdated",
            Status::Planned => "planned",
        }
    }
}

/// Bakes one asset.
///
/// # Errors
/// [`Failure`]; the old output is intact.
pub fn bake_one(baking: &Baking, job: &Job, report: &mut Report) -> Result<Status, Failure> {
    let loaded = load(baking.sources, baking.options, &job.input)?;
    report.loaded(&loaded);
    baking.console.log(&report.lap("read"));
    if baking.again && !loaded.is_master {
        return Err(Failure::Input("holds no record of a bake to repeat: run foliar bake".into()));
    }
    let recorded: Vec<String> = loaded.layers.iter().map(|layer| layer.record.room.clone()).collect();
    let only = if baking.again { Some(recorded.as_slice()) } else { baking.only };
    let rows = plan::make(baking.bakers, &loaded.settings, only, &Facts::of(&loaded.plant))?;
    report.plan(&rows);
    let for_people = baking.options.format == Format::Human && baking.options.inputs.len() == 1;
    if for_people && baking.options.explain_roles {
        baking.console.result(foliar_structure::explain(&loaded.evidence).trim_end())?;
    }
    if for_people && baking.options.mode == Mode::DryRun {
        baking.console.result(&plan::table(&rows))?;
    }
    let Some(output) = &job.output else { return Ok(Status::Planned) };
    if baking.options.mode == Mode::DryRun {
        return Ok(Status::Planned);
    }
    let rooms = bake_rooms(baking, &loaded, &rows, report)?;
    let files = finish(baking, &loaded, &rows, &rooms, output, report)?;
    fail_on(baking, report)?;
    let status = commit(baking, &files)?;
    baking.console.log(&report.lap("write"));
    Ok(status)
}

fn bake_rooms(baking: &Baking, loaded: &Loaded, rows: &[Row], report: &mut Report) -> Result<Vec<Room>, Failure> {
    let bar = Bar::new(baking.console.draws_progress());
    let cache = baking.options.cache.as_deref().map(Cache::new);
    let rooms = rooms::bake(loaded, rows, cache.as_ref(), &bar)?;
    report.find(rooms.iter().flat_map(|room| room.findings.iter().cloned()));
    baking.console.log(&report.lap("rooms"));
    Ok(rooms)
}

/// Everything that will be written, the commit last.
fn finish(
    baking: &Baking,
    loaded: &Loaded,
    rows: &[Row],
    rooms: &[Room],
    output: &Path,
    report: &mut Report,
) -> Result<Vec<OutputFile>, Failure> {
    let (layers, left_out) = all_layers(loaded, rooms);
    let (document, findings) = foliar_carrier::assemble(&loaded.document, &layers)?;
    report.find(left_out.into_iter().chain(findings));
    report.rooms(rows, rooms, &document);
    baking.console.log(&report.lap("assemble"));
    let mut files = Vec::new();
    if let Some(picture) = &baking.options.picture {
        files.push(draw(loaded, &layers, picture)?);
        baking.console.log(&report.lap("picture"));
    }
    files.extend(main_files(loaded, rooms, &document, output)?);
    report.written = files.iter().map(|file| file.path.clone()).filter(|path| !is_dash(path)).collect();
    Ok(files)
}

/// Structure, what was baked now, and what the file held already and still belongs to it; what does
/// not is left out, with a finding.
fn all_layers(loaded: &Loaded, rooms: &[Room]) -> (Vec<Layer>, Vec<Finding>) {
    let mut layers = vec![loaded.structure.clone()];
    layers.extend(rooms.iter().map(|room| room.layer.clone()));
    let structure = loaded.structure.content_hash();
    let mut findings = Vec::new();
    let baked = |layer: &&Layer| rooms.iter().any(|room| room.layer.record.room == layer.record.room);
    for layer in loaded.layers.iter().filter(|layer| !baked(layer)) {
        let record = &layer.record;
        let differs = |name: &str, hash: &String| record.reads.get(name).is_some_and(|read| read != hash);
        if differs(names::ROOM_STRUCTURE, &structure) || differs("base", &loaded.base_hash) {
            let text =
                format!("{} was baked from another base or structure and was left out: run foliar bake", record.room);
            findings.push(Finding::new(&code::STALE, text));
        } else {
            layers.push(layer.clone());
        }
    }
    (layers, findings)
}

fn main_files(loaded: &Loaded, rooms: &[Room], document: &Document, output: &Path) -> Result<Vec<OutputFile>, Failure> {
    match rooms {
        _ if !outputs::is_layer(output) => outputs::encode(document, output),
        [] => outputs::encode_layer(&loaded.structure, output),
        [room] => outputs::encode_layer(&room.layer, output),
        _ => Err(Failure::usage(format!(
            "-o {}: a layer file holds one room, and {} were baked: say which with --only",
            output.display(),
            rooms.len()
        ))),
    }
}

fn draw(loaded: &Loaded, layers: &[Layer], picture: &Path) -> Result<OutputFile, Failure> {
    let params: ViewParams = view_params(&loaded.settings)?;
    let title = picture.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let layers: Vec<&Layer> = layers.iter().collect();
    let refuse = |e| Failure::Input(format!("{}: {e}", picture.display()));
    let sheet = foliar_view::bake_sheet(&loaded.plant, &layers, &title, &params).map_err(refuse)?;
    Ok(OutputFile { path: picture.to_path_buf(), bytes: foliar_view::png_bytes(&sheet).map_err(refuse)? })
}

/// The section [view].
///
/// # Errors
/// [`Failure::Usage`] as every section.
pub fn view_params(settings: &Settings) -> Result<ViewParams, Failure> {
    settings.section("view")
}

/// Prints the findings, and refuses those that are too serious.
fn fail_on(baking: &Baking, report: &Report) -> Result<(), Failure> {
    for finding in &report.findings {
        baking.console.finding(finding);
    }
    let Some(limit) = baking.options.fail_on else { return Ok(()) };
    let bad: Vec<&str> = report.findings.iter().filter(|f| f.severity >= limit).map(|f| f.code.as_str()).collect();
    match bad.as_slice() {
        [] => Ok(()),
        _ => Err(Failure::Found(format!("--fail-on: found {}; nothing was written", bad.join(", ")))),
    }
}

fn commit(baking: &Baking, files: &[OutputFile]) -> Result<Status, Failure> {
    let (data, files): (Vec<&OutputFile>, Vec<&OutputFile>) = files.iter().partition(|file| is_dash(&file.path));
    let files: Vec<OutputFile> = files.into_iter().cloned().collect();
    if baking.options.mode == Mode::Check {
        let same = foliar_carrier::is_unchanged(&files);
        return Ok(if same { Status::Unchanged } else { Status::Outdated });
    }
    make_folders(baking.options)?;
    let outcome = foliar_carrier::write_files(&files)?;
    for file in &data {
        baking.console.data(&file.bytes)?;
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
