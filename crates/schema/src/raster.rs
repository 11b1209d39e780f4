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
pub const RASTERS: &[RasterInfo] = &[RasterInfo {
    name: names::RASTER_NOISE,
    room: names::ROOM_NOISE,
    channels: 2,
    min: -1.0,
    max: 1.0,
    // One step of 16 bits, as PNG stores it.
    visible_step: 2.0 / 65_535.0,
    doc: "tiling 1/f^beta noise of the wind, peak 1",
}];

/// The raster of this name.
pub fn raster(name: &str) -> Option<&'static RasterInfo> {
    RASTERS.iter().find(|raster| raster.name == name)
}
