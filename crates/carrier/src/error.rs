//! What can go wrong between bytes and plants. Every message names the file, the place in it, what
//! is wrong there and what would be right.

/// Why bytes cannot be read, joined or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CarrierError {
    /// A file cannot be opened or read at all.
    #[error("{file}: cannot be read: {source}: {remedy}")]
    Open {
        /// The file as the user named it.
        file: String,
        /// What the system said.
        source: std::io::Error,
        /// What would be right.
        remedy: String,
    },
    /// A file, layer or image holds what it must not, or what this version cannot read.
    #[error("{file}{}: {problem}: {remedy}", PlaceText(place))]
    Input {
        /// The file as the user named it.
        file: String,
        /// Where in it: a JSON pointer, `line 12`, `byte 20`; empty where the whole file is meant.
        place: String,
        /// What is wrong, with the number.
        problem: String,
        /// What would be right.
        remedy: String,
    },
    /// A layer that does not belong to the base, or to the layers beside it.
    #[error("layer {room}{}: {problem}: {remedy}", PlaceText(place))]
    Mismatch {
        /// Room of the layer.
        room: String,
        /// Which array, or empty.
        place: String,
        /// What does not fit, with the numbers.
        problem: String,
        /// What would be right.
        remedy: String,
    },
    /// A file cannot be written; what was there before is intact.
    #[error("{file}: cannot be written: {source}: {remedy}")]
    Output {
        /// The file as the user named it.
        file: String,
        /// What the system said.
        source: std::io::Error,
        /// What would be right.
        remedy: String,
    },
}

/// A place with its separator, or nothing.
struct PlaceText<'a>(&'a str);

impl std::fmt::Display for PlaceText<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.is_empty() { Ok(()) } else { write!(f, ", {}", self.0) }
    }
}

impl CarrierError {
    /// Something wrong in an input: `file`, place in it, what is wrong, what would be right.
    pub fn input(
        file: impl Into<String>,
        place: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        CarrierError::Input { file: file.into(), place: place.into(), problem: problem.into(), remedy: remedy.into() }
    }

    /// A layer that does not fit: room, array, what does not fit, what would be right.
    pub fn mismatch(
        room: impl Into<String>,
        place: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        CarrierError::Mismatch {
            room: room.into(),
            place: place.into(),
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }

    /// Whether it is about writing (exit status 4) rather than about what was read (status 3).
    pub fn is_output(&self) -> bool {
        matches!(self, CarrierError::Output { .. })
    }
}
