//! What the model is measured against: light followed path by path through leaves that scatter on both sides.
//!
//! Slow and simple. Every leaf draws from streams of its own, so the numbers are the same for any number of threads. Whoever has
//! triangles, textures and materials of its own walks them by [`World`]; [`Scene`] is one of opaque leaves.

mod path;
mod scene;
mod stream;

#[cfg(test)]
mod tests;

pub use path::{Met, Surroundings, Ways, World, irradiance_at, radiance_along};
pub use scene::{Origin, Scene, Shape};
pub use stream::Stream;
