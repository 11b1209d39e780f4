//! Sections of `foliar.toml` that are not a room's own: [import], [roles], [scene], [pack].
//! A parameter is defined here once; flags, environment names and help come from these fields.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which axis of an OBJ points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// Y up, as glTF has it.
    Y,
    /// Z up: turned by -90 degrees about X.
    Z,
}

/// Unit of length of an OBJ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// Meter.
    M,
    /// Centimeter.
    Cm,
    /// Millimeter.
    Mm,
    /// Inch.
    In,
    /// Foot.
    Ft,
}

impl Unit {
    /// Length of one unit in meters.
    pub const fn meters(self) -> f64 {
        match self {
            Unit::M => 1.0,
            Unit::Cm => 0.01,
            Unit::Mm => 0.001,
            Unit::In => 0.0254,
            Unit::Ft => 0.3048,
        }
    }
}

/// How an asset is read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Import {
    /// Axis of an OBJ that points up; nothing said means y.
    pub up: Option<Up>,
    /// Unit of length of an OBJ; nothing said means m.
    pub unit: Option<Unit>,
    /// Height of the plant in meters: an OBJ is scaled to it, instead of `unit`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_m: Option<f64>,
    /// Node of a glTF to bake, by name, with everything below it.
    pub node: Option<String>,
    /// Scene of a glTF to bake, by number.
    pub scene: Option<u32>,
    /// Every node that draws a shared mesh gets a mesh of its own (else it is baked once, for its first node).
    pub expand_instances: bool,
    /// Folders outside the asset's own that textures and buffers may be read from.
    pub search: Vec<String>,
    /// Loose images for parts without one: PART=FILE.
    pub texture: Vec<String>,
}

/// Patterns (`*leaf*`, case ignored) over material, object and node names that decide roles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Roles {
    /// Parts that are leaves.
    pub leaf: Vec<String>,
    /// Parts that are wood.
    pub wood: Vec<String>,
    /// Parts that are no plant.
    pub other: Vec<String>,
}

/// What the scene requires; without it every baker runs at its defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Scene {
    /// How close, how sharp.
    pub camera: Camera,
    /// What light there is.
    pub light: Light,
    /// How windy it gets.
    pub wind: Wind,
    /// Whether leaves fall.
    pub fall: Fall,
    /// What it may cost.
    pub budget: Budget,
}

/// How close, how sharp.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Camera {
    /// Nearest distance between camera and foliage.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub nearest_m: f64,
    /// Height of the picture in pixels.
    #[schemars(range(min = 1))]
    pub height_px: u32,
    /// Vertical field of view.
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    pub fov_deg: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Camera { nearest_m: 3.0, height_px: 1080, fov_deg: 60.0 }
    }
}

/// Whether and how the sun moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sun {
    /// No sun.
    None,
    /// It stands still.
    Fixed,
    /// It moves.
    #[default]
    Moving,
}

/// Whether and how the sky changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sky {
    /// No sky light.
    None,
    /// The same from everywhere and always.
    Constant,
    /// It changes.
    #[default]
    Varying,
}

/// Which ambient term the scene wants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ambient {
    /// Whatever is there and fits.
    #[default]
    Auto,
    /// The density room's (Luft07), cheap.
    Density,
    /// Traced occlusion (Kusternig07 section 3.4).
    Traced,
    /// None.
    None,
}

/// What light there is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// The sun.
    pub sun: Sun,
    /// Toward the sun in the plant's frame, where it is fixed.
    pub sun_direction: Option<[f64; 3]>,
    /// The sky.
    pub sky: Sky,
    /// Light that bounces between leaves.
    pub indirect: bool,
    /// Which ambient term.
    pub ambient: Ambient,
    /// Realigned normals (Luft07), whatever `ambient` says.
    pub soft_normals: bool,
    /// Leaves seen against the sun.
    pub backlit: bool,
}

impl Default for Light {
    fn default() -> Self {
        Light {
            sun: Sun::default(),
            sun_direction: None,
            sky: Sky::default(),
            indirect: true,
            ambient: Ambient::default(),
            soft_normals: true,
            backlit: true,
        }
    }
}

/// How far the longest branch's tip moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Strength {
    /// Not at all.
    None,
    /// 2 % of its length.
    #[default]
    Breeze,
    /// 7 % of its length.
    Strong,
    /// 15 % of its length.
    Storm,
}

/// How windy it gets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Wind {
    /// The strongest wind that is shown.
    pub strength: Strength,
}

/// Whether leaves fall.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Fall {
    /// Single leaves fall.
    pub leaves: bool,
}

/// What it may cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Budget {
    /// rms error of each channel in its visible steps: 1 cannot be seen, 4 is a preview.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub quality: f64,
    /// Most bytes per vertex that a packed file may add.
    #[schemars(range(min = 0))]
    pub bytes_per_vertex: u32,
}

impl Default for Budget {
    fn default() -> Self {
        Budget { quality: 1.0, bytes_per_vertex: 48 }
    }
}

/// What is checked, and how serious it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Check {
    /// Rooms or channels that the file must hold: `wind,density`.
    pub require: Vec<String>,
    /// How serious a code is here: CODE=off, CODE=note, CODE=warning or CODE=error.
    pub severity: Vec<String>,
}

/// What a packed file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Engine {
    /// Any glTF viewer, no shader: NORMAL realigned, `COLOR_0` times the ambient coefficient.
    Core,
    /// Blender: float attributes of equal widths, vectors with Z up.
    Blender,
    /// Luft07's own encoding: a vector per vertex along the realigned normal, as long as the ambient coefficient.
    Luft07,
}

impl Engine {
    /// All that there are.
    pub const ALL: [Engine; 3] = [Engine::Core, Engine::Blender, Engine::Luft07];

    /// The word in files and flags.
    pub const fn name(self) -> &'static str {
        match self {
            Engine::Core => "core",
            Engine::Blender => "blender",
            Engine::Luft07 => "luft07",
        }
    }
}

/// How a file is packed for an engine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Pack {
    /// What the packed file is for.
    #[schemars(extend("x-flag" = "for"))]
    pub engine: Option<Engine>,
}
