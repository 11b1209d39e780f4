//! Plants around the one that is baked: from texts to placed plants. What a record keeps of them is the
//! file's name, its hash and the place; a re-bake finds the file by its name.

use crate::Failure;
use crate::bake_one::Baking;
use crate::config::{Given, Origin, Settings};
use crate::gather::Sources;
use crate::load::{self, Loaded};
use crate::options::{Options, is_dash};
use crate::plan::Row;
use crate::report::Report;
use foliar_bake::{Placed, Placement};
use foliar_plant::Plant;
use foliar_schema::{Finding, Import, code, names};
use foliar_view::Standing;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How the place of a room's list of neighbors ends.
pub const ENDING: &str = ".neighbor";

/// One neighbor as it was given.
#[derive(Clone, Debug, PartialEq)]
pub struct Stand {
    /// The file as it was given.
    file: PathBuf,
    /// Its name: all that a record keeps of where it lies.
    name: String,
    placement: Placement,
    origin: Origin,
}

/// Neighbors by the room that was given them.
pub type Stands = BTreeMap<String, Vec<Stand>>;

/// What one room sees around the plant.
#[derive(Clone, Debug, Default)]
pub struct Around {
    /// The neighbors, placed.
    pub placed: Vec<Placed>,
    /// What was read of them, by name: for record and cache.
    pub reads: BTreeMap<String, String>,
}

/// What every room sees around the plant.
#[derive(Default)]
pub struct Neighbors(BTreeMap<String, Around>);

impl Neighbors {
    /// What the room of a row sees.
    pub fn of(&self, row: &Row) -> Around {
        self.0.get(row.baker.room()).cloned().unwrap_or_default()
    }
}

/// Takes the neighbors out of what was given, and leaves texts without folders there: plan, record and cache
/// know no paths.
///
/// # Errors
/// [`Failure::Usage`] for a text that is no neighbor, and for two files of one name.
pub fn named(settings: &mut Settings) -> Result<Stands, Failure> {
    let mut stands = Stands::new();
    for (dotted, given) in settings.ending_mut(ENDING) {
        let list = stands_of(dotted, given)?;
        given.value = list.iter().map(|stand| format!("{}@{}", stand.name, stand.placement)).collect();
        stands.insert(dotted.trim_end_matches(ENDING).to_owned(), list);
    }
    Ok(stands)
}

fn stands_of(dotted: &str, given: &Given) -> Result<Vec<Stand>, Failure> {
    let refuse = |what: String| Failure::usage(format!("{}: {dotted}: {what}", given.origin));
    let texts = given.value.as_array().into_iter().flatten().filter_map(Value::as_str);
    let mut files: BTreeMap<String, PathBuf> = BTreeMap::new();
    let mut stands = Vec::new();
    for text in texts {
        let (file, placement) = Placement::parse(text).map_err(refuse)?;
        let file = PathBuf::from(file);
        let name = file.file_name().filter(|_| !is_dash(&file)).map(|name| name.to_string_lossy().into_owned());
        let name = name.ok_or_else(|| refuse(format!("{text:?} names no file: name an .obj, .gltf or .glb")))?;
        let other = files.entry(name.clone()).or_insert_with(|| file.clone());
        if *other != file {
            let both = format!("{} and {}", other.display(), file.display());
            return Err(refuse(format!("{both} have one name, which is all that a record keeps: rename one of them")));
        }
        stands.push(Stand { file, name, placement, origin: given.origin.clone() });
    }
    Ok(stands)
}

/// A neighbor's file, read.
struct Read {
    plant: Arc<Plant>,
    base: String,
    structure: String,
}

/// Reads the neighbors of every room that will be baked; each file once.
///
/// # Errors
/// [`Failure`] with the neighbor's file: it is not there, or is no plant.
pub fn load(
    baking: &Baking,
    input: &Path,
    loaded: &Loaded,
    rows: &[Row],
    stands: &Stands,
    report: &mut Report,
) -> Result<Neighbors, Failure> {
    let mut files: BTreeMap<PathBuf, Read> = BTreeMap::new();
    let mut neighbors = Neighbors::default();
    for row in rows.iter().filter(|row| row.needed) {
        let Some(list) = stands.get(row.baker.room()) else { continue };
        let mut around = Around::default();
        for stand in list {
            let file = find(stand, input, &loaded.settings)?;
            if !files.contains_key(&file) {
                files.insert(file.clone(), read(baking, &file, report)?);
            }
            let read = &files[&file];
            around.placed.push(Placed::new(read.plant.clone(), &stand.placement));
            around.reads.insert(format!("neighbor/{}", stand.name), read.base.clone());
            around.reads.insert(format!("neighbor/{}/{}", stand.name, names::ROOM_STRUCTURE), read.structure.clone());
        }
        report.find(changed(loaded, row, list, &around));
        report.find(coincident(loaded, list, &around));
        neighbors.0.insert(row.baker.room().to_owned(), around);
    }
    Ok(neighbors)
}

