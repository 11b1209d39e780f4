//! A second reader of masters, which shares no code with the writer: it walks the JSON and the bytes
//! by the glTF specification and the contract alone, and says what does not hold. Tests run it over
//! every file that they write, since the Khronos validator cannot look inside the extensions.

mod maps;
mod packed;
mod tables;

use foliar_schema::{CHANNELS, Channel, CodeInfo, code, names};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use tables::Table;

pub use maps::maps_beside;

/// What a file was found to hold.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Rooms of its records, in their order; none where the file is no master.
    pub rooms: Vec<String>,
    /// Rows of `foliarLeaf`.
    pub leaves: usize,
    /// Primitives with a role.
    pub roles: usize,
    /// Channels over primitives that were checked value by value.
    pub attributes: usize,
}

/// How far the length of a unit vector may be from 1: each of three components is rounded to f32
/// (relative 2^-24 each), so the squared length is off by less than 4 x 2^-24; eight times that.
const UNIT_TOLERANCE: f64 = 2e-6;

/// Reads `.glb`, or `.gltf` with its first buffer beside it, and verifies it.
///
/// # Errors
/// What does not hold, with its place.
pub fn verify_file(path: &Path) -> Result<Summary, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let is_glb = bytes.starts_with(b"glTF");
    let verified = if is_glb { verify(&bytes) } else { verify_json(&bytes, path) };
    let verified = verified.and_then(|summary| verify_sides(&bytes, is_glb, path).map(|()| summary));
    verified.map_err(|problem| format!("{}: {problem}", path.display()))
}

/// What lies beside a file.
fn verify_sides(bytes: &[u8], is_glb: bool, path: &Path) -> Result<(), String> {
    let length = bytes.get(12..16).map_or(0, |b| b.iter().rev().fold(0, |sum, b| sum * 256 + usize::from(*b)));
    let (json, bin) = match is_glb {
        true => (bytes.get(20..20 + length).unwrap_or_default(), bytes.get(28 + length..).unwrap_or_default()),
        false => (bytes, &[][..]),
    };
    let json: Value = serde_json::from_slice(json).map_err(|e| e.to_string())?;
    // A .gltf has its pictures in another file: what is in them was looked at already.
    if is_glb { Master { json: &json, bin }.sides(path) } else { Ok(()) }
}

fn verify_json(bytes: &[u8], path: &Path) -> Result<Summary, String> {
    let json: Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
    let uri = json["buffers"][0]["uri"].as_str().filter(|uri| !uri.starts_with("data:"));
    let name = uri.map(|uri| percent_encoding::percent_decode_str(uri).decode_utf8_lossy().into_owned());
    let bin = name.map(|name| std::fs::read(path.with_file_name(name)).map_err(|e| e.to_string())).transpose()?;
    first(problems(&json, bin.as_deref().unwrap_or(&[])))
}

/// Verifies one GLB.
///
/// # Errors
/// What does not hold, with its place.
pub fn verify(bytes: &[u8]) -> Result<Summary, String> {
    let word = |at: usize| {
        let four = bytes.get(at..at + 4).ok_or_else(|| format!("the file ends before byte {}", at + 4))?;
        Ok::<usize, String>(four.iter().rev().fold(0, |sum, b| sum * 256 + usize::from(*b)))
    };
    ensure(bytes.starts_with(b"glTF") && word(4)? == 2 && word(8)? == bytes.len(), || "header".into())?;
    let length = word(12)?;
    ensure(length % 4 == 0 && bytes.get(16..20) == Some(b"JSON"), || "JSON chunk".into())?;
    let json = bytes.get(20..20 + length).ok_or("the JSON chunk is cut")?;
    let json: Value = serde_json::from_slice(json).map_err(|e| e.to_string())?;
    let start = 20 + length;
    let bin = if start < bytes.len() {
        ensure(bytes.get(start + 4..start + 8) == Some(b"BIN\0"), || "BIN chunk".into())?;
        ensure(start + 8 + word(start)? == bytes.len(), || "length of the BIN chunk".into())?;
        &bytes[start + 8..]
    } else {
        &[]
    };
    first(problems(&json, bin))
}

/// What does not hold at one place of a file.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Its code.
    pub code: &'static CodeInfo,
    /// JSON pointer, or empty.
    pub place: String,
    /// What does not hold, with the numbers.
    pub text: String,
}

