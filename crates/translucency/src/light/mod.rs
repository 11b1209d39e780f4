//! From light to three coefficients: basis, entry into the leaf, fits over directions (Habel07).

mod basis;
mod curve;
mod entry;
mod project;

pub use basis::{BASIS, coefficients, vector};
pub use curve::Curve;
pub use entry::{Entrance, Entry};
pub use project::{Fit, Projection};
