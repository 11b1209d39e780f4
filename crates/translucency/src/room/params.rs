//! Parameters of the translucency room, each defined once.

use super::ROOM;
use crate::light::{Entry, Fit};
use crate::map::{Model, Spreading};
use crate::photo::Veins;
use foliar_bake::BakeError;
use foliar_schema::names;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Kinds of leaves whose optics are known (PROSPECT-D inverted).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LeafKind {
    /// A green leaf of .2 mm.
    #[default]
    Typical,
    /// Thin and light green, .12 mm.
    Young,
    /// Thick and dark, .3 mm.
    Dark,
    /// Yellow, .2 mm.
    Senescent,
}

/// Whether two numbers bend the linear answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum AngularCurve {
    /// No: any viewer of three coefficients shows the map.
    #[default]
    Straight,
    /// Yes: a viewer must multiply by a0 + a1 l_z, which the record tells. Errors fall by a third to six tenths.
    Fitted,
}

/// What the map is divided by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Normalize {
    /// Nothing: physical.
    #[default]
    None,
    /// Its mean under diffuse light.
    Mean,
    /// Each texel by its own answer to diffuse light: only direction is left, for a leaf whose backlit photograph holds
    /// the rest.
    Diffuse,
}

/// Wavelengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Bands {
    /// One, `wavelength_nm`.
    #[default]
    One,
    /// Three maps a side: 610, 550 and 450 nm.
    Rgb,
}

/// Sides of the leaf that maps are made for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sides {
    /// Shown on the front, lit from the back.
    Front,
    /// Shown on the back, lit from the front.
    Back,
    /// Both.
    #[default]
    Both,
}

/// A side that a map is shown on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Front.
    Front,
    /// Back.
    Back,
}

impl Side {
    /// Which side light falls on where this one is shown: 0 front, 1 back.
    pub(super) fn lit(self) -> usize {
        match self {
            Side::Front => 1,
            Side::Back => 0,
        }
    }
}

impl Sides {
    /// Each side with the name of its raster.
    pub fn list(self) -> &'static [(Side, &'static str)] {
        const BOTH: [(Side, &str); 2] =
            [(Side::Front, names::RASTER_TRANSLUCENCY_FRONT), (Side::Back, names::RASTER_TRANSLUCENCY_BACK)];
        match self {
            Sides::Front => &BOTH[..1],
            Sides::Back => &BOTH[1..],
            Sides::Both => &BOTH,
        }
    }
}

/// In which frame the back's normal map was baked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NormalFrame {
    /// On the front's texture coordinates: x is the image's right on both sides.
    #[default]
    SameUvMirrored,
    /// In a right-handed frame of the back: its x points to the image's left.
    RightHanded,
}

/// Which way green points in normal maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NormalY {
    /// To the image's top (OpenGL, glTF).
    #[default]
    Up,
    /// To its bottom (DirectX).
    Down,
}

/// What the map of thickness is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ThicknessFrom {
    /// Thickness, measured or painted.
    #[default]
    Map,
    /// A photograph in color with alpha: thickness is estimated, veins thick, rim thin, the mean as `thickness_mean_mm` says.
    Photo,
}

/// Numbers of an EXR.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Exr {
    /// 16 bits: right to .05 %.
    #[default]
    Half,
    /// 32 bits.
    Float,
}

/// Whether a measured reflectance holds the surface's mirror.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Mirror {
    /// It does.
    #[default]
    Included,
    /// It was left out.
    Excluded,
}