impl Problem {
    fn at(self, place: &str) -> Self {
        Problem { place: place.into(), ..self }
    }
}

/// Names the code of what does not hold.
fn coded<T>(code: &'static CodeInfo, result: Result<T, String>) -> Result<T, Problem> {
    result.map_err(|text| Problem { code, place: String::new(), text })
}

fn first((summary, problems): (Summary, Vec<Problem>)) -> Result<Summary, String> {
    match problems.into_iter().next() {
        None => Ok(summary),
        Some(Problem { place, text, .. }) if place.is_empty() => Err(text),
        Some(Problem { place, text, .. }) => Err(format!("{place}: {text}")),
    }
}

/// Everything in a glTF that does not hold, `bin` its first buffer, and what it was found to hold.
pub fn problems(json: &Value, bin: &[u8]) -> (Summary, Vec<Problem>) {
    let mut found = Vec::new();
    let summary = Master { json, bin }.verify(&mut found);
    (summary, found)
}

fn ensure(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}

/// Whether extras mirror `value`. Where they are no object, or hold something foreign under the name
/// (told by the missing member `key`), there can be no mirror.
fn is_mirror(extras: &Value, key: &str, value: &Value) -> bool {
    let foreign = extras.get(names::EXTENSION).is_some_and(|found| found.get(key).is_none());
    !extras.is_object() || foreign || &extras[names::EXTENSION] == value
}

struct Master<'a> {
    json: &'a Value,
    bin: &'a [u8],
}

fn number(value: &Value) -> usize {
    value.as_u64().map_or(0, |n| n as usize)
}

fn items(value: &Value) -> impl Iterator<Item = (usize, &Value)> {
    value.as_array().into_iter().flatten().enumerate()
}

