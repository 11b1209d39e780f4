//! The sky: directions that stand for equal parts of the sphere, in opposite pairs, so that an open
//! place prefers none.

use foliar_numerics::fibonacci_sphere;
use glam::DVec3;

/// Directions of the sky: the whole sphere, not the upper half, because a crown is lit from the ground
/// too, and because then no frame is preferred.
pub const DIRECTIONS: usize = 32;

/// Pairs of opposite directions.
pub(crate) const AXES: usize = DIRECTIONS / 2;

/// One direction of each pair: the first half of [`sky_directions`], whose second half mirrors it.
pub(crate) fn sky_axes() -> [DVec3; AXES] {
    std::array::from_fn(|i| fibonacci_sphere(i, DIRECTIONS))
}

/// The directions: half of a Fibonacci lattice, and its mirror image through the center.
pub fn sky_directions() -> [DVec3; DIRECTIONS] {
    let axes = sky_axes();
    std::array::from_fn(|i| if i < AXES { axes[i] } else { -axes[i - AXES] })
}
