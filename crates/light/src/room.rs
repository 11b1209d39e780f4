//! The room: what `foliar bake` and `foliar-light` call.

use crate::bake::{reference_values, values};
use crate::{Params, output, requirement};
use foliar_bake::{BakeError, Baked, Baker, Facts, Inputs, Needs, Progress, Requirement, Rung};
use foliar_plant::Plant;
use foliar_schema::{Scene, names};
use serde_json::{Map, Value, json};

/// What f32 sums may move a transmittance: 1e-5 and 1e-4 of a depth, which hides what it moves; in steps of 1 / 255.
const EXACT_STEPS: f64 = 0.01;

/// The light room.
#[derive(Clone, Copy, Debug, Default)]
pub struct Light;

impl Baker for Light {
    fn room(&self) -> &'static str {
        names::ROOM_LIGHT
    }

    fn version(&self) -> u32 {
        1
    }

    fn about(&self) -> &'static str {
        "optical depths of the leaves in eight directions, for sun, sky and light between leaves (Boulanger08)"
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
            rung("exact", json!({"engine": "exact"}), EXACT_STEPS),
            rung("paper", json!({"engine": "exact", "profile": "paper"}), EXACT_STEPS),
            rung("tree-4", json!({"engine": "tree", "quality": 4.0}), 4.0),
            rung("tree", json!({"engine": "tree"}), 1.0),
            rung("tree-0.25", json!({"engine": "tree", "quality": 0.25}), 0.25),
        ]
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        let params = Params::from_json(params)?;
        let Some(plant) = with_leaves(inputs) else { return Ok(output::empty(&params)) };
        progress.step("light", 0, 1);
        let values = values(plant, &params)?;
        progress.step("light", 1, 1);
        Ok(output::baked(plant, &values, &params.optics()?, &params))
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        let params = Params::from_json(params)?;
        let Some(plant) = with_leaves(inputs) else { return Ok(output::empty(&params)) };
        Ok(output::baked(plant, &reference_values(plant, &params), &params.optics()?, &params))
    }
}

fn with_leaves<'a>(inputs: &Inputs<'a>) -> Option<&'a Plant> {
    inputs.plant.filter(|plant| !plant.leaves().is_empty())
}