impl Master<'_> {
    fn verify(&self, found: &mut Vec<Problem>) -> Summary {
        let root = &self.json["extensions"][names::EXTENSION];
        if root.is_null() {
            found.extend(self.packed().err());
            return Summary::default();
        }
        found.extend(self.header(root).into_iter().filter_map(Result::err));
        let writes: BTreeSet<&str> =
            items(&root["records"]).flat_map(|(_, r)| items(&r["writes"]).filter_map(|(_, w)| w.as_str())).collect();
        let tables = self.tables(root, &writes, found);
        let mut summary = Summary {
            rooms: items(&root["records"]).filter_map(|(_, r)| r["room"].as_str().map(str::to_string)).collect(),
            leaves: tables.iter().find(|t| t.class == names::CLASS_LEAF).map_or(0, |t| t.rows),
            ..Summary::default()
        };
        let mut channels = BTreeSet::new();
        let mut is_whole = true;
        for (m, mesh) in items(&self.json["meshes"]) {
            let mut sets = BTreeSet::new();
            for (p, primitive) in items(&mesh["primitives"]) {
                match self.primitive(root, primitive, &tables) {
                    Ok((names, role)) => {
                        summary.roles += usize::from(role);
                        summary.attributes += names.len();
                        sets.insert(names);
                    }
                    Err(problem) => {
                        found.push(problem.at(&format!("/meshes/{m}/primitives/{p}")));
                        is_whole = false;
                    }
                }
            }
            let same = ensure(sets.len() <= 1, || format!("its primitives carry different channels: {sets:?}"));
            found.extend(coded(&code::CONTRACT_CHANNEL, same).map_err(|p| p.at(&format!("/meshes/{m}"))).err());
            channels.extend(sets.into_iter().flatten());
        }
        found.extend(self.maps(root, &writes));
        // A primitive that does not hold says so itself; what it carries is not known.
        found.extend(records(&writes, &channels).into_iter().filter(|_| is_whole).filter_map(Result::err));
        summary
    }

    fn packed(&self) -> Result<(), Problem> {
        let Some(engine) = packed::Packed::engine(self.json) else { return Ok(()) };
        let verified = packed::Packed { json: self.json, bin: self.bin }.verify(engine);
        coded(&code::CONTRACT_CHANNEL, verified.map_err(|e| format!("packed for {engine}: {e}")))
    }

    /// Mirror, declarations, and that each room has one record.
    fn header(&self, root: &Value) -> [Result<(), Problem>; 4] {
        let mirror = &self.json["asset"]["extras"];
        let listed = |list: &str, name: &str| items(&self.json[list]).any(|(_, v)| v == name);
        let used = ensure(listed("extensionsUsed", names::EXTENSION), || "the extension is not listed as used".into());
        let required = listed("extensionsRequired", names::EXTENSION);
        let mut rooms: Vec<&str> = items(&root["records"]).filter_map(|(_, r)| r["room"].as_str()).collect();
        rooms.sort_unstable();
        let twice = rooms.windows(2).find(|pair| pair[0] == pair[1]);
        [
            coded(
                &code::CONTRACT_MIRROR,
                ensure(is_mirror(mirror, "contract", root), || "mirror and extension differ".into()),
            ),
            coded(&code::CONTRACT_DECLARED, used),
            coded(
                &code::CONTRACT_DECLARED,
                ensure(!required, || "the extension must not be required: stock loaders would refuse the file".into()),
            ),
            coded(
                &code::CONTRACT_COLLISION,
                ensure(twice.is_none(), || format!("room {} has two records", twice.map_or("", |pair| pair[0]))),
            ),
        ]
    }

    /// Channels of a primitive, each value checked, and whether it has a role.
    fn primitive(
        &self,
        root: &Value,
        primitive: &Value,
        tables: &[Table],
    ) -> Result<(BTreeSet<&'static str>, bool), Problem> {
        let role = &primitive["extensions"][names::EXTENSION]["role"];
        let mirror = &primitive["extras"];
        let mirrors = role.is_null() || is_mirror(mirror, "role", &json!({"role": role}));
        coded(&code::CONTRACT_MIRROR, ensure(mirrors, || "role and mirror differ".into()))?;
        let known = role.is_null() || ["wood", "leaf", "other"].iter().any(|r| role == r);
        coded(&code::CONTRACT_MIRROR, ensure(known, || format!("role {role} is none of wood, leaf, other")))?;
        let attributes = &primitive["attributes"];
        let count = number(&self.json["accessors"][number(&attributes["POSITION"])]["count"]);
        let mut found = BTreeSet::new();
        for channel in CHANNELS {
            if let Some((_, label, class)) = IDS.iter().find(|ids| ids.0 == channel.name) {
                if self.ids(primitive, count, tables, (label, class))? {
                    found.insert(channel.name);
                }
                continue;
            }
            let name = root["renamed"][channel.name].as_str().unwrap_or(channel.name);
            if let Some(accessor) = attributes.get(name) {
                let values = self.floats(number(accessor), channel.width, count).map_err(|e| format!("{name}: {e}"));
                let values = coded(&code::CONTRACT_CHANNEL, values)?;
                coded(&code::CONTRACT_RANGE, check_values(channel, &values).map_err(|e| format!("{name}: {e}")))?;
                found.insert(channel.name);
            }
        }
        Ok((found, !role.is_null()))
    }

    /// Whether a primitive has ids with this label; each is a row, or the null id.
    fn ids(
        &self,
        primitive: &Value,
        count: usize,
        tables: &[Table],
        (label, class): (&str, &str),
    ) -> Result<bool, Problem> {
        let features = &primitive["extensions"][names::MESH_FEATURES]["featureIds"];
        let labeled: Vec<&Value> = items(features).map(|(_, f)| f).filter(|f| f["label"] == label).collect();
        let Some(feature) = labeled.last() else { return Ok(false) };
        let once = ensure(labeled.len() == 1, || format!("{} sets of ids have the label {label}", labeled.len()));
        coded(&code::CONTRACT_COLLISION, once)?;
        coded(&code::CONTRACT_ID, self.id_values(primitive, feature, count, tables, (label, class)))?;
        Ok(true)
    }

    fn id_values(
        &self,
        primitive: &Value,
        feature: &Value,
        count: usize,
        tables: &[Table],
        (label, class): (&str, &str),
    ) -> Result<(), String> {
        let table =
            feature["propertyTable"].as_u64().map(|t| tables.get(t as usize).ok_or("no such table")).transpose()?;
        let own = tables.iter().find(|t| t.class == class);
        ensure(table.is_none_or(|t| t.class == class), || format!("{label}: its ids name another table"))?;
        let rows = table.or(own).map_or(0, |t| t.rows);
        ensure(number(&feature["featureCount"]) == rows.max(1), || format!("featureCount is not {rows}"))?;
        let null = number(&feature["nullFeatureId"]);
        ensure(null == rows, || format!("nullFeatureId {null} is not {rows}, the number of rows"))?;
        let attribute = format!("{}{}", names::FEATURE_ID_PREFIX, number(&feature["attribute"]));
        let accessor = primitive["attributes"][&attribute].as_u64().ok_or(format!("{attribute} does not exist"))?;
        let ids = self.floats(accessor as usize, 1, count)?;
        let bad = ids.iter().find(|id| id.fract() != 0.0 || **id < 0.0 || **id > null as f64);
        ensure(bad.is_none(), || format!("{label}: id {bad:?} is no row of {rows}"))
    }

    /// All values of a float accessor of foliar.
    fn floats(&self, accessor: usize, width: usize, count: usize) -> Result<Vec<f64>, String> {
        let accessor = &self.json["accessors"][accessor];
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"][width];
        ensure(accessor["type"] == kind && accessor["componentType"] == 5126, || format!("no {kind} of floats"))?;
        ensure(number(&accessor["count"]) == count, || format!("count is not {count}, that of POSITION"))?;
        let view = &self.json["bufferViews"][number(&accessor["bufferView"])];
        ensure(view["name"].as_str().is_some_and(|n| n.starts_with(names::VIEW_PREFIX)), || {
            "its view is not foliar's".into()
        })?;
        ensure(view["target"] == 34962, || "its view has no target".into())?;
        let bytes = self.view(view, 4)?;
        let (stride, offset) = (number(&view["byteStride"]).max(width * 4), number(&accessor["byteOffset"]));
        (0..count)
            .flat_map(|i| {
                (0..width).map(move |c| i.saturating_mul(stride).saturating_add(offset).saturating_add(c * 4))
            })
            .map(|at| float(bytes, at).ok_or_else(|| format!("byte {at} lies outside its view")))
            .collect()
    }

    fn view(&self, view: &Value, alignment: usize) -> Result<&[u8], String> {
        let (offset, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
        ensure(view["buffer"] == 0 && offset % alignment == 0, || format!("view {view} is misplaced"))?;
        self.bin
            .get(offset..offset.saturating_add(length))
            .ok_or_else(|| format!("view {view} reaches past its buffer"))
    }
}

