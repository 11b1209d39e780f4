//! Why a bake cannot be done.

use foliar_schema::RangeError;

/// Why a bake cannot be done; each message says what would be right.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// A parameter outside its range.
    #[error("{room}.{source}")]
    Range {
        /// The room.
        room: String,
        /// Which parameter, and what is allowed.
        source: RangeError,
    },
    /// A parameter that does not exist or has the wrong type.
    #[error("{room}.{place}: {reason}")]
    Parameter {
        /// The room.
        room: String,
        /// Which parameter.
        place: String,
        /// What is wrong with it and what would be right.
        reason: String,
    },
    /// An input that the room needs is not there.
    #[error("{room} needs {what}: {remedy}")]
    Needs {
        /// The room.
        room: String,
        /// What it needs.
        what: &'static str,
        /// What to do.
        remedy: String,
    },
    /// A map that cannot be used.
    #[error("{room}: map {map} {problem}: {remedy}")]
    Map {
        /// The room.
        room: String,
        /// Which map.
        map: String,
        /// What is wrong with it.
        problem: String,
        /// What would be right.
        remedy: String,
    },
    /// A value left its channel's declared range: a fault of ours.
    #[error("{room} wrote {channel} = {value} at row {row}: a fault of foliar, please report it")]
    Broken {
        /// The room.
        room: String,
        /// Channel or column.
        channel: String,
        /// First bad row.
        row: usize,
        /// What it is.
        value: f32,
    },
}
