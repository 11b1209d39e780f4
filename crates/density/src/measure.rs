//! Errors of a bake against its reference, over a fixed sample of places: for the record, and to choose by.

use crate::fast::{luft_ambient, median};
use crate::field::Query;
use crate::generators::Foliage;
use crate::medium::SkySample;
use crate::params::{AmbientTerm, NormalMode, Params};
use crate::{directions::DIRECTIONS, reference};
use foliar_numerics::ErrorStats;
use foliar_schema::{MeasuredError, channel, names};
use rayon::prelude::*;

/// Places of a sample.
const PLACES: usize = 4096;
/// Most chords that are summed in f64.
const MOST_CHORDS: usize = 1 << 22;
/// Fewest places of a sample.
const FEWEST: usize = 8;

/// Indices of up to 4,096 of `count` places, evenly spread over the list.
pub(crate) fn sample(count: usize) -> Vec<usize> {
    spread(count, PLACES)
}

fn spread(count: usize, most: usize) -> Vec<usize> {
    let places = most.min(count);
    (0..places).map(|i| i * count / places).collect()
}

/// Error of k_a (Luft07 eq. 4) at places of these densities.
pub(crate) fn luft(fast: &[f32], exact: &[f64], reference: f64, params: &Params) -> MeasuredError {
    let ambient = |density: f64| luft_ambient(density, reference, params);
    let errors = fast.iter().zip(exact).map(|(&fast, &exact)| ambient(f64::from(fast)) - ambient(exact));
    measured(names::AMBIENT, errors.collect())
}

/// Error of the density relative to itself, rms over the places where it is above a fifth of the median over all
/// these places: what is left in the open is no foliage, and nothing divides by it. 0 where there is none.
pub(crate) fn relative(fast: &[f32], exact: &[f64]) -> f64 {
    const SHARE_OF_MEDIAN: f64 = 0.2;
    let mut sorted = exact.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let least = SHARE_OF_MEDIAN * median(&sorted);
    let pairs = fast.iter().zip(exact).filter(|(_, exact)| **exact > least);
    let errors: Vec<f64> = pairs.map(|(&fast, exact)| f64::from(fast) / exact - 1.0).collect();
    if errors.is_empty() { 0.0 } else { ErrorStats::of(errors).rms }
}

/// Errors of the sky's ambient term and directions, those of the two that `params` asks for.
pub(crate) fn sky(fast: &[SkySample], exact: &[SkySample], params: &Params) -> Vec<MeasuredError> {
    let pairs = || fast.iter().zip(exact);
    let lift = 1.0 - params.darkest_ambient;
    let mut errors = Vec::new();
    if params.ambient == AmbientTerm::Sky && params.wants_ambient() {
        let terms = pairs().map(|(fast, exact)| lift * (fast.transmittance - exact.transmittance));
        errors.push(measured(names::AMBIENT, terms.collect()));
    }
    if params.normals == NormalMode::Sky && params.wants_normals() {
        let angle = |chord: f64| 2.0 * libm::asin((chord / 2.0).min(1.0)).to_degrees();
        let angles = pairs().map(|(fast, exact)| angle((fast.direction - exact.direction).length()));
        errors.push(measured(names::SOFT_NORMAL, angles.collect()));
    }
    errors
}

/// Errors of chords summed in f32 against the reference's f64: at fewer places where the crown has many balls,
/// since nothing is chosen by them.
pub(crate) fn chords(
    foliage: &Foliage,
    queries: &[Query],
    samples: &[SkySample],
    params: &Params,
) -> Vec<MeasuredError> {
    let most = (MOST_CHORDS / (DIRECTIONS * foliage.generators.len().max(1))).clamp(FEWEST, PLACES);
    let places = spread(queries.len(), most);
    let exact = |&at: &usize| reference::sky(&foliage.generators, foliage.radius, foliage.mean_area, &queries[at]);
    let exact: Vec<SkySample> = places.par_iter().map(exact).collect();
    let fast: Vec<SkySample> = places.iter().map(|&at| samples[at]).collect();
    sky(&fast, &exact, params)
}

/// The largest of several errors, visible steps.
pub(crate) fn worst(errors: &[MeasuredError]) -> f64 {
    errors.iter().map(|error| error.rms_steps).fold(0.0, f64::max)
}

fn measured(name: &str, errors: Vec<f64>) -> MeasuredError {
    let stats = ErrorStats::of(errors);
    let step = channel(name).map_or(1.0, |channel| channel.visible_step);
    MeasuredError {
        channel: name.into(),
        rms_steps: stats.rms / step,
        p999_steps: stats.p999 / step,
        places: stats.count as u32,
    }
}
