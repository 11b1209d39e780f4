//! How finely the density is computed: the cheapest setting, by a cost model, that keeps the promise of
//! `quality`, as measured over a fixed sample of places. No clock has a say: the same plant gets the same setting
//! on every machine.

use crate::coarse::Coarse;
use crate::directions::AXES;
use crate::fast::density_unit;
use crate::field::{Field, Query};
use crate::generators::Foliage;
use crate::lattice::Lattice;
use crate::measure;
use crate::medium::SkySample;
use crate::params::Params;
use crate::sky::{Sky, most_swept, swept};
use foliar_schema::MeasuredError;
use rayon::prelude::*;

/// Lattice points per radius that are tried, coarsest first.
const RUNGS: [f64; 9] = [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0];
/// Most lattice points, and fewest of these: a large plant may have as many as it has vertices. A small one whose leaves
/// are small beside it needs more than it has vertices, or every ball would be asked for every leaf.
const FEWEST_MOST_POINTS: usize = 1 << 22;
/// Most points that one sweep may fill, 4 bytes each.
const MOST_SWEPT: f64 = (1 << 25) as f64;

/// What things cost, in nanoseconds of one common processor: only their ratios count.
mod cost {
    /// A pair of ball and place, for its chords.
    pub const CHORD: f64 = 1.0;
    /// A ball, for each axis, whatever it meets.
    pub const DISK: f64 = 60.0;
    /// A place, for each axis swept.
    pub const LOOK: f64 = 16.0;
    /// A point of a column.
    pub const SWEEP: f64 = 3.0;
    /// A lattice point that is filled.
    pub const POINT: f64 = 4.0;
    /// A ball that is put onto a lattice.
    pub const SPLAT: f64 = 300.0;
    /// A place, for the density alone: of a lattice, and exact.
    pub const SPLINE: f64 = 40.0;
    pub const PLACE: f64 = 150.0;
    /// A pair of ball and place, for the density.
    pub const PAIR: f64 = 0.4;
}

/// The rungs worth a try, by how errors fall with the points per radius: to the 2.5th power of them for the
/// density, and about the second for the sky.
struct Climb {
    power: f64,
    /// Points per radius that just keep the promise, by the law.
    least: f64,
    /// Whether the law starts from what was measured on this plant.
    measured: bool,
}

impl Climb {
    /// Starts from the error that trees of 40,000 leaves and more have at two points per radius, in steps.
    fn new(power: f64, at_two: f64, quality: f64) -> Climb {
        Climb { power, least: law(2.0, at_two / quality, power), measured: false }
    }

    /// Whether a rung may keep the promise, after what was missed.
    fn may_keep(&self, points: f64) -> bool {
        // A little less than the law says: what is measured decides.
        points >= 0.95 * self.least
    }

    /// Whether a rung is all but sure to keep it.
    fn will_keep(&self, points: f64) -> bool {
        self.measured && points >= 1.1 * self.least
    }

    /// A rung missed by a factor.
    fn missed(&mut self, points: f64, factor: f64) {
        self.least = law(points, factor, self.power);
        self.measured = true;
    }
}

/// Points per radius at which a promise that is missed by a factor at so many is just kept.
fn law(points: f64, factor: f64, power: f64) -> f64 {
    points * libm::pow(factor, 1.0 / power)
}

/// Most points of a lattice for so many places.
pub(crate) fn most_points(places: usize) -> usize {
    places.max(FEWEST_MOST_POINTS)
}

/// The sky, its errors, and the lattice points per radius that keep the promise; 0 where chords were summed.
pub(crate) struct ChosenSky {
    pub samples: Vec<SkySample>,
    pub errors: Vec<MeasuredError>,
    pub points: f64,
}

/// The sky at all queries.
pub(crate) fn sky(foliage: &Foliage, queries: &[Query], params: &Params, most: usize) -> ChosenSky {
    let chords = Sky::by_chords(foliage);
    let at = measure::sample(queries.len());
    let places = of(queries, &at);
    let (exact, pairs) = chords.counted_samples(&places);
    if places.len() < queries.len() {
        let scale = queries.len() as f64 / places.len() as f64;
        let balls = foliage.generators.len() as f64;
        let dear = pairs as f64 * scale * cost::CHORD + balls * AXES as f64 * cost::DISK;
        if let Some(chosen) = swept_sky(foliage, queries, params, most, (&at, &places, &exact, dear)) {
            return chosen;
        }
    }
    let samples = if places.len() < queries.len() { chords.samples(queries) } else { exact };
    let errors = measure::chords(foliage, queries, &samples, params);
    ChosenSky { samples, errors, points: 0.0 }
}

