//! Parameters of the wind room.

use foliar_bake::{BakeError, parse_params};
use foliar_plant::LEVELS;
use foliar_schema::names;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Parameters of the wind room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Levels of branches that sway on their own, stems first; deeper ones move as what they grow from.
    #[schemars(range(min = 1, max = 4))]
    pub levels: u32,
    /// How displacement grows along a branch, level by level: the weight to this power. Above 1 a branch bends, at 1 it leans.
    /// Shaders must use the same: the places where bark meets bark are matched for these.
    #[schemars(inner(range(min = 1.0, max = 8.0)))]
    pub exponents: [f64; LEVELS],
}

impl Default for Params {
    fn default() -> Self {
        Params { levels: LEVELS as u32, exponents: [2.0, 1.5, 1.5, 1.0] }
    }
}

impl Params {
    /// The parameters of a JSON object, with defaults for what it does not name.
    ///
    /// # Errors
    /// [`BakeError::Range`] outside the documented ranges, [`BakeError::Parameter`] for unknown names and wrong types.
    pub fn from_json(params: &Map<String, Value>) -> Result<Params, BakeError> {
        parse_params(names::ROOM_WIND, params)
    }
}
