//! `foliar inspect`: what a file holds.

use super::Call;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::Options;
use crate::outputs::{Job, is_layer};
use crate::report::Report;
use crate::runner::{self, Product};
use crate::{Failure, load, plan};
use foliar_bake::{Array, Layer};
use foliar_plant::Base;
use foliar_schema::{channel, column, names};
use serde_json::{Value, json};
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
        report.text = Some(text(&held).trim_end().into());
        report.set("held", held.clone());
        report.answer = Some(held);
        Ok(Product::Answer)
    })
}

fn layer_file(input: &Path, report: &mut Report) -> Result<Value, Failure> {
    let layer = load::layer(input)?;
    report.read.push(input.to_path_buf());
    Ok(json!({
        "file": input.display().to_string(),
        "leaves": leaves(&layer),
        "rooms": [room(&layer)],
    }))
}

fn asset(sources: &Sources, options: &Options, input: &Path, report: &mut Report) -> Result<Value, Failure> {
    let asset = load::asset(sources, options, input)?;
    report.asset(&asset);
    let structure = asset.layers.iter().find(|layer| layer.record.room == names::ROOM_STRUCTURE);
    Ok(json!({
        "file": input.display().to_string(),
        "base": asset.base_hash,
        "leaves": structure.and_then(leaves),
        "parts": parts(&asset.base, structure),
        "rooms": asset.layers.iter().map(room).collect::<Vec<_>>(),
        "findings": report.findings,
    }))
}

fn leaves(layer: &Layer) -> Option<usize> {
    let is_structure = layer.record.room == names::ROOM_STRUCTURE;
    is_structure.then(|| layer.column(names::CLASS_LEAF, "area").map_or(0, Array::rows))
}

fn parts(base: &Base, structure: Option<&Layer>) -> Vec<Value> {
    let one = |part: &foliar_plant::Part| {
        json!({
            "name": part.name(),
            "mesh": part.place.mesh,
            "primitive": part.place.primitive,
            "role": structure.and_then(|layer| layer.roles.get(&part.place)).map(|role| role.name()),
            "vertices": part.positions.len(),
            "triangles": part.triangles.len(),
        })
    };
    base.parts.iter().map(one).collect()
}

/// Record and arrays of a layer.
fn room(layer: &Layer) -> Value {
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
    let pictures = layer.pictures.iter().map(|(name, bytes)| json!({"name": name, "bytes": bytes.len()}));
    json!({
        "room": layer.record.room,
        "record": layer.record,
        "channels": attributes.chain(columns).chain(rasters).collect::<Vec<_>>(),
        "pictures": pictures.collect::<Vec<_>>(),
    })
}

fn statistics(name: &str, place: &str, unit: &str, array: &Array) -> Value {
    let values: Vec<f64> = match array {
        Array::F32 { data, .. } => data.iter().copied().map(f64::from).collect(),
        Array::I32 { data, .. } => data.iter().copied().map(f64::from).collect(),
    };
    let width = array.width();
    let mut told = spread(&values);
    if width > 1 {
        let one = |c: usize| spread(&values.iter().skip(c).step_by(width).copied().collect::<Vec<_>>());
        told["components"] = (0..width).map(one).collect();
    }
    for (key, value) in [
        ("name", json!(name)),
        ("place", json!(place)),
        ("unit", json!(unit)),
        ("rows", json!(array.rows())),
        ("width", json!(width)),
    ] {
        told[key] = value;
    }
    told
}

/// Least, mean and greatest of numbers; of none JSON says null.
fn spread(values: &[f64]) -> Value {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
    let mean = values.iter().copied().collect::<foliar_numerics::CompensatedSum>().value() / values.len() as f64;
    json!({ "min": low, "mean": mean, "max": high })
}

fn text(held: &Value) -> String {
    let word = |value: &Value| match value {
        Value::Null => "-".to_owned(),
        Value::String(text) => text.clone(),
        Value::Number(n) if n.is_f64() => format!("{:.4}", n.as_f64().unwrap_or_default()),
        other => other.to_string(),
    };
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    fn rows<const N: usize>(items: &[Value], names: [&str; N], cell: impl Fn(&Value, &str) -> String) -> String {
        let cells = items.iter().map(|item| names.map(|name| cell(item, name)));
        plan::columns(&std::iter::once(names.map(String::from)).chain(cells).collect::<Vec<_>>())
    }
    let plain = |item: &Value, name: &str| word(&item[name]);
    // Where several numbers belong together, each has its own.
    let each = |item: &Value, name: &str| match item["components"].as_array() {
        Some(all) if ["min", "mean", "max"].contains(&name) => {
            all.iter().map(|one| word(&one[name])).collect::<Vec<_>>().join(" ")
        }
        _ => word(&item[name]),
    };
    let mut text = format!("{}: {} leaves\n", word(&held["file"]), word(&held["leaves"]));
    let parts = list(&held["parts"]);
    if !parts.is_empty() {
        text.push_str(&rows(&parts, ["name", "role", "mesh", "primitive", "vertices", "triangles"], plain));
    }
    for room in list(&held["rooms"]) {
        let record = &room["record"];
        text.push_str(&format!("\n{} version {}, given {}\n", word(&room["room"]), record["version"], record["given"]));
        text.push_str(&rows(&list(&room["channels"]), ["name", "place", "rows", "unit", "min", "mean", "max"], each));
        for picture in list(&room["pictures"]) {
            text.push_str(&format!("picture {}, {} bytes\n", word(&picture["name"]), picture["bytes"]));
        }
        for error in list(&record["errors"]) {
            let [rms, p999] = ["rmsSteps", "p999Steps"].map(|key| word(&error[key]));
            let channel = word(&error["channel"]);
            text.push_str(&format!(
                "error of {channel}: rms {rms}, 99.9 % {p999} visible steps ({} places)\n",
                error["places"]
            ));
        }
    }
    text
}
