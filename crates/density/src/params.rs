//! Parameters of the density room: what a person would pick, each defined once (Luft07 eqs. 2 to 4).

use crate::ROOM;
use crate::surface::SurfaceParams;
use foliar_bake::{BakeError, Placement, parse_params};
use foliar_schema::Budget;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Which leaves a vertex of a leaf counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SelfLeaf {
    /// All but the leaf's own group: a lone leaf is fully lit.
    #[default]
    Exclude,
    /// All, as the paper sums: a lone leaf shades itself.
    Include,
}

/// Which ambient term `_AMBIENT` holds.
///
/// The default was measured: rank correlation with the depth under the crown (`crown_depth`) on seven
/// shared trees of 448 to 39,060 leaves, at about the automatic radius, is -.57 to -.94 for `sky` and .07 to
/// -.89 for `luft`: where leaves grow in tufts, local density tells of the tuft, and the sky of the crown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum AmbientTerm {
    /// k_a of the local density (Luft07 eq. 4).
    Luft,
    /// Transmittance to the sky, averaged over all directions (Beer-Lambert through the density field).
    #[default]
    Sky,
}

/// What one metaball stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GeneratorKind {
    /// A leaf, weighted by its area with alpha (mean weight 1).
    #[default]
    Leaf,
    /// A leaf, every one with weight 1.
    LeafCount,
    /// A triangle of the foliage, every one with weight 1, as the paper has it: a leaf that is cut into more
    /// triangles gets denser.
    Primitive,
}

/// In units of what `threshold` and `darkest_density` are given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DensityUnit {
    /// The plant's own median density: the same numbers suit any tree.
    #[default]
    Median,
    /// Density at the center of a mean leaf alone, as the paper has it: to be found by hand for each tree.
    Absolute,
}

/// Where realigned normals come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NormalMode {
    /// Mean direction to the sky, each direction weighted by the light that comes through: our own.
    #[default]
    Sky,
    /// Normal of the closest point of the implicit surface, cavities left out (Luft07 section 4).
    Surface,
}

/// Which channels are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Channels {
    /// `_AMBIENT` and `_SOFT_NORMAL`.
    #[default]
    Both,
    /// `_AMBIENT` only.
    Ambient,
    /// `_SOFT_NORMAL` only.
    Normals,
}

/// Parameters of the density room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Radius of influence of a leaf, meters (Luft07 eq. 2); nothing said: from the crown's size and the
    /// number of its leaves.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub radius_m: Option<f64>,
    /// Density below which a place counts as outside, in units of `density_unit` (tau of Luft07 eq. 3).
    #[schemars(range(min = 0.0))]
    pub threshold: f64,
    /// Density above the threshold from which a place is darkest, in units of `density_unit` (d_min of
    /// Luft07 eq. 4).
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub darkest_density: f64,
    /// Unit of `threshold` and `darkest_density`.
    pub density_unit: DensityUnit,
    /// Ambient coefficient of the darkest places (k_min of Luft07 eq. 4).
    #[schemars(range(min = 0.0, max = 1.0))]
    pub darkest_ambient: f64,
    /// How fast light falls off with density (n of Luft07 eq. 4).
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub exponent: f64,
    /// Whether a leaf's own group counts in the density at its vertices.
    #[serde(rename = "self")]
    pub self_leaf: SelfLeaf,
    /// Ambient term: `luft` or `sky`.
    pub ambient: AmbientTerm,
    /// What one metaball stands for.
    pub generators: GeneratorKind,
    /// Share of the metaballs that count, chosen at random (Luft07 section 5): faster and coarser.
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0))]
    pub subsample: f64,
    /// Where realigned normals come from.
    pub normals: NormalMode,
    /// Which channels are written.
    pub channels: Channels,
    /// Error of each channel, rms over 4,096 places, in its visible steps: 1 cannot be seen, 4 is a preview;
    /// nothing said: what the scene asks for.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub quality: Option<f64>,
    /// Plants around this one, `FILE@x,y,z[,yaw_deg[,scale]]` each: where the origin of FILE stands, meters in the
    /// rest frame of the plant being baked. They darken and turn normals, and are no part of the median density.
    pub neighbor: Vec<String>,
    /// Share of the original normal in the realigned one (Luft07 section 4).
    #[schemars(range(min = 0.0, max = 1.0))]
    pub blend: f64,
    /// Edge of a cell of the implicit surface, meters; nothing said: a quarter of the radius of influence.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub surface_cell_m: Option<f64>,
    /// Most memory that the implicit surface and its making may take, megabytes.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub surface_memory_mb: f64,
}

