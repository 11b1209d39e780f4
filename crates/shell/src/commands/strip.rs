//! `foliar strip`: the base comes back.

use super::{Call, assemble};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::Options;
use crate::outputs::Job;
use crate::{Failure, load, runner};

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Import)?;
    let Some(input) = options.inputs.first() else { return Err(Failure::usage("strip FILE -o OUT")) };
    let output = assemble::output(&options)?;
    let job = Job { input: input.clone(), output: Some(output.to_path_buf()) };
    runner::run(&options, &console, &[job], &mut |job, report| {
        let asset = load::asset(&sources, &options, &job.input)?;
        report.asset(&asset);
        console.log(&report.lap("read"));
        let names: Vec<&str> = asset.layers.iter().map(|layer| layer.record.room.as_str()).collect();
        let what = format!("the base without {}", if names.is_empty() { "any layer".into() } else { names.join(", ") });
        assemble::product(&options, report, &asset.document, output, &what)
    })
}
