//! The second reader over every glTF that a test wrote: it looks where the validator cannot.

use crate::validator;
use anyhow::{Result, bail};
use foliar_carrier::second_reader;

/// Verifies every output of the tests.
pub fn run() -> Result<()> {
    let (mut bad, outputs) = (0, validator::outputs()?);
    for output in &outputs {
        if let Err(what) = second_reader::verify_file(output) {
            println!("{}: {what}", output.display());
            bad += 1;
        }
    }
    if bad > 0 {
        bail!("the second reader refuses {bad} of {} files", outputs.len());
    }
    println!("second reader: {} files hold what they say", outputs.len());
    Ok(())
}
