//! The translucency room's ladder: transport, entry, fit and curve against counted photons; spread, filters and resolution
//! against the direct gather. Writes the tables and the chart of docs/tradeoff/translucency.md.

use super::room::cpu_seconds;
use crate::bench::translucency::oracle::{records, reliefs};
use crate::bench::translucency::{piece, recipe, rms, tables_of};
use crate::repo;
use anyhow::{Context, Result};
use foliar_translucency::PRESETS;
use foliar_translucency::light::{Entry, Fit};
use foliar_translucency::map::by_rule::leaf_by_rule;
use foliar_translucency::map::{Model, Recipe, Spreading, coefficient_map, reference};
use foliar_translucency::oracle::bumps_error;
use foliar_translucency::transport::{AddingDoubling, DeltaP1, Multipole};
use std::fmt::Write;

const DOCUMENT: &str = "docs/tradeoff/translucency.md";
const CHART: &str = "docs/tradeoff/translucency.svg";
/// Texels along a leaf of 80 mm.
const SIZES: [usize; 3] = [512, 1024, 2048];
/// Filters of the bank; 0 is no spread at all.
const FILTERS: [usize; 6] = [0, 3, 4, 6, 8, 10];

/// One way through a leaf.
struct Way {
    name: &'static str,
    model: Model,
    entry: Entry,
    spreading: Spreading,
    fit: Fit,
    curve: bool,
}

fn ways() -> Vec<Way> {
    let way =
        |name, model, entry| Way { name, model, entry, spreading: Spreading::Kernel, fit: Fit::Uniform, curve: false };
    let best = |name| way(name, Model::AddingDoubling, Entry::Transport);
    vec![
        way("the paper: multipole, cosine alone", Model::Multipole, Entry::Lambert),
        way("multipole, transport entry", Model::Multipole, Entry::Transport),
        way("diffusion, transport entry", Model::Diffusion, Entry::Transport),
        way("adding-doubling, cosine alone", Model::AddingDoubling, Entry::Lambert),
        way("adding-doubling, cosine and mirror", Model::AddingDoubling, Entry::Fresnel),
        Way { spreading: Spreading::None, ..best("adding-doubling, transport entry, no spread") },
        best("**default**: adding-doubling, transport entry, spread"),
        Way { fit: Fit::Cosine, ..best("the default, fit by cosine") },
        Way { fit: Fit::Anchor, ..best("the default, exact from straight behind") },
        Way { curve: true, ..best("the default with the curve of two numbers") },
    ]
}

/// Measures everything.
pub fn run() -> Result<()> {
    let (bumps, groups) = bumps()?;
    let costs = costs()?;
    let text = format!(
        "### Flat leaves: light that passes at 510 nm\n\n{}\n### Bumps under five lights against counted photons\n\n{}\n\
         ### Spread, filters and resolution against the direct gather\n\n{}",
        flat()?,
        bumps_table(&bumps, &groups),
        costs_table(&costs)
    );
    println!("{text}");
    super::leaf_pictures::draw()?;
    std::fs::write(repo::root().join(CHART), chart(&costs)).context(CHART)?;
    let document = super::replaced(DOCUMENT, &repo::text(DOCUMENT)?, &text)?;
    std::fs::write(repo::root().join(DOCUMENT), document).context(DOCUMENT)
}

/// T of each preset by each model.
fn flat() -> Result<String> {
    const EXACT: usize = 48;
    const DEFAULT: usize = 16;
    let mut text =
        String::from("| leaf | T | multipole | diffusion | adding-doubling of 16 nodes |\n|---|---|---|---|---|\n");
    for preset in PRESETS {
        let (medium, d) = (preset.medium(510.0).context("no 510 nm")?, preset.thickness_mm);
        let t = |nodes| AddingDoubling::one(&medium, d, 1.0, nodes).transmittance;
        let exact = t(EXACT);
        let off = |t: f64| format!("{t:.4} ({:+.1} %)", 100.0 * (t / exact - 1.0));
        let multipole = off(Multipole::new(&medium, d, 1.0).transmittance());
        let diffusion = off(DeltaP1::new(&medium, d, 1.0).totals().1);
        let _ = writeln!(
            text,
            "| {}, {d} mm | {exact:.4} | {multipole} | {diffusion} | {} |",
            preset.name,
            off(t(DEFAULT))
        );
    }
    Ok(text)
}

/// What a way errs on each relief, and the processor seconds of its tables and map.
struct Bump {
    name: &'static str,
    errors: Vec<f64>,
    seconds: f64,
}

fn bumps() -> Result<(Vec<Bump>, Vec<String>)> {
    let records = records("relief")?;
    let groups = reliefs(&records, "relief face");
    let leaf = leaf_by_rule(1024);
    let mut bumps = Vec::new();
    for way in ways() {
        let with = |recipe: Recipe| Recipe {
            model: way.model,
            entry: way.entry,
            spreading: way.spreading,
            fit: way.fit,
            curve: way.curve,
            ..recipe
        };
        let errors = groups.iter().map(|(_, records)| bumps_error(records, with)).collect();
        let recipe = with(recipe(leaf.texel_mm)?);
        let (_, seconds) = cpu_seconds(|| Ok(coefficient_map(&leaf.back, &tables_of(&leaf.back, &recipe)?)))?;
        bumps.push(Bump { name: way.name, errors, seconds });
    }
    Ok((bumps, groups.into_iter().map(|group| group.0).collect()))
}

