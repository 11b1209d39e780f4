//! From a map of thickness and normals to a map of coefficients.

pub mod by_rule;
mod fast;
mod leaf;
mod pyramid;
mod recipe;
pub mod reference;
mod tables;

pub use fast::coefficient_map;
#[cfg(test)]
pub(crate) use fast::coefficient_map_on;
pub use leaf::{LEAST_THICKNESS_MM, LeafMap, normals_from_heights};
pub(crate) use pyramid::Image;
pub use recipe::{Model, Recipe, Spreading, Tissue};
pub use tables::Tables;
