//! `foliar-view`: pictures.

use super::{Call, view_leaf};
use crate::Failure;
use crate::bake_one::view_params;
use crate::flags::Direct;
use crate::gather::Sources;
use crate::load::{Loaded, load};
use crate::neighbors;
use crate::options::{Mode, Options, is_dash};
use crate::outputs::Job;
use crate::runner::{self, Product};
use clap::ArgMatches;
use foliar_bake::Layer;
use foliar_carrier::OutputFile;
use foliar_schema::names;
use foliar_structure::branches;
use foliar_view::{Look, Standing, ViewError, ViewParams};
use std::path::{Path, PathBuf};

/// Pictures of a turntable shown in a second.
const FRAMES_PER_SECOND: u16 = 24;

/// Runs the command.
pub fn run(call: &Call) -> Result<(), Failure> {
    let options = Options::from(call.matches);
    let console = options.console();
    let sources = Sources::new(call, Direct::Sections(&["view"]))?;
    let (input, output) = files(&options)?;
    let wanted = Wanted::from(call.matches);
    let job = Job { input, output: Some(output.clone()) };
    runner::run(&options, &console, &[job], &mut |job, report| {
        if view_leaf::is_layer(&job.input) {
            view_leaf::refuse_others(&options, wanted.name())?;
            if options.mode == Mode::DryRun {
                return Ok(report.planned(&output, "a sheet of a leaf lit from behind"));
            }
            let other = call.matches.get_one::<PathBuf>("against").map(PathBuf::as_path);
            let bytes = view_leaf::draw(&job.input, other, report)?;
            return Ok(Product::Files(vec![OutputFile { path: output.clone(), bytes }]));
        }
        let mut loaded = load(&sources, &options, &job.input)?;
        let stands = neighbors::named(&mut loaded.settings)?.remove("view").unwrap_or_default();
        report.loaded(&loaded);
        if let Some(leaf) = call.matches.get_one::<String>("light-through") {
            if options.mode == Mode::DryRun {
                return Ok(report.planned(&output, "a sheet of a leaf lit from behind"));
            }
            let beside = |other: &PathBuf| neighbors::load_beside(&sources, &options, other, "--against", report);
            let other = call.matches.get_one::<PathBuf>("against");
            let beside = other.map(beside).transpose()?;
            let against = beside.as_ref().zip(other.map(PathBuf::as_path));
            let bytes = view_leaf::of_tree(leaf, (&loaded, &job.input), against)?;
            return Ok(Product::Files(vec![OutputFile { path: output.clone(), bytes }]));
        }
        with_branches(&mut loaded, &job.input)?;
        let around = neighbors::standing(&sources, &options, &stands, report)?;
        console.log(&report.lap("read"));
        let params = view_params(&loaded.settings)?;
        if options.mode == Mode::DryRun {
            let size = format!("{} x {}", params.width_px, params.height_px);
            return Ok(report.planned(&output, &format!("{} of {size}", wanted.name())));
        }
        let layers = all_layers(&loaded);
        let tree = Tree { loaded: &loaded, layers: &layers, around: &around, input: &job.input };
        let bytes = match &wanted {
            Wanted::Against(other) => {
                let beside = neighbors::load_beside(&sources, &options, other, "--against", report)?;
                tree.against(&beside, other, &params)
            }
            wanted => tree.draw(wanted, &params),
        };
        let bytes = bytes.map_err(|error| refuse(&error, &job.input))?;
        console.log(&report.lap("picture"));
        Ok(Product::Files(vec![OutputFile { path: output.clone(), bytes }]))
    })
}

fn files(options: &Options) -> Result<(PathBuf, PathBuf), Failure> {
    let (Some(input), Some(output)) = (options.inputs.first(), &options.output) else {
        return Err(Failure::usage("foliar-view FILE -o PICTURE.png"));
    };
    let is_png = output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if !is_png && !is_dash(output) {
        return Err(Failure::usage(format!("-o {}: must end in .png, or be -", output.display())));
    }
    Ok((input.clone(), output.clone()))
}

/// What is drawn.
enum Wanted {
    Picture,
    Sheet,
    Channels,
    Turntable(u32),
    Sway(u32),
    SwaySheet,
    Against(PathBuf),
}

