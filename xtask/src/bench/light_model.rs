//! The run-time models of light against traced paths: `cargo xtask tradeoff light-model` says the same and more.

use super::Figure;
use crate::tradeoff::light_model::{DEFAULT, Errors, HARMONICS, PAPER, Scored, mean, measure};
use anyhow::{Result, anyhow};
use std::sync::OnceLock;

/// Size of the bias of the default model.
pub fn bias() -> Result<Figure> {
    figure(DEFAULT, |errors| errors.bias)
}

/// Error of the default model where single leaves are averaged away.
pub fn low() -> Result<Figure> {
    figure(DEFAULT, |errors| errors.low)
}

/// The same with nine numbers for the sun.
pub fn low_by_harmonics() -> Result<Figure> {
    figure(HARMONICS, |errors| errors.low)
}

/// Size of the bias of the paper's model: not near what it is known to be, it is not the paper's.
pub fn paper_bias() -> Result<Figure> {
    figure(PAPER, |errors| errors.bias)
}

fn figure(pipeline: usize, of: impl Fn(&Errors) -> f64) -> Result<Figure> {
    let scored = scored()?;
    let value = of(&mean(scored, pipeline));
    let paper = of(&mean(scored, PAPER));
    Ok(Figure::new(value, format!("Boulanger08's own model {paper:.3}; paths through {} crowns", scored.len())))
}

/// Traced once for all rows.
fn scored() -> Result<&'static [Scored]> {
    static SCORED: OnceLock<Result<Vec<Scored>, String>> = OnceLock::new();
    let scored = SCORED.get_or_init(|| measure().map_err(|error| format!("{error:#}")));
    scored.as_deref().map_err(|error| anyhow!("{error}"))
}