/// The neighbors of a picture, with what was baked for them.
///
/// # Errors
/// As [`load`].
pub fn standing(
    sources: &Sources,
    options: &Options,
    list: &[Stand],
    report: &mut Report,
) -> Result<Vec<Standing>, Failure> {
    let mut standing = Vec::new();
    for stand in list {
        let found = load_beside(sources, options, &stand.file, "neighbor", report)?;
        standing.push(Standing { plant: found.plant, layers: found.layers, transform: stand.placement.transform() });
    }
    Ok(standing)
}

/// Where a neighbor's file lies: as it was given, or, by its name, in the asset's folder or a searched one.
fn find(stand: &Stand, input: &Path, settings: &Settings) -> Result<PathBuf, Failure> {
    if !matches!(stand.origin, Origin::Record(_)) {
        return Ok(stand.file.clone());
    }
    let folder = if is_dash(input) { Path::new("") } else { input.parent().unwrap_or(Path::new("")) };
    let search = settings.section::<Import>("import")?.search;
    let file = foliar_carrier::paths::resolve(&stand.name, folder, &search, &stand.origin.to_string())?;
    if file.is_file() {
        return Ok(file);
    }
    let remedy = "put it there, name its folder with --search, or say with --neighbor where it is now";
    Err(Failure::Input(format!("neighbor {} ({}) is not there: {remedy}", file.display(), stand.origin)))
}

fn read(baking: &Baking, file: &Path, report: &mut Report) -> Result<Read, Failure> {
    let found = load_beside(baking.sources, baking.options, file, "neighbor", report)?;
    let structure = found.structure.content_hash();
    Ok(Read { plant: Arc::new(found.plant), base: found.base_hash, structure })
}

/// A file that is read beside the input, `what` it is to it; its findings name it.
///
/// # Errors
/// As [`load::load`], in that file.
pub fn load_beside(
    sources: &Sources,
    options: &Options,
    file: &Path,
    what: &str,
    report: &mut Report,
) -> Result<Loaded, Failure> {
    let flags = flags_for(&sources.flags, file);
    let sources = Sources { flags, environment: sources.environment.clone(), ..*sources };
    let mut found = load::load(&sources, options, file)
        .map_err(|failure| failure.in_file(&format!("{what} {}", file.display())))?;
    let in_file = |finding: Finding| match finding.file {
        Some(_) => finding,
        None => finding.in_file(file.display().to_string()),
    };
    report.find(std::mem::take(&mut found.findings).into_iter().map(in_file));
    report.read.append(&mut found.files);
    Ok(found)
}

/// The flags that are about a neighbor too: roles and searched folders; axis and unit where it is an OBJ.
fn flags_for(flags: &Settings, file: &Path) -> Settings {
    let is_obj = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
    let not_its_own = ["import.node", "import.scene", "import.texture", "import.height_m"];
    let of_an_obj = ["import.up", "import.unit"];
    let mut kept = flags.clone();
    not_its_own.iter().chain(of_an_obj.iter().filter(|_| !is_obj)).for_each(|name| kept.remove(name));
    kept
}

/// What the record of the last bake read otherwise.
fn changed(loaded: &Loaded, row: &Row, stands: &[Stand], around: &Around) -> Vec<Finding> {
    let again = stands.iter().any(|stand| matches!(stand.origin, Origin::Record(_)));
    let record = loaded.layers.iter().map(|layer| &layer.record).find(|record| record.room == row.baker.room());
    let Some(record) = record.filter(|_| again) else { return Vec::new() };
    let differs = |stand: &&Stand| {
        around.reads.iter().any(|(name, hash)| {
            name.starts_with(&format!("neighbor/{}", stand.name))
                && record.reads.get(name).is_some_and(|old| old != hash)
        })
    };
    let mut names: Vec<&str> = stands.iter().filter(differs).map(|stand| stand.name.as_str()).collect();
    names.dedup();
    let text = |name: &str| {
        format!("neighbor {name} is not the one that {} was baked with: it is baked with the new one", record.room)
    };
    names.into_iter().map(|name| Finding::new(&code::STALE, text(name))).collect()
}

/// Foliage that counts twice.
fn coincident(loaded: &Loaded, stands: &[Stand], around: &Around) -> Vec<Finding> {
    let hash = |stand: &Stand| around.reads.get(&format!("neighbor/{}", stand.name));
    let is_twice = |(index, stand): &(usize, &Stand)| {
        let matrix = around.placed[*index].transform;
        let on_itself = hash(stand) == Some(&loaded.base_hash) && matrix == Placement::default().transform();
        let earlier = &stands[..*index];
        on_itself
            || earlier
                .iter()
                .zip(&around.placed)
                .any(|(other, at)| hash(other) == hash(stand) && at.transform == matrix)
    };
    let text = |stand: &Stand| {
        let at = format!("{}@{}", stand.name, stand.placement);
        format!("neighbor {at} coincides with the plant or with another neighbor: its foliage counts twice; move it")
    };
    let twice = stands.iter().enumerate().filter(is_twice);
    twice.map(|(_, stand)| Finding::new(&code::NEIGHBOR_COINCIDES, text(stand))).collect()
}
