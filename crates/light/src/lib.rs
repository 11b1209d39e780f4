//! Light in the crown: optical depths of leaves in eight directions, and the model that lights them (Boulanger08).

mod alpha;
mod bake;
mod choose;
pub mod crown;
mod kernel;
pub mod leaves;
pub mod model;
pub mod octants;
pub mod optics;
mod output;
mod params;
pub mod profile;
mod rays;
pub mod reference;
mod requirement;
mod room;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod tree;
pub mod truth;
pub mod ways;

pub use params::{DepthEngine, Params, SunModel};
pub use rays::{HARMONICS, harmonics, rays_at};
pub use room::Light;
