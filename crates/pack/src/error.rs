//! Why a file cannot be packed.

use foliar_carrier::CarrierError;

/// Why a file cannot be packed; every message says what would be right.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PackError {
    /// Nothing that a profile could pack.
    #[error(
        "holds neither ambient coefficients nor realigned normals (no layer of room density): bake them first: foliar-density TREE -o TREE.glb"
    )]
    NothingBaked,
    /// The room had nothing to do.
    #[error(
        "its layer of room density is empty, no part is a leaf: name the leaves and bake again: foliar-density TREE --leaf PATTERN -o TREE.glb"
    )]
    NoLeaves,
    /// The file is no master any more.
    #[error("is packed for {engine} already, and holds no layers any more: name the master that it was packed from")]
    AlreadyPacked {
        /// What it says of itself.
        engine: String,
    },
    /// A layer whose values are not those of the base's vertices.
    #[error(
        "{channel} of mesh {mesh} primitive {primitive} has {found} values, the base {vertices} vertices: run foliar rebake"
    )]
    Stale {
        /// Channel of the layer.
        channel: &'static str,
        /// Mesh.
        mesh: u32,
        /// Primitive of the mesh.
        primitive: u32,
        /// Values in the layer.
        found: usize,
        /// Vertices of the primitive.
        vertices: usize,
    },
    /// The base cannot be read or edited.
    #[error(transparent)]
    Carrier(#[from] CarrierError),
}
