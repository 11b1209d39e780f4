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
mod limbs;
mod load;
mod maps;
mod neighbors;
mod options;
mod outputs;
mod plan;
mod progress;
mod record;
mod report;
mod rooms;
mod runner;
mod said;
mod start;
mod telling;

pub use commands::{Program, commands};
pub use failure::Failure;
pub use start::{foliar, foliar_check, foliar_import, foliar_library, foliar_pack, foliar_room, foliar_view};
