//! Every figure that foliar must reach, measured: figure, gate, peer, processor, pass or MISS.

mod allocations;
mod calibration;
pub mod correlation;
pub mod density;
mod gates;
mod programs;
mod reading;

use anyhow::{Result, bail};
use gates::Gate;

/// What was measured.
pub struct Figure {
    /// In the gate's unit.
    pub value: f64,
    /// What it is compared with, measured in the same run; or why there is no peer.
    pub peer: String,
}

impl Figure {
    fn new(value: f64, peer: impl Into<String>) -> Self {
        Figure { value, peer: peer.into() }
    }
}

/// A name of gates.toml and how it is measured.
type Measure = (&'static str, fn() -> Result<Figure>);

const MEASURES: [Measure; 10] = [
    ("calibration-seconds", calibration::seconds),
    ("density-seconds", density::seconds),
    ("density-memory", density::memory),
    ("field-error", density::field_error),
    ("gradient-error", density::gradient_error),
    ("depth-correlation", correlation::worst),
    ("bake-seconds", programs::bake),
    ("obj-parse-ratio", reading::parse),
    ("obj-read-ratio", reading::read),
    ("picture-seconds", programs::picture),
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
    for (name, measure) in chosen {
        let gate = gates.get(*name).ok_or_else(|| anyhow::anyhow!("gates.toml has no [{name}]"))?;
        missed += usize::from(!report(name, gate, &measure()?));
    }
    if missed > 0 {
        bail!("{missed} figures miss their gates");
    }
    Ok(())
}

/// Prints one figure; whether it passes.
fn report(name: &str, gate: &Gate, figure: &Figure) -> bool {
    let passes = gate.at_most.is_none_or(|most| figure.value <= most);
    let (value, unit) = (figure.value, if gate.unit == "1" { "" } else { gate.unit.as_str() });
    let limit = gate.at_most.map_or("no gate".into(), |most| format!("at most {}{unit}", digits(most)));
    let verdict = if passes { "pass" } else { "MISS" };
    let value = digits(value);
    println!("{verdict}  {name}: {value}{unit}, {limit}; {}; peer: {}", gate.what, figure.peer);
    passes
}

/// Three digits that a person can read, whatever the size of the number.
fn digits(value: f64) -> String {
    if (1e-2..1e4).contains(&value.abs()) { format!("{value:.3}") } else { format!("{value:.2e}") }
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
