//! Parameters of the light room.

use crate::optics::{Optics, OpticsKind, Rgb};
use crate::profile::Profile;
use foliar_bake::BakeError;
use foliar_schema::{Budget, names};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// How optical depths are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DepthEngine {
    /// `exact` or `tree`, whatever keeps the promise of `quality` in less time.
    #[default]
    Auto,
    /// Every leaf against every other.
    Exact,
    /// Leaves that are far stand together.
    Tree,
    /// Rays from points on the leaf: sees the shape of leaves, their cut-outs, and wood; many times as slow as `tree`.
    Rays,
}

/// What the run-time model knows of the sun's light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SunModel {
    /// What the eight octants say.
    #[default]
    Octants,
    /// Nine coefficients of transmittance more (spherical harmonics of order 2), from rays: shadows are sharper.
    Harmonics,
}

/// Parameters of the light room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// How optical depths are found.
    pub engine: DepthEngine,
    /// How leaves are counted.
    pub profile: Profile,
    /// For `tree`: leaves stand together where they spread less than this times their distance; nothing said: as
    /// `quality` allows.
    #[schemars(range(max = 0.9), extend("exclusiveMinimum" = 0.0))]
    pub opening: Option<f64>,
    /// For rays: how many in each octant.
    #[schemars(range(min = 1, max = 4096))]
    pub rays: u32,
    /// What the run-time model knows of the sun's light.
    pub sun: SunModel,
    /// Error of the transmittance of an octant, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a
    /// preview; nothing said: what the scene asks for.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub quality: Option<f64>,
    /// Kind of leaf: what it reflects and lets through.
    pub leaf_kind: OpticsKind,
    /// Reflectance of the front, one number or red, green, blue; none: that of `leaf_kind`.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub reflectance_front: Vec<f64>,
    /// Reflectance of the back.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub reflectance_back: Vec<f64>,
    /// Share of the light on the front that leaves on the back.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub transmittance_front: Vec<f64>,
    /// Share of the light on the back that leaves on the front.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub transmittance_back: Vec<f64>,
}

impl Default for Params {
    fn default() -> Self {
        Params {
            engine: DepthEngine::default(),
            profile: Profile::default(),
            opening: None,
            rays: 16,
            sun: SunModel::default(),
            quality: None,
            leaf_kind: OpticsKind::default(),
            reflectance_front: Vec::new(),
            reflectance_back: Vec::new(),
            transmittance_front: Vec::new(),
            transmittance_back: Vec::new(),
        }
    }
}

impl Params {
    /// The parameters of a JSON object, with defaults for what it does not name.
    ///
    /// # Errors
    /// [`BakeError::Range`] outside the documented ranges, [`BakeError::Parameter`] for unknown names, wrong types, and
    /// leaves that give off more light than falls on them.
    pub fn from_json(params: &Map<String, Value>) -> Result<Params, BakeError> {
        let (room, value) = (names::ROOM_LIGHT, Value::Object(params.clone()));
        foliar_schema::check_ranges(&schemars::schema_for!(Params).to_value(), &value)
            .map_err(|source| BakeError::Range { room: room.into(), source })?;
        let params: Params = serde_json::from_value(value).map_err(|error| refused("params", error.to_string()))?;
        params.check()?;
        Ok(params)
    }

    /// Refuses what JSON cannot say but Rust can, and numbers that do not go together.
    ///
    /// # Errors
    /// [`BakeError::Parameter`] with name, number and what would be right.
    pub fn check(&self) -> Result<(), BakeError> {
        let opening = self.opening.unwrap_or(0.5);
        let rules = [
            ("opening", opening, opening > 0.0 && opening <= 0.9, "above 0 and at most 0.9"),
            ("quality", self.quality(), self.quality() > 0.0, "above 0 (rms error in visible steps)"),
            ("rays", f64::from(self.rays), (1..=4096).contains(&self.rays), "from 1 to 4096"),
        ];
        if let Some((name, value, _, rule)) = rules.into_iter().find(|(_, v, holds, _)| !(v.is_finite() && *holds)) {
            return Err(refused(name, format!("is {value}: must be finite and {rule}")));
        }
        self.optics()?.check().map_err(|(name, reason)| refused(name, reason))
    }

    /// What the leaves reflect and let through.
    ///
    /// # Errors
    /// [`BakeError::Parameter`] for a list that is neither empty nor one number nor three.
    pub fn optics(&self) -> Result<Optics, BakeError> {
        let kind = self.leaf_kind.optics();
        let own = |name: &str, given: &[f64], else_: Rgb| match *given {
            [] => Ok(else_),
            [gray] => Ok([gray; 3]),
            [r, g, b] => Ok([r, g, b]),
            _ => Err(refused(name, format!("holds {} numbers: must be one, or red, green, blue", given.len()))),
        };
        Ok(Optics {
            reflectance_front: own("reflectance_front", &self.reflectance_front, kind.reflectance_front)?,
            reflectance_back: own("reflectance_back", &self.reflectance_back, kind.reflectance_back)?,
            transmittance_front: own("transmittance_front", &self.transmittance_front, kind.transmittance_front)?,
            transmittance_back: own("transmittance_back", &self.transmittance_back, kind.transmittance_back)?,
        })
    }

    /// The error to keep, visible steps: this room's own, else a scene's default.
    pub(crate) fn quality(&self) -> f64 {
        self.quality.unwrap_or_else(|| Budget::default().quality)
    }
}

fn refused(place: &str, reason: String) -> BakeError {
    BakeError::Parameter { room: names::ROOM_LIGHT.into(), place: place.into(), reason }
}
