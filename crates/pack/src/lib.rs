//! Delivery: from a master, which is exact and complete, to the file that ships, which holds what one
//! engine needs and nothing else. The one place that may replace what the base holds.

mod blender;
mod core;
mod error;
mod luft07;
mod master;
mod measure;
mod tangents;

#[cfg(test)]
mod tests;

pub use error::PackError;
pub use measure::{PackReport, PackedAttribute};

use foliar_carrier::edit::{Edits, NewAttribute, edit};
use foliar_carrier::{Asset, Document};
use foliar_plant::Place;
use foliar_schema::{Engine, Finding, names};
use master::Master;
use serde_json::json;

/// Program and version that packed a file.
const GENERATOR: &str = concat!("foliar ", env!("CARGO_PKG_VERSION"));

/// A packed file and what is to be said of it.
#[derive(Clone, Debug)]
pub struct Packed {
    /// The file.
    pub document: Document,
    /// Bytes and errors.
    pub report: PackReport,
    /// What was noticed.
    pub findings: Vec<Finding>,
}

/// What a profile makes of a master, before it is put into the file.
#[derive(Default)]
struct Plan {
    edits: Edits,
    /// What stands where, for the measuring: in the order of the report.
    carriers: Vec<Carrier>,
    findings: Vec<Finding>,
}

/// A channel of the master and the attribute that carries it.
#[derive(Clone, Copy)]
struct Carrier {
    channel: &'static str,
    attribute: &'static str,
    /// How its values are read back.
    decode: measure::Decode,
}

impl Plan {
    fn add(&mut self, attribute: NewAttribute) {
        self.edits.attributes.push(attribute);
    }

    /// Floats of one primitive.
    fn floats(&mut self, place: Place, name: &str, width: usize, data: Vec<f32>) {
        let numbers = foliar_carrier::edit::Numbers::F32(data);
        self.add(NewAttribute { place, name: name.into(), width, numbers });
    }
}

/// Packs a master for an engine. Every table, id and record of foliar is left behind; what an engine
/// needs of them is written as it takes it. The rest of the base comes through.
///
/// # Errors
/// [`PackError::NothingBaked`] where there is no density layer, [`PackError::NoLeaves`] where that is empty, [`PackError::AlreadyPacked`] for a file
/// that was packed before, [`PackError::Carrier`] where the base is not what the layers were baked from.
pub fn pack(asset: &Asset, engine: Engine) -> Result<Packed, PackError> {
    let master = Master::of(asset)?;
    let plan = match engine {
        Engine::Core => core::plan(&master)?,
        Engine::Blender => blender::plan(&master)?,
        Engine::Luft07 => luft07::plan(&master),
    };
    let mut document = edit(&asset.document, &plan.edits)?;
    sign(&mut document, engine);
    let report = measure::report(engine, &master, &plan, &document)?;
    Ok(Packed { document, report, findings: plan.findings })
}

/// Says in the file's extras what it was packed for, where they are an object or missing.
fn sign(document: &mut Document, engine: Engine) {
    let Some(asset) = document.json.get_mut("asset").and_then(serde_json::Value::as_object_mut) else { return };
    if let Some(extras) = asset.entry("extras").or_insert_with(|| json!({})).as_object_mut() {
        extras.insert(names::PACKED.into(), json!({"engine": engine.name(), "generator": GENERATOR}));
    }
}
