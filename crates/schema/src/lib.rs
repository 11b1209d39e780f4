//! The contract of foliar: every name, channel, column, range, unit, visible step, issue code and
//! configuration section that crosses a crate or reaches a file. Nothing else in the workspace
//! spells one of these names.

mod channel;
mod codes;
mod column;
mod config;
mod extension;
mod finding;
pub mod names;
mod ranges;
mod raster;
mod record;
mod role;
mod rooms;

pub use channel::{Channel, Element, Neutral, channel};
pub use codes::{CODES, CodeInfo, code};
pub use column::{Column, REFERENCES, column};
pub use config::{
    Ambient, Budget, Camera, Check, Engine, Fall, Import, Light, Pack, Roles, Scene, Sky, Strength, Sun, Unit, Up, Wind,
};
pub use extension::{CONTRACT, ColorLink, FoliageExtension, MapLink, PrimitiveExtension, SheetLinks};
pub use finding::{Finding, Severity};
pub use ranges::{RangeError, check_ranges};
pub use raster::{RasterInfo, raster};
pub use record::{MeasuredError, Record};
pub use role::Role;
pub use rooms::{CHANNELS, COLUMNS, LATER_ROOMS, RASTERS, ROOMS};
