//! Tests of the room: reference values, laws of the house, laws of its own, extremes, times.

mod extremes;
mod feet;
mod field;
mod golden;
mod laws;
mod modes;
mod neighbors;
mod oracle;
mod plants;
mod quality;
