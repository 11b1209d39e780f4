//! What the step that finds roles and leaves writes.

use super::Room;
use crate::{Channel, Column, Element, Neutral, Role, column::ANY, column::NOT_NEGATIVE};

/// Largest id that a float attribute holds exactly.
pub(super) const MAX_ID: f32 = 16_777_216.0;

/// The step that finds roles and leaves.
pub const ROOM_STRUCTURE: &str = "structure";

/// Layer key of leaf ids (in files: a feature id attribute with label [`LABEL_LEAF`]).
pub const LEAF_ID: &str = "LEAF_ID";

/// Label of the leaf ids among a primitive's feature ids.
pub const LABEL_LEAF: &str = "foliar_leaf";

/// Table class of leaves; row = leaf id.
pub const CLASS_LEAF: &str = "foliarLeaf";

macro_rules! leaf_column {
    ($name:literal, $element:ident, $width:literal, $range:expr, $unit:literal, $doc:literal) => {
        Column {
            class: CLASS_LEAF,
            name: $name,
            room: ROOM_STRUCTURE,
            element: Element::$element,
            width: $width,
            array: false,
            unit: $unit,
            range: $range,
            visible_step: 0.0,
            optical_depth: false,
            doc: $doc,
        }
    };
}

pub(super) const ROOM: Room = Room {
    name: ROOM_STRUCTURE,
    channels: &[Channel {
        name: LEAF_ID,
        room: ROOM_STRUCTURE,
        width: 1,
        roles: &[Role::Leaf],
        min: 0.0,
        max: MAX_ID,
        unit_length: false,
        unit: "row of foliarLeaf",
        visible_step: 1.0,
        step_unit: "id",
        optical_depth: false,
        neutral: Neutral::NullId,
        doc: "leaf that the vertex belongs to",
    }],
    columns: &[
        leaf_column!("center", F32, 3, ANY, "m, rest frame", "area-weighted center of the leaf"),
        leaf_column!("normal", F32, 3, ANY, "unit vector, rest frame", "area-weighted normal, side of the first face"),
        leaf_column!("area", F32, 1, NOT_NEGATIVE, "m^2", "one-sided area times alpha coverage"),
        leaf_column!("group", I32, 1, ANY, "group id", "leaves that are one object share it"),
        leaf_column!("petiole", F32, 3, ANY, "m, rest frame", "point of the leaf nearest to wood"),
        leaf_column!("crownVolume", I32, 1, [0.0, 1.0], "0 or 1", "1 where the row was sampled from a crown volume"),
    ],
    rasters: &[],
};
