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

/// A crown and its neighbors as absorbing media, ready to be asked.
#[derive(Debug)]
pub struct Sky {
    crown: Medium,
    /// Each with a lattice of its own: how finely the crown is seen does not depend on what stands around it.
    neighbors: Vec<Medium>,
    /// Optical depth of one unit of the crown's chords.
    scale: f64,
}

impl Sky {
    /// Prepares a crown. `points_per_radius` of the lattice set the error.
    pub fn new(foliage: &Foliage, points_per_radius: f64) -> Sky {
        let medium = |balls: &[Generator]| Medium::new(balls, foliage.radius, points_per_radius);
        let (crown, neighbors) = (medium(foliage.own()), foliage.stands().map(medium).collect());
        let scale = extinction(foliage.mean_area, crown.lattice.radius);
        Sky { crown, neighbors, scale }
    }

    /// Radius of the balls of the crown's medium, meters: the radius of influence, or more where the lattice
    /// would take too much memory.
    pub fn radius(&self) -> f64 {
        self.crown.lattice.radius
    }

    /// The sky at each query.
    pub fn samples(&self, queries: &[Query]) -> Vec<SkySample> {
        let directions = sky_directions();
        let mut depths = vec![vec![0.0f32; queries.len()]; directions.len()];
        self.crown.add_depths(&directions, queries, 1.0, &mut depths);
        for neighbor in &self.neighbors {
            // Extinction goes with one over the square of the radius.
            let share = (self.radius() / neighbor.lattice.radius).powi(2) as f32;
            neighbor.add_depths(&directions, queries, share, &mut depths);
        }
        let sample = |(index, query): (usize, &Query)| {
            let depths = std::array::from_fn(|d| self.scale * f64::from(depths[d][index]));
            see(&depths, &directions, query.position)
        };
        queries.par_iter().enumerate().map(sample).collect()
    }
}

/// The balls of one plant.
#[derive(Debug)]
struct Medium {
    lattice: Lattice,
    /// In radii of the medium, sorted by group.
    balls: Vec<Generator>,
}

impl Medium {
    fn new(balls: &[Generator], radius: f64, points_per_radius: f64) -> Medium {
        let lattice = Lattice::around(balls, radius, points_per_radius, MOST_POINTS);
        let mut balls = balls.to_vec();
        balls.iter_mut().for_each(|ball| ball.position /= lattice.radius);
        balls.sort_by_key(|ball| ball.group);
        Medium { lattice, balls }
    }

    /// Adds the depths toward each direction, times `share`, to what is there.
    fn add_depths(&self, directions: &[DVec3], queries: &[Query], share: f32, depths: &mut [Vec<f32>]) {
        let add = |all: &mut Vec<f32>, more: Vec<f32>| {
            all.iter_mut().zip(more).for_each(|(sum, depth)| *sum += share * depth);
        };
        let pairs = depths.par_iter_mut().zip(directions);
        if self.balls.len().saturating_mul(queries.len()) <= MOST_PAIRS {
            pairs.for_each(|(all, toward)| add(all, self.summed_depths(queries, *toward)));
        } else {
            let density = self.lattice.splat(&self.balls);
            let own: Vec<&[Generator]> = queries.par_iter().map(|query| self.group(query.skip)).collect();
            pairs.for_each(|(all, toward)| add(all, self.swept_depths(&density, queries, &own, *toward)));
        }
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

    /// The balls of a group.
    fn group(&self, group: u32) -> &[Generator] {
        let start = self.balls.partition_point(|ball| ball.group < group);
        let count = self.balls[start..].partition_point(|ball| ball.group == group);
        &self.balls[start..start + count]
    }
}
