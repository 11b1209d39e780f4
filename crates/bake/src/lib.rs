//! What a baker is: a pure function from a plant, maps and parameters to one layer; and the laws
//! that every baker keeps.

mod array;
mod baker;
mod error;
mod hash;
pub mod laws;
mod layer;
mod parse;
mod placement;
mod raster;
pub mod reframe;
mod run;

pub use array::Array;
pub use baker::{
    Baked, Baker, BranchFacts, Enclose, Facts, Hull, Idle, Inputs, Maps, Needs, Progress, Quiet, Requirement, Rung,
    pixel_m,
};
pub use error::BakeError;
pub use hash::base_hash;
pub use layer::{AttributeKey, ColumnKey, Layer};
pub use parse::{params_json, parse_params};
pub use placement::{Placed, Placement};
pub use raster::{FloatRaster, MapRaster};
pub use run::{Request, first_broken, resolve_params, run};
