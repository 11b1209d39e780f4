//! The room's accuracy ladder: what each rung promises, errs and costs.

use super::room;
use anyhow::Result;
use foliar_bake::Baker;
use foliar_density::Density;
use foliar_plant::Plant;
use foliar_schema::names;
use serde_json::Value;

/// One rung, climbed.
pub struct RungScore {
    /// Its name.
    pub name: &'static str,
    /// Promised error, visible steps.
    pub promise: f64,
    /// Measured error of the ambient term, visible steps; `None` where it writes none.
    pub ambient: Option<f64>,
    /// The same of the normals.
    pub normal: Option<f64>,
    /// Seconds of the processor.
    pub seconds: f64,
}

/// Climbs the rungs of the ladder with these names on a plant.
pub fn climb(plant: &Plant, wanted: impl Fn(&str) -> bool) -> Result<Vec<RungScore>> {
    let score = |rung: foliar_bake::Rung| {
        let params = Value::Object(rung.params.clone());
        let (layer, seconds) = room::cpu_seconds(|| room::bake(plant, &params))?;
        let error = |name: &str| layer.record.errors.iter().find(|e| e.channel == name).map(|e| e.rms_steps);
        Ok(RungScore {
            name: rung.name,
            promise: rung.promise_steps,
            ambient: error(names::AMBIENT),
            normal: error(names::SOFT_NORMAL),
            seconds,
        })
    };
    Density.ladder().into_iter().filter(|rung| wanted(rung.name)).map(score).collect()
}
