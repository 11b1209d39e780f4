//! What the layer of the branch hierarchy holds.

use super::Room;
use super::structure::{CLASS_LEAF, MAX_ID};
use crate::{Channel, Column, Element, Neutral, Role, column::ANY, column::NOT_NEGATIVE, column::ROWS};

/// The layer of the branch hierarchy, which structure finds when a room asks for it.
pub const ROOM_BRANCHES: &str = "branches";

/// Layer key of branch ids (in files: a feature id attribute with label [`LABEL_BRANCH`]).
pub const BRANCH_ID: &str = "BRANCH_ID";

/// Label of the branch ids among a primitive's feature ids.
pub const LABEL_BRANCH: &str = "foliar_branch";

/// Arc length along the branch that the vertex belongs to.
pub const BRANCH_ARC: &str = "_BRANCH_ARC";

/// Table class of branches; row = branch id.
pub const CLASS_BRANCH: &str = "foliarBranch";

/// Table class of the rings that the axes of branches run through, branch by branch, from root to tip.
pub const CLASS_AXIS: &str = "foliarBranchAxis";

macro_rules! branch_column {
    ($name:literal, $element:ident, $width:literal, $array:literal, $range:expr, $unit:literal, $doc:literal) => {
        branch_column!(CLASS_BRANCH, $name, $element, $width, $array, $range, $unit, $doc)
    };
    ($class:ident, $name:literal, $element:ident, $width:literal, $array:literal, $range:expr, $unit:literal, $doc:literal) => {
        Column {
            class: $class,
            name: $name,
            room: ROOM_BRANCHES,
            element: Element::$element,
            width: $width,
            array: $array,
            unit: $unit,
            range: $range,
            visible_step: 0.0,
            optical_depth: false,
            doc: $doc,
        }
    };
}

pub(super) const ROOM: Room = Room {
    name: ROOM_BRANCHES,
    channels: &[
        Channel {
            name: BRANCH_ID,
            room: ROOM_BRANCHES,
            width: 1,
            roles: &[Role::Wood],
            min: 0.0,
            max: MAX_ID,
            unit_length: false,
            unit: "row of foliarBranch",
            visible_step: 1.0,
            step_unit: "id",
            optical_depth: false,
            neutral: Neutral::NullId,
            doc: "branch that the vertex belongs to, at any depth",
        },
        Channel {
            name: BRANCH_ARC,
            room: ROOM_BRANCHES,
            width: 1,
            roles: &[Role::Wood],
            min: 0.0,
            max: f32::MAX,
            unit_length: false,
            unit: "m, rest frame",
            visible_step: 1e-3,
            step_unit: "m",
            optical_depth: false,
            neutral: Neutral::Value(0.0),
            doc: "way along the axis of the vertex's branch, from its root; the same all around a ring",
        },
    ],
    columns: &[
        Column {
            class: CLASS_LEAF,
            name: "branch",
            room: ROOM_BRANCHES,
            element: Element::I32,
            width: 1,
            array: false,
            unit: "row of foliarBranch, -1 none",
            range: ROWS,
            visible_step: 0.0,
            optical_depth: false,
            doc: "branch that the petiole is nearest to",
        },
        Column {
            class: CLASS_LEAF,
            name: "branchArc",
            room: ROOM_BRANCHES,
            element: Element::F32,
            width: 1,
            array: false,
            unit: "m, rest frame",
            range: ANY,
            visible_step: 0.0,
            optical_depth: false,
            doc: "way along that branch's axis, from its root, to where the leaf hangs",
        },
        branch_column!(
            "parent",
            I32,
            1,
            false,
            ROWS,
            "row of foliarBranch, -1 none",
            "branch that it grows from; -1 for a root"
        ),
        branch_column!("level", I32, 1, false, NOT_NEGATIVE, "level", "0 for a stem, else its parent's plus one"),
        branch_column!(
            "chain",
            I32,
            4,
            true,
            ROWS,
            "rows of foliarBranch, -1 none",
            "the branch itself or its ancestor at levels 0 to 3"
        ),
        branch_column!(
            "pivot",
            F32,
            3,
            false,
            ANY,
            "m, rest frame",
            "where its axis, drawn on backward, meets its parent's"
        ),
        branch_column!(
            "direction",
            F32,
            3,
            false,
            ANY,
            "unit vector, rest frame",
            "from its root to the middle of its length"
        ),
        branch_column!("length", F32, 1, false, NOT_NEGATIVE, "m", "length of its axis"),
        branch_column!("radius", F32, 1, false, NOT_NEGATIVE, "m", "radius at its root"),
        branch_column!("margin", F32, 1, false, ANY, "1", "cost of the second-best parent less that of the chosen one"),
        branch_column!(
            "cost",
            F32,
            1,
            false,
            ANY,
            "1",
            "cost of the chosen parent: gap, distance from its axis, thickness, taper"
        ),
        branch_column!("gap", F32, 1, false, ANY, "radii of the branch", "distance between its bark and its parent's"),
        branch_column!(
            "kind",
            I32,
            1,
            false,
            [0.0, 2.0],
            "0, 1 or 2",
            "0 hangs on another, 1 stands on the ground, 2 is an island"
        ),
        branch_column!(
            "roughness",
            F32,
            1,
            false,
            NOT_NEGATIVE,
            "1",
            "mean deviation of its rings from circles, over their radius"
        ),
        branch_column!(
            "split",
            F32,
            1,
            false,
            [0.0, 1.0],
            "1",
            "share of its rings that fall into several parts: it is fused"
        ),
        branch_column!("tubes", I32, 1, false, NOT_NEGATIVE, "tubes", "tubes end to end that it was joined from"),
        branch_column!(
            CLASS_AXIS,
            "branch",
            I32,
            1,
            false,
            NOT_NEGATIVE,
            "row of foliarBranch",
            "branch whose axis runs through the ring"
        ),
        branch_column!(
            CLASS_AXIS,
            "offset",
            F32,
            3,
            false,
            ANY,
            "m, rest frame",
            "center of the ring less the branch's pivot"
        ),
        branch_column!(CLASS_AXIS, "radius", F32, 1, false, NOT_NEGATIVE, "m, rest frame", "radius of the ring"),
    ],
    rasters: &[],
};
