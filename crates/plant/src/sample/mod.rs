//! Plants made by rule, with their true structure: the odd list that every law runs over, and trees
//! for fixtures and benchmarks. Pure functions of their arguments, the same bits on every machine
//! (integer hashes, low-discrepancy points, libm).

mod build;
mod crowns;
mod foliage;
mod hard;
mod hierarchy;
mod leaf;
mod noise;
mod odd;
mod skeleton;
mod textures;
mod tree;
mod tubes;

pub use crowns::{Quad, crowns, quads};
pub use hard::{FUSED_TREES, HARD_TREES, HardTree, fused_tree, hard_tree, wood_for_speed};
pub use leaf::{LEAF_WIDTH_MM, leaf_form};
pub use odd::odd_plants;
pub use tree::Recipe;

use crate::Plant;

/// A plant whose structure is known because it was made.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Name, kebab-case, unique in its list.
    pub name: &'static str,
    /// The plant with its true roles, leaves, groups and areas.
    pub plant: Plant,
}

#[cfg(test)]
mod tests;