/// Records and channels name each other.
fn records(writes: &BTreeSet<&str>, channels: &BTreeSet<&'static str>) -> [Result<(), Problem>; 2] {
    let missing: Vec<_> = writes.iter().filter(|w| !w.contains('/') && !channels.contains(**w)).collect();
    let extra: Vec<_> = channels.iter().filter(|name| !writes.contains(**name)).collect();
    [
        ensure(missing.is_empty(), || format!("records name channels that no primitive has: {missing:?}")),
        ensure(extra.is_empty(), || format!("no record names the channels {extra:?}")),
    ]
    .map(|result| coded(&code::CONTRACT_RECORD, result))
}

/// Channels that are ids, with label and table class.
const IDS: [(&str, &str, &str); 2] = [
    (names::LEAF_ID, names::LABEL_LEAF, names::CLASS_LEAF),
    (names::BRANCH_ID, names::LABEL_BRANCH, names::CLASS_BRANCH),
];

fn float(bytes: &[u8], at: usize) -> Option<f64> {
    let four: [u8; 4] = bytes.get(at..at + 4)?.try_into().ok()?;
    Some(f64::from(f32::from_le_bytes(four)))
}

fn is_unit(vector: &[f64]) -> bool {
    (vector.iter().map(|v| v * v).sum::<f64>().sqrt() - 1.0).abs() <= UNIT_TOLERANCE
}

fn check_values(channel: &Channel, values: &[f64]) -> Result<(), String> {
    let (low, high) = (f64::from(channel.min), f64::from(channel.max));
    let bad = values.iter().find(|v| !(**v >= low && **v <= high));
    ensure(bad.is_none(), || format!("{} is outside {low} to {high}", bad.copied().unwrap_or_default()))?;
    let unit = !channel.unit_length || values.chunks(channel.width).all(is_unit);
    ensure(unit, || "a vector is not unit".into())
}
