//! Why a base has no structure.

use foliar_plant::{Place, PlantError};

/// Why a base has no structure, or a layer does not fit a base; each message says what would be right.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureError {
    /// The base breaks an invariant (index out of range, coordinate not finite).
    #[error(transparent)]
    Base(#[from] PlantError),
    /// A pattern of `[roles]` is no glob.
    #[error("roles.{role} = {pattern:?}: {reason}; a pattern is text with * and ?, such as \"*leaf*\"")]
    Pattern {
        /// List that holds it.
        role: &'static str,
        /// The pattern.
        pattern: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A parameter out of range.
    #[error("structure.{name} = {value}: must be {expected}")]
    Parameter {
        /// Which.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What would be right.
        expected: &'static str,
    },
    /// More leaves than a float id can count.
    #[error(
        "{count} leaves: at most 16777216 (2^24) can be numbered in a float attribute; split the plant, or merge its leaves"
    )]
    TooMany {
        /// How many there are.
        count: usize,
    },
    /// More branches than a float id can count.
    #[error(
        "{count} branches: at most 16777216 (2^24) can be numbered in a float attribute; split the plant, or merge its wood"
    )]
    TooManyBranches {
        /// How many pieces of wood there are.
        count: usize,
    },
    /// Coordinates too coarse for the size of the wood.
    #[error(
        "part {part:?} stands so far from its mesh's origin that its coordinates step by {step} m, with wood {diagonal} m \
         across: its tubes cannot be told; move the mesh to its origin and place it by its node"
    )]
    Coarse {
        /// Name of the part.
        part: String,
        /// Step between neighboring f32 coordinates, meters.
        step: f64,
        /// Diagonal of the box around the wood, meters.
        diagonal: f64,
    },
    /// A layer lacks something, or it has another size than the base.
    #[error("layer {layer}, {what}: {found}, must be {expected}; bake it of this base anew")]
    Layer {
        /// Which layer.
        layer: &'static str,
        /// Which array.
        what: String,
        /// What it holds.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// A primitive of the base has no role in the layer.
    #[error("layer structure: mesh {}, primitive {} has no role; bake the structure of this base anew", place.mesh, place.primitive)]
    NoRole {
        /// The primitive.
        place: Place,
    },
}
