//! Parameters of the noise texture.

use foliar_bake::BakeError;
use foliar_schema::names;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// The texture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NoiseParams {
    /// Slope of the power spectrum in time, 1/f^beta: 1 is pink, 2 is brown. A straight way through a field in the
    /// plane has the power of the field less one, so the field itself falls with beta + 1.
    #[schemars(range(min = 0.5, max = 4))]
    pub beta: f64,
    /// Texels along each edge.
    #[schemars(range(min = 32, max = 2048))]
    pub size: u32,
    /// Lowest waves per tile: 2 or 3 where one row alone would look periodic.
    #[schemars(range(min = 1, max = 64))]
    pub kmin: u32,
    /// Highest waves per tile, below half the size: times tiles per second it is the fastest sway in hertz.
    /// Near half the size, filtering between texels loses much of it.
    #[schemars(range(min = 8, max = 1024))]
    pub kmax: u32,
    /// Which of all such textures.
    #[schemars(range(min = 0, max = 4_294_967_295_u32))]
    pub seed: u32,
}

impl Default for NoiseParams {
    fn default() -> Self {
        NoiseParams { beta: 2.0, size: 256, kmin: 1, kmax: 32, seed: 1 }
    }
}

impl NoiseParams {
    /// Reads parameters whose ranges were checked.
    ///
    /// # Errors
    /// [`BakeError::Parameter`] where the band is empty or finer than the texels.
    pub fn from_json(params: &Map<String, Value>) -> Result<NoiseParams, BakeError> {
        let refuse = |place: &str, reason: String| BakeError::Parameter {
            room: names::ROOM_NOISE.into(),
            place: place.into(),
            reason,
        };
        let params: NoiseParams = serde_json::from_value(Value::Object(params.clone()))
            .map_err(|error| refuse("parameters", error.to_string()))?;
        if 2 * params.kmax >= params.size {
            let reason = format!("{}: must be below half of size = {}", params.kmax, params.size);
            return Err(refuse("kmax", reason));
        }
        if params.kmin > params.kmax {
            return Err(refuse("kmin", format!("{}: must be at most kmax = {}", params.kmin, params.kmax)));
        }
        Ok(params)
    }
}
