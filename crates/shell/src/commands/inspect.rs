//! `foliar inspect`: what a file holds.

use super::Call;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::Options;
use crate::outputs::{Job, is_layer};
use crate::report::Report;
use crate::runner;
use crate::said::PartTold;
use crate::{Failure, load, plan};
use foliar_bake::{Array, Layer};
use foliar_schema::{Finding, Record, Role, channel, column, names};
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Assets)?;
    let jobs: Vec<Job> = options.inputs.iter().map(|input| Job { input: input.clone(), output: None }).collect();
    runner::run(&options, &console, &jobs, &mut |job, report| {
        report.text = Some(String::new());
        let held = if is_layer(&job.input) {
            layer_file(&job.input, report)?
        } else {
            asset(&sources, &options, &job.input, report)?
        };
        console.log(&report.lap("read"));
        report.told.held = Some(held.clone());
        report.answer(text(&held).trim_end(), &held)
    })
}

/// What a file holds.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Held {
    /// The file as it was named.
    file: String,
    /// blake3 of its base; a layer alone has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<String>,
    /// How many leaves; null where nobody has looked for them.
    leaves: Option<usize>,
    /// Parts of the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    parts: Option<Vec<PartTold>>,
    /// Its layers.
    rooms: Vec<RoomHeld>,
    /// What was noticed while reading it.
    #[serde(skip_serializing_if = "Option::is_none")]
    findings: Option<Vec<Finding>>,
}

/// Record and arrays of a layer.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RoomHeld {
    /// The room.
    room: String,
    /// Its record, whole.
    record: Record,
    /// Channels, then columns, then maps.
    channels: Vec<Statistics>,
    /// Pictures that are passed on as they came.
    pictures: Vec<PictureHeld>,
}

/// A picture that is passed on.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PictureHeld {
    /// Its name.
    name: String,
    /// Its size.
    bytes: usize,
}

/// Numbers of a channel, a column or a map.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Statistics {
    /// Least of all its numbers; null where there are none.
    min: Option<f64>,
    /// Their mean.
    mean: Option<f64>,
    /// The greatest.
    max: Option<f64>,
    /// The same of each, where several numbers belong together.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    components: Vec<Spread>,
    /// Channel, property or map.
    name: String,
    /// Primitive, class, or size.
    place: String,
    /// Unit; empty where there is none.
    unit: String,
    /// How many vertices, rows or texels.
    rows: usize,
    /// Numbers of each.
    width: usize,
}

/// Least, mean and greatest; of no numbers null.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Spread {
    /// The least.
    min: Option<f64>,
    /// The mean.
    mean: Option<f64>,
    /// The greatest.
    max: Option<f64>,
}

fn layer_file(input: &Path, report: &mut Report) -> Result<Held, Failure> {
    let layer = load::layer(input)?;
    report.read.push(input.to_path_buf());
    let (leaves, rooms) = (leaves(&layer), vec![room(&layer)]);
    Ok(Held { file: input.display().to_string(), base: None, leaves, parts: None, rooms, findings: None })
}

fn asset(sources: &Sources, options: &Options, input: &Path, report: &mut Report) -> Result<Held, Failure> {
    let asset = load::asset(sources, options, input)?;
    report.asset(&asset);
    let structure = asset.layers.iter().find(|layer| layer.record.room == names::ROOM_STRUCTURE);
    let role = |part: &foliar_plant::Part| structure.and_then(|layer| layer.roles.get(&part.place)).copied();
    Ok(Held {
        file: input.display().to_string(),
        leaves: structure.and_then(leaves),
        parts: Some(asset.base.parts.iter().map(|part| PartTold::of(part, role(part))).collect()),
        rooms: asset.layers.iter().map(room).collect(),
        findings: Some(report.findings.clone()),
        base: Some(asset.base_hash),
    })
}

fn leaves(layer: &Layer) -> Option<usize> {
    let is_structure = layer.record.room == names::ROOM_STRUCTURE;
    is_structure.then(|| layer.column(names::CLASS_LEAF, "area").map_or(0, Array::rows))
}

