//! Metaball density: ambient coefficient k_a and realigned normals (Luft07).
//!
//! Every leaf is a ball of influence; the sum of the balls is a density (Luft07 eq. 2). Where it is
//! high, little of the sky is seen (eq. 4).

mod ambient;
mod choose;
mod chord_sums;
mod chords;
mod coarse;
mod columns;
mod depth;
mod directions;
pub mod fast;
mod field;
mod generators;
mod grid;
mod groups;
mod hull;
mod kernel;
mod lattice;
mod measure;
mod medium;
mod moments;
mod normals;
mod order;
mod output;
mod params;
pub mod reference;
mod requirement;
mod sky;
mod subsample;
pub mod surface;
mod tessellate;
#[cfg(test)]
mod tests;

pub use ambient::ambient_coefficient;
pub use coarse::Coarse;
pub use depth::crown_depth;
pub use directions::{DIRECTIONS, sky_directions};
pub use field::{Field, Query, Sample};
use foliar_bake::{BakeError, Baked, Baker, Enclose, Facts, Hull, Inputs, Needs, Progress, Requirement, Rung};
pub use foliar_numerics::Isa;
use foliar_schema::{Scene, names};
pub use generators::{Foliage, Generator, NO_GROUP};
pub use medium::{BALL_INTEGRAL, SkySample};
pub use params::{AmbientTerm, Channels, DensityUnit, GeneratorKind, NormalMode, Params, SelfLeaf};
use serde_json::{Map, Value, json};
pub use sky::Sky;

const ROOM: &str = names::ROOM_DENSITY;

/// What f32 sums may move k_a: 1e-6 of the weights in reach, four times the median density at most, through
/// the steepest slope of eq. 4 (1.5 per median density), in steps of 1 / 255.
const EXACT_STEPS: f64 = 0.01;

/// The density room.
#[derive(Clone, Copy, Debug, Default)]
pub struct Density;

impl Baker for Density {
    fn room(&self) -> &'static str {
        ROOM
    }

    fn version(&self) -> u32 {
        4
    }

    fn about(&self) -> &'static str {
        "ambient coefficient and realigned normals from the density of the foliage (Luft07)"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(Params).to_value()
    }

    fn needs(&self) -> Needs {
        Needs { plant: true, ..Needs::default() }
    }

    fn require(&self, scene: &Scene, facts: &Facts) -> Requirement {
        requirement::require(scene, facts)
    }

    fn ladder(&self) -> Vec<Rung> {
        let rung = |name, params: Value, promise_steps| Rung {
            name,
            params: params.as_object().cloned().unwrap_or_default(),
            promise_steps,
        };
        vec![
            rung("k_a-exact", json!({"ambient": "luft", "channels": "ambient", "quality": EXACT_STEPS}), EXACT_STEPS),
            rung("k_a", json!({"ambient": "luft", "channels": "ambient"}), 1.0),
            rung("sky-4", json!({"ambient": "sky", "quality": 4.0}), 4.0),
            rung("sky", json!({}), 1.0),
            rung("sky-0.25", json!({"quality": 0.25}), 0.25),
        ]
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        let params = Params::from_json(params)?;
        let (Some(plant), Some(foliage)) = (inputs.plant, generators::foliage(inputs, &params)) else {
            return Ok(output::empty(&params));
        };
        let places = fast::Places::new(plant, &params);
        progress.step("density", 0, 1);
        let values = fast::values(plant, &foliage, &places, &params)?;
        progress.step("density", 1, 1);
        Ok(output::baked(plant, &foliage, &places, &values, &params))
    }

    fn hull(&self) -> Option<&dyn Enclose> {
        Some(self)
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        let params = Params::from_json(params)?;
        let (Some(plant), Some(foliage)) = (inputs.plant, generators::foliage(inputs, &params)) else {
            return Ok(output::empty(&params));
        };
        let places = fast::Places::new(plant, &params);
        let values = reference::values(plant, &foliage, &places, &params)?;
        Ok(output::baked(plant, &foliage, &places, &values, &params))
    }
}

impl Enclose for Density {
    fn enclose(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Hull, BakeError> {
        let params = Params::from_json(params)?;
        let (Some(plant), Some(foliage)) = (inputs.plant, generators::foliage(inputs, &params)) else {
            return Ok(Hull::default());
        };
        hull::around(plant, &foliage, &params)
    }
}
