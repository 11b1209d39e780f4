//! Parameters of the room: each defined once; flags, configuration keys, help and schema come from here.

use crate::ROOM;
use foliar_bake::{BakeError, parse_params};
use foliar_plant::Plant;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Parameters of the room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Radius within which leaves count, as a share of the plant's longest edge.
    #[schemars(range(min = 0.01, max = 1.0))]
    pub reach: f64,
}

impl Default for Params {
    fn default() -> Self {
        Params { reach: 0.05 }
    }
}

impl Params {
    /// The parameters of a JSON object, with defaults for what it does not name.
    ///
    /// # Errors
    /// [`BakeError::Range`] outside the documented ranges, [`BakeError::Parameter`] for unknown names and wrong types.
    pub fn from_json(params: &Map<String, Value>) -> Result<Params, BakeError> {
        parse_params(ROOM, params)
    }

    /// Radius within which leaves count, meters.
    pub(crate) fn radius_m(&self, plant: &Plant) -> f64 {
        self.reach * plant.size().max_element()
    }
}
