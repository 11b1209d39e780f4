//! Maps of leaf materials: from texts (`FILE`, `MATERIAL=FILE`) to numbers, one set for each material, or for several that
//! share all of it. What a record keeps of a file is its name, from the asset's folder on, and its hash; a re-bake
//! finds it by that.

mod materials;
mod own;
mod shelf;

use crate::Failure;
use crate::bake_one::Baking;
use crate::config::{Fields, Given, Origin, Settings};
use crate::load::Loaded;
use crate::options::is_dash;
use crate::plan::Row;
use crate::report::Report;
use foliar_bake::{Baker, Layer, Maps};
use foliar_plant::Plant;
use foliar_schema::{Finding, names};
use materials::{alone, by_material, photographed};
use own::Own;
use serde_json::{Map, Value};
use shelf::Shelf;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Parameters that say which material a map or another parameter belongs to.
const MATERIAL: &str = "material";
const FOR_MATERIAL: &str = "for_material";
/// Parameter that says what thickness is read from, and its word for a photograph.
const THICKNESS_FROM: &str = "thickness_from";
const PHOTO: &str = "photo";

/// Whether the map of thickness is a photograph by what was given.
fn from_photo(given: &Map<String, Value>) -> bool {
    given.get(THICKNESS_FROM).is_some_and(|from| from == PHOTO)
}

/// One map as it was given.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Which map.
    map: String,
    /// Materials that it is for; nothing said: see `material`.
    pattern: Option<String>,
    /// The file as it was given.
    file: PathBuf,
    /// What a record keeps of where it lies.
    name: String,
    origin: Origin,
}

impl Entry {
    /// Whether it names this map.
    pub fn is(&self, map: &str) -> bool {
        self.map == map
    }
}

/// Maps by the room that was given them.
pub type Entries = BTreeMap<String, Vec<Entry>>;

/// Maps of one or more materials that share them, with what else is theirs.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// The name in files: that of its first material.
    pub name: String,
    /// Names of its materials.
    pub materials: Vec<String>,
    /// The numbers.
    pub maps: Maps,
    /// Pictures that are passed on.
    pub pictures: BTreeMap<String, Vec<u8>>,
    /// What was given for it.
    pub given: Map<String, Value>,
    /// Hashes of its files, by what a record calls them.
    pub reads: BTreeMap<String, String>,
    /// File of each map.
    files: BTreeMap<String, PathBuf>,
}

impl Sheet {
    /// Adds a material that shares all maps; what they show by day is mixed.
    fn join(&mut self, name: String, own: Option<&Own>) {
        let count = self.materials.len() as f32;
        self.materials.push(name);
        let mixed = self.maps.get_mut(names::MAP_ALBEDO).zip(own);
        for (mean, one) in mixed.into_iter().flat_map(|(m, own)| m.raster.data.iter_mut().zip(&own.albedo.raster.data))
        {
            *mean = (*mean * count + one) / (count + 1.0);
        }
    }

    /// A failure of its bake with the file of the map that it is about.
    pub fn blame(&self, failure: Failure) -> Failure {
        let text = failure.to_string();
        let file = self.files.iter().find(|(map, _)| text.contains(&format!("map {map} ")));
        match file {
            Some((_, file)) => failure.in_file(&file.display().to_string()),
            None => failure,
        }
    }

    /// The same for a finding.
    pub fn placed(&self, finding: Finding) -> Finding {
        let map = finding.place.as_deref().and_then(|place| place.strip_prefix("map "));
        match map.and_then(|map| self.files.get(map)) {
            Some(file) if finding.file.is_none() => finding.in_file(file.display().to_string()),
            _ => finding,
        }
    }
}

/// Takes the files of maps out of what was given, and leaves names there that mean the same on another machine.
///
/// # Errors
/// [`Failure::Usage`] for two files of one name.
pub fn named(fields: &Fields, settings: &mut Settings, input: &Path) -> Result<Entries, Failure> {
    let folder = if is_dash(input) { Path::new("") } else { input.parent().unwrap_or(Path::new("")) };
    let mut entries = Entries::new();
    for field in fields.all() {
        let (Some(map), dotted) = (&field.map, field.dotted()) else { continue };
        for (_, given) in settings.ending_mut(&dotted) {
            let list = entries_of(map, folder, given)?;
            let text = |entry: &Entry| match &entry.pattern {
                Some(pattern) => format!("{pattern}={}", entry.name),
                None => entry.name.clone(),
            };
            given.value = list.iter().map(text).collect();
            entries.entry(field.section.clone()).or_default().extend(list);
        }
    }
    for list in entries.values() {
        let mut files: BTreeMap<&str, &Path> = BTreeMap::new();
        for entry in list {
            let other = files.entry(&entry.name).or_insert(&entry.file);
            if *other != entry.file {
                let text = format!(
                    "{} and {} have one name, which is all that a record keeps: rename one of them, or put both into the \
                     asset's folder",
                    other.display(),
                    entry.file.display()
                );
                return Err(Failure::usage(text));
            }
        }
    }
    Ok(entries)
}

fn entries_of(map: &str, folder: &Path, given: &Given) -> Result<Vec<Entry>, Failure> {
    let texts = given.value.as_array().into_iter().flatten().filter_map(Value::as_str);
    let entry = |text: &str| {
        let (pattern, file) = match text.split_once('=') {
            Some((pattern, file)) => (Some(pattern.trim().to_owned()), file),
            None => (None, text),
        };
        let file = PathBuf::from(file);
        let name = file.file_name().filter(|_| !is_dash(&file));
        let Some(name) = name else {
            let text = format!("{}: map {map}: {text:?} names no file: FILE or MATERIAL=FILE", given.origin);
            return Err(Failure::usage(text));
        };
        let name = match inside(&file, folder) {
            _ if matches!(given.origin, Origin::Record(_)) => file.to_string_lossy().into_owned(),
            Some(name) => name,
            None => name.to_string_lossy().into_owned(),
        };
        Ok(Entry { map: map.into(), pattern, file, name, origin: given.origin.clone() })
    };
    texts.map(entry).collect()
}

