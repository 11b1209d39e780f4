//! One asset all the way: read, structure, plan, rooms, assemble.

use crate::cache::Cache;
use crate::console::Console;
use crate::gather::Sources;
use crate::limbs::{self, Limbs};
use crate::load::{Loaded, load};
use crate::maps::{self, Sheet};
use crate::neighbors::{self, Neighbors};
use crate::options::{Mode, Options, is_dash};
use crate::outputs::{self, Job};
use crate::plan::{self, Row};
use crate::progress::Bar;
use crate::report::Report;
use crate::rooms::{self, Room};
use crate::runner::Product;
use crate::{Failure, config::Settings};
use foliar_bake::{Baker, Inputs, Layer, Maps};
use foliar_carrier::{Document, OutputFile};
use foliar_schema::{Finding, code, names};
use foliar_view::ViewParams;
use std::collections::BTreeMap;
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

/// Bakes one asset.
///
/// # Errors
/// [`Failure`]; the old output is intact.
pub fn bake_one(baking: &Baking, job: &Job, report: &mut Report) -> Result<Product, Failure> {
    let mut loaded = load(baking.sources, baking.options, &job.input)?;
    let stands = neighbors::named(&mut loaded.settings)?;
    report.loaded(&loaded);
    baking.console.log(&report.lap("read"));
    if baking.again && !loaded.is_master {
        return Err(Failure::Input("holds no record of a bake to repeat: run foliar bake".into()));
    }
    let recorded: Vec<String> = loaded.layers.iter().map(|layer| layer.record.room.clone()).collect();
    let only = if baking.again { Some(recorded.as_slice()) } else { baking.only };
    let entries = maps::named(baking.sources.fields, &mut loaded.settings, &job.input)?;
    let (mut rows, limbs) = limbs::plan(baking, &mut loaded, only, report)?;
    let sheets = maps::settle(baking, &loaded, &job.input, &mut rows, &entries, report)?;
    report.plan(&rows, limbs.as_ref());
    let neighbors = neighbors::load(baking, &job.input, &loaded, &rows, &stands, report)?;
    report.text = asked(baking, &loaded, &rows, limbs.as_ref());
    let surface = baking.options.surface.as_deref();
    if baking.options.mode == Mode::DryRun || job.output.is_none() && surface.is_none() {
        return Ok(Product::Planned);
    }
    let mut files = surface.map_or(Ok(Vec::new()), |path| enclose(baking, &loaded, &rows, path, report))?;
    if let (None, Some(path)) = (&job.output, surface) {
        report.told.output = Some(path.display().to_string());
    }
    if let Some(output) = &job.output {
        let around = (&neighbors, &sheets);
        let mut rooms = bake_rooms(baking, &loaded, limbs.as_ref(), around, &rows, report)?;
        if is_dash(output) {
            rooms.iter_mut().for_each(|room| maps::embed_all(&mut room.layer));
        }
        let made = Made { branches: limbs.map(|limbs| limbs.layer), rooms };
        files.extend(finish(baking, &loaded, &rows, &made, output, report)?);
    }
    Ok(Product::Files(files))
}

/// The roles and the plan for people, where they were asked for.
fn asked(baking: &Baking, loaded: &Loaded, rows: &[Row], limbs: Option<&Limbs>) -> Option<String> {
    if baking.options.inputs.len() > 1 {
        return None;
    }
    let roles = baking.options.explain_roles.then(|| foliar_structure::explain(&loaded.evidence).trim_end().to_owned());
    let plan = (baking.options.mode == Mode::DryRun).then(|| plan::table(rows, limbs));
    let parts: Vec<String> = roles.into_iter().chain(plan).collect();
    (!parts.is_empty()).then(|| parts.join("\n"))
}

fn bake_rooms(
    baking: &Baking,
    loaded: &Loaded,
    limbs: Option<&Limbs>,
    around: (&Neighbors, &BTreeMap<String, Vec<Sheet>>),
    rows: &[Row],
    report: &mut Report,
) -> Result<Vec<Room>, Failure> {
    let bar = Bar::new(baking.console.draws_progress());
    let cache = baking.options.cache.as_deref().map(Cache::new);
    let rooms = rooms::bake(loaded, limbs, around, rows, cache.as_ref(), &bar)?;
    report.find(rooms.iter().flat_map(|room| room.findings.iter().cloned()));
    baking.console.log(&report.lap("rooms"));
    Ok(rooms)
}

