//! Ray casting, closest points, grids

mod closest;

pub use closest::{Closest, TriangleTree, closest_on_segment, closest_on_triangle};
