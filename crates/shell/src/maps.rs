//! Maps of leaf materials: from texts (`FILE`, `MATERIAL=FILE`) to numbers, one set for each material, or for several that
//! share all of it. What a record keeps of a file is its name, from the asset's folder on, and its hash; a re-bake
//! finds it by that.

use crate::Failure;
use crate::bake_one::Baking;
use crate::config::{Fields, Given, Origin, Settings, from_text};
use crate::load::Loaded;
use crate::options::is_dash;
use crate::plan::Row;
use crate::report::Report;
use foliar_bake::{Baker, FloatRaster, Layer, MapRaster, Maps};
use foliar_plant::{AlphaMode, Plant};
use foliar_schema::{Finding, Import, Role, code, names};
use globset::{GlobBuilder, GlobMatcher};
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Parameters that say which material a map or another parameter belongs to.
const MATERIAL: &str = "material";
const FOR_MATERIAL: &str = "for_material";
/// Alpha of a blended material from which it counts as leaf.
const BLEND_CUTOFF: f32 = 0.5;

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

/// What makes two sets of maps the same: the file of each map, and what was given for them.
type Source = (Vec<(String, PathBuf)>, Map<String, Value>);

/// Reads the maps of a room.
///
/// # Errors
/// [`Failure`] with the file, or with the leaf materials that there are.
pub fn gather(gathering: &Gathering, baker: &dyn Baker, entries: &[Entry]) -> Result<Gathered, Failure> {
    let mut gathered = Gathered::default();
    let wanted = match gathering.plant {
        Some(plant) => by_material(gathering, baker, entries, plant, &mut gathered.findings)?,
        None => vec![alone(gathering, baker, entries)?],
    };
    let mut shelf = Shelf { gathering, read: BTreeMap::new() };
    let mut known: Vec<Source> = Vec::new();
    for material in wanted {
        let mut files = Vec::new();
        for (map, entry) in &material.entries {
            files.push(((*map).to_owned(), shelf.find(entry)?));
        }
        let key = (files, material.given.clone());
        // Alpha of the material's own color makes it a set of its own.
        let own_alpha = own_alpha(gathering.plant, &material.name);
        match known.iter().position(|other| *other == key).filter(|_| own_alpha.is_none()) {
            Some(at) => gathered.sheets[at].materials.push(material.name),
            None => {
                gathered.sheets.push(shelf.sheet(&material, &key.0, own_alpha, &mut gathered.findings)?);
                known.push(key);
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
            let text = format!(
                "{room}: material {} has maps and no map of {map}: give it with --{map} {}=FILE",
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

/// The one set of maps that stand alone.
fn alone<'a>(gathering: &Gathering, baker: &dyn Baker, entries: &'a [Entry]) -> Result<Wanted<'a>, Failure> {
    let mut of_map: BTreeMap<&str, &Entry> = BTreeMap::new();
    for entry in entries {
        if let Some(other) = of_map.insert(&entry.map, entry) {
            let text = format!(
                "map {} is given twice, {} and {}: without a tree one leaf is baked at a time",
                entry.map,
                other.file.display(),
                entry.file.display()
            );
            return Err(Failure::usage(text));
        }
    }
    if let Some(entry) = of_map.get(names::MAP_BACKLIT) {
        let text = format!("{}: a backlit photograph is passed on into a tree: name the tree", entry.origin);
        return Err(Failure::usage(text));
    }
    Ok(Wanted { name: String::new(), entries: of_map, given: own_given(gathering, baker, None)? })
}

/// Names of the leaf materials of a plant, in the order of the file.
fn leaf_materials(plant: &Plant) -> Vec<String> {
    let parts = plant.parts().iter().enumerate().filter(|(index, _)| plant.role(*index) == Role::Leaf);
    let used: BTreeSet<u32> = parts.filter_map(|(_, part)| part.material).collect();
    let mut found: Vec<String> = Vec::new();
    for index in used {
        let name = material_name(plant, index);
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// The name of a material, or its number in words, as the carrier links it.
fn material_name(plant: &Plant, index: u32) -> String {
    let own = plant.base().materials.get(index as usize).and_then(|material| material.name.clone());
    own.filter(|name| !name.is_empty()).unwrap_or_else(|| format!("material {index}"))
}

fn by_material<'a>(
    gathering: &Gathering,
    baker: &dyn Baker,
    entries: &'a [Entry],
    plant: &Plant,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Wanted<'a>>, Failure> {
    let leaves = leaf_materials(plant);
    let listed = || if leaves.is_empty() { "none".to_owned() } else { leaves.join(", ") };
    let unnamed = unnamed_patterns(gathering, baker)?;
    let mut of: BTreeMap<&str, BTreeMap<&str, &Entry>> = BTreeMap::new();
    for entry in entries {
        let patterns = match &entry.pattern {
            Some(text) => vec![Pattern::new(text)?],
            None => unnamed.clone(),
        };
        let hit: Vec<&String> = leaves.iter().filter(|name| patterns.iter().any(|p| p.matches(name))).collect();
        let hit = match (patterns.is_empty(), leaves.as_slice()) {
            (true, [only]) => vec![only],
            (true, []) => Vec::new(),
            (true, _) => {
                let text = format!(
                    "map {} ({}): the tree has {} leaf materials, {}: say which with --material NAME or NAME=FILE",
                    entry.map,
                    entry.origin,
                    leaves.len(),
                    listed()
                );
                return Err(Failure::usage(text));
            }
            _ => hit,
        };
        if hit.is_empty() {
            let text = format!(
                "map {} {} ({}) is for no leaf material of this tree; there are: {}",
                entry.map,
                entry.file.display(),
                entry.origin,
                listed()
            );
            if matches!(entry.origin, Origin::Flag(_)) {
                return Err(Failure::usage(text));
            }
            findings.push(Finding::new(&code::MAP_UNUSED, text));
        }
        for name in hit {
            let maps = of.entry(name.as_str()).or_default();
            if let Some(other) = maps.insert(&entry.map, entry) {
                let text = format!(
                    "map {} of material {name} is given twice, {} and {}: give one of them",
                    entry.map,
                    other.file.display(),
                    entry.file.display()
                );
                return Err(Failure::usage(text));
            }
        }
    }
    let wanted = leaves.iter().filter_map(|name| Some((name, of.remove(name.as_str())?)));
    let wanted = wanted.map(|(name, entries)| {
        Ok(Wanted { name: name.clone(), entries, given: own_given(gathering, baker, Some(name))? })
    });
    wanted.collect()
}

/// A pattern over names of materials, case ignored, as patterns of roles are.
#[derive(Clone)]
struct Pattern(GlobMatcher, String);

impl Pattern {
    fn new(text: &str) -> Result<Pattern, Failure> {
        let glob = GlobBuilder::new(&text.to_lowercase()).build();
        let glob = glob.map_err(|e| Failure::usage(format!("material {text:?}: is no pattern: {}", e.kind())))?;
        Ok(Pattern(glob.compile_matcher(), text.to_lowercase()))
    }

    fn matches(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        // A name that holds what a pattern takes for special still means itself.
        self.1 == name || self.0.is_match(name)
    }
}

fn texts<'a>(gathering: &'a Gathering, baker: &dyn Baker, key: &str) -> impl Iterator<Item = (&'a str, &'a Given)> {
    let given = gathering.settings.get(&format!("{}.{key}", baker.room()));
    given.into_iter().flat_map(|given| {
        given.value.as_array().into_iter().flatten().filter_map(Value::as_str).map(move |text| (text, given))
    })
}

/// Patterns of materials that maps without a name belong to.
fn unnamed_patterns(gathering: &Gathering, baker: &dyn Baker) -> Result<Vec<Pattern>, Failure> {
    texts(gathering, baker, MATERIAL).map(|(text, _)| Pattern::new(text)).collect()
}

/// What was given for a material: the section, and over it what is for this material alone.
fn own_given(gathering: &Gathering, baker: &dyn Baker, name: Option<&str>) -> Result<Map<String, Value>, Failure> {
    let mut given = gathering.settings.given(baker.room());
    for field in gathering.fields.section(baker.room()).filter(|field| field.map.is_some()) {
        given.shift_remove(field.path.last().map_or("", String::as_str));
    }
    given.shift_remove(MATERIAL);
    given.shift_remove(FOR_MATERIAL);
    for (text, from) in texts(gathering, baker, FOR_MATERIAL) {
        let refuse = |why: String| Failure::usage(format!("{}: {FOR_MATERIAL} {text:?}: {why}", from.origin));
        let form = || refuse("must be MATERIAL:KEY=VALUE, such as Needle*:leaf_width_mm=2".into());
        let (place, value) = text.split_once('=').ok_or_else(form)?;
        let (pattern, key) = place.rsplit_once(':').ok_or_else(form)?;
        let field = gathering.fields.find(&format!("{}.{}", baker.room(), key.trim())).map_err(refuse)?;
        if field.map.is_some() || [MATERIAL, FOR_MATERIAL].contains(&key.trim()) {
            return Err(refuse("maps are given as MATERIAL=FILE".into()));
        }
        let value = from_text(field, value.trim()).map_err(refuse)?;
        if name.is_none_or(|name| Pattern::new(pattern.trim()).is_ok_and(|p| p.matches(name))) {
            given.insert(key.trim().into(), value);
        }
    }
    Ok(given)
}

/// A file that was read.
struct Found {
    hash: String,
    bytes: Vec<u8>,
}

/// Files, each read once.
struct Shelf<'a> {
    gathering: &'a Gathering<'a>,
    read: BTreeMap<PathBuf, Found>,
}

impl Shelf<'_> {
    /// Where a map lies: as it was given, or, by its name, in the asset's folder or a searched one.
    fn find(&self, entry: &Entry) -> Result<PathBuf, Failure> {
        if !matches!(entry.origin, Origin::Record(_)) {
            return Ok(entry.file.clone());
        }
        let input = self.gathering.input;
        let folder = if is_dash(input) { Path::new("") } else { input.parent().unwrap_or(Path::new("")) };
        let search = self.gathering.settings.section::<Import>("import")?.search;
        let file = foliar_carrier::paths::resolve(&entry.name, folder, &search, &entry.origin.to_string())?;
        if file.is_file() {
            return Ok(file);
        }
        let remedy = format!("put it there, name its folder with --search, or give it again with --{}", entry.map);
        Err(Failure::Input(format!("map {} ({}) is not there: {remedy}", file.display(), entry.origin)))
    }

    fn read(&mut self, file: &Path) -> Result<&Found, Failure> {
        if !self.read.contains_key(file) {
            let unreadable = |e| {
                let remedy = "name a readable PNG, TIFF or EXR";
                Failure::Input(format!("{}: cannot be read: {e}: {remedy}", file.display()))
            };
            let bytes = std::fs::read(file).map_err(unreadable)?;
            let hash = blake3::hash(&bytes).to_hex().to_string();
            self.read.insert(file.to_path_buf(), Found { hash, bytes });
        }
        Ok(&self.read[file])
    }

    fn sheet(
        &mut self,
        wanted: &Wanted,
        files: &[(String, PathBuf)],
        own_alpha: Option<MapRaster>,
        findings: &mut Vec<Finding>,
    ) -> Result<Sheet, Failure> {
        let mut sheet = Sheet {
            name: wanted.name.clone(),
            materials: vec![wanted.name.clone()],
            given: wanted.given.clone(),
            files: files.iter().cloned().collect(),
            ..Sheet::default()
        };
        let mut alpha = None;
        for (map, file) in files {
            let name = file.display().to_string();
            let found = self.read(file)?;
            let entry = wanted.entries.get(map.as_str());
            sheet.reads.insert(format!("map/{}", entry.map_or(map.as_str(), |e| &e.name)), found.hash.clone());
            if map == names::MAP_BACKLIT {
                sheet.pictures.insert(names::PICTURE_COLOR.into(), photograph(&found.bytes, &name)?);
                continue;
            }
            let read = foliar_carrier::images::read_map(&found.bytes, &name)?;
            findings.extend(read.findings);
            if map == names::MAP_THICKNESS {
                alpha = read.alpha;
            }
            sheet.maps.insert(map.clone(), read.map);
        }
        if !sheet.maps.contains_key(names::MAP_ALPHA)
            && let Some(thickness) = sheet.maps.get(names::MAP_THICKNESS)
        {
            let (width, height) = (thickness.raster.width, thickness.raster.height);
            let alpha = alpha.or_else(|| own_alpha.map(|own| resampled(&own, width, height)));
            sheet.maps.extend(alpha.map(|alpha| (names::MAP_ALPHA.to_owned(), alpha)));
        }
        Ok(sheet)
    }
}

/// A photograph that a glTF can hold as it is.
fn photograph(bytes: &[u8], name: &str) -> Result<Vec<u8>, Failure> {
    let format = foliar_carrier::images::sniff(bytes);
    if format.gltf_mime().is_none() {
        let text = format!("{name}: is {}, and a glTF holds PNG or JPEG: convert the photograph to PNG", format.name());
        return Err(Failure::Input(text));
    }
    foliar_carrier::images::decode(bytes, name)?;
    Ok(bytes.to_vec())
}

/// Where the color of a material says that there is leaf: 1 or 0.
fn own_alpha(plant: Option<&Plant>, name: &str) -> Option<MapRaster> {
    let base = plant?.base();
    let index =
        (0..base.materials.len() as u32).find(|index| plant.is_some_and(|p| material_name(p, *index) == name))?;
    let material = base.materials.get(index as usize)?;
    let cutoff = match material.alpha_mode {
        AlphaMode::Opaque => return None,
        AlphaMode::Mask(cutoff) => cutoff,
        AlphaMode::Blend => BLEND_CUTOFF,
    };
    let raster = base.rasters.get(material.base_color_raster? as usize).filter(|raster| raster.has_alpha)?;
    let factor = material.base_color[3];
    let alpha = |pixel: &[u8]| if f32::from(pixel[3]) / 255.0 * factor >= cutoff { 1.0 } else { 0.0 };
    let data = raster.rgba.chunks_exact(4).map(alpha).collect();
    Some(MapRaster { raster: FloatRaster { width: raster.width, height: raster.height, channels: 1, data }, bits: 8 })
}

/// A mask at another size: the texel in the middle of each.
fn resampled(mask: &MapRaster, width: u32, height: u32) -> MapRaster {
    let own = &mask.raster;
    let at = |to: u32, size: u32, from: u32| (u64::from(2 * to + 1) * u64::from(from) / u64::from(2 * size)) as usize;
    let texel = |y: u32, x: u32| own.data[at(y, height, own.height) * own.width as usize + at(x, width, own.width)];
    let data = (0..height).flat_map(|y| (0..width).map(move |x| texel(y, x))).collect();
    MapRaster { raster: FloatRaster { width, height, channels: 1, data }, bits: mask.bits }
}
