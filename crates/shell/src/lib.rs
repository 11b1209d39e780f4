//! Flags, configuration, exit status, reports: what turns libraries into programs. Knows rooms only
//! as the bakers that it is handed.

mod bake_one;
mod cache;
mod commands;
pub mod config;
mod console;
mod failure;
mod finding_formats;
mod flags;
mod gather;
mod load;
mod options;
mod outputs;
mod plan;
mod progress;
mod record;
mod report;
mod rooms;
mod start;

pub use commands::{Program, commands};
pub use failure::Failure;
pub use start::{foliar, foliar_import, foliar_room, foliar_view};

/// Rooms that the plan names and this version has not.
pub const LATER_ROOMS: &[&str] = &["wind", "light", "occlusion", "translucency", "fall", "noise", "leafscan", "check"];