/// The way from a folder down to a file in it.
fn inside(file: &Path, folder: &Path) -> Option<String> {
    let absolute = |path: &Path| std::path::absolute(if path.as_os_str().is_empty() { Path::new(".") } else { path });
    let (file, folder) = (absolute(file).ok()?, absolute(folder).ok()?);
    let rest = file.strip_prefix(folder).ok()?;
    Some(rest.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/"))
}

/// What selecting and reading maps needs.
pub struct Gathering<'a> {
    /// All parameters.
    pub fields: &'a Fields,
    /// What was given.
    pub settings: &'a Settings,
    /// The asset.
    pub input: &'a Path,
    /// The plant whose materials are meant; none: the maps stand alone.
    pub plant: Option<&'a Plant>,
}

/// Sets of maps, what was noticed, and the files that were read.
#[derive(Default)]
pub struct Gathered {
    /// The sets.
    pub sheets: Vec<Sheet>,
    /// What was noticed.
    pub findings: Vec<Finding>,
    /// Files read.
    pub files: Vec<PathBuf>,
}

/// A material and the maps that are for it.
struct Wanted<'a> {
    name: String,
    entries: BTreeMap<&'a str, &'a Entry>,
    given: Map<String, Value>,
}

/// What makes two sets of maps the same.
struct Source {
    /// The file of each map.
    files: Vec<(String, PathBuf)>,
    given: Map<String, Value>,
    own: Option<Own>,
}

impl Source {
    fn same(&self, other: &Source) -> bool {
        self.files == other.files && self.given == other.given && Own::same(self.own.as_ref(), other.own.as_ref())
    }
}

/// Reads the maps of a room.
///
/// # Errors
/// [`Failure`] with the file, or with the leaf materials that there are.
pub fn gather(gathering: &Gathering, baker: &dyn Baker, entries: &[Entry]) -> Result<Gathered, Failure> {
    let mut gathered = Gathered::default();
    let wanted = match gathering.plant {
        Some(plant) => {
            let mut wanted = by_material(gathering, baker, entries, plant, &mut gathered.findings)?;
            wanted.extend(photographed(gathering, baker, plant, &wanted)?);
            wanted
        }
        None => vec![alone(gathering, baker, entries)?],
    };
    let mut shelf = Shelf { gathering, read: BTreeMap::new() };
    let mut known: Vec<Source> = Vec::new();
    for material in wanted {
        let mut files = Vec::new();
        for (map, entry) in &material.entries {
            files.push(((*map).to_owned(), shelf.find(entry)?));
        }
        let own = Own::of(gathering.plant, &material.name, from_photo(&material.given));
        let source = Source { files, given: material.given.clone(), own };
        match known.iter().position(|other| other.same(&source)) {
            Some(at) => gathered.sheets[at].join(material.name, source.own.as_ref()),
            None => {
                gathered.sheets.push(shelf.sheet(&material, &source, &mut gathered.findings)?);
                known.push(source);
            }
        }
    }
    gathered.files = shelf.read.into_keys().collect();
    Ok(gathered)
}

/// Reads the maps of every room that lives on them, and settles whether it is needed: without a map it has nothing to do.
///
/// # Errors
/// As [`gather`]; [`Failure::Usage`] where a room is asked for and has no map.
pub fn settle(
    baking: &Baking,
    loaded: &Loaded,
    input: &Path,
    rows: &mut [Row],
    entries: &Entries,
    report: &mut Report,
) -> Result<BTreeMap<String, Vec<Sheet>>, Failure> {
    let mut all = BTreeMap::new();
    for row in rows.iter_mut().filter(|row| row.needed && !row.baker.needs().maps.is_empty()) {
        let room = row.baker.room();
        let gathering =
            Gathering { fields: baking.sources.fields, settings: &loaded.settings, input, plant: Some(&loaded.plant) };
        let none = Vec::new();
        let Gathered { mut sheets, findings, files } =
            gather(&gathering, row.baker, entries.get(room).unwrap_or(&none))?;
        report.find(findings);
        report.read.extend(files);
        let wants = row.baker.needs().maps;
        let lacks = |sheet: &Sheet| wants.iter().find(|map| !sheet.maps.contains_key(**map));
        if let Some((sheet, map)) = sheets.iter().find_map(|sheet| Some((sheet, lacks(sheet)?))) {
            let what = if from_photo(&sheet.given) { "no picture of its own" } else { "maps" };
            let text = format!(
                "{room}: material {} has {what} and no map of {map}: give it with --{map} {}=FILE",
                sheet.name, sheet.name
            );
            return Err(Failure::usage(text));
        }
        if sheets.is_empty() {
            let what = wants.join(", ");
            if baking.only.is_some_and(|only| only.iter().any(|name| name == room)) {
                return Err(Failure::usage(format!(
                    "{room} needs a map: --{what} FILE, or {what} in section [{room}]"
                )));
            }
            (row.needed, row.because) = (false, format!("no map of {what} is given for a leaf material"));
        }
        // How long pictures come out nobody knows before.
        row.bytes = None;
        sheets.iter_mut().for_each(|sheet| sheet.materials.sort());
        all.insert(room.to_owned(), sheets);
    }
    Ok(all)
}

/// Has every map of a layer go into the file: where nothing can lie beside it.
pub fn embed_all(layer: &mut Layer) {
    if !layer.rasters.is_empty() {
        layer.record.resolved.insert("embed_all".into(), true.into());
    }
}
