//! Configuration: fields from schemas, values from sources, one merged answer that knows where each
//! value came from.

mod env;
mod fields;
mod file;
mod settings;
mod value;

pub use env::from_environment;
pub use fields::{Field, Fields, Kind, nearest};
pub use file::{asset_file, from_file, from_toml, project_file};
pub use settings::{Given, Origin, Settings};
pub use value::{from_json, from_text};
