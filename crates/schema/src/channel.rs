//! Channels (values per vertex), with units, ranges and the step that an eye can just see.

use crate::{CHANNELS, Role};

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

/// The channel of this name.
pub fn channel(name: &str) -> Option<&'static Channel> {
    CHANNELS.iter().find(|c| c.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{COLUMNS, LATER_ROOMS, ROOMS};

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
