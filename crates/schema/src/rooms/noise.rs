//! What the baker of wind noise writes: a texture for a library, no part of a tree (Kusternig07 section 5).

use super::Room;
use crate::RasterInfo;

/// The baker of wind noise: a texture for a library, no part of a tree.
pub const ROOM_NOISE: &str = "noise";

/// Raster of wind noise, two channels (Kusternig07 section 5).
pub const RASTER_NOISE: &str = "noise";

pub(super) const ROOM: Room = Room {
    name: ROOM_NOISE,
    channels: &[],
    columns: &[],
    rasters: &[RasterInfo {
        name: RASTER_NOISE,
        room: ROOM_NOISE,
        channels: 2,
        min: -1.0,
        max: 1.0,
        // One step of 16 bits, as PNG stores it.
        visible_step: 2.0 / 65_535.0,
        doc: "tiling 1/f^beta noise of the wind, peak 1",
    }],
};
