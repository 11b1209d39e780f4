//! Parameters of a picture.

use crate::ViewError;
use foliar_schema::check_ranges;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the tree is lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Look {
    /// As the file came: its own normals, the same ambient light everywhere.
    Plain,
    /// With what was baked: realigned normals, ambient coefficient.
    #[default]
    Baked,
    /// As any glTF viewer does without foliar's shaders: NORMAL turned by the triangle's side, `COLOR_0` as a
    /// factor on the color, back faces of one-sided materials left out, no shadows on the tree.
    Stock,
    /// A pen drawing: ink where the normals turn by more than `line_angle_deg`, and round the silhouette (Luft07
    /// Figure 7).
    Lines,
    /// Sun and sky by what the light room baked (Boulanger08): no shadow rays.
    Light,
    /// The same light followed path by path, what `light` stands for: a path per ray, so ask for many samples.
    Traced,
}

/// Which normals a pen drawing follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Normals {
    /// Those of the file.
    Plain,
    /// The realigned ones, where they were baked.
    #[default]
    Baked,
}

/// What lies behind the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Background {
    /// A neutral gray gradient.
    #[default]
    Studio,
    /// White.
    White,
    /// Black.
    Black,
    /// Nothing: alpha 0.
    Clear,
}

/// What lies under the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ground {
    /// Only the tree's shadow, fading out with distance.
    #[default]
    Shadow,
    /// Nothing.
    None,
}

/// What says how large the plant is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// A person of 1.7 m beside plants of about that size or more, and a bar of a round length.
    #[default]
    Person,
    /// The bar alone.
    Bar,
    /// Nothing.
    None,
}

/// Parameters of a picture. Angles around the tree count from +Z (0) over +X (90), as seen from above
/// counter-clockwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ViewParams {
    /// Width of the picture in pixels.
    #[schemars(range(min = 16, max = 8192))]
    pub width_px: u32,
    /// Height of the picture in pixels; the legend of false colors stands below and adds to it.
    #[schemars(range(min = 16, max = 8192))]
    pub height_px: u32,
    /// Rays per pixel.
    #[schemars(range(min = 1, max = 1024))]
    pub samples: u32,
    /// How the tree is lit, where no channel is asked for.
    pub look: Look,
    /// Normals that `lines` follow.
    pub line_normals: Normals,
    /// Angle between the normals of neighboring places from which `lines` draw an edge, degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub line_angle_deg: f64,
    /// Width of `lines` in pixels.
    #[schemars(range(min = 0.1, max = 16.0))]
    pub line_width_px: f64,
    /// Gaps and leaves smaller than this are left out of `lines`, pixels; 0 keeps all.
    #[schemars(range(min = 0.0, max = 32.0))]
    pub line_detail_px: f64,
    /// Plants that stand around it, `FILE@x,y,z[,yaw_deg[,scale]]` each, as `foliar bake` takes them.
    pub neighbor: Vec<String>,
    /// Name of a channel or column to show in false colors instead, such as `_AMBIENT` or `foliarLeaf/group`;
    /// `_WIND_WEIGHTS[2]` shows its third number alone, `role` what each part was taken for, `petiole-length` how long
    /// leaves hang.
    pub channel: Option<String>,
    /// Where the camera stands around the tree, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub azimuth_deg: f64,
    /// How far the camera stands above the tree's horizon, degrees.
    #[schemars(range(min = -89.0, max = 89.0))]
    pub elevation_deg: f64,
    /// Vertical opening of the camera, degrees.
    #[schemars(range(min = 1.0, max = 120.0))]
    pub fov_deg: f64,
    /// Point that the camera looks at, `x,y,z` in meters of the scene's rest frame; without one the whole plant is in
    /// the picture.
    pub target_m: Option<[f64; 3]>,
    /// Distance of the camera from the point that it looks at (the plant's center where none is given), meters; without
    /// one it stands where it would see the whole plant.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub distance_m: Option<f64>,
    /// Where the sun stands around the tree, degrees.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub sun_azimuth_deg: f64,
    /// Height of the sun above the horizon, degrees.
    #[schemars(range(min = 1.0, max = 90.0))]
    pub sun_elevation_deg: f64,
    /// Factor on all light.
    #[schemars(extend("exclusiveMinimum" = 0.0), range(max = 1000.0))]
    pub exposure: f64,
    /// What lies behind the tree.
    pub background: Background,
    /// What lies under the tree.
    pub ground: Ground,
    /// What says how large the plant is.
    pub scale: Scale,
}

impl Default for ViewParams {
    fn default() -> Self {
        ViewParams {
            width_px: 960,
            height_px: 720,
            samples: 16,
            look: Look::default(),
            line_normals: Normals::default(),
            line_angle_deg: 40.0,
            line_width_px: 1.2,
            line_detail_px: 6.0,
            neighbor: Vec::new(),
            channel: None,
            azimuth_deg: 30.0,
            elevation_deg: 10.0,
            fov_deg: 30.0,
            target_m: None,
            distance_m: None,
            sun_azimuth_deg: 80.0,
            sun_elevation_deg: 50.0,
            exposure: 1.0,
            background: Background::default(),
            ground: Ground::default(),
            scale: Scale::default(),
        }
    }
}

/// What a picture shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shading {
    /// As [`Look::Plain`].
    Plain,
    /// As [`Look::Baked`].
    Baked,
    /// As [`Look::Stock`].
    Stock,
    /// As [`Look::Lines`].
    Lines(Normals),
    /// As [`Look::Light`].
    Light,
    /// As [`Look::Traced`].
    Traced,
    /// A channel or column in false colors, with a legend.
    Channel(String),
}

impl ViewParams {
    /// What these parameters ask for: the channel where there is one, else the look.
    pub fn shading(&self) -> Shading {
        match (&self.channel, self.look) {
            (Some(name), _) => Shading::Channel(name.clone()),
            (None, Look::Plain) => Shading::Plain,
            (None, Look::Baked) => Shading::Baked,
            (None, Look::Stock) => Shading::Stock,
            (None, Look::Lines) => Shading::Lines(self.line_normals),
            (None, Look::Light) => Shading::Light,
            (None, Look::Traced) => Shading::Traced,
        }
    }

    /// JSON Schema: flags, files and help come from it.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(ViewParams).to_value()
    }

    /// # Errors
    /// [`ViewError::Range`] names the parameter that is out of range.
    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let numbers = [
            self.azimuth_deg,
            self.elevation_deg,
            self.fov_deg,
            self.sun_azimuth_deg,
            self.sun_elevation_deg,
            self.exposure,
            self.line_angle_deg,
            self.line_width_px,
            self.line_detail_px,
        ];
        // NaN would become null in JSON, which no range refuses.
        let chosen = self.target_m.iter().flatten().chain(&self.distance_m);
        if numbers.iter().chain(chosen).any(|n| !n.is_finite()) {
            return Err(ViewError::NotFinite);
        }
        let value = serde_json::to_value(self).unwrap_or_default();
        Ok(check_ranges(&ViewParams::schema(), &value)?)
    }
}
