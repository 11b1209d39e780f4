//! `foliar-pack`: from a master to the file that ships.

use super::{Call, assemble};
use crate::config::Settings;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::options::{Options, is_dash};
use crate::outputs::{self, Job};
use crate::report::Report;
use crate::runner::{self, Product};
use crate::{Failure, load};
use foliar_pack::{PackError, PackReport};
use foliar_schema::{Engine, Finding, Pack, Scene, code};
use std::path::Path;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Pack)?;
    let jobs = outputs::jobs(&options)?;
    jobs.iter().try_for_each(check)?;
    runner::run(&options, &console, &jobs, &mut |job, report| {
        let settings = sources.gather(&options, &job.input, Settings::default())?;
        let engine = engine(&settings)?;
        let asset = load::asset(&sources, &options, &job.input)?;
        report.asset(&asset);
        console.log(&report.lap("read"));
        let packed = foliar_pack::pack(&asset, engine).map_err(|e| refuse(e, &job.input))?;
        report.find(packed.findings);
        report.find(over_budget(&packed.report, &settings.section::<Scene>("scene")?));
        tell(report, packed.report);
        console.log(&report.lap("pack"));
        let Some(output) = &job.output else { return Ok(Product::Planned) };
        assemble::product(&options, report, &packed.document, output, &format!("a file for {}", engine.name()))
    })
}

/// Refuses an output that is no glTF, or the master itself: packing cannot be undone.
fn check(job: &Job) -> Result<(), Failure> {
    let Some(output) = &job.output else {
        return Err(Failure::usage("where to? say -o OUT for one input, -d DIR for several"));
    };
    outputs::check_ending(output, false)?;
    let full = |path: &Path| std::fs::canonicalize(path).ok();
    if !is_dash(output) && full(output).is_some_and(|output| Some(output) == full(&job.input)) {
        let text = "would replace the master, whose layers a packed file does not hold: name another output";
        return Err(Failure::usage(format!("-o {}: {text}", output.display())));
    }
    Ok(())
}

fn engine(settings: &Settings) -> Result<Engine, Failure> {
    settings.section::<Pack>("pack")?.engine.ok_or_else(|| {
        let names = Engine::ALL.map(Engine::name).join("|");
        Failure::usage(format!("what for? say --for {names}, or engine = \"...\" in section [pack] of foliar.toml"))
    })
}

fn refuse(error: PackError, input: &Path) -> Failure {
    match error {
        PackError::Carrier(error) => error.into(),
        error => Failure::Input(format!("{}: {error}", input.display())),
    }
}

fn over_budget(packed: &PackReport, scene: &Scene) -> Option<Finding> {
    let (added, budget) = (packed.added_bytes_per_vertex, scene.budget.bytes_per_vertex as usize);
    let message = format!("packing adds {added} bytes per vertex, scene.budget.bytes_per_vertex is {budget}");
    (added > budget).then(|| Finding::new(&code::PACK_BUDGET, message))
}

/// What the report holds of it, and people read.
fn tell(report: &mut Report, packed: PackReport) {
    let mut words = vec![format!(
        "for {}: {:.1} bytes per vertex, {} more than the base",
        packed.engine.name(),
        packed.bytes_per_vertex,
        packed.added_bytes_per_vertex
    )];
    words.extend(packed.attributes.iter().map(|a| {
        let (rms, most) = (a.rms_steps, a.max_steps);
        format!("{} in {} ({}) off by {rms:.2} visible steps, {most:.2} at most", a.channel, a.attribute, a.stored)
    }));
    report.told.packed = Some(words.join("; "));
    report.told.pack = Some(packed);
}
