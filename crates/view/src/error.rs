//! Why a picture cannot be drawn.

use foliar_schema::RangeError;
use foliar_space::RayError;

/// Why a picture cannot be drawn; each message says what would be right.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A parameter outside its range.
    #[error("view.{0}")]
    Range(#[from] RangeError),
    /// A parameter is NaN or infinite.
    #[error("view: angles, places and exposure must be finite numbers")]
    NotFinite,
    /// No layer holds what is to be shown.
    #[error("no channel or column {name:?} to show: the layers hold {known}")]
    Channel {
        /// What was asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// Plants that stand around one that is lit by its own bake.
    #[error("look = light and traced draw a plant alone: leave out --neighbor")]
    Neighbors,
    /// Sun or sky that the light model does not take.
    #[error("view: {0}")]
    Model(#[from] foliar_light::model::ModelError),
    /// A layer does not fit the plant.
    #[error("{name} of part {part} holds {found} rows of {width}, the plant asks for {expected}: bake it again")]
    Shape {
        /// Channel or column.
        name: String,
        /// Name of the part, or of the table.
        part: String,
        /// Rows found.
        found: usize,
        /// Numbers per row found.
        width: usize,
        /// What would fit.
        expected: String,
    },
    /// Triangles that no ray can be cast at.
    #[error("the plant cannot be drawn: {0}")]
    Rays(#[from] RayError),
    /// A layer that holds no light through leaves.
    #[error("the layer of {0:?} holds no maps of light through a leaf: name one that foliar-translucency wrote")]
    NoLeaf(String),
    /// Two pictures that should be of one size are not.
    #[error("pictures of {0}x{1} and {2}x{3} pixels cannot be compared: make them the same size")]
    Sizes(u32, u32, u32, u32),
    /// The picture does not fit into a PNG.
    #[error("PNG: {0}")]
    Png(#[from] image::ImageError),
    /// The pictures do not fit into an animated PNG.
    #[error("animated PNG: {0}")]
    Apng(#[from] png::EncodingError),
}
