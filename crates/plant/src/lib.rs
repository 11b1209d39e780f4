//! Plants: the base as it was read (parts, materials, rasters) and the facts that structure found
//! (roles, leaves). `Plant::new` checks the invariants once; after it nobody asks whether x is NaN.

mod base;
mod leaf;
mod plant;
pub mod sample;

pub use base::{AlphaMode, Base, Material, Part, Place, Raster};
pub use leaf::{Leaf, NO_LEAF};
pub use plant::{Plant, PlantError, Structure};
