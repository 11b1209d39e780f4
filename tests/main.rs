//! End to end: the real binaries, real files, exit statuses and messages.

#![expect(clippy::unwrap_used, clippy::print_stderr, reason = "a test that cannot go on fails; a skipped one says so")]

mod after;
mod bad_input;
mod bad_places;
mod bake;
mod branches;
mod check;
mod ci;
mod common;
mod config;
mod consumer;
mod conventions;
mod density;
mod diff;
mod expected;
mod expected_parts;
mod generate;
mod import;
mod inspect;
mod laws;
mod layers;
mod leafscan;
mod moving;
mod mutations;
mod neighbors;
mod outsiders;
mod pack;
mod plants;
mod schemas;
mod streams;
mod surface;
mod translucency;
mod translucency_bad;
mod translucency_forms;
mod view;
