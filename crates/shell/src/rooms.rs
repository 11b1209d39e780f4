//! Bakes the rooms of a plan, side by side, each from base and structure alone.

use crate::cache::Cache;
use crate::limbs::Limbs;
use crate::load::Loaded;
use crate::maps::Sheet;
use crate::neighbors::{Around, Neighbors};
use crate::plan::Row;
use crate::{Failure, record};
use foliar_bake::{Inputs, Layer, Maps, Progress, Request, resolve_params, run};
use foliar_schema::{Finding, names};
use rayon::prelude::*;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::time::Instant;

/// One room's result.
pub struct Room {
    /// What it made.
    pub layer: Layer,
    /// What it noticed.
    pub findings: Vec<Finding>,
    /// Seconds taken.
    pub seconds: f64,
    /// Whether the layer came from the cache.
    pub cached: bool,
}

/// Bakes every needed row.
///
/// # Errors
/// The first room's failure, in the order of the plan.
pub fn bake(
    loaded: &Loaded,
    limbs: Option<&Limbs>,
    (neighbors, sheets): (&Neighbors, &BTreeMap<String, Vec<Sheet>>),
    plan: &[Row],
    cache: Option<&Cache>,
    progress: &dyn Progress,
) -> Result<Vec<Room>, Failure> {
    let reads = BTreeMap::from([
        ("base".to_owned(), loaded.base_hash.clone()),
        (names::ROOM_STRUCTURE.to_owned(), loaded.structure.content_hash()),
    ]);
    let branches = limbs.map(|limbs| (names::ROOM_BRANCHES.to_owned(), limbs.layer.content_hash()));
    let with_branches: BTreeMap<_, _> = reads.clone().into_iter().chain(branches).collect();
    let of = |row: &Row| if row.baker.needs().branches { &with_branches } else { &reads };
    let needed: Vec<&Row> = plan.iter().filter(|row| row.needed).collect();
    let bake = |row: &Row| match sheets.get(row.baker.room()) {
        Some(sheets) => on_sheets(loaded, sheets, row, of(row), cache, progress),
        None => one(loaded, &neighbors.of(row), row, of(row), cache, progress),
    };
    let baked: Vec<Result<Room, Failure>> = needed.into_par_iter().map(bake).collect();
    baked.into_iter().collect()
}

/// A room that lives on maps, once for each set: one layer, its rasters named after the sets.
fn on_sheets(
    loaded: &Loaded,
    sheets: &[Sheet],
    row: &Row,
    reads: &BTreeMap<String, String>,
    cache: Option<&Cache>,
    progress: &dyn Progress,
) -> Result<Room, Failure> {
    let start = Instant::now();
    let room = row.baker.room();
    let bake = |sheet: &Sheet| -> Result<Kept, Failure> {
        let reads = reads.iter().chain(&sheet.reads).map(|(n, h)| (n.clone(), h.clone())).collect();
        let request = Request { given: sheet.given.clone(), implied: row.implied.clone(), reads };
        let inputs = Inputs { plant: Some(&loaded.plant), maps: &sheet.maps, neighbors: &[] };
        let params = resolve_params(row.baker, &request.implied, &request.given)?;
        let baked = kept(row, &inputs, &request, &params, cache, progress);
        baked.map_err(|failure| sheet.blame(failure))
    };
    let baked: Vec<Result<Kept, Failure>> = sheets.par_iter().map(bake).collect();
    let baked: Vec<Kept> = baked.into_iter().collect::<Result<_, _>>()?;
    let cached = baked.iter().all(|kept| kept.cached);
    let mut layer = Layer::default();
    layer.record.room = room.into();
    layer.record.version = row.baker.version();
    layer.record.resolved = row.params.clone();
    layer.record.reads = reads.clone();
    layer.record.given = record::given(&loaded.settings, room);
    let (mut findings, mut facts) = (Vec::new(), Map::new());
    for (sheet, kept) in sheets.iter().zip(baked) {
        findings.extend(kept.findings.into_iter().map(|finding| sheet.placed(finding)));
        layer.record.reads.extend(sheet.reads.clone());
        facts.insert(sheet.name.clone(), sheet_facts(sheet, &kept.layer, &row.params));
        let named = |name: String| format!("{}/{name}", sheet.name);
        layer.rasters.extend(kept.layer.rasters.into_iter().map(|(name, raster)| (named(name), raster)));
        layer.pictures.extend(sheet.pictures.iter().map(|(name, bytes)| (named(name.clone()), bytes.clone())));
    }
    layer.record.facts.insert(names::FACT_SHEETS.into(), facts.into());
    layer.record.writes = maps_written(&layer);
    Ok(Room { layer, findings, seconds: start.elapsed().as_secs_f64(), cached })
}

/// What a record says it wrote.
fn maps_written(layer: &Layer) -> Vec<String> {
    let rasters = layer.rasters.keys().map(|name| format!("{}{name}", names::WRITES_RASTER));
    let pictures = layer.pictures.keys().map(|name| format!("{}{name}", names::WRITES_PICTURE));
    let mut writes: Vec<String> = rasters.chain(pictures).collect();
    writes.sort();
    writes
}

/// What a record says of one set: its materials, what the room says, and the parameters that are not those of the room.
fn sheet_facts(sheet: &Sheet, layer: &Layer, shared: &Map<String, Value>) -> Value {
    let mut facts = Map::new();
    facts.insert("materials".into(), sheet.materials.clone().into());
    facts.extend(layer.record.facts.clone());
    let own = layer.record.resolved.iter().filter(|(name, value)| shared.get(*name).is_some_and(|s| s != *value));
    let own: Map<String, Value> = own
        .filter(|(_, value)| !value.as_array().is_some_and(Vec::is_empty))
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect();
    if !own.is_empty() {
        facts.insert("parameters".into(), own.into());
    }
    facts.into()
}

/// A layer that was baked, or kept from an earlier bake.
struct Kept {
    layer: Layer,
    findings: Vec<Finding>,
    cached: bool,
}

/// Bakes, unless the cache holds the same.
fn kept(
    row: &Row,
    inputs: &Inputs,
    request: &Request,
    params: &Map<String, Value>,
    cache: Option<&Cache>,
    progress: &dyn Progress,
) -> Result<Kept, Failure> {
    let found = cache.and_then(|cache| cache.get(row.baker.room(), row.baker.version(), params, &request.reads));
    if let Some((layer, findings)) = found {
        return Ok(Kept { layer, findings, cached: true });
    }
    let (layer, findings) = run(row.baker, inputs, request, progress)?;
    if let Some(cache) = cache {
        cache.put(&layer, params, &findings)?;
    }
    Ok(Kept { layer, findings, cached: false })
}

fn one(
    loaded: &Loaded,
    around: &Around,
    row: &Row,
    reads: &BTreeMap<String, String>,
    cache: Option<&Cache>,
    progress: &dyn Progress,
) -> Result<Room, Failure> {
    let start = Instant::now();
    let room = row.baker.room();
    let reads: BTreeMap<_, _> = reads.iter().chain(&around.reads).map(|(n, h)| (n.clone(), h.clone())).collect();
    let request = Request { given: loaded.settings.given(room), implied: row.implied.clone(), reads };
    let inputs = Inputs { plant: Some(&loaded.plant), maps: &Maps::new(), neighbors: &around.placed };
    let Kept { mut layer, findings, cached } = kept(row, &inputs, &request, &row.params, cache, progress)?;
    layer.record.given = record::given(&loaded.settings, room);
    Ok(Room { layer, findings, seconds: start.elapsed().as_secs_f64(), cached })
}