impl Wanted {
    fn from(matches: &ArgMatches) -> Self {
        match (matches.get_one::<PathBuf>("against"), matches.get_one::<u32>("turntable")) {
            (Some(other), _) => Wanted::Against(other.clone()),
            (None, Some(&frames)) => Wanted::Turntable(frames),
            (None, None) if matches.contains_id("sway") => match matches.get_one::<u32>("sway") {
                Some(_) if matches.get_flag("sheet") => Wanted::SwaySheet,
                frames => Wanted::Sway(frames.copied().unwrap_or(1)),
            },
            (None, None) if matches.get_flag("channels") => Wanted::Channels,
            (None, None) if matches.get_flag("sheet") => Wanted::Sheet,
            (None, None) => Wanted::Picture,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Wanted::Picture => "a picture",
            Wanted::Sheet | Wanted::Channels | Wanted::SwaySheet | Wanted::Against(_) => {
                "a contact sheet with pictures"
            }
            Wanted::Turntable(_) | Wanted::Sway(_) => "an animated picture",
        }
    }
}

/// What is drawn branch by branch needs the branches that the file holds.
fn with_branches(loaded: &mut Loaded, input: &Path) -> Result<(), Failure> {
    let Some(layer) = loaded.layers.iter().find(|layer| layer.record.room == names::ROOM_BRANCHES) else {
        return Ok(());
    };
    let refuse = |error: &dyn std::fmt::Display| Failure::Input(format!("{}: {error}", input.display()));
    let (base, leaves) = (loaded.plant.base(), loaded.plant.leaves().len());
    let found = branches::from_layer(layer, base, leaves).map_err(|error| refuse(&error))?;
    let plant = std::mem::take(&mut loaded.plant).with_branches(found.branches);
    loaded.plant = plant.map_err(|error| refuse(&error))?;
    Ok(())
}

fn all_layers(loaded: &Loaded) -> Vec<&Layer> {
    std::iter::once(&loaded.structure).chain(&loaded.layers).collect()
}

fn refuse(error: &ViewError, input: &Path) -> Failure {
    match error {
        ViewError::Range(_) | ViewError::NotFinite | ViewError::Neighbors | ViewError::Channel { .. } => {
            Failure::Usage(error.to_string())
        }
        _ => Failure::Input(format!("{}: {error}", input.display())),
    }
}

/// The plant that is drawn.
struct Tree<'a> {
    loaded: &'a Loaded,
    layers: &'a [&'a Layer],
    around: &'a [Standing],
    input: &'a Path,
}

impl Tree<'_> {
    fn draw(&self, wanted: &Wanted, params: &ViewParams) -> Result<Vec<u8>, ViewError> {
        let (plant, layers, shading) = (&self.loaded.plant, self.layers, params.shading());
        if let Wanted::Turntable(frames) = *wanted {
            let turned = foliar_view::turntable(plant, layers, self.around, &shading, params, frames)?;
            return foliar_view::apng_bytes(&turned, FRAMES_PER_SECOND);
        }
        if let Wanted::Sway(frames) = *wanted {
            let wind = (foliar_schema::Strength::Storm, frames, foliar_view::FRAME_S);
            let times = foliar_view::swaying(plant, layers, self.around, &shading, params, wind)?;
            return foliar_view::apng_bytes(&times, FRAMES_PER_SECOND);
        }
        let title = self.input.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let picture = match wanted {
            Wanted::Sheet if matches!(params.look, Look::Light | Look::Traced) => {
                foliar_view::light_sheet(plant, layers, self.around, &title, params)
            }
            Wanted::Sheet => foliar_view::bake_sheet(plant, layers, self.around, &title, params),
            Wanted::Channels => foliar_view::channel_sheet(plant, layers, self.around, &title, params),
            Wanted::SwaySheet => foliar_view::sway_sheet(plant, layers, self.around, &title, params),
            _ => foliar_view::render_among(plant, layers, self.around, &shading, params),
        };
        foliar_view::png_bytes(&picture?)
    }

    /// Under the names of the files: a picture holds no paths.
    fn against(&self, other: &Loaded, file: &Path, params: &ViewParams) -> Result<Vec<u8>, ViewError> {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (name, other_name) = (name(self.input), name(file));
        let layers = all_layers(other);
        let plants = [(&self.loaded.plant, self.layers, &*name), (&other.plant, &*layers, &*other_name)];
        foliar_view::png_bytes(&foliar_view::comparison(plants, self.around, params)?)
    }
}
