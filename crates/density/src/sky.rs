//! What each place sees of the sky, through the foliage taken for an absorbing medium: density on a
//! lattice, one sweep of it for each axis of the sky, lookups by interpolation; or the chords of all balls.
//!
//! Evaluated once for each leaf, so that a leaf's corners agree: realigned normals that point outward all
//! round a crown must break somewhere, and this way never inside a leaf.

use crate::Isa;
use crate::chords;
use crate::columns::Columns;
use crate::directions::{AXES, DIRECTIONS, sky_axes, sky_directions};
use crate::field::Query;
use crate::generators::{Foliage, Generator};
use crate::groups::Groups;
use crate::lattice::{Lattice, Spot};
use crate::medium::{SkySample, chords as both_chords, extinction, see};
use crate::order;
use glam::DVec3;
use rayon::prelude::*;

/// Lattice points that may be swept at once, 4 bytes each.
const POINTS_AT_ONCE: usize = 1 << 22;
/// The integral of (1 - r^2)^2 from the middle of a ball of radius 1 outward.
const CHORD_FROM_MIDDLE: f64 = 8.0 / 15.0;
/// Cells by which places are ordered: about those of a lattice.
const CELLS_PER_RADIUS: f64 = 4.0;

/// A crown and its neighbors as absorbing media, ready to be asked.
#[derive(Debug)]
pub struct Sky<'a> {
    foliage: &'a Foliage,
    /// One for each plant: how finely the crown is seen does not depend on what stands around it.
    media: Vec<Medium<'a>>,
    isa: Isa,
}

/// The balls of one plant.
#[derive(Debug)]
struct Medium<'a> {
    balls: &'a [Generator],
    groups: Groups,
    /// `None` where chords are summed.
    lattice: Option<(Lattice, Vec<f32>)>,
}

impl<'a> Sky<'a> {
    /// Prepares lattices of `points_per_radius`, which set the error; coarser where one would have more than
    /// `most` points.
    pub fn on_lattices(foliage: &'a Foliage, points_per_radius: f64, most: usize) -> Sky<'a> {
        let isa = Isa::best();
        let medium = |balls: &'a [Generator]| {
            let lattice = Lattice::around(balls, foliage.radius, points_per_radius, most);
            let density = lattice.splat(balls, foliage.radius, isa);
            Medium { balls, groups: Groups::new(balls), lattice: Some((lattice, density)) }
        };
        Sky { foliage, media: foliage.stands().map(medium).collect(), isa }
    }

    /// Exact up to f32 rounding: all chords.
    pub fn by_chords(foliage: &'a Foliage) -> Sky<'a> {
        let medium = |balls: &'a [Generator]| Medium { balls, groups: Groups::default(), lattice: None };
        Sky { foliage, media: foliage.stands().map(medium).collect(), isa: Isa::best() }
    }

    /// The same sky on chosen instructions: same bits.
    pub fn on(mut self, isa: Isa) -> Self {
        self.isa = isa;
        self
    }

    /// The sky at each query.
    pub fn samples(&self, queries: &[Query]) -> Vec<SkySample> {
        self.counted_samples(queries).0
    }

    /// The same, and how many pairs of ball and query were looked at for chords.
    pub(crate) fn counted_samples(&self, queries: &[Query]) -> (Vec<SkySample>, u64) {
        let (axes, directions) = (sky_axes(), sky_directions());
        // Neighbors in space read the same part of a lattice: each place's answer is its own, whatever the order.
        let cells = CELLS_PER_RADIUS / self.foliage.radius;
        let order = order::in_space(queries.len(), |at| Some(queries[at].position * cells));
        let order: Vec<u32> = order.into_iter().map(|(_, at)| at).collect();
        let scale = extinction(self.foliage.mean_area, self.foliage.radius);
        let depths: Vec<chords::Depths> = self.media.iter().map(|m| m.depths(self, queries, &order, &axes)).collect();
        let sample = |(index, at): (usize, &u32)| {
            let mut sums = [0.0f64; DIRECTIONS];
            for medium in &depths {
                for (axis, depths) in medium.axes.iter().enumerate() {
                    sums[axis] += scale * f64::from(depths[index][0]);
                    sums[axis + AXES] += scale * f64::from(depths[index][1]);
                }
            }
            see(&sums, &directions, queries[*at as usize].position)
        };
        let sorted: Vec<SkySample> = order.par_iter().enumerate().map(sample).collect();
        let mut samples = sorted.clone();
        order.iter().zip(sorted).for_each(|(at, sample)| samples[*at as usize] = sample);
        (samples, depths.iter().map(|depths| depths.pairs).sum())
    }
}

impl Medium<'_> {
    /// Depths in radii toward both ends of each axis, without the balls that each query leaves out; in this order.
    fn depths(&self, sky: &Sky, queries: &[Query], order: &[u32], axes: &[DVec3; AXES]) -> chords::Depths {
        let radius = sky.foliage.radius;
        let Some((lattice, density)) = &self.lattice else {
            let queries: Vec<Query> = order.par_iter().map(|at| queries[*at as usize]).collect();
            return chords::depths(self.balls, radius, &queries, axes, sky.isa);
        };
        // Groups are found in the order of the list, in which neighbors share them.
        let own: Vec<&[Generator]> = self.groups.of_each(queries);
        let own: Vec<&[Generator]> = order.par_iter().map(|at| own[*at as usize]).collect();
        let per_radius = 1.0 / radius;
        let spots: Vec<Spot> =
            order.par_iter().map(|at| lattice.spot(queries[*at as usize].position * per_radius)).collect();
        let along = |toward: &DVec3| {
            let columns = Columns::new(lattice, density, *toward);
            let depths = |(spot, own): (&Spot, &&[Generator])| {
                less_own(columns.depths(spot), spot.place, own, per_radius, *toward)
            };
            spots.par_iter().zip(&own).with_min_len(1024).map(depths).collect()
        };
        let at_once = (POINTS_AT_ONCE as f64 * AXES as f64 / swept(lattice)) as usize;
        let at_once = at_once.clamp(1, AXES);
        let each = axes.chunks(at_once).flat_map(|axes| axes.par_iter().map(along).collect::<Vec<_>>());
        chords::Depths { axes: each.collect(), pairs: 0 }
    }
}

/// Points that the longest sweep of a lattice fills.
pub(crate) fn most_swept(lattice: &Lattice) -> f64 {
    sky_axes().into_iter().map(|axis| Columns::points(lattice, axis)).fold(0.0, f64::max)
}

/// Points that all sweeps of a lattice fill.
pub(crate) fn swept(lattice: &Lattice) -> f64 {
    sky_axes().into_iter().map(|axis| Columns::points(lattice, axis)).sum()
}

/// Depths less the chords of a place's own balls; the place in radii.
fn less_own(depths: [f32; 2], place: DVec3, own: &[Generator], per_radius: f64, toward: DVec3) -> [f32; 2] {
    let mut depths = depths.map(f64::from);
    for ball in own {
        let from = place - ball.position * per_radius;
        // Mostly a leaf is asked about in its own middle.
        let chords = if from == DVec3::ZERO { [CHORD_FROM_MIDDLE; 2] } else { both_chords(from, toward) };
        depths = [0, 1].map(|end| depths[end] - f64::from(ball.weight) * chords[end]);
    }
    depths.map(|depth| depth.max(0.0) as f32)
}
