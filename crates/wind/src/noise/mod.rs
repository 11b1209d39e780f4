//! The noise of the wind: a tiling texture of two channels whose sections are 1/f^beta (Kusternig07 section 5).
//!
//! Baked once for a library, no part of a tree: it needs no plant.

mod field;
mod measure;
mod params;
mod synthesis;
#[cfg(test)]
mod tests;

pub use field::Field;
pub use measure::{Measured, measure};
pub use params::NoiseParams;
pub use synthesis::{Mode, modes};

use foliar_bake::{BakeError, Baked, Baker, Facts, FloatRaster, Inputs, Needs, Progress, Requirement, Rung};
use foliar_schema::{Scene, names};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// What sums in another order may move a texel: some 1e-12 of its value, far below a step of 16 bits.
const EXACT_STEPS: f64 = 0.01;

/// The baker of the texture.
#[derive(Clone, Copy, Debug, Default)]
pub struct Noise;

impl Baker for Noise {
    fn room(&self) -> &'static str {
        names::ROOM_NOISE
    }

    fn version(&self) -> u32 {
        1
    }

    fn about(&self) -> &'static str {
        "a tiling texture of 1/f^beta noise for the wind of a whole library (Kusternig07 section 5)"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(NoiseParams).to_value()
    }

    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn require(&self, _: &Scene, _: &Facts) -> Requirement {
        Requirement::NotRequired { because: "one for a whole library, no part of a tree: foliar-noise".into() }
    }

    fn ladder(&self) -> Vec<Rung> {
        let small = json!({"size": 64, "kmax": 16});
        vec![Rung { name: "small", params: small.as_object().cloned().unwrap_or_default(), promise_steps: EXACT_STEPS }]
    }

    fn bake(&self, _: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        let params = NoiseParams::from_json(params)?;
        progress.step("noise", 0, 1);
        let field = synthesis::separable(&modes(&params), params.size as usize);
        progress.step("noise", 1, 1);
        Ok(baked(field, &params))
    }

    fn reference(&self, _: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        let params = NoiseParams::from_json(params)?;
        Ok(baked(synthesis::direct(&modes(&params), params.size as usize), &params))
    }
}

/// Scales the field to [-1, 1] and says what was measured on it.
fn baked(mut field: Vec<[f64; 2]>, params: &NoiseParams) -> Baked {
    let peak = field.iter().flatten().fold(0.0f64, |peak, value| peak.max(value.abs())).max(f64::MIN_POSITIVE);
    field.iter_mut().flatten().for_each(|value| *value /= peak);
    let raster = FloatRaster {
        width: params.size,
        height: params.size,
        channels: 2,
        data: field.iter().flatten().map(|&value| value as f32).collect(),
    };
    let facts = json!({
        "measured": measure(&raster, params).to_json(),
        "decode": "16 bits: value = 2 u / 65535 - 1; red and green, blue is 0",
    });
    let resolved = serde_json::to_value(params).unwrap_or_default();
    Baked {
        rasters: BTreeMap::from([(names::RASTER_NOISE.to_owned(), raster)]),
        resolved: resolved.as_object().cloned().unwrap_or_default(),
        facts: facts.as_object().cloned().unwrap_or_default(),
        ..Baked::default()
    }
}
