//! Tests of the room: laws of the house, laws of its own, extremes, shaders.

mod bark;
mod laws;
mod motion;
mod shaders;
mod tables;
