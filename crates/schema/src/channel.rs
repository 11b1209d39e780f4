//! Channels (values per vertex) and columns (values per leaf or branch), with units, ranges and
//! the step that an eye can just see.

use crate::{Role, names};

/// Number type of a channel or column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// 32-bit float.
    F32,
    /// 32-bit signed integer.
    I32,
}

/// What a vertex gets that a channel does not apply to, where its mesh must carry it all the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Neutral {
    /// The same number in every component.
    Value(f32),
    /// The vertex's own NORMAL.
    OwnNormal,
    /// The id that means "none": the number of rows of the table.
    NullId,
}

/// One value per vertex.
#[derive(Clone, Copy, Debug)]
pub struct Channel {
    /// Name in a layer and, unless it is an id, of the glTF attribute.
    pub name: &'static str,
    /// Who writes it.
    pub room: &'static str,
    /// Numbers per vertex.
    pub width: usize,
    /// Parts that it says something about.
    pub roles: &'static [Role],
    /// Least value of a component.
    pub min: f32,
    /// Greatest value of a component.
    pub max: f32,
    /// Whether each value is a unit vector.
    pub unit_length: bool,
    /// Unit of measure.
    pub unit: &'static str,
    /// Smallest difference that can be seen, in `step_unit`.
    pub visible_step: f64,
    /// Unit of the visible step.
    pub step_unit: &'static str,
    /// What stands where it does not apply.
    pub neutral: Neutral,
    /// One line for docs and legends.
    pub doc: &'static str,
}

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
    /// One line for docs.
    pub doc: &'static str,
}

/// Steps and rooms in the order in which files list them.
pub const ROOMS: &[&str] = &[
    names::ROOM_STRUCTURE,
    names::ROOM_BRANCHES,
    names::ROOM_WIND,
    names::ROOM_DENSITY,
    names::ROOM_TRANSLUCENCY,
];

/// Rooms that the plan names and this version has not.
pub const LATER_ROOMS: &[&str] = &["light", "occlusion", "fall", "leafscan"];

/// Largest id that a float attribute holds exactly.
const MAX_ID: f32 = 16_777_216.0;

/// All channels, in the order in which files list them.
pub const CHANNELS: &[Channel] = &[
    Channel {
        name: names::LEAF_ID,
        room: names::ROOM_STRUCTURE,
        width: 1,
        roles: &[Role::Leaf],
        min: 0.0,
        max: MAX_ID,
        unit_length: false,
        unit: "row of foliarLeaf",
        visible_step: 1.0,
        step_unit: "id",
        neutral: Neutral::NullId,
        doc: "leaf that the vertex belongs to",
    },
    Channel {
        name: names::BRANCH_ID,
        room: names::ROOM_BRANCHES,
        width: 1,
        roles: &[Role::Wood],
        min: 0.0,
        max: MAX_ID,
        unit_length: false,
        unit: "row of foliarBranch",
        visible_step: 1.0,
        step_unit: "id",
        neutral: Neutral::NullId,
        doc: "branch that the vertex belongs to, at any depth",
    },
    Channel {
        name: names::BRANCH_ARC,
        room: names::ROOM_BRANCHES,
        width: 1,
        roles: &[Role::Wood],
        min: 0.0,
        max: f32::MAX,
        unit_length: false,
        unit: "m, rest frame",
        visible_step: 1e-3,
        step_unit: "m",
        neutral: Neutral::Value(0.0),
        doc: "way along the axis of the vertex's branch, from its root; the same all around a ring",
    },
    Channel {
        name: names::WIND_WEIGHTS,
        room: names::ROOM_WIND,
        width: 4,
        roles: &[Role::Leaf, Role::Wood],
        min: 0.0,
        max: 1.0,
        unit_length: false,
        unit: "1",
        // Half a pixel at 3 m (1.6 mm) in a storm that moves the tip of a branch of 10 m by 1.5 m.
        visible_step: 1e-3,
        step_unit: "1",
        neutral: Neutral::Value(0.0),
        doc: "how much of the sway of its branch, and of each ancestor, the vertex takes part in; level 0 to 3",
    },
    Channel {
        name: names::LEAF_WEIGHT,
        room: names::ROOM_WIND,
        width: 1,
        roles: &[Role::Leaf],
        min: 0.0,
        max: 1.0,
        unit_length: false,
        unit: "1",
        visible_step: 1.0 / 255.0,
        step_unit: "1",
        neutral: Neutral::Value(0.0),
        doc: "way along the leaf: 0 at the petiole, 1 at the tip",
    },
    Channel {
        name: names::AMBIENT,
        room: names::ROOM_DENSITY,
        width: 1,
        roles: &[Role::Leaf, Role::Wood],
        min: 0.0,
        max: 1.0,
        unit_length: false,
        unit: "1",
        visible_step: 1.0 / 255.0,
        step_unit: "1",
        neutral: Neutral::Value(1.0),
        doc: "ambient coefficient: share of the sky's light that reaches the vertex",
    },
    Channel {
        name: names::SOFT_NORMAL,
        room: names::ROOM_DENSITY,
        width: 3,
        roles: &[Role::Leaf],
        min: -1.0,
        max: 1.0,
        unit_length: true,
        unit: "unit vector, mesh frame",
        visible_step: 1.0,
        step_unit: "degree",
        neutral: Neutral::OwnNormal,
        doc: "normal realigned to the shape of the crown",
    },
];

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
        doc: "turns X to the branch's right, Y to its up, Z along it",
    },
];

/// The channel of this name.
pub fn channel(name: &str) -> Option<&'static Channel> {
    CHANNELS.iter().find(|c| c.name == name)
}

/// The column of this class and name.
pub fn column(class: &str, name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|c| c.class == class && c.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_and_column_belongs_to_a_listed_room() {
        assert!(CHANNELS.iter().map(|c| c.room).chain(COLUMNS.iter().map(|c| c.room)).all(|r| ROOMS.contains(&r)));
    }

    #[test]
    fn a_room_is_here_or_comes_later() {
        assert!(LATER_ROOMS.iter().all(|later| !ROOMS.contains(later)));
    }

    #[test]
    fn names_are_unique() {
        let mut names: Vec<_> = CHANNELS.iter().map(|c| c.name.to_string()).collect();
        names.extend(COLUMNS.iter().map(|c| format!("{}/{}", c.class, c.name)));
        let all = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all);
    }
}
