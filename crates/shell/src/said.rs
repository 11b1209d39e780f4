//! What programs say to machines: the report of `--report`, the lines of `--format json`, and the schemas of both.
//! What a command has nothing for is left out.

use crate::commands::{Compared, Explained, Held, Looked, Valued};
use crate::options::{Mode, Options};
use crate::runner::Status;
use foliar_pack::PackReport;
use foliar_plant::Part;
use foliar_schema::{Finding, MeasuredError, Role};
use schemars::{JsonSchema, SchemaGenerator, generate::SchemaSettings};
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What `--report FILE.json` holds: what was read, found, made and measured.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reports<'a> {
    /// Version of the program.
    pub foliar: &'static str,
    /// One entry per input that was tried, in their order.
    pub assets: &'a [AssetReport],
}

/// Everything about one input.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AssetReport {
    /// The input as it was named.
    pub asset: String,
    /// Where its product goes, or nothing for what only answers.
    pub output: Option<String>,
    /// What kind of file it is: `obj`, `gltf` or `glb`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source: Option<&'static str>,
    /// blake3 of its base: everything but what foliar wrote.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// Its parts, with their roles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<Vec<PartTold>>,
    /// How many leaves it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leaves: Option<usize>,
    /// Every file of the asset that was read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub files: Option<Vec<String>>,
    /// What a packed file costs and lost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pack: Option<PackReport>,
    /// The same in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub packed: Option<String>,
    /// Branches that were found, and how sure each is (docs/branches.md).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Map<String, Value>")]
    pub branches: Option<Value>,
    /// What was to be done, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plan: Option<Vec<Step>>,
    /// What the rooms made, or the layers that were put together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rooms: Option<Vec<RoomTold>>,
    /// Figures that `--measure` asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<Value>,
    /// Facts of what was baked from maps or a scan: scales, sizes, ranges.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facts: Option<Map<String, Value>>,
    /// What `foliar inspect` found in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held: Option<Held>,
    /// Every parameter by its name, of `foliar config`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BTreeMap<String, Valued>")]
    pub configuration: Option<Map<String, Value>>,
    /// What became of it.
    pub status: Status,
    /// Every file that belongs to the output.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outputs: Option<Vec<String>>,
    /// Exit status that its failure alone has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exit: Option<u8>,
    /// Why it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Everything that was noticed.
    pub findings: Vec<Finding>,
    /// Seconds of each stage, in their order.
    #[schemars(with = "BTreeMap<String, f64>")]
    pub stages: Map<String, Value>,
    /// Seconds in all.
    pub seconds: f64,
}

/// One part of a plant.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct PartTold {
    /// Its name: material, else node, else mesh.
    pub name: String,
    /// Index of its mesh.
    pub mesh: u32,
    /// Index of its primitive in the mesh.
    pub primitive: u32,
    /// What it was taken for; null where nobody has said yet.
    pub role: Option<Role>,
    /// Its vertices.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: usize,
    /// How sure its role is, 0 to 1; where it was found afresh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub confidence: Option<f64>,
    /// Its connected pieces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pieces: Option<usize>,
    /// Whether it is closed blobs that stand for foliage.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crown_volume: Option<bool>,
    /// Every reason for a role.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Vec<Reason>>,
}

impl PartTold {
    /// What can be counted in a part.
    pub fn of(part: &Part, role: Option<Role>) -> Self {
        PartTold {
            name: part.name().into(),
            mesh: part.place.mesh,
            primitive: part.place.primitive,
            role,
            vertices: part.positions.len(),
            triangles: part.triangles.len(),
            confidence: None,
            pieces: None,
            crown_volume: None,
            evidence: None,
        }
    }
}

/// One reason to believe in a role.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reason {
    /// The role that it speaks for.
    pub role: Role,
    /// How much it says: natural logarithm of the odds.
    pub weight: f64,
    /// What was seen.
    pub reason: String,
}

/// One line of a plan.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Step {
    /// A baker, needed or not.
    Bakes(Bakes),
    /// A file that would be written.
    Writes(Writes),
}

/// A baker in a plan.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Bakes {
    /// Its room.
    pub baker: String,
    /// Whether it is baked.
    pub needed: bool,
    /// Why, or why not.
    pub because: String,
    /// Every parameter; one that the room settles itself says by what.
    #[schemars(with = "Map<String, Value>")]
    pub parameters: Value,
    /// Bytes that it adds; null where the room cannot tell.
    pub bytes: Option<u64>,
    /// Seconds that it will take, roughly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds_estimated: Option<f64>,
    /// Where branches come from: `found`, `file` or `cache`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<&'static str>,
}

/// A file that would be written.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Writes {
    /// Its path.
    pub writes: String,
    /// What it would be.
    pub what: String,
}