/// Parameters of the translucency room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Map of thickness, `FILE` or `MATERIAL=FILE`: white is `thickness_scale_mm`; floats are millimeters.
    #[schemars(extend("x-map" = names::MAP_THICKNESS))]
    pub thickness: Vec<String>,
    /// Map of where the leaf is, `FILE` or `MATERIAL=FILE`; nothing given: the alpha of the thickness map or of the
    /// material's own color, else wherever the thickness is above 0.
    #[schemars(extend("x-map" = names::MAP_ALPHA))]
    pub alpha: Vec<String>,
    /// Normal map of the front, `FILE` or `MATERIAL=FILE`: light from there shows on the back.
    #[schemars(extend("x-map" = names::MAP_NORMAL_FRONT))]
    pub normal_front: Vec<String>,
    /// Normal map of the back, `FILE` or `MATERIAL=FILE`: light from there shows on the front.
    #[schemars(extend("x-map" = names::MAP_NORMAL_BACK))]
    pub normal_back: Vec<String>,
    /// Height map of the front in place of its normals, `FILE` or `MATERIAL=FILE`.
    #[schemars(extend("x-map" = names::MAP_HEIGHT_FRONT))]
    pub height_front: Vec<String>,
    /// Height map of the back, outward from it, `FILE` or `MATERIAL=FILE`.
    #[schemars(extend("x-map" = names::MAP_HEIGHT_BACK))]
    pub height_back: Vec<String>,
    /// Photograph of the leaf against the light, PNG or JPEG, `FILE` or `MATERIAL=FILE`: the color of what comes through,
    /// passed on as it is. Without one it is estimated from the base color.
    #[schemars(extend("x-map" = names::MAP_BACKLIT))]
    pub backlit: Vec<String>,
    /// Leaf materials that maps without a name belong to (`*leaf*`, case ignored); nothing given: the only one that there is.
    pub material: Vec<String>,
    /// What differs for one material, `MATERIAL:KEY=VALUE` each, KEY of this section: `Needle*:leaf_width_mm=2`.
    pub for_material: Vec<String>,
    /// Width of the map on the leaf, mm; this or `texel_mm` must be given: light spreads in millimeters.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub leaf_width_mm: Option<f64>,
    /// Edge of a texel on the leaf, mm.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub texel_mm: Option<f64>,
    /// The other edge of it, down the image, mm; nothing said: texels are square.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub texel_height_mm: Option<f64>,
    /// Thickness of the leaf where the map is 1 (white), less the offset, mm; nothing said: 1 for maps of floats, which hold
    /// millimeters. Whole numbers need it.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub thickness_scale_mm: Option<f64>,
    /// Thickness of the leaf where the map is 0, mm.
    pub thickness_offset_mm: f64,
    /// What the thickness map is.
    pub thickness_from: ThicknessFrom,
    /// Mean thickness of a photographed leaf, mm; nothing said: that of the kind of leaf.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub thickness_mean_mm: Option<f64>,
    /// How veins look in a photograph.
    pub veins: Veins,
    /// Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_scale_mm: Option<f64>,
    /// Kind of leaf.
    pub preset: LeafKind,
    /// Wavelength, nm: 510 as in the paper; a leaf's green peak is at 550.
    #[schemars(range(min = 450, max = 680))]
    pub wavelength_nm: f64,
    /// One wavelength or three.
    pub bands: Bands,
    /// Absorption, 1/mm; nothing said: that of `preset`.
    #[schemars(range(min = 0.0))]
    pub absorption: Option<f64>,
    /// Reduced scattering, 1/mm; nothing said: that of `preset`.
    #[schemars(range(min = 0.0))]
    pub reduced_scattering: Option<f64>,
    /// Mean cosine of scattering.
    #[schemars(range(min = -0.95, max = 0.999))]
    pub anisotropy: f64,
    /// Index of refraction; nothing said: that of `preset`.
    #[schemars(range(min = 1.0, max = 4.0))]
    pub index: Option<f64>,
    /// Measured reflectance and transmittance, `R,T`, of a leaf as thick as the median of the map: absorption and scattering
    /// follow from them. For `bands = "rgb"` three of them, of red, green and blue: `R,T;R,T;R,T`.
    pub fit_rt: Option<String>,
    /// Whether the measured reflectance holds the surface's mirror.
    pub mirror: Mirror,
    /// Layers of tissue from the front, `ABSORPTION,REDUCED,ANISOTROPY,SHARE` each, shares of the thickness; nothing said: one
    /// tissue.
    pub layer: Vec<String>,
    /// Where energy comes from.
    pub model: Model,
    /// How light enters.
    pub entry: Entry,
    /// How the fit weighs directions.
    pub fit: Fit,
    /// Whether two numbers bend the linear answer.
    pub curve: AngularCurve,
    /// Whether light spreads inside the leaf.
    pub spread: Spreading,
    /// Filters of the bank that stands for the spread, the identity among them; without it as many as keep the bank within
    /// .3 % rms of the direct gather: 6 on a map of 1024 texels, 8 on one of 4096.
    #[schemars(range(min = 2, max = 12))]
    pub filters: Option<u32>,
    /// What the map is divided by.
    pub normalize: Normalize,
    /// Sides that maps are made for.
    pub sides: Sides,
    /// In which frame the back's normal map was baked.
    pub normal_frame: NormalFrame,
    /// Which way green points in normal maps.
    pub normal_y: NormalY,
    /// Edge up to which texels of the baked maps are merged, two by two, mm; nothing said: none. A scene implies the size of a
    /// pixel at its nearest distance.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub coarsest_mm: Option<f64>,
    /// Numbers of the EXR beside the file.
    pub exr: Exr,
    /// Whether every map goes into the file, in 8 bits, and none beside it.
    pub embed_all: bool,
}

