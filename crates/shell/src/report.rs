//! What is said of one asset, filled in as the bake goes on, so that a failed one tells what it knows.

use crate::limbs::Limbs;
use crate::load::Loaded;
use crate::plan::{self, Row};
use crate::rooms::Room;
use crate::runner::Product;
use foliar_carrier::{Asset, Document, SourceKind};
use foliar_schema::{Finding, names};
use foliar_structure::Evidence;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A finished report.
pub struct Told {
    /// The whole object.
    pub json: Map<String, Value>,
    /// What people read in place of a result line.
    pub text: Option<String>,
    /// What machines read in place of it.
    pub answer: Option<Value>,
}

impl Told {
    /// Whether the input failed.
    pub fn failed(&self) -> bool {
        self.json.contains_key("error")
    }
}

/// The report of one asset.
pub struct Report {
    /// Members of the JSON object.
    pub json: Map<String, Value>,
    /// Everything noticed.
    pub findings: Vec<Finding>,
    /// Every file that was really read.
    pub read: Vec<PathBuf>,
    /// Every file that belongs to the output.
    pub written: Vec<PathBuf>,
    /// What people read in place of a result line.
    pub text: Option<String>,
    /// What machines read in place of it.
    pub answer: Option<Value>,
    /// The findings stand in `text` already: nobody else says them.
    pub tells_findings: bool,
    laps: Map<String, Value>,
    start: Instant,
    lap: Instant,
}

impl Report {
    /// An empty report of an input.
    pub fn new(input: &Path) -> Self {
        let json = Map::from_iter([("asset".to_owned(), json!(input.display().to_string()))]);
        let now = Instant::now();
        Report {
            json,
            findings: Vec::new(),
            read: Vec::new(),
            written: Vec::new(),
            text: None,
            answer: None,
            tells_findings: false,
            laps: Map::new(),
            start: now,
            lap: now,
        }
    }

    /// Sets a member.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) {
        self.json.insert(name.into(), value.into());
    }

    /// Notes the seconds since the last lap; gives them in words.
    pub fn lap(&mut self, stage: &str) -> String {
        let seconds = self.lap.elapsed().as_secs_f64();
        self.lap = Instant::now();
        self.laps.insert(stage.into(), json!(seconds));
        format!("{stage}: {seconds:.3} s")
    }

    /// Takes findings; those that name no file are about the asset.
    pub fn find(&mut self, findings: impl IntoIterator<Item = Finding>) {
        let asset = self.json.get("asset").and_then(Value::as_str);
        let asset = asset.map(|name| if name == "-" { "standard input" } else { name }.to_owned());
        self.findings.extend(findings.into_iter().map(|mut finding| {
            finding.file = finding.file.or_else(|| asset.clone());
            finding
        }));
    }

    /// What was read, of a file whose structure is not asked for.
    pub fn asset(&mut self, asset: &Asset) {
        self.read.extend_from_slice(&asset.files);
        self.find(asset.findings.iter().cloned());
        self.set("base", asset.base_hash.clone());
    }

    /// What would be written, in place of writing it.
    pub fn planned(&mut self, output: &Path, what: &str) -> Product {
        self.set("plan", json!([{ "writes": output.display().to_string(), "what": what }]));
        self.text = Some(format!("would write {}: {what}", output.display()));
        Product::Planned
    }

    /// What was read and found.
    pub fn loaded(&mut self, loaded: &Loaded) {
        self.read.clone_from(&loaded.files);
        self.find(loaded.findings.iter().cloned());
        let source = match loaded.source {
            SourceKind::Obj => "obj",
            SourceKind::Gltf => "gltf",
            SourceKind::Glb => "glb",
        };
        self.set("source", source);
        self.set("base", loaded.base_hash.clone());
        self.set("parts", parts(loaded));
        self.set("leaves", loaded.plant.leaves().len());
        let names: Vec<String> = loaded.files.iter().map(|file| file.display().to_string()).collect();
        self.set("files", names);
    }

    /// The plan.
    pub fn plan(&mut self, rows: &[Row], limbs: Option<&Limbs>) {
        let step = limbs.map(|limbs| {
            let plan::Branches { because, bytes } = plan::branches(rows, limbs);
            let record = &limbs.layer.record;
            json!({
                "baker": record.room,
                "needed": true,
                "because": because,
                "parameters": record.resolved,
                "bytes": bytes,
                "from": limbs.source,
            })
        });
        self.set("plan", step.into_iter().chain(rows.iter().map(Row::to_json)).collect::<Vec<_>>());
    }

    /// What the rooms made, with bytes predicted and bytes in the file.
    pub fn rooms(&mut self, rows: &[Row], rooms: &[Room], document: &Document) {
        let needed = rows.iter().filter(|row| row.needed);
        let one = |(row, room): (&Row, &Room)| {
            let record = &room.layer.record;
            json!({
                "room": record.room,
                "version": record.version,
                "bytesPredicted": row.bytes,
                "bytesWritten": written_bytes(document, &record.room),
                "secondsEstimated": row.seconds(),
                "seconds": room.seconds,
                "cached": room.cached,
                "given": record.given,
                "resolved": record.resolved,
                "facts": record.facts,
                "errors": record.errors,
                "writes": record.writes,
            })
        };
        self.set("rooms", needed.zip(rooms).map(one).collect::<Vec<_>>());
    }

    /// The whole object.
    pub fn finish(mut self) -> Told {
        self.set("findings", json!(self.findings));
        let laps = std::mem::take(&mut self.laps);
        self.set("stages", laps);
        let seconds = self.start.elapsed().as_secs_f64();
        self.set("seconds", seconds);
        Told { json: self.json, text: self.text, answer: self.answer }
    }
}

/// Parts with their roles; those of a fresh analysis with their evidence in numbers.
fn parts(loaded: &Loaded) -> Vec<Value> {
    let one = |(index, part): (usize, &foliar_plant::Part)| {
        let mut object = json!({
            "name": part.name(),
            "mesh": part.place.mesh,
            "primitive": part.place.primitive,
            "role": loaded.plant.role(index).name(),
            "vertices": part.positions.len(),
            "triangles": part.triangles.len(),
        });
        if let Some(evidence) = loaded.evidence.get(index) {
            object["confidence"] = json!(evidence.confidence);
            object["pieces"] = json!(evidence.pieces);
            object["crownVolume"] = json!(evidence.crown_volume);
            let reason = |e: &Evidence| json!({"role": e.role.name(), "weight": e.weight, "reason": e.reason});
            object["evidence"] = evidence.evidence.iter().map(reason).collect();
        }
        object
    };
    loaded.plant.parts().iter().enumerate().map(one).collect()
}

/// Bytes that the layer of a room takes in a document: its buffer views are named after it.
pub fn written_bytes(document: &Document, room: &str) -> u64 {
    let prefix = format!("{}{room}:", names::VIEW_PREFIX);
    let of_room = |view: &&Value| view["name"].as_str().is_some_and(|name| name.starts_with(&prefix));
    document.list("bufferViews").iter().filter(of_room).filter_map(|view| view["byteLength"].as_u64()).sum()
}