/// The sky from the coarsest lattices that keep the promise, as long as they cost less than `dear`.
fn swept_sky(
    foliage: &Foliage,
    queries: &[Query],
    params: &Params,
    most: usize,
    (at, places, exact, dear): (&[usize], &[Query], &[SkySample], f64),
) -> Option<ChosenSky> {
    let mut climb = Climb::new(2.0, 1.5, params.quality());
    for points in RUNGS {
        let lattice = Lattice::around(foliage.own(), foliage.radius, points, most);
        let sweeps = (AXES * queries.len()) as f64 * cost::LOOK + swept(&lattice) * cost::SWEEP;
        if lattice.is_coarser_than(points)
            || most_swept(&lattice) > MOST_SWEPT
            || sweeps + foliage.generators.len() as f64 * cost::SPLAT >= dear
        {
            return None;
        }
        if climb.may_keep(points) {
            let sky = Sky::on_lattices(foliage, points, most);
            // The sweeps cost most: where the promise is all but certain, they are done once, for all places.
            let all = climb.will_keep(points).then(|| sky.samples(queries));
            let sampled = all.as_ref().map_or_else(|| sky.samples(places), |all| of(all, at));
            let errors = measure::sky(&sampled, exact, params);
            let factor = measure::worst(&errors) / params.quality();
            if factor <= 1.0 {
                return Some(ChosenSky { samples: all.unwrap_or_else(|| sky.samples(queries)), errors, points });
            }
            climb.missed(points, factor);
        }
    }
    None
}

/// Densities, the unit they are judged in, the error of k_a, that of the density of the plant's own balls
/// ([`measure::relative`]), and the lattice points per radius that keep the promise; 0 where the field is exact.
pub(crate) struct ChosenField {
    pub densities: Vec<f32>,
    pub unit: f64,
    pub error: MeasuredError,
    pub relative: f64,
    pub points: f64,
}

/// Error of the density that goes with one visible step of k_a, relative to itself, rms: k_a hides what happens to
/// dark places, on which every density beyond the darkest looks the same.
const RELATIVE_PER_STEP: f64 = 0.005;

/// The density at all queries, for k_a. The plant's own balls alone decide how it is computed, so that neighbors
/// change neither its unit nor, where they do not reach, any bit; theirs are summed one by one.
pub(crate) fn field(foliage: &Foliage, queries: &[Query], params: &Params, most: usize) -> ChosenField {
    let field = Field::new(foliage.own(), foliage.radius);
    let at = measure::sample(queries.len());
    let places = of(queries, &at);
    let (exact, pairs): (Vec<f64>, Vec<usize>) = places.par_iter().map(|query| field.exact(query)).unzip();
    let dear = cost::PLACE + cost::PAIR * pairs.iter().sum::<usize>() as f64 / places.len().max(1) as f64;
    let splined = splined_field(foliage, queries, params, most, (&places, &exact, dear));
    let mut chosen = splined.unwrap_or_else(|| {
        let unit = density_unit(foliage, params, |queries| field.densities(queries));
        let densities = field.densities(queries);
        let fast: Vec<f32> = at.iter().map(|&at| densities[at]).collect();
        let error = measure::luft(&fast, &exact, unit, params);
        ChosenField { densities, unit, error, relative: measure::relative(&fast, &exact), points: 0.0 }
    });
    let near = foliage.neighbors_near(queries);
    if !near.is_empty() {
        let around = Field::new(&near, foliage.radius);
        chosen.densities.iter_mut().zip(around.densities(queries)).for_each(|(sum, more)| *sum += more);
        let exact: Vec<f64> = places.par_iter().zip(&exact).map(|(query, own)| own + around.exact(query).0).collect();
        let fast: Vec<f32> = at.iter().map(|&at| chosen.densities[at]).collect();
        chosen.error = measure::luft(&fast, &exact, chosen.unit, params);
    }
    chosen
}

/// The density of the plant's own balls from the coarsest lattice that keeps the promise, as long as it costs
/// less than `dear` a place.
fn splined_field(
    foliage: &Foliage,
    queries: &[Query],
    params: &Params,
    most: usize,
    (places, exact, dear): (&[Query], &[f64], f64),
) -> Option<ChosenField> {
    let asked = (queries.len() + foliage.own) as f64;
    let (quality, mut climb) = (params.quality(), Climb::new(2.5, 6.0, params.quality()));
    for points in RUNGS {
        let lattice = Lattice::around(foliage.own(), foliage.radius, points, most);
        let splat = foliage.own as f64 * cost::SPLAT + lattice.points() as f64 * cost::POINT;
        if lattice.is_coarser_than(points) || asked * cost::SPLINE + splat >= asked * dear {
            return None;
        }
        if climb.may_keep(points) {
            let coarse = Coarse::new(foliage.own(), foliage.radius, points, most);
            let fast = coarse.densities(places);
            let relative = measure::relative(&fast, exact);
            let mut factor = relative / (RELATIVE_PER_STEP * quality);
            if factor <= 1.0 {
                let unit = density_unit(foliage, params, |queries| coarse.densities(queries));
                let error = measure::luft(&fast, exact, unit, params);
                factor = error.rms_steps / quality;
                if factor <= 1.0 {
                    return Some(ChosenField { densities: coarse.densities(queries), unit, error, relative, points });
                }
            }
            climb.missed(points, factor);
        }
    }
    None
}

fn of<T: Copy>(all: &[T], at: &[usize]) -> Vec<T> {
    at.iter().map(|&at| all[at]).collect()
}
