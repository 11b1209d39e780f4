//! Metaball density: ambient coefficient k_a and realigned normals (Luft07).
//!
//! Every leaf is a ball of influence; the sum of the balls is a density (Luft07 eq. 2). Where it is
//! high, little of the sky is seen (eq. 4).

mod params;
mod requirement;

use foliar_bake::{BakeError, Baked, Baker, Facts, Inputs, Needs, Progress, Requirement, Rung};
use foliar_schema::{Scene, names};
pub use params::{AmbientTerm, Channels, GeneratorKind, Params, SelfLeaf};
use serde_json::{Map, Value};

const ROOM: &str = names::ROOM_DENSITY;

/// The density room.
#[derive(Clone, Copy, Debug, Default)]
pub struct Density;

fn schema() -> Value {
    schemars::schema_for!(Params).to_value()
}

impl Baker for Density {
    fn room(&self) -> &'static str {
        ROOM
    }

    fn version(&self) -> u32 {
        1
    }

    fn about(&self) -> &'static str {
        "ambient coefficient and realigned normals from the density of the foliage (Luft07)"
    }

    fn schema(&self) -> Value {
        schema()
    }

    fn needs(&self) -> Needs {
        Needs { plant: true, maps: &[] }
    }

    fn require(&self, scene: &Scene, facts: &Facts) -> Requirement {
        requirement::require(scene, facts)
    }

    fn ladder(&self) -> Vec<Rung> {
        Vec::new()
    }

    fn bake(&self, _: &Inputs, params: &Map<String, Value>, _: &dyn Progress) -> Result<Baked, BakeError> {
        Params::from_json(params)?;
        Ok(Baked::default())
    }

    fn reference(&self, _: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        Params::from_json(params)?;
        Ok(Baked::default())
    }
}
