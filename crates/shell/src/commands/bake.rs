//! `foliar bake`, `foliar-import` and `foliar-ROOM`: one road with different rooms on it.

use super::Call;
use super::tree::{lives_on_maps, room_sections};
use crate::bake_one::{Baking, bake_one};
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Mode, Options};
use crate::outputs::{self, Job};
use crate::{Failure, runner};

/// `foliar bake`.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let only = (!options.only.is_empty()).then_some(options.only.as_slice());
    bake(call, &options, Direct::Assets, only, false)
}

/// `foliar-import`: structure only.
pub fn import(call: &Call) -> Result<(), Failure> {
    bake(call, &Options::from(call.matches), Direct::Sections(&["structure"]), Some(&[]), false)
}

/// `foliar-ROOM`: one room.
pub fn room(call: &Call, room: &str) -> Result<(), Failure> {
    let sections = room_sections(call.bakers, room);
    let options = Options::from(call.matches);
    let alone = call.bakers.iter().find(|baker| baker.room() == room && lives_on_maps(**baker));
    if let Some(baker) = alone.filter(|_| options.inputs.is_empty()) {
        return super::alone::run(call, *baker);
    }
    bake(call, &Options::from(call.matches), Direct::Sections(&sections), Some(&[room.to_owned()]), false)
}

/// Bakes every input. `again` repeats what the files' records say, and nothing else.
///
/// # Errors
/// The asset's own failure where there is one input, [`Failure::Batch`] where there are several.
pub fn bake(
    call: &Call,
    options: &Options,
    direct: Direct,
    only: Option<&[String]>,
    again: bool,
) -> Result<(), Failure> {
    let console = options.console();
    let jobs = if again { in_place(options)? } else { outputs::jobs(options)? };
    check_outputs(options, &jobs)?;
    outputs::check_surface(options)?;
    let sources = Sources::new(call, direct)?;
    let baking = Baking { bakers: call.bakers, only, sources: &sources, options, console: &console, again };
    runner::run(options, &console, &jobs, &mut |job, report| bake_one(&baking, job, report))
}

/// `foliar rebake` writes where it reads.
fn in_place(options: &Options) -> Result<Vec<Job>, Failure> {
    if options.output.is_some() || options.directory.is_some() {
        return outputs::jobs(options);
    }
    Ok(options.inputs.iter().map(|input| Job { input: input.clone(), output: Some(input.clone()) }).collect())
}

fn check_outputs(options: &Options, jobs: &[Job]) -> Result<(), Failure> {
    for job in jobs {
        match &job.output {
            Some(output) => outputs::check_ending(output, true)?,
            None if options.mode == Mode::DryRun || options.explain_roles || options.surface.is_some() => {}
            None => return Err(Failure::usage("where to? say -o OUT for one input, -d DIR for several")),
        }
    }
    Ok(())
}
