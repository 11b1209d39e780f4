//! Every figure that foliar must reach, measured: figure, gate, peer, processor, pass or MISS.

mod allocations;
mod branches;
mod calibration;
mod checking;
pub mod correlation;
pub mod density;
mod expected;
mod fft;
mod gates;
pub mod light;
mod light_model;
mod oracle;
mod programs;
mod reading;
mod shading;
mod size;
mod surface;
pub mod translucency;
pub mod wind;

use anyhow::{Context, Result, bail};
use gates::Gate;
use std::collections::BTreeMap;

/// What was measured.
pub struct Figure {
    /// In the gate's unit.
    pub value: f64,
    /// What it is compared with, measured in the same run; or why there is no peer.
    pub peer: String,
    /// Whether it is nothing without a peer, and there is none: neither pass nor miss.
    pub absent: bool,
}

impl Figure {
    fn new(value: f64, peer: impl Into<String>) -> Self {
        Figure { value, peer: peer.into(), absent: false }
    }

    /// A ratio to a peer that is not installed.
    fn absent(peer: impl Into<String>) -> Self {
        Figure { value: f64::NAN, peer: peer.into(), absent: true }
    }
}

/// A name of gates.toml and how it is measured.
type Measure = (&'static str, fn() -> Result<Figure>);

/// The calibration loop first.
const MEASURES: &[Measure] = &[
    ("calibration-seconds", calibration::seconds),
    ("density-seconds", density::seconds),
    ("density-memory", density::memory),
    ("size-200k-seconds", size::medium),
    ("size-200k-memory", size::medium_memory),
    ("size-1m-seconds", size::large),
    ("size-1m-field-seconds", size::large_field),
    ("size-1m-field-error", size::large_error),
    ("size-1m-exact-seconds", size::large_exact),
    ("size-1m-radius-seconds", size::large_radius),
    ("size-1m-memory", size::large_memory),
    ("size-5m-memory", size::huge_memory),
    ("neighbor-time", size::neighbor),
    ("fft-time-40k-4", fft::small_coarse),
    ("fft-time-40k-8", fft::small_fine),
    ("fft-time-1m-4", fft::large_coarse),
    ("fft-time-1m-8", fft::large_fine),
    ("branches-seconds", branches::seconds),
    ("branches-large-seconds", branches::large_seconds),
    ("branches-memory", branches::memory),
    ("branches-wrong-parents", branches::wrong_parents),
    ("wind-seconds", wind::seconds),
    ("wind-large-seconds", wind::large_seconds),
    ("wind-memory", wind::memory),
    ("wind-slip", wind::slip),
    ("wind-slip-most", wind::slip_most),
    ("wind-slip-16-bits", wind::slip_of_rounding),
    ("wind-weight-steps", wind::steps),
    ("wind-leaf-slip", wind::leaf_slip),
    ("wind-normals", wind::normals),
    ("wind-frames", wind::frames),
    ("light-1500-seconds", light::sapling),
    ("light-40k-paper-seconds", light::paper),
    ("light-40k-exact-seconds", light::exact),
    ("light-40k-tree-1-percent-seconds", light::percent),
    ("light-40k-tree-1-percent-error", light::percent_error),
    ("light-40k-tree-1-per-mille-seconds", light::per_mille),
    ("light-40k-tree-1-per-mille-error", light::per_mille_error),
    ("light-40k-rays-seconds", light::rays),
    ("light-40k-wood-seconds", light::wood),
    ("light-40k-room-seconds", light::room),
    ("light-200k-tree-seconds", light::medium),
    ("light-1m-tree-seconds", light::large),
    ("light-1m-tree-memory", light::large_memory),
    ("light-model-bias", light_model::bias),
    ("light-model-low", light_model::low),
    ("light-model-low-harmonics", light_model::low_by_harmonics),
    ("light-model-paper-bias", light_model::paper_bias),
    ("noise-slope", wind::noise_slope),
    ("noise-seam", wind::noise_seam),
    ("noise-correlation", wind::noise_correlation),
    ("noise-mean", wind::noise_mean),
    ("translucency-seconds", translucency::seconds),
    ("translucency-rgb-seconds", translucency::rgb_seconds),
    ("translucency-program-seconds", programs::leaf_side),
    ("translucency-program-rgb-seconds", programs::leaf_rgb),
    ("translucency-large-seconds", translucency::large_seconds),
    ("translucency-large-memory", translucency::large_memory),
    ("translucency-tables-seconds", translucency::tables),
    ("translucency-bank-error", translucency::bank_error),
    ("translucency-fft-ratio", translucency::fft_ratio),
    ("translucency-oracle-slab-24", translucency::oracle::slab_24),
    ("translucency-oracle-slab-16", translucency::oracle::slab_16),
    ("translucency-oracle-energy", translucency::oracle::energy),
    ("translucency-oracle-layers", translucency::oracle::layers),
    ("translucency-oracle-layers-turned", translucency::oracle::layers_turned),
    ("translucency-oracle-diffusion", translucency::oracle::diffusion),
    ("translucency-oracle-diffusion-slanting", translucency::oracle::diffusion_slanting),
    ("translucency-oracle-radial", translucency::oracle::radial),
    ("translucency-oracle-golden-direct", translucency::oracle::golden_direct),
    ("translucency-oracle-golden-inside", translucency::oracle::golden_inside),
    ("translucency-oracle-golden", translucency::oracle::golden_anywhere),
    ("translucency-oracle-relief-linear", translucency::oracle::relief_linear),
    ("translucency-oracle-relief-curve", translucency::oracle::relief_curve),
    ("translucency-oracle-relief-exit", translucency::oracle::relief_exit),
    ("translucency-oracle-leaf-params", translucency::oracle::leaf_params),
    ("translucency-oracle-leaves", translucency::oracle::leaves),
    ("expected-files", expected::files),
    ("linden-leaves", expected::linden_leaves),
    ("oracle-error", oracle::worst),
    ("field-error", density::field_error),
    ("gradient-error", density::gradient_error),
    ("depth-correlation", correlation::sky),
    ("depth-correlation-luft", correlation::luft),
    ("depth-correlation-traced", shading::traced_depth),
    ("depth-correlation-crowns", correlation::crown_volumes),
    ("rim-less-inside", correlation::rim_less_inside),
    ("sky-shading-correlation", shading::correlation),
    ("ambient-variance-third", shading::third_best),
    ("ambient-variance-worst", shading::worst),
    ("bake-seconds", programs::bake),
    ("obj-parse-ratio", reading::parse),
    ("obj-read-ratio", reading::read),
    ("picture-seconds", programs::picture),
    ("check-seconds", checking::seconds),
    ("check-memory", checking::memory),
    ("surface-normals-seconds", surface::normals),
    ("surface-time-40k-4", surface::small_coarse),
    ("surface-time-40k-8", surface::small_fine),
    ("surface-time-1m-4", surface::large_coarse),
    ("surface-time-1m-8", surface::large_fine),
    ("surface-memory-1m", surface::large_memory),
];

/// Measures every figure whose name contains `name`.
pub fn run(name: Option<&str>) -> Result<()> {
    let gates = gates::read()?;
    let chosen: Vec<&Measure> = MEASURES.iter().filter(|m| name.is_none_or(|n| m.0.contains(n))).collect();
    if chosen.is_empty() {
        bail!("no figure is named like {:?}", name.unwrap_or(""));
    }
    println!("{}, {} threads", calibration::processor(), std::thread::available_parallelism()?);
    let mut missed = 0;
    for (name, measure) in with_calibration(chosen, &gates) {
        let gate = gates.get(*name).with_context(|| format!("gates.toml has no [{name}]"))?;
        missed += usize::from(!report(name, gate, &measure()?));
    }
    if missed > 0 {
        bail!("{missed} figures miss their gates");
    }
    Ok(())
}

/// Absolute seconds mean little alone: where any is measured, so is the calibration loop.
fn with_calibration<'a>(mut chosen: Vec<&'a Measure>, gates: &BTreeMap<String, Gate>) -> Vec<&'a Measure> {
    let has_seconds = chosen.iter().any(|m| gates.get(m.0).is_some_and(|gate| gate.unit == "s"));
    if has_seconds && chosen[0].0 != MEASURES[0].0 {
        chosen.insert(0, &MEASURES[0]);
    }
    chosen
}

