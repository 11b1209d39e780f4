//! What the room of light through leaves writes (Kusternig07 section 3.5).

use super::Room;
use crate::RasterInfo;

/// The room of light through leaves (Kusternig07 section 3.5): lives on maps, of one leaf material each.
pub const ROOM_TRANSLUCENCY: &str = "translucency";

/// Raster shown on the front of a leaf: three coefficients and the mean over directions; green or the one wavelength.
pub const RASTER_TRANSLUCENCY_FRONT: &str = "translucencyFront";

/// The same shown on the back.
pub const RASTER_TRANSLUCENCY_BACK: &str = "translucencyBack";

/// Ending of a raster of red light.
pub const BAND_RED: &str = "Red";

/// Ending of a raster of blue light.
pub const BAND_BLUE: &str = "Blue";

/// Photograph of a leaf against the light, passed on as it came.
pub const MAP_BACKLIT: &str = "backlit";

/// Mean base color of a leaf material, linear, in one texel: what the color of light that comes through is estimated from.
pub const MAP_ALBEDO: &str = "albedo";

/// Fact of a set of maps: linear color of the light that comes through over its greatest part, estimated.
pub const FACT_COLOR_ESTIMATE: &str = "colorEstimate";

/// Color of the light that comes through, the picture of a layer that is passed on as it came.
pub const PICTURE_COLOR: &str = "color";

/// Member of a translucency record's facts: what was made for each set of maps, by name.
pub const FACT_SHEETS: &str = "sheets";

pub(super) const ROOM: Room = Room {
    name: ROOM_TRANSLUCENCY,
    channels: &[],
    columns: &[],
    rasters: &[
        translucency(RASTER_TRANSLUCENCY_FRONT, "light through a leaf, shown on the front"),
        translucency("translucencyFrontRed", "the same in red"),
        translucency("translucencyFrontBlue", "the same in blue"),
        translucency(RASTER_TRANSLUCENCY_BACK, "light through a leaf, shown on the back"),
        translucency("translucencyBackRed", "the same in red"),
        translucency("translucencyBackBlue", "the same in blue"),
    ],
};

/// Coefficients of light through a leaf, and the mean over directions. What passes is at most 1, and a steep bump that was
/// divided by its mean leans at most this far.
const fn translucency(name: &'static str, doc: &'static str) -> RasterInfo {
    let room = ROOM_TRANSLUCENCY;
    RasterInfo { name, room, channels: 4, min: -64.0, max: 64.0, visible_step: 1.0 / 255.0, doc }
}