/// What is said of a room.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum RoomTold {
    /// It baked.
    Baked(Box<Baked>),
    /// Its layer was put onto the base as it was.
    Put(Put),
}

impl RoomTold {
    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            RoomTold::Baked(baked) => &baked.room,
            RoomTold::Put(put) => &put.room,
        }
    }
}

/// What a room made.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Baked {
    /// The room.
    pub room: String,
    /// Its version.
    pub version: u32,
    /// Bytes that the plan expected.
    pub bytes_predicted: Option<u64>,
    /// Bytes that it has in the file.
    pub bytes_written: u64,
    /// Seconds that the plan expected.
    pub seconds_estimated: f64,
    /// Seconds that it took.
    pub seconds: f64,
    /// Whether it came from the cache.
    pub cached: bool,
    /// Parameters that a person gave.
    pub given: Map<String, Value>,
    /// Every parameter as it was used.
    pub resolved: Map<String, Value>,
    /// Scales, bounds, reference values.
    pub facts: Map<String, Value>,
    /// Errors against the reference.
    pub errors: Vec<MeasuredError>,
    /// Channels and `class/property` columns.
    pub writes: Vec<String>,
}

/// A layer that was put onto a base.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Put {
    /// Its room.
    pub room: String,
    /// The room's version when it was baked.
    pub version: u32,
}

/// The line that `--format json` prints for an input: of commands that write, and of whatever failed.
#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line<'a> {
    /// The input as it was named.
    asset: &'a str,
    /// Where its product goes, or nothing for what only answers.
    output: Option<&'a str>,
    /// What became of it.
    status: Status,
    /// Exit status that its failure alone has.
    #[serde(skip_serializing_if = "Option::is_none")]
    exit: Option<u8>,
    /// Why it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    /// Every file that belongs to the output.
    #[serde(skip_serializing_if = "Option::is_none")]
    outputs: Option<&'a [String]>,
    /// How many leaves it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    leaves: Option<usize>,
    /// What a packed file costs and lost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pack: Option<&'a PackReport>,
    /// Figures that `--measure` asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    measured: Option<&'a Value>,
    /// Everything that was noticed.
    findings: &'a [Finding],
    /// Seconds in all.
    seconds: f64,
    /// What would be done, with `--dry-run`.
    #[serde(skip_serializing_if = "Option::is_none")]
    plan: Option<&'a [Step]>,
    /// Parts with their roles, with `--explain-roles`.
    #[serde(skip_serializing_if = "Option::is_none")]
    parts: Option<&'a [PartTold]>,
    /// Report, rules and lists that were written beside.
    #[serde(skip_serializing_if = "Option::is_none")]
    lists: Option<Vec<String>>,
}

impl<'a> Line<'a> {
    /// What a report says in one line; the plan and the roles where they were asked for.
    pub fn of(report: &'a AssetReport, options: &Options, lists: &[PathBuf]) -> Self {
        let is_plan = options.mode == Mode::DryRun;
        Line {
            asset: &report.asset,
            output: report.output.as_deref(),
            status: report.status,
            exit: report.exit,
            error: report.error.as_deref(),
            outputs: report.outputs.as_deref(),
            leaves: report.leaves,
            pack: report.pack.as_ref(),
            measured: report.measured.as_ref(),
            findings: &report.findings,
            seconds: report.seconds,
            plan: report.plan.as_deref().filter(|_| is_plan),
            parts: report.parts.as_deref().filter(|_| options.explain_roles),
            lists: (!lists.is_empty()).then(|| lists.iter().map(|list| list.display().to_string()).collect()),
        }
    }
}

/// JSON Schemas of everything that a program says, by file name.
pub fn schemas() -> [(&'static str, Value); 7] {
    [
        ("foliar-report", settings().into_generator().into_root_schema_for::<Reports>().to_value()),
        ("foliar-line", settings().into_generator().into_root_schema_for::<Line>().to_value()),
        ("foliar-check", answer::<Looked>("foliar-check --format json")),
        ("foliar-inspect", answer::<Held>("foliar inspect --format json")),
        ("foliar-diff", answer::<Compared>("foliar diff --format json")),
        ("foliar-config", answer::<BTreeMap<String, Valued>>("foliar config --format json")),
        ("foliar-explain", answer::<Vec<Explained>>("foliar explain --format json")),
    ]
}

/// What is written, not what could be read.
fn settings() -> SchemaSettings {
    SchemaSettings::draft2020_12().for_serialize()
}

/// A line of a command that answers: its answer, or how an input failed.
fn answer<T: JsonSchema>(title: &str) -> Value {
    let mut generator: SchemaGenerator = settings().into_generator();
    let either = [generator.subschema_for::<T>(), generator.subschema_for::<Line>()];
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "description": "One line per input: the answer, or how the input failed",
        "anyOf": either,
        "$defs": generator.take_definitions(true),
    })
}
