//! What the room __room__ writes.

use super::Room;
use crate::{Channel, Neutral, Role};

/// The room of __room__.
pub const ROOM___ROOM__: &str = "__room__";

/// Share of the plant's foliage around a vertex.
pub const __ROOM___SHARE: &str = "___ROOM___SHARE";

pub(super) const ROOM: Room = Room {
    name: ROOM___ROOM__,
    channels: &[Channel {
        name: __ROOM___SHARE,
        room: ROOM___ROOM__,
        width: 1,
        roles: &[Role::Leaf, Role::Wood],
        min: 0.0,
        max: 1.0,
        unit_length: false,
        unit: "1",
        visible_step: 1.0 / 255.0,
        step_unit: "1",
        optical_depth: false,
        neutral: Neutral::Value(0.0),
        doc: "share of the plant's leaf area around the vertex, near leaves counting more",
    }],
    columns: &[],
    rasters: &[],
};
