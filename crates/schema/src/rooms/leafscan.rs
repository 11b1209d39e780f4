//! What the baker of leaf scans writes: maps for a library, no part of a tree; a room over maps reads them.

use super::Room;
use crate::RasterInfo;

/// The baker of leaf scans: maps for a library, no part of a tree.
pub const ROOM_LEAFSCAN: &str = "leafscan";

/// Map of a leaf's thickness.
pub const MAP_THICKNESS: &str = "thickness";

/// Map of where the leaf is.
pub const MAP_ALPHA: &str = "alpha";

/// Map of the front's normals.
pub const MAP_NORMAL_FRONT: &str = "normal-front";

/// Map of the back's normals.
pub const MAP_NORMAL_BACK: &str = "normal-back";

/// Map of the front's relief.
pub const MAP_HEIGHT_FRONT: &str = "height-front";

/// Map of the back's relief, outward from the back.
pub const MAP_HEIGHT_BACK: &str = "height-back";

pub(super) const ROOM: Room = Room {
    name: ROOM_LEAFSCAN,
    channels: &[],
    columns: &[],
    rasters: &[
        scan(MAP_THICKNESS, 1, [0.0, 1000.0], "thickness of a scanned leaf, mm; 0 where there is none"),
        scan(MAP_HEIGHT_FRONT, 1, [-1000.0, 1000.0], "how far its front stands out, mm"),
        scan(MAP_HEIGHT_BACK, 1, [-1000.0, 1000.0], "how far its back stands out, mm"),
        scan(MAP_NORMAL_FRONT, 3, [-1.0, 1.0], "normals of its front"),
        scan(MAP_NORMAL_BACK, 3, [-1.0, 1.0], "normals of its back, x image right"),
    ],
};

/// A map of a scanned leaf. A thousandth of a millimeter is half a per cent of a leaf; in normals it is a twentieth of a degree.
const fn scan(name: &'static str, channels: u32, range: [f32; 2], doc: &'static str) -> RasterInfo {
    let [min, max] = range;
    RasterInfo { name, room: ROOM_LEAFSCAN, channels, min, max, visible_step: 1e-3, doc }
}
