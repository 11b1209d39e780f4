//! Ray casting, closest points, grids.

mod boxes;
mod closest;
mod rays;

pub use boxes::{Aabb, BoxTree};
pub use closest::{Closest, TriangleTree, closest_on_segment, closest_on_triangle};
pub use rays::{Beam, Hit, RayError, Rays};
