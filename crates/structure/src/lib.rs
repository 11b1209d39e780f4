//! Geometry to facts: roles of parts with their evidence, leaves with area, group and petiole,
//! virtual leaves of crown volumes; and, when a room asks for it, the branch hierarchy. Found once, for every room.

mod analyze;
pub mod branches;
mod coverage;
mod crown;
mod error;
mod evidence;
mod findings;
mod forms;
mod geometry;
mod groups;
mod layer;
mod leaves;
mod look;
mod lying;
mod params;
mod patterns;
mod petiole;
mod pieces;
mod roles;
mod shape;
mod sharing;
mod words;

pub use analyze::{Analysis, analyze, judge_roles};
pub use error::StructureError;
pub use evidence::{Evidence, PartEvidence, Source, explain};
pub use layer::{from_layer, to_layer};
pub use params::StructureParams;

/// Version of the step: it changes when results change.
pub const VERSION: u32 = 1;
