//! Tests of the bake: reference values of an independent program, laws of the house, extremes.

mod golden;
mod laws;
mod oracle;
mod plants;
mod room;
mod sums;
