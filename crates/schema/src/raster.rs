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
    scan(names::MAP_THICKNESS, 1, [0.0, 1000.0], "thickness of a scanned leaf, mm; 0 where there is none"),
    scan(names::MAP_HEIGHT_FRONT, 1, [-1000.0, 1000.0], "how far its front stands out, mm"),
    scan(names::MAP_HEIGHT_BACK, 1, [-1000.0, 1000.0], "how far its back stands out, mm"),
    scan(names::MAP_NORMAL_FRONT, 3, [-1.0, 1.0], "normals of its front"),
    scan(names::MAP_NORMAL_BACK, 3, [-1.0, 1.0], "normals of its back, x image right"),
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

/// A map of a scanned leaf. A thousandth of a millimeter is half a per cent of a leaf; in normals it is a twentieth of a degree.
const fn scan(name: &'static str, channels: u32, range: [f32; 2], doc: &'static str) -> RasterInfo {
    let [min, max] = range;
    RasterInfo { name, room: names::ROOM_LEAFSCAN, channels, min, max, visible_step: 1e-3, doc }
}

/// The raster of this name.
pub fn raster(name: &str) -> Option<&'static RasterInfo> {
    RASTERS.iter().find(|raster| raster.name == name)
}
