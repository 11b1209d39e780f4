//! `foliar rebake`: the same again, from the records inside the files.

use super::{Call, bake};
use crate::Failure;
use crate::flags::Direct;
use crate::options::Options;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    bake::bake(call, &Options::from(call.matches), Direct::Assets, None, true)
}
