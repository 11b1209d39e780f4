//! Columns (values per leaf or branch), with units, ranges and the step that an eye can just see.

use crate::channel::{Element, MOST_DEPTH};
use crate::names;

/// One value per row of a property table.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Class of the table.
    pub class: &'static str,
    /// Property of the class.
    pub name: &'static str,
    /// Who writes it.
    pub room: &'static str,
    /// Number type.
    pub element: Element,
    /// Numbers per row: 1 SCALAR, 2 to 4 VECn (or an array where `array`).
    pub width: usize,
    /// A fixed-length array rather than a vector.
    pub array: bool,
    /// Unit of measure.
    pub unit: &'static str,
    /// Least and greatest value of a number.
    pub range: [f32; 2],
    /// Smallest difference that can be seen; 0 where a difference is no matter of seeing.
    pub visible_step: f64,
    /// As of [`Channel`].
    pub optical_depth: bool,
    /// One line for docs.
    pub doc: &'static str,
}

/// Any number.
const ANY: [f32; 2] = [f32::MIN, f32::MAX];

macro_rules! leaf_column {
    ($name:literal, $element:ident, $width:literal, $unit:literal, $doc:literal) => {
        Column {
            class: names::CLASS_LEAF,
            name: $name,
            room: names::ROOM_STRUCTURE,
            element: Element::$element,
            width: $width,
            array: false,
            unit: $unit,
            range: ANY,
            visible_step: 0.0,
            optical_depth: false,
            doc: $doc,
        }
    };
}

macro_rules! branch_column {
    ($name:literal, $element:ident, $width:literal, $array:literal, $unit:literal, $doc:literal) => {
        branch_column!(CLASS_BRANCH, $name, $element, $width, $array, $unit, $doc)
    };
    ($class:ident, $name:literal, $element:ident, $width:literal, $array:literal, $unit:literal, $doc:literal) => {
        Column {
            class: names::$class,
            name: $name,
            room: names::ROOM_BRANCHES,
            element: Element::$element,
            width: $width,
            array: $array,
            unit: $unit,
            range: ANY,
            visible_step: 0.0,
            optical_depth: false,
            doc: $doc,
        }
    };
}

/// All columns, in the order in which files list them.
pub const COLUMNS: &[Column] = &[
    leaf_column!("center", F32, 3, "m, rest frame", "area-weighted center of the leaf"),
    leaf_column!("normal", F32, 3, "unit vector, rest frame", "area-weighted normal, side of the first face"),
    leaf_column!("area", F32, 1, "m^2", "one-sided area times alpha coverage"),
    leaf_column!("group", I32, 1, "group id", "leaves that are one object share it"),
    leaf_column!("petiole", F32, 3, "m, rest frame", "point of the leaf nearest to wood"),
    Column {
        class: names::CLASS_LEAF,
        name: "branch",
        room: names::ROOM_BRANCHES,
        element: Element::I32,
        width: 1,
        array: false,
        unit: "row of foliarBranch, -1 none",
        range: ANY,
        visible_step: 0.0,
        optical_depth: false,
        doc: "branch that the petiole is nearest to",
    },
    Column {
        class: names::CLASS_LEAF,
        name: "branchArc",
        room: names::ROOM_BRANCHES,
        element: Element::F32,
        width: 1,
        array: false,
        unit: "m, rest frame",
        range: ANY,
        visible_step: 0.0,
        optical_depth: false,
        doc: "way along that branch's axis, from its root, to where the leaf hangs",
    },
    leaf_column!("crownVolume", I32, 1, "0 or 1", "1 where the row was sampled from a crown volume"),
    branch_column!("parent", I32, 1, false, "row of foliarBranch, -1 none", "branch that it grows from; -1 for a root"),
    branch_column!("level", I32, 1, false, "level", "0 for a stem, else its parent's plus one"),
    branch_column!(
        "chain",
        I32,
        4,
        true,
        "rows of foliarBranch, -1 none",
        "the branch itself or its ancestor at levels 0 to 3"
    ),
    branch_column!("pivot", F32, 3, false, "m, rest frame", "where its axis, drawn on backward, meets its parent's"),
    branch_column!("direction", F32, 3, false, "unit vector, rest frame", "from its root to the middle of its length"),
    branch_column!("length", F32, 1, false, "m", "length of its axis"),
    branch_column!("radius", F32, 1, false, "m", "radius at its root"),
    branch_column!("margin", F32, 1, false, "1", "cost of the second-best parent less that of the chosen one"),
    branch_column!(
        "cost",
        F32,
        1,
        false,
        "1",
        "cost of the chosen parent: gap, distance from its axis, thickness, taper"
    ),
    branch_column!("gap", F32, 1, false, "radii of the branch", "distance between its bark and its parent's"),
    branch_column!("kind", I32, 1, false, "0, 1 or 2", "0 hangs on another, 1 stands on the ground, 2 is an island"),
    branch_column!("roughness", F32, 1, false, "1", "mean deviation of its rings from circles, over their radius"),
    branch_column!("split", F32, 1, false, "1", "share of its rings that fall into several parts: it is fused"),
    branch_column!("tubes", I32, 1, false, "tubes", "tubes end to end that it was joined from"),
    branch_column!(
        CLASS_AXIS,
        "branch",
        I32,
        1,
        false,
        "row of foliarBranch",
        "branch whose axis runs through the ring"
    ),
    branch_column!(CLASS_AXIS, "offset", F32, 3, false, "m, rest frame", "center of the ring less the branch's pivot"),
    branch_column!(CLASS_AXIS, "radius", F32, 1, false, "m, rest frame", "radius of the ring"),
    Column {
        class: names::CLASS_WIND,
        name: "phase",
        room: names::ROOM_WIND,
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
        class: names::CLASS_WIND,
        name: "frame",
        room: names::ROOM_WIND,
        element: Element::F32,
        width: 4,
        array: false,
        unit: "quaternion x y z w, rest frame",
        range: ANY,
        visible_step: 0.0,
        optical_depth: false,
        doc: "turns X to the branch's right, Y to its up, Z along it",
    },
    Column {
        class: names::CLASS_LIGHT,
        name: names::OPTICAL_DEPTH,
        room: names::ROOM_LIGHT,
        element: Element::F32,
        width: 8,
        array: true,
        unit: "optical depth",
        range: [0.0, MOST_DEPTH],
        visible_step: 1.0 / 255.0,
        optical_depth: true,
        doc: "optical depths of octants, x > 0 bit 0, z > 0 bit 1, y > 0 bit 2",
    },
    Column {
        class: names::CLASS_LIGHT,
        name: names::SUN_HARMONICS,
        room: names::ROOM_LIGHT,
        element: Element::F32,
        width: 9,
        array: true,
        unit: "coefficient",
        range: ANY,
        visible_step: 1.0 / 255.0,
        optical_depth: false,
        doc: "transmittance in real spherical harmonics: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2",
    },
];

/// The column of this class and name.
pub fn column(class: &str, name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|c| c.class == class && c.name == name)
}