/// Prints one figure; whether it passes.
fn report(name: &str, gate: &Gate, figure: &Figure) -> bool {
    if figure.absent {
        println!("skip  {name}: {}; {}", gate.what, figure.peer);
        return true;
    }
    let passes = gate.passes(figure.value);
    let unit = if gate.unit == "1" { String::new() } else { format!(" {}", gate.unit) };
    let bound = |words: &str, limit: f64| format!("{words} {}{unit}", digits(limit));
    let limit = match (gate.at_most, gate.at_least) {
        (Some(most), _) => bound("at most", most),
        (None, Some(least)) => bound("at least", least),
        (None, None) => "no gate".into(),
    };
    let verdict = if passes { "pass" } else { "MISS" };
    let value = digits(figure.value);
    println!("{verdict}  {name}: {value}{unit}, {limit}; {}; peer: {}", gate.what, figure.peer);
    passes
}

/// Three digits that a person can read, whatever the size of the number.
fn digits(value: f64) -> String {
    match value.abs() {
        size if size.fract() == 0.0 && size < 1e6 => format!("{value}"),
        size if (1e-2..1e4).contains(&size) => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// The least of several runs, seconds: what the machine can do when nobody disturbs it.
fn least_seconds(runs: usize, mut run: impl FnMut() -> Result<()>) -> Result<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let start = std::time::Instant::now();
        run()?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}

/// A peer that is not installed is said in so many words.
fn missing(name: &str) -> String {
    format!("{name}: peer missing")
}
