//! Ray casting, closest points, grids.

mod closest;
mod rays;

pub use closest::{Closest, TriangleTree, closest_on_segment, closest_on_triangle};
pub use rays::{Beam, Hit, RayError, Rays};
