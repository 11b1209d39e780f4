//! Tests of the run-time model: the oracle's values, laws, hazards, shaders.

mod hazards;
mod laws;
mod oracle;
mod shaders;