/// The surface around the foliage, of the room that knows one, needed or not.
fn enclose(
    baking: &Baking,
    loaded: &Loaded,
    rows: &[Row],
    path: &Path,
    report: &mut Report,
) -> Result<Vec<OutputFile>, Failure> {
    let knows = rows.iter().find_map(|row| Some((row, row.baker.hull()?)));
    let (row, room) = knows.ok_or_else(|| Failure::usage("--surface: no room knows a surface"))?;
    let inputs = Inputs { plant: Some(&loaded.plant), maps: &Maps::new(), neighbors: &[] };
    let hull = room.enclose(&inputs, &row.params)?;
    if hull.triangles.is_empty() {
        let text = format!(
            "{}: no foliage to enclose: the surface is an empty scene; name leaves with --leaf",
            row.baker.room()
        );
        report.find([Finding::new(&code::LEAF_NONE, text)]);
    }
    baking.console.log(&report.lap("surface"));
    Ok(foliar_carrier::encode(&foliar_carrier::hull_document(&hull, "crown"), path)?)
}

/// What this bake made.
struct Made {
    /// The layer of branches, where the plan asked for them.
    branches: Option<Layer>,
    rooms: Vec<Room>,
}

impl Made {
    fn layers(&self) -> impl Iterator<Item = &Layer> {
        self.branches.iter().chain(self.rooms.iter().map(|room| &room.layer))
    }
}

/// Everything that will be written, the commit last.
fn finish(
    baking: &Baking,
    loaded: &Loaded,
    rows: &[Row],
    made: &Made,
    output: &Path,
    report: &mut Report,
) -> Result<Vec<OutputFile>, Failure> {
    let (layers, left_out) = all_layers(loaded, made);
    let (document, findings) = foliar_carrier::assemble(&loaded.document, &layers)?;
    report.find(left_out.into_iter().chain(findings));
    report.rooms(rows, &made.rooms, &document);
    baking.console.log(&report.lap("assemble"));
    let mut files = Vec::new();
    if let Some(picture) = &baking.options.picture {
        files.push(draw(loaded, &layers, picture)?);
        baking.console.log(&report.lap("picture"));
    }
    files.extend(main_files(loaded, made, &document, output)?);
    Ok(files)
}

/// Structure, what was baked now, and what the file held already and still belongs to it; what does
/// not is left out, with a finding.
fn all_layers(loaded: &Loaded, made: &Made) -> (Vec<Layer>, Vec<Finding>) {
    let mut layers = vec![loaded.structure.clone()];
    layers.extend(made.layers().cloned());
    let mut hashes = BTreeMap::from([
        ("base", loaded.base_hash.clone()),
        (names::ROOM_STRUCTURE, loaded.structure.content_hash()),
        // Until they are known: what was baked from branches must not stay without them.
        (names::ROOM_BRANCHES, made.branches.as_ref().map_or(String::new(), Layer::content_hash)),
    ]);
    let mut findings = Vec::new();
    let baked = |layer: &&Layer| made.layers().any(|own| own.record.room == layer.record.room);
    // The order of a file: branches stand before the rooms that read them.
    for layer in loaded.layers.iter().filter(|layer| !baked(layer)) {
        let record = &layer.record;
        let differs = |(name, hash): (&&str, &String)| record.reads.get(*name).is_some_and(|read| read != hash);
        if hashes.iter().any(differs) {
            let text = format!(
                "{} was baked from another base, structure or branches and was left out: run foliar bake",
                record.room
            );
            findings.push(Finding::new(&code::STALE, text));
            continue;
        }
        if record.room == names::ROOM_BRANCHES {
            hashes.insert(names::ROOM_BRANCHES, layer.content_hash());
        }
        layers.push(layer.clone());
    }
    (layers, findings)
}

fn main_files(loaded: &Loaded, made: &Made, document: &Document, output: &Path) -> Result<Vec<OutputFile>, Failure> {
    match made.rooms.as_slice() {
        _ if !outputs::is_layer(output) => outputs::encode(document, output),
        [] => outputs::encode_layer(made.branches.as_ref().unwrap_or(&loaded.structure), output),
        [room] => outputs::encode_layer(&room.layer, output),
        rooms => Err(Failure::usage(format!(
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
    let sheet = foliar_view::bake_sheet(&loaded.plant, &layers, &[], &title, &params).map_err(refuse)?;
    Ok(OutputFile { path: picture.to_path_buf(), bytes: foliar_view::png_bytes(&sheet).map_err(refuse)? })
}

/// The section [view].
///
/// # Errors
/// [`Failure::Usage`] as every section.
pub fn view_params(settings: &Settings) -> Result<ViewParams, Failure> {
    settings.section("view")
}
