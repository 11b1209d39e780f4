//! What each place sees of the sky, through the foliage taken for an absorbing medium: density on a
//! lattice, one sweep of it for each direction, lookups by interpolation.
//!
//! Evaluated once for each leaf, so that a leaf's corners agree: realigned normals that point outward all
//! round a crown must break somewhere, and this way never inside a leaf.

use crate::directions::sky_directions;
use crate::field::Query;
use crate::generators::{Foliage, Generator};
use crate::lattice::Lattice;
use crate::medium::{SkySample, chord, extinction, see};
use glam::DVec3;
use rayon::prelude::*;

/// Most lattice points: 4 bytes each, once and once for each thread.
const MOST_POINTS: usize = 1 << 20;
/// Up to so many pairs of balls and queries, chords are summed one by one: exact, and no slower.
const MOST_PAIRS: usize = 400_000;

/// A crown as an absorbing medium, ready to be asked.
#[derive(Debug)]
pub struct Sky {
    lattice: Lattice,
    /// Balls in radii of the medium, the plant's own first and sorted by group.
    balls: Vec<Generator>,
    own: usize,
    scale: f64,
}

impl Sky {
    /// Prepares a crown. `points_per_radius` of the lattice set the error.
    pub fn new(foliage: &Foliage, points_per_radius: f64) -> Sky {
        let lattice = Lattice::around(&foliage.generators, foliage.radius, points_per_radius, MOST_POINTS);
        let scale = extinction(foliage.mean_area, lattice.radius);
        let mut balls = foliage.generators.clone();
        balls.iter_mut().for_each(|ball| ball.position /= lattice.radius);
        balls[..foliage.own].sort_by_key(|ball| ball.group);
        Sky { lattice, balls, own: foliage.own, scale }
    }

    /// Radius of the balls of the medium, meters: the radius of influence, or more where the lattice
    /// would take too much memory.
    pub fn radius(&self) -> f64 {
        self.lattice.radius
    }

    /// The sky at each query.
    pub fn samples(&self, queries: &[Query]) -> Vec<SkySample> {
        let directions = sky_directions();
        let depths: Vec<Vec<f32>> = if self.balls.len().saturating_mul(queries.len()) <= MOST_PAIRS {
            directions.par_iter().map(|toward| self.summed_depths(queries, *toward)).collect()
        } else {
            let density = self.lattice.splat(&self.balls);
            let own: Vec<&[Generator]> = queries.par_iter().map(|query| self.group(query.skip)).collect();
            directions.par_iter().map(|toward| self.swept_depths(&density, queries, &own, *toward)).collect()
        };
        let sample = |(index, query): (usize, &Query)| {
            let depths = std::array::from_fn(|d| self.scale * f64::from(depths[d][index]));
            see(&depths, &directions, query.position)
        };
        queries.par_iter().enumerate().map(sample).collect()
    }

    /// Depths toward one direction, before the extinction's scale: chords of all balls.
    fn summed_depths(&self, queries: &[Query], toward: DVec3) -> Vec<f32> {
        let depth = |query: &Query| {
            let place = query.position / self.lattice.radius;
            let others = self.balls.iter().filter(|ball| ball.group != query.skip);
            others.map(|ball| f64::from(ball.weight) * chord(place - ball.position, toward)).sum::<f64>() as f32
        };
        queries.iter().map(depth).collect()
    }

    /// The same from a sweep of the lattice, less the chords of `own`, the balls that each query leaves out.
    fn swept_depths(&self, density: &[f32], queries: &[Query], own: &[&[Generator]], toward: DVec3) -> Vec<f32> {
        let columns = self.lattice.columns(toward);
        let swept = self.lattice.sweep(density, &columns);
        let depth = |(query, own): (&Query, &&[Generator])| {
            let place = query.position / self.lattice.radius;
            let seen = self.lattice.value_toward(&swept, &columns, place, toward);
            let own: f64 = own.iter().map(|b| f64::from(b.weight) * chord(place - b.position, toward)).sum();
            (f64::from(seen) - own).max(0.0) as f32
        };
        queries.iter().zip(own).map(depth).collect()
    }

    /// Own balls of a group.
    fn group(&self, group: u32) -> &[Generator] {
        let own = &self.balls[..self.own];
        let start = own.partition_point(|ball| ball.group < group);
        let count = own[start..].partition_point(|ball| ball.group == group);
        &own[start..start + count]
    }
}
