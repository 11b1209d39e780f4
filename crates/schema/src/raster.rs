//! Rasters that bakers write, with ranges and the step that counts.

use crate::names;

/// A raster of floats.
#[derive(Clone, Copy, Debug)]
pub struct RasterInfo {
    /// Name in a layer.
    pub name: &'static str,
    /// Who writes it.
    pub room: &'static str,
    /// Numbers per texel.
    pub channels: u32,
    /// Least value.
    pub min: f32,
    /// Greatest value.
    pub max: f32,
    /// Smallest difference that counts.
    pub visible_step: f64,
    /// One line for docs.
    pub doc: &'static str,
}

/// All rasters.
pub const RASTERS: &[RasterInfo] = &[
    RasterInfo {
        name: names::RASTER_NOISE,
        room: names::ROOM_NOISE,
        channels: 2,
        min: -1.0,
        max: 1.0,
        // One step of 16 bits, as PNG stores it.
        visible_step: 2.0 / 65_535.0,
        doc: "tiling 1/f^beta noise of the wind, peak 1",
    },
    translucency(names::RASTER_TRANSLUCENCY_FRONT, "light through a leaf, shown on the front"),
    translucency("translucencyFrontRed", "the same in red"),
    translucency("translucencyFrontBlue", "the same in blue"),
    translucency(names::RASTER_TRANSLUCENCY_BACK, "light through a leaf, shown on the back"),
    translucency("translucencyBackRed", "the same in red"),
    translucency("translucencyBackBlue", "the same in blue"),
];

/// Coefficients of light through a leaf, and the mean over directions. What passes is at most 1, and a steep bump that was
/// divided by its mean leans at most this far.
const fn translucency(name: &'static str, doc: &'static str) -> RasterInfo {
    let room = names::ROOM_TRANSLUCENCY;
    RasterInfo { name, room, channels: 4, min: -64.0, max: 64.0, visible_step: 1.0 / 255.0, doc }
}

/// The raster of this name.
pub fn raster(name: &str) -> Option<&'static RasterInfo> {
    RASTERS.iter().find(|raster| raster.name == name)
}
