//! Geometry to facts: roles of parts with their evidence, leaves with area, group and petiole,
//! virtual leaves of crown volumes. Found once, for every room. Branches come with wind.

mod analyze;
mod error;
mod evidence;
mod layer;
mod params;

pub use analyze::{Analysis, analyze};
pub use error::StructureError;
pub use evidence::{Evidence, PartEvidence, explain};
pub use layer::{from_layer, to_layer};
pub use params::StructureParams;

/// Version of the step: it changes when results change.
pub const VERSION: u32 = 1;
