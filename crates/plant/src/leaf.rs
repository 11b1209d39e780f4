//! One leaf: what rooms know of it.

use glam::Vec3;

/// Leaf id of a vertex that belongs to none.
pub const NO_LEAF: u32 = u32::MAX;

/// One row of the table `foliarLeaf`. Rest frame, meters, as the file stores it (f32), so that a
/// bake from memory and a bake from the file see the same numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Leaf {
    /// Area-weighted center.
    pub center: Vec3,
    /// Area-weighted unit normal on the side of the first face.
    pub normal: Vec3,
    /// One-sided area times alpha coverage, m^2; 0 or above.
    pub area: f32,
    /// Leaves that are one object (crossed cards, doubled sheets) share it.
    pub group: u32,
    /// Point of the leaf nearest to wood.
    pub petiole: Vec3,
    /// Sampled from a crown volume: no vertices of its own.
    pub crown_volume: bool,
}
