//! Bakes the rooms of a plan, side by side, each from base and structure alone.

use crate::cache::Cache;
use crate::limbs::Limbs;
use crate::load::Loaded;
use crate::neighbors::{Around, Neighbors};
use crate::plan::Row;
use crate::{Failure, record};
use foliar_bake::{Inputs, Layer, Maps, Progress, Request, run};
use foliar_schema::{Finding, names};
use rayon::prelude::*;
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
    neighbors: &Neighbors,
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
    let baked: Vec<Result<Room, Failure>> =
        needed.into_par_iter().map(|row| one(loaded, &neighbors.of(row), row, of(row), cache, progress)).collect();
    baked.into_iter().collect()
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
    let found = cache.and_then(|cache| cache.get(room, row.baker.version(), &row.params, &reads));
    let cached = found.is_some();
    let (mut layer, findings) = match found {
        Some(found) => found,
        None => {
            let request = Request { given: loaded.settings.given(room), implied: row.implied.clone(), reads };
            let inputs = Inputs { plant: Some(&loaded.plant), maps: &Maps::new(), neighbors: &around.placed };
            let (layer, findings) = run(row.baker, &inputs, &request, progress)?;
            if let Some(cache) = cache {
                cache.put(&layer, &row.params, &findings)?;
            }
            (layer, findings)
        }
    };
    layer.record.given = record::given(&loaded.settings, room);
    Ok(Room { layer, findings, seconds: start.elapsed().as_secs_f64(), cached })
}