fn room(layer: &Layer) -> RoomHeld {
    let attributes = layer.attributes.iter().map(|(key, array)| {
        let place = format!("mesh {} primitive {}", key.place.mesh, key.place.primitive);
        statistics(&key.name, &place, channel(&key.name).map_or("", |info| info.unit), array)
    });
    let columns = layer.columns.iter().map(|(key, array)| {
        let unit = column(&key.class, &key.property).map_or("", |info| info.unit);
        statistics(&key.property, &key.class, unit, array)
    });
    let rasters = layer.rasters.iter().map(|(name, raster)| {
        let array = Array::F32 { width: raster.channels.max(1) as usize, data: raster.data.clone() };
        statistics(name, &format!("map of {} x {} texels", raster.width, raster.height), "", &array)
    });
    let pictures = layer.pictures.iter();
    RoomHeld {
        room: layer.record.room.clone(),
        record: layer.record.clone(),
        channels: attributes.chain(columns).chain(rasters).collect(),
        pictures: pictures.map(|(name, bytes)| PictureHeld { name: name.clone(), bytes: bytes.len() }).collect(),
    }
}

fn statistics(name: &str, place: &str, unit: &str, array: &Array) -> Statistics {
    let values: Vec<f64> = match array {
        Array::F32 { data, .. } => data.iter().copied().map(f64::from).collect(),
        Array::I32 { data, .. } => data.iter().copied().map(f64::from).collect(),
    };
    let width = array.width();
    let one = |c: usize| spread(&values.iter().skip(c).step_by(width).copied().collect::<Vec<_>>());
    let components = if width > 1 { (0..width).map(one).collect() } else { Vec::new() };
    let Spread { min, mean, max } = spread(&values);
    let [name, place, unit] = [name, place, unit].map(str::to_owned);
    Statistics { min, mean, max, components, name, place, unit, rows: array.rows(), width }
}

/// Least, mean and greatest of numbers.
fn spread(values: &[f64]) -> Spread {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
    let mean = values.iter().copied().collect::<foliar_numerics::CompensatedSum>().value() / values.len() as f64;
    let [min, mean, max] = [low, mean, high].map(|number| Some(number).filter(|number| number.is_finite()));
    Spread { min, mean, max }
}

fn text(held: &Held) -> String {
    let leaves = held.leaves.map_or_else(|| "-".into(), |leaves| leaves.to_string());
    let mut text = format!("{}: {leaves} leaves\n", held.file);
    let parts = held.parts.as_deref().unwrap_or_default();
    if !parts.is_empty() {
        let heads = ["name", "role", "mesh", "primitive", "vertices", "triangles"];
        text.push_str(&rows(heads, parts, |part| {
            let role = part.role.map_or("-", Role::name).to_owned();
            let [vertices, triangles] = [part.vertices, part.triangles].map(|count| count.to_string());
            [part.name.clone(), role, part.mesh.to_string(), part.primitive.to_string(), vertices, triangles]
        }));
    }
    for RoomHeld { room, record, channels, pictures } in &held.rooms {
        let given = serde_json::Value::Object(record.given.clone());
        text.push_str(&format!("\n{room} version {}, given {given}\n", record.version));
        text.push_str(&rows(["name", "place", "rows", "unit", "min", "mean", "max"], channels, cells));
        for PictureHeld { name, bytes } in pictures {
            text.push_str(&format!("picture {name}, {bytes} bytes\n"));
        }
        for error in &record.errors {
            text.push_str(&format!(
                "error of {}: rms {:.4}, 99.9 % {:.4} visible steps ({} places)\n",
                error.channel, error.rms_steps, error.p999_steps, error.places
            ));
        }
    }
    text
}

fn rows<const N: usize, T>(heads: [&str; N], items: &[T], cells: impl Fn(&T) -> [String; N]) -> String {
    plan::columns(&std::iter::once(heads.map(String::from)).chain(items.iter().map(cells)).collect::<Vec<_>>())
}

/// Where several numbers belong together, each has its own.
fn cells(told: &Statistics) -> [String; 7] {
    let number = |value: Option<f64>| value.map_or_else(|| "-".into(), |value| format!("{value:.4}"));
    let each = |own: Option<f64>, of: fn(&Spread) -> Option<f64>| match told.components.as_slice() {
        [] => number(own),
        all => all.iter().map(|one| number(of(one))).collect::<Vec<_>>().join(" "),
    };
    let [min, mean, max] = [each(told.min, |s| s.min), each(told.mean, |s| s.mean), each(told.max, |s| s.max)];
    [told.name.clone(), told.place.clone(), told.rows.to_string(), told.unit.clone(), min, mean, max]
}
