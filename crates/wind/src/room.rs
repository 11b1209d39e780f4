//! The room: what `foliar bake` and `foliar-wind` call.

use crate::{Params, fast, output, reference, requirement};
use foliar_bake::{BakeError, Baked, Baker, Facts, Inputs, Needs, Progress, Requirement, Rung};
use foliar_plant::Branches;
use foliar_schema::{Scene, names};
use serde_json::{Map, Value, json};

/// What another way to find the same crossings may move a weight at a joint: some 1e-9, below the rounding to f32, in steps
/// of 1e-3.
const EXACT_STEPS: f64 = 0.001;

/// The wind room.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wind;

impl Baker for Wind {
    fn room(&self) -> &'static str {
        names::ROOM_WIND
    }

    fn version(&self) -> u32 {
        2
    }

    fn about(&self) -> &'static str {
        "weights, phases and frames that let a shader sway branches and leaves (Kusternig07 section 5)"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(Params).to_value()
    }

    fn needs(&self) -> Needs {
        Needs { plant: true, branches: true, ..Needs::default() }
    }

    fn require(&self, scene: &Scene, facts: &Facts) -> Requirement {
        requirement::require(scene, facts)
    }

    fn ladder(&self) -> Vec<Rung> {
        let rung = |(name, levels): (&'static str, u32)| Rung {
            name,
            params: json!({ "levels": levels }).as_object().cloned().unwrap_or_default(),
            promise_steps: EXACT_STEPS,
        };
        [("levels-1", 1), ("levels-2", 2), ("levels-3", 3), ("levels-4", 4)].map(rung).into()
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        progress.step("wind", 0, 1);
        let baked = bake_with(inputs, params, fast::values)?;
        progress.step("wind", 1, 1);
        Ok(baked)
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        bake_with(inputs, params, reference::values)
    }
}

type Valuing = fn(&foliar_plant::Plant, &Branches, crate::Rule) -> fast::Values;

fn bake_with(inputs: &Inputs, params: &Map<String, Value>, values: Valuing) -> Result<Baked, BakeError> {
    let params = Params::from_json(params)?;
    let plant = inputs.plant_for(names::ROOM_WIND)?;
    let needs = || BakeError::Needs {
        room: names::ROOM_WIND.into(),
        what: "branches",
        remedy: "find them (foliar_structure::branches) before".into(),
    };
    let branches = plant.branches().ok_or_else(needs)?;
    let values = values(plant, branches, (&params).into());
    Ok(output::baked(plant, branches, &values, &params))
}
