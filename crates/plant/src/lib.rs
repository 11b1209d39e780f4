//! Plants: the base as it was read (parts, materials, rasters) and the facts that structure found
//! (roles, leaves, and branches where a room asks for them). `Plant::new` and `Plant::with_branches` check the
//! invariants once; after them nobody asks whether x is NaN.

mod base;
mod branches;
mod leaf;
mod plant;
pub mod sample;

pub use base::{AlphaMode, Base, Material, Part, Place, Raster};
pub use branches::{Attachment, Axis, Branch, Branches, LARGEST_MARGIN, LEVELS, NO_BRANCH, OnBranch, Spot, Stalk};
pub use leaf::{Leaf, NO_LEAF};
pub use plant::{Plant, PlantError, Structure};
