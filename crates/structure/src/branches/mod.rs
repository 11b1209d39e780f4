//! The branch hierarchy of an unrigged tree (Kusternig07 section 5, made robust): found when a room asks for it.

mod layer;

pub use layer::to_layer;

/// Version of the step: it changes when results change.
pub const VERSION: u32 = 1;
