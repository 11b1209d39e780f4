//! __Room__: share of the plant's foliage around each vertex.
//!
//! Every leaf counts with its area and with a weight that falls from 1 at its center to 0 at a radius. This is the
//! example that a new room starts from: put what it is to compute in its place.

pub mod fast;
mod output;
mod params;
pub mod reference;
#[cfg(test)]
mod tests;

use foliar_bake::{BakeError, Baked, Baker, Facts, Inputs, Needs, Progress, Requirement, Rung};
use foliar_plant::Plant;
use foliar_schema::{Scene, names};
pub use params::Params;
use serde_json::{Map, Value};

const ROOM: &str = names::ROOM___ROOM__;

/// What another order of f64 sums may move a share, far below the rounding to f32, in steps of 1 / 255.
const EXACT_STEPS: f64 = 0.001;

/// Bytes of a share.
const SHARE_BYTES: u64 = 4;

/// The room.
#[derive(Clone, Copy, Debug, Default)]
pub struct __Room__;

impl Baker for __Room__ {
    fn room(&self) -> &'static str {
        ROOM
    }

    fn version(&self) -> u32 {
        1
    }

    fn about(&self) -> &'static str {
        "share of the plant's foliage around each vertex"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(Params).to_value()
    }

    fn needs(&self) -> Needs {
        Needs { plant: true, ..Needs::default() }
    }

    /// Every scene gets it: say here what of a scene asks for it, which parameters that implies, and why.
    fn require(&self, _: &Scene, facts: &Facts) -> Requirement {
        let vertices = if facts.leaves > 0 { facts.leaf_vertices + facts.wood_vertices } else { 0 };
        let bytes = SHARE_BYTES * vertices as u64;
        let because = format!("every scene gets it: {vertices} vertices, {bytes} bytes");
        Requirement::Required { params: Map::new(), because, bytes }
    }

    /// One rung, since nothing here trades accuracy for time.
    fn ladder(&self) -> Vec<Rung> {
        vec![Rung { name: "exact", params: Map::new(), promise_steps: EXACT_STEPS }]
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        progress.step(ROOM, 0, 1);
        let baked = bake_with(inputs, params, fast::shares)?;
        progress.step(ROOM, 1, 1);
        Ok(baked)
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        bake_with(inputs, params, reference::shares)
    }
}

/// Shares of a part's vertices, for a plant and a radius in meters.
type Sharing = fn(&Plant, f64) -> Vec<Vec<f32>>;

fn bake_with(inputs: &Inputs, params: &Map<String, Value>, shares: Sharing) -> Result<Baked, BakeError> {
    let params = Params::from_json(params)?;
    let plant = inputs.plant_for(ROOM)?;
    if plant.leaves().is_empty() {
        return Ok(output::empty(&params));
    }
    let radius = params.radius_m(plant);
    Ok(output::baked(plant, shares(plant, radius), radius, &params))
}
