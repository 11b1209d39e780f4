//! What each place sees of the sky, through the foliage taken for an absorbing medium: extinction on a
//! grid, one sweep of the grid for each direction, lookups by trilinear interpolation.
//!
//! Evaluated once for each leaf, so that a leaf's corners agree: realigned normals that point outward all
//! round a crown must break somewhere, and this way never inside a leaf.

use crate::directions::{DIRECTIONS, sky_directions};
use crate::field::Query;
use crate::generators::{Foliage, Generator};
use crate::lattice::Lattice;
use crate::medium::{SkySample, chord, extinction, see};
use glam::DVec3;
use rayon::prelude::*;

/// Lattice points per radius of influence.
const POINTS_PER_RADIUS: f64 = 2.0;
/// Most lattice points: 32 depths of 4 bytes each make 34 MB.
const MOST_POINTS: usize = 1 << 18;

/// Optical depths of a crown, ready to be asked.
#[derive(Debug)]
pub struct Sky {
    lattice: Lattice,
    directions: [DVec3; DIRECTIONS],
    /// Direction after direction: depth from each lattice point to the open sky.
    depths: Vec<f32>,
    /// Balls by group, in radii: what a query leaves out.
    own: Vec<Generator>,
    scale: f64,
}

impl Sky {
    /// Sweeps the lattice.
    pub fn new(foliage: &Foliage) -> Sky {
        let lattice = Lattice::around(&foliage.generators, foliage.radius, POINTS_PER_RADIUS, MOST_POINTS);
        let scale = extinction(foliage.mean_area, lattice.radius);
        let mut balls = foliage.generators.clone();
        balls.iter_mut().for_each(|ball| ball.position /= lattice.radius);
        let density = lattice.splat(&balls);
        let directions = sky_directions();
        let mut depths = vec![0.0f32; density.len() * DIRECTIONS];
        // A factor of the extinction may be beyond f32 for a moment; depths are taken in balls and scaled last.
        depths
            .par_chunks_mut(density.len().max(1))
            .zip(directions)
            .for_each(|(depths, direction)| lattice.sweep(&density, direction, depths));
        let mut own = balls[..foliage.own].to_vec();
        own.sort_by_key(|ball| ball.group);
        Sky { lattice, directions, depths, own, scale }
    }

    /// Radius of the balls of the medium, meters: the radius of influence, or twice the lattice's step
    /// where memory forbids a finer one.
    pub fn radius(&self) -> f64 {
        self.lattice.radius
    }

    /// The sky at each query.
    pub fn samples(&self, queries: &[Query]) -> Vec<SkySample> {
        queries.par_iter().map(|query| self.sample(query)).collect()
    }

    fn sample(&self, query: &Query) -> SkySample {
        let place = query.position / self.lattice.radius;
        let start = self.own.partition_point(|ball| ball.group < query.skip);
        let own = || self.own[start..].iter().take_while(|ball| ball.group == query.skip);
        let points = self.lattice.len();
        let inside = self.lattice.stencil(place);
        let mut depths = [0.0f64; DIRECTIONS];
        for (index, toward) in self.directions.iter().enumerate() {
            let stencil = match &inside {
                Some(stencil) => Some(*stencil),
                None => self.lattice.entry(place, *toward).and_then(|entry| self.lattice.stencil(entry)),
            };
            let plane = &self.depths[index * points..(index + 1) * points];
            let seen = stencil.map_or(0.0, |s| s.value(plane));
            let own: f64 = own().map(|b| f64::from(b.weight) * chord(place - b.position, *toward)).sum();
            depths[index] = self.scale * (f64::from(seen) - own).max(0.0);
        }
        see(&depths, &self.directions, query.position)
    }
}