fn bumps_table(bumps: &[Bump], groups: &[String]) -> String {
    let mut text = format!(
        "| way | {} | processor s, 1024 x 1024 |\n|---|{}---|\n",
        groups.join(" | "),
        "---|".repeat(groups.len())
    );
    for bump in bumps {
        let errors: Vec<String> = bump.errors.iter().map(|e| format!("{:.1} %", 100.0 * e)).collect();
        let _ = writeln!(text, "| {} | {} | {:.2} |", bump.name, errors.join(" | "), bump.seconds);
    }
    text
}

/// One size and bank.
struct Cost {
    size: usize,
    filters: usize,
    seconds: f64,
    error: f64,
}

fn costs() -> Result<Vec<Cost>> {
    const SIDE: usize = 64;
    const PLACES: [[f64; 2]; 3] = [[0.5, 0.55], [0.62, 0.5], [0.79, 0.6]];
    let mut costs = Vec::new();
    for size in SIZES {
        eprintln!("{size}");
        let leaf = leaf_by_rule(size);
        let pieces = PLACES.map(|place| piece(&leaf.back, SIDE, place));
        let base = recipe(leaf.texel_mm)?;
        let exact: Vec<_> = pieces.iter().map(|piece| reference::coefficient_map(piece, &base)).collect();
        for filters in FILTERS {
            let spreading = if filters == 0 { Spreading::None } else { Spreading::Kernel };
            let recipe = Recipe { filters: Some(filters), spreading, ..base.clone() };
            let tables = tables_of(&leaf.back, &recipe)?;
            let (_, seconds) = cpu_seconds(|| Ok(coefficient_map(&leaf.back, &tables_of(&leaf.back, &recipe)?)))?;
            let errors = pieces.iter().zip(&exact).map(|(piece, exact)| rms(&coefficient_map(piece, &tables), exact));
            costs.push(Cost { size, filters, seconds, error: errors.fold(0.0, f64::max) });
        }
    }
    Ok(costs)
}

fn costs_table(costs: &[Cost]) -> String {
    let mut text = String::from(
        "| texels | texel, mm | filters | processor s | error, rms of the mean |\n|---|---|---|---|---|\n",
    );
    for cost in costs {
        let filters = if cost.filters == 0 { "no spread".into() } else { cost.filters.to_string() };
        let texel = foliar_translucency::map::by_rule::WIDTH_MM / cost.size as f64;
        let _ = writeln!(
            text,
            "| {0} x {0} | {texel:.3} | {filters} | {1:.2} | {2:.3} % |",
            cost.size,
            cost.seconds,
            100.0 * cost.error
        );
    }
    text
}

/// Error over time, both by powers of ten; a line per size.
fn chart(costs: &[Cost]) -> String {
    const COLORS: [&str; 3] = ["#7fae5a", "#2f6d3a", "#4a7fb5"];
    let (left, right, top, bottom) = (70.0, 560.0, 30.0, 300.0);
    let x = |seconds: f64| left + (libm::log10(seconds.max(0.01)) + 2.0) / 3.0 * (right - left);
    let y = |error: f64| bottom - (libm::log10(error.max(1e-5)) + 5.0) / 4.0 * (bottom - top);
    let mut text = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 600 350\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
    );
    for power in 0..=4 {
        let (at, words) = (y(libm::pow(10.0, f64::from(power) - 5.0)), libm::pow(10.0, f64::from(power) - 3.0));
        let _ = writeln!(
            text,
            "<line x1=\"{left}\" x2=\"{right}\" y1=\"{at:.0}\" y2=\"{at:.0}\" stroke=\"#ddd\"/>\
             <text x=\"{}\" y=\"{:.0}\" text-anchor=\"end\">{words} %</text>",
            left - 6.0,
            at + 4.0
        );
    }
    for power in 0..=3 {
        let (at, words) = (x(libm::pow(10.0, f64::from(power) - 2.0)), libm::pow(10.0, f64::from(power) - 2.0));
        let _ = writeln!(text, "<text x=\"{at:.0}\" y=\"{}\" text-anchor=\"middle\">{words} s</text>", bottom + 18.0);
    }
    for (size, color) in SIZES.into_iter().zip(COLORS) {
        let own: Vec<&Cost> = costs.iter().filter(|cost| cost.size == size).collect();
        let points: Vec<String> = own.iter().map(|c| format!("{:.1},{:.1}", x(c.seconds), y(c.error))).collect();
        let _ = writeln!(text, "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\"/>", points.join(" "));
        for cost in &own {
            let (x, y) = (x(cost.seconds), y(cost.error));
            let name = if cost.filters == 0 { format!("{size}, no spread") } else { cost.filters.to_string() };
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{color}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"10\">{name}</text>",
                x + 6.0,
                y - 4.0
            );
        }
    }
    let _ = writeln!(
        text,
        "<text x=\"{left}\" y=\"342\">processor seconds; up: rms error against the direct gather; numbers: filters of the bank</text>\n</svg>"
    );
    text
}
