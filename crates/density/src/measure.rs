//! Errors of a bake against its reference, over a fixed sample of places, for the record.

use crate::fast::luft_ambient;
use crate::field::{Field, Query};
use crate::generators::Foliage;
use crate::medium::SkySample;
use crate::params::{AmbientTerm, NormalMode, Params};
use crate::sky::Sky;
use crate::{directions::DIRECTIONS, reference};
use foliar_numerics::ErrorStats;
use foliar_schema::{MeasuredError, channel, names};
use rayon::prelude::*;

/// Places of a sample.
const PLACES: usize = 4096;
/// Most chords summed to measure the sky; fewer places are measured where the crown has many balls.
const MOST_CHORDS: usize = 1 << 23;
/// Fewest places of a sample.
const FEWEST: usize = 8;

/// Indices of up to `most` of `count` places, evenly spread over the list.
fn sample(count: usize, most: usize) -> Vec<usize> {
    let places = most.min(count);
    (0..places).map(|i| i * count / places).collect()
}

/// Error of k_a (Luft07 eq. 4), the density a sum of `fields`, against f64 sums.
pub(crate) fn luft(
    fields: &[&Field],
    queries: &[Query],
    ambient: &[f32],
    reference: f64,
    params: &Params,
) -> MeasuredError {
    let density = |at: usize| fields.iter().map(|field| field.exact_density(&queries[at])).sum();
    let error = |&at: &usize| f64::from(ambient[at]) - luft_ambient(density(at), reference, params);
    let errors: Vec<f64> = sample(queries.len(), PLACES).par_iter().map(error).collect();
    measured(names::AMBIENT, errors)
}

/// Errors of the sky's ambient term and directions against the chords of all balls.
pub(crate) fn sky(
    sky: &Sky,
    foliage: &Foliage,
    queries: &[Query],
    samples: &[SkySample],
    params: &Params,
) -> Vec<MeasuredError> {
    let most = (MOST_CHORDS / (DIRECTIONS * foliage.generators.len().max(1))).clamp(FEWEST, PLACES);
    let exact = |&at: &usize| reference::sky(&foliage.generators, sky.radius(), foliage.mean_area, &queries[at]);
    let places = sample(queries.len(), most);
    let exact: Vec<SkySample> = places.par_iter().map(exact).collect();
    let pairs = || places.iter().map(|&at| &samples[at]).zip(&exact);
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
