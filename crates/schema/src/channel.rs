//! Channels (values per vertex), with units, ranges and the step that an eye can just see.

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
    /// Whether values are optical depths: what is seen of them is the transmittance, exp(-value), and the visible step
    /// is one of that.
    pub optical_depth: bool,
    /// What stands where it does not apply.
    pub neutral: Neutral,
    /// One line for docs and legends.
    pub doc: &'static str,
}

/// Steps and rooms in the order in which files list them.
pub const ROOMS: &[&str] = &[
    names::ROOM_STRUCTURE,
    names::ROOM_BRANCHES,
    names::ROOM_WIND,
    names::ROOM_LIGHT,
    names::ROOM_DENSITY,
    names::ROOM_TRANSLUCENCY,
];

/// Rooms that the plan names and this version has not.
pub const LATER_ROOMS: &[&str] = &["occlusion", "fall"];

/// Largest id that a float attribute holds exactly.
const MAX_ID: f32 = 16_777_216.0;

/// Largest optical depth in a file: nothing is seen beyond it.
pub(crate) const MOST_DEPTH: f32 = 16.0;

const fn light_depth(name: &'static str, doc: &'static str) -> Channel {
    Channel {
        name,
        room: names::ROOM_LIGHT,
        width: 4,
        roles: &[Role::Wood],
        min: 0.0,
        max: MOST_DEPTH,
        unit_length: false,
        unit: "optical depth",
        visible_step: 1.0 / 255.0,
        step_unit: "transmittance",
        optical_depth: true,
        neutral: Neutral::Value(0.0),
        doc,
    }
}

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
        optical_depth: false,
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
        optical_depth: false,
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
        optical_depth: false,
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
        optical_depth: false,
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
        optical_depth: false,
        neutral: Neutral::Value(0.0),
        doc: "way along the leaf: 0 at the petiole, 1 at the tip",
    },
    light_depth(names::LIGHT_DEPTH_0, "optical depths toward the ground: octants -x -z, +x -z, -x +z, +x +z"),
    light_depth(names::LIGHT_DEPTH_1, "optical depths toward the sky: octants -x -z, +x -z, -x +z, +x +z"),
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
        optical_depth: false,
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
        optical_depth: false,
        neutral: Neutral::OwnNormal,
        doc: "normal realigned to the shape of the crown",
    },
];

/// The channel of this name.
pub fn channel(name: &str) -> Option<&'static Channel> {
    CHANNELS.iter().find(|c| c.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::COLUMNS;

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
