//! What the room of metaball density writes (Luft07).

use super::Room;
use crate::{Channel, Neutral, Role};

/// The room of metaball density (Luft07).
pub const ROOM_DENSITY: &str = "density";

/// Ambient coefficient k_a (Luft07 eq. 4) or the sky's ambient term.
pub const AMBIENT: &str = "_AMBIENT";

/// Realigned normal (Luft07 section 4), unit, in the mesh's own frame.
pub const SOFT_NORMAL: &str = "_SOFT_NORMAL";

pub(super) const ROOM: Room = Room {
    name: ROOM_DENSITY,
    channels: &[
        Channel {
            name: AMBIENT,
            room: ROOM_DENSITY,
            width: 1,
            roles: &[Role::Leaf, Role::Wood],
            min: 0.0,
            max: 1.0,
            unit_length: false,
            unit: "1",
            visible_step: 1.0 / 255.0,
            step_unit: "1",
            optical_depth: false,
            neutral: Neutral::Value(1.0),
            doc: "ambient coefficient: share of the sky's light that reaches the vertex",
        },
        Channel {
            name: SOFT_NORMAL,
            room: ROOM_DENSITY,
            width: 3,
            roles: &[Role::Leaf],
            min: -1.0,
            max: 1.0,
            unit_length: true,
            unit: "unit vector, mesh frame",
            visible_step: 1.0,
            step_unit: "degree",
            optical_depth: false,
            neutral: Neutral::OwnNormal,
            doc: "normal realigned to the shape of the crown",
        },
    ],
    columns: &[],
    rasters: &[],
};
