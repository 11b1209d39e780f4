//! Rasters that bakers write, with ranges and the step that counts.

use crate::RASTERS;

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

/// The raster of this name.
pub fn raster(name: &str) -> Option<&'static RasterInfo> {
    RASTERS.iter().find(|raster| raster.name == name)
}
