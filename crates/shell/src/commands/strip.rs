//! `foliar strip`: the base comes back.

use super::{Call, assemble};
use crate::options::Options;
use crate::{Failure, load};
use foliar_schema::Import;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let Some(input) = options.inputs.first() else { return Err(Failure::usage("strip FILE -o OUT")) };
    let asset = load::read(input, &Import::default())?;
    for finding in &asset.findings {
        console.finding(finding);
    }
    assemble::write(&options, &console, &asset.document)
}
