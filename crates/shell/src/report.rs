//! What is said of one asset, filled in as the bake goes on, so that a failed one tells what it knows.

use crate::limbs::Limbs;
use crate::load::Loaded;
use crate::plan::{self, Row};
use crate::rooms::Room;
use crate::runner::{Product, Status};
use crate::said::{AssetReport, Baked, Bakes, PartTold, Reason, RoomTold, Step, Writes};
use crate::{Failure, outputs};
use foliar_carrier::{Asset, Document, SourceKind};
use foliar_schema::{Finding, names};
use foliar_structure::Evidence;
use serde::Serialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A finished report.
pub struct Told {
    /// Everything.
    pub report: AssetReport,
    /// What people read in place of a result line.
    pub text: Option<String>,
    /// What machines read in place of it.
    pub answer: Option<Value>,
}

impl Told {
    /// Whether the input failed.
    pub fn failed(&self) -> bool {
        self.report.status == Status::Failed
    }
}

/// The report of one asset.
pub struct Report {
    /// What is known so far, but for findings and seconds.
    pub told: AssetReport,
    /// Everything noticed.
    pub findings: Vec<Finding>,
    /// Every file that was really read.
    pub read: Vec<PathBuf>,
    /// Every file that belongs to the output.
    pub written: Vec<PathBuf>,
    /// What people read in place of a result line.
    pub text: Option<String>,
    /// What machines read in place of it.
    answer: Option<Value>,
    /// The findings stand in `text` already: nobody else says them.
    pub tells_findings: bool,
    start: Instant,
    lap: Instant,
}

impl Report {
    /// An empty report of an input.
    pub fn new(input: &Path) -> Self {
        let now = Instant::now();
        Report {
            told: AssetReport { asset: input.display().to_string(), ..AssetReport::default() },
            findings: Vec::new(),
            read: Vec::new(),
            written: Vec::new(),
            text: None,
            answer: None,
            tells_findings: false,
            start: now,
            lap: now,
        }
    }

    /// Answers: to people in words, to machines with an object.
    ///
    /// # Errors
    /// [`Failure::Fault`] for what is no JSON.
    pub fn answer(&mut self, text: impl Into<String>, answer: &impl Serialize) -> Result<Product, Failure> {
        self.text = Some(text.into());
        self.answer = Some(outputs::value(answer)?);
        Ok(Product::Answer)
    }

    /// Notes the seconds since the last lap; gives them in words.
    pub fn lap(&mut self, stage: &str) -> String {
        let seconds = self.lap.elapsed().as_secs_f64();
        self.lap = Instant::now();
        self.told.stages.insert(stage.into(), json!(seconds));
        format!("{stage}: {seconds:.3} s")
    }

    /// Takes findings; those that name no file are about the asset.
    pub fn find(&mut self, findings: impl IntoIterator<Item = Finding>) {
        let asset = if self.told.asset == "-" { "standard input" } else { &self.told.asset };
        self.findings.extend(findings.into_iter().map(|mut finding| {
            finding.file = finding.file.or_else(|| Some(asset.to_owned()));
            finding
        }));
    }

    /// What was read, of a file whose structure is not asked for.
    pub fn asset(&mut self, asset: &Asset) {
        self.read.extend_from_slice(&asset.files);
        self.find(asset.findings.iter().cloned());
        self.told.base = Some(asset.base_hash.clone());
    }

    /// What would be written, in place of writing it.
    pub fn planned(&mut self, output: &Path, what: &str) -> Product {
        let writes = output.display().to_string();
        self.told.plan = Some(vec![Step::Writes(Writes { writes, what: what.into() })]);
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
        self.told.source = Some(source);
        self.told.base = Some(loaded.base_hash.clone());
        self.told.parts = Some(parts(loaded));
        self.told.leaves = Some(loaded.plant.leaves().len());
        self.told.files = Some(loaded.files.iter().map(|file| file.display().to_string()).collect());
    }

    /// The plan.
    pub fn plan(&mut self, rows: &[Row], limbs: Option<&Limbs>) {
        let step = limbs.map(|limbs| {
            let plan::Branches { because, bytes } = plan::branches(rows, limbs);
            let record = &limbs.layer.record;
            Bakes {
                baker: record.room.clone(),
                needed: true,
                because,
                parameters: record.resolved.clone().into(),
                bytes: Some(bytes),
                seconds_estimated: None,
                from: Some(limbs.source),
            }
        });
        self.told.plan = Some(step.into_iter().chain(rows.iter().map(Row::told)).map(Step::Bakes).collect());
    }

    /// What the rooms made, with bytes predicted and bytes in the file.
    pub fn rooms(&mut self, rows: &[Row], rooms: &[Room], document: &Document) {
        let needed = rows.iter().filter(|row| row.needed);
        let one = |(row, room): (&Row, &Room)| {
            let record = &room.layer.record;
            RoomTold::Baked(Box::new(Baked {
                room: record.room.clone(),
                version: record.version,
                bytes_predicted: row.bytes,
                bytes_written: written_bytes(document, &record.room),
                seconds_estimated: row.seconds(),
                seconds: room.seconds,
                cached: room.cached,
                given: record.given.clone(),
                resolved: record.resolved.clone(),
                facts: record.facts.clone(),
                errors: record.errors.clone(),
                writes: record.writes.clone(),
            }))
        };
        self.told.rooms = Some(needed.zip(rooms).map(one).collect());
    }

    /// The whole object.
    pub fn finish(mut self) -> Told {
        self.told.findings = self.findings;
        self.told.seconds = self.start.elapsed().as_secs_f64();
        Told { report: self.told, text: self.text, answer: self.answer }
    }
}

/// Parts with their roles; those of a fresh analysis with their evidence in numbers.
fn parts(loaded: &Loaded) -> Vec<PartTold> {
    let one = |(index, part): (usize, &foliar_plant::Part)| {
        let bare = PartTold::of(part, Some(loaded.plant.role(index)));
        let Some(found) = loaded.evidence.get(index) else { return bare };
        let reason = |e: &Evidence| Reason { role: e.role, weight: e.weight, reason: e.reason.clone() };
        PartTold {
            confidence: Some(found.confidence),
            pieces: Some(found.pieces),
            crown_volume: Some(found.crown_volume),
            evidence: Some(found.evidence.iter().map(reason).collect()),
            ..bare
        }
    };
    loaded.plant.parts().iter().enumerate().map(one).collect()
}

/// Bytes that the layer of a room takes in a document: its buffer views are named after it.
pub fn written_bytes(document: &Document, room: &str) -> u64 {
    let prefix = format!("{}{room}:", names::VIEW_PREFIX);
    let of_room = |view: &&Value| view["name"].as_str().is_some_and(|name| name.starts_with(&prefix));
    document.list("bufferViews").iter().filter(of_room).filter_map(|view| view["byteLength"].as_u64()).sum()
}
