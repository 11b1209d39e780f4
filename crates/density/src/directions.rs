//! The sky: directions that stand for equal parts of the sphere, in opposite pairs, so that an open
//! place prefers none.

use foliar_numerics::fibonacci_sphere;
use glam::DVec3;

/// Directions of the sky: the whole sphere, not the upper half, because a crown is lit from the ground
/// too, and because then no frame is preferred.
pub const DIRECTIONS: usize = 32;

/// The directions: half of a Fibonacci lattice, and its mirror image through the center.
pub fn sky_directions() -> [DVec3; DIRECTIONS] {
    std::array::from_fn(|i| {
        let half = fibonacci_sphere(i % (DIRECTIONS / 2), DIRECTIONS);
        if i < DIRECTIONS / 2 { half } else { -half }
    })
}