impl Default for Params {
    fn default() -> Self {
        Params {
            thickness: Vec::new(),
            alpha: Vec::new(),
            normal_front: Vec::new(),
            normal_back: Vec::new(),
            height_front: Vec::new(),
            height_back: Vec::new(),
            backlit: Vec::new(),
            material: Vec::new(),
            for_material: Vec::new(),
            leaf_width_mm: None,
            texel_mm: None,
            texel_height_mm: None,
            thickness_scale_mm: None,
            thickness_offset_mm: 0.0,
            thickness_from: ThicknessFrom::default(),
            thickness_mean_mm: None,
            veins: Veins::default(),
            height_scale_mm: None,
            preset: LeafKind::default(),
            wavelength_nm: 510.0,
            bands: Bands::default(),
            absorption: None,
            reduced_scattering: None,
            anisotropy: crate::presets::ANISOTROPY,
            index: None,
            fit_rt: None,
            mirror: Mirror::default(),
            layer: Vec::new(),
            model: Model::default(),
            entry: Entry::default(),
            fit: Fit::default(),
            curve: AngularCurve::default(),
            spread: Spreading::default(),
            filters: None,
            normalize: Normalize::default(),
            sides: Sides::default(),
            normal_frame: NormalFrame::default(),
            normal_y: NormalY::default(),
            coarsest_mm: None,
            exr: Exr::default(),
            embed_all: false,
        }
    }
}

/// A parameter that cannot be, why, and what would be right.
pub(super) fn refuse(place: &str, reason: impl Into<String>) -> BakeError {
    BakeError::Parameter { room: ROOM.into(), place: place.into(), reason: reason.into() }
}

impl Params {
    /// The parameters of a JSON object, with defaults for what it does not name.
    ///
    /// # Errors
    /// [`BakeError::Range`] outside the documented ranges, [`BakeError::Parameter`] for unknown names, wrong types, and
    /// where none or both of width and texel are given.
    pub fn from_json(params: &Map<String, Value>) -> Result<Params, BakeError> {
        let value = Value::Object(params.clone());
        let schema = schemars::schema_for!(Params).to_value();
        foliar_schema::check_ranges(&schema, &value)
            .map_err(|source| BakeError::Range { room: ROOM.into(), source })?;
        let params: Params = serde_json::from_value(value).map_err(|error| refuse("params", error.to_string()))?;
        if params.leaf_width_mm.is_some() == params.texel_mm.is_some() {
            let reason = "give this or texel_mm, and not both: how light spreads depends on the size of a texel";
            return Err(refuse("leaf_width_mm", reason));
        }
        if params.curve == AngularCurve::Fitted && params.entry != Entry::Transport {
            return Err(refuse("curve", "fitted needs entry = transport: the other entries have no curve"));
        }
        let own =
            [("absorption", params.absorption.is_some()), ("reduced_scattering", params.reduced_scattering.is_some())];
        let own = own.into_iter().filter_map(|(name, given)| given.then_some(name));
        let tissue = [("layer", !params.layer.is_empty()), ("fit_rt", params.fit_rt.is_some())];
        let mut said = tissue.into_iter().filter_map(|(name, given)| given.then_some(name)).chain(own);
        if let (Some(first @ ("layer" | "fit_rt")), Some(second)) = (said.next(), said.next()) {
            return Err(refuse(second, format!("and {first} both say the tissue: give one of them")));
        }
        if params.mirror != Mirror::default() && params.fit_rt.is_none() {
            return Err(refuse("mirror", "says how R of fit_rt was measured: give fit_rt too"));
        }
        if !params.layer.is_empty() && params.model != Model::AddingDoubling {
            return Err(refuse("layer", "several layers need model = adding-doubling"));
        }
        Ok(params)
    }

    /// Edges of a texel, right and down, mm, of a map of this width.
    pub(super) fn texel_mm(&self, width: usize) -> [f64; 2] {
        let right = self.texel_mm.unwrap_or_else(|| self.leaf_width_mm.unwrap_or(f64::NAN) / width as f64);
        [right, self.texel_height_mm.unwrap_or(right)]
    }
}

impl LeafKind {
    /// Name of its preset.
    pub fn name(self) -> &'static str {
        match self {
            LeafKind::Typical => "typical",
            LeafKind::Young => "young",
            LeafKind::Dark => "dark",
            LeafKind::Senescent => "senescent",
        }
    }
}