impl Default for Params {
    fn default() -> Self {
        Params {
            radius_m: None,
            threshold: 0.1,
            darkest_density: 2.0,
            density_unit: DensityUnit::default(),
            darkest_ambient: 0.1,
            exponent: 3.0,
            self_leaf: SelfLeaf::default(),
            ambient: AmbientTerm::default(),
            generators: GeneratorKind::default(),
            subsample: 1.0,
            normals: NormalMode::default(),
            channels: Channels::default(),
            quality: None,
            neighbor: Vec::new(),
            blend: 0.0,
            surface_cell_m: None,
            surface_memory_mb: SurfaceParams::default().memory_mb,
        }
    }
}

impl Params {
    /// The parameters of a JSON object, with defaults for what it does not name.
    ///
    /// # Errors
    /// [`BakeError::Range`] outside the documented ranges, [`BakeError::Parameter`] for unknown names,
    /// wrong types and numbers that are not finite.
    pub fn from_json(params: &Map<String, Value>) -> Result<Params, BakeError> {
        let params: Params = parse_params(ROOM, params)?;
        params.check()?;
        Ok(params)
    }

    /// Refuses what JSON cannot say but Rust can: NaN and infinities, and values out of range.
    ///
    /// # Errors
    /// [`BakeError::Parameter`] with name, number and what would be right.
    pub fn check(&self) -> Result<(), BakeError> {
        let radius = self.radius_m.unwrap_or(1.0);
        let cell = self.surface_cell_m.unwrap_or(1.0);
        let rules: [(&str, f64, bool, &str); 10] = [
            ("radius_m", radius, radius > 0.0, "above 0 (a leaf's influence, Luft07 eq. 2)"),
            ("threshold", self.threshold, self.threshold >= 0.0, "0 or above (Luft07 eq. 3)"),
            ("darkest_density", self.darkest_density, self.darkest_density > 0.0, "above 0 (Luft07 eq. 4)"),
            ("darkest_ambient", self.darkest_ambient, (0.0..=1.0).contains(&self.darkest_ambient), "from 0 to 1"),
            ("exponent", self.exponent, self.exponent > 0.0, "above 0 (Luft07 eq. 4)"),
            ("quality", self.quality(), self.quality() > 0.0, "above 0 (rms error in visible steps)"),
            ("blend", self.blend, (0.0..=1.0).contains(&self.blend), "from 0 to 1"),
            ("subsample", self.subsample, self.subsample > 0.0 && self.subsample <= 1.0, "above 0 and at most 1"),
            ("surface_cell_m", cell, cell > 0.0, "above 0"),
            ("surface_memory_mb", self.surface_memory_mb, self.surface_memory_mb > 0.0, "above 0"),
        ];
        for text in &self.neighbor {
            let refuse = |reason| BakeError::Parameter { room: ROOM.into(), place: "neighbor".into(), reason };
            Placement::parse(text).map_err(refuse)?;
        }
        match rules.into_iter().find(|(_, value, holds, _)| !(value.is_finite() && *holds)) {
            None => Ok(()),
            Some((name, value, _, rule)) => Err(BakeError::Parameter {
                room: ROOM.into(),
                place: name.into(),
                reason: format!("is {value}: must be finite and {rule}"),
            }),
        }
    }

    /// Whether `_AMBIENT` is written.
    pub(crate) fn wants_ambient(&self) -> bool {
        self.channels != Channels::Normals
    }

    /// Whether `_SOFT_NORMAL` is written.
    pub(crate) fn wants_normals(&self) -> bool {
        self.channels != Channels::Ambient
    }

    /// Whether anything of what is written comes from the sky.
    pub(crate) fn asks_sky(&self) -> bool {
        self.wants_ambient() && self.ambient == AmbientTerm::Sky
            || self.wants_normals() && self.normals == NormalMode::Sky
    }

    /// Whether anything of what is written is a matter of threshold and density.
    pub(crate) fn asks_density(&self) -> bool {
        self.wants_ambient() && self.ambient == AmbientTerm::Luft
            || self.wants_normals() && self.normals == NormalMode::Surface
    }

    /// The error to keep, visible steps: this room's own, else a scene's default. (A scene that says
    /// something else says it through the parameters that it implies.)
    pub(crate) fn quality(&self) -> f64 {
        self.quality.unwrap_or_else(|| Budget::default().quality)
    }
}
