//! What the room of wind writes (Kusternig07 section 5).

use super::Room;
use crate::{Channel, Column, Element, Neutral, Role, column::ANY};

/// The room of wind (Kusternig07 section 5).
pub const ROOM_WIND: &str = "wind";

/// Weights of the four levels of branches, 0 at the bark to 1 at the tip of a level's longest branch (Kusternig07 section 5).
pub const WIND_WEIGHTS: &str = "_WIND_WEIGHTS";

/// A leaf's own weight, 0 at the petiole to 1 at the tip.
pub const LEAF_WEIGHT: &str = "_LEAF_WEIGHT";

/// Table class of what moves branches; row = branch id.
pub const CLASS_WIND: &str = "foliarWind";

pub(super) const ROOM: Room = Room {
    name: ROOM_WIND,
    channels: &[
        Channel {
            name: WIND_WEIGHTS,
            room: ROOM_WIND,
            width: 4,
            roles: &[Role::Leaf, Role::Wood],
            min: 0.0,
            max: 1.0,
            unit_length: false,
            unit: "1",
            // Half a pixel at 3 m (1.6 mm) in a storm that moves the tip of a branch of 10 m by 1.5 m.
            visible_step: 1e-3,
            step_unit: "1",
            optical_depth: false,
            neutral: Neutral::Value(0.0),
            doc: "how much of the sway of its branch, and of each ancestor, the vertex takes part in; level 0 to 3",
        },
        Channel {
            name: LEAF_WEIGHT,
            room: ROOM_WIND,
            width: 1,
            roles: &[Role::Leaf],
            min: 0.0,
            max: 1.0,
            unit_length: false,
            unit: "1",
            visible_step: 1.0 / 255.0,
            step_unit: "1",
            optical_depth: false,
            neutral: Neutral::Value(0.0),
            doc: "way along the leaf: 0 at the petiole, 1 at the tip",
        },
    ],
    columns: &[
        Column {
            class: CLASS_WIND,
            name: "phase",
            room: ROOM_WIND,
            element: Element::F32,
            width: 2,
            array: false,
            unit: "tiles of the noise",
            range: ANY,
            visible_step: 0.0,
            optical_depth: false,
            doc: "where in the noise the branch starts",
        },
        Column {
            class: CLASS_WIND,
            name: "frame",
            room: ROOM_WIND,
            element: Element::F32,
            width: 4,
            array: false,
            unit: "quaternion x y z w, rest frame",
            range: ANY,
            visible_step: 0.0,
            optical_depth: false,
            doc: "turns X to the branch's right, Y to its up, Z along it",
        },
    ],
    rasters: &[],
};
