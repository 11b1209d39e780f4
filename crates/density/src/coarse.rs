//! The density from a lattice (Luft07 eq. 2): samples of it on a few points per radius, joined by a cubic B-spline
//! (Unser 1999). A sum over thousands of balls becomes a look at 64 points.

use crate::Isa;
use crate::field::Query;
use crate::generators::Generator;
use crate::groups::Groups;
use crate::lattice::Lattice;
use rayon::prelude::*;

/// Queries of one task.
const TASK: usize = 2048;

/// Balls on a lattice, ready to be asked.
#[derive(Clone, Debug)]
pub struct Coarse {
    lattice: Lattice,
    coefficients: Vec<f32>,
    groups: Groups,
    radius: f64,
}

impl Coarse {
    /// Samples the density of balls of `radius` meters at `points_per_radius`, which set the error; at fewer
    /// where there would be more than `most` points.
    pub fn new(generators: &[Generator], radius: f64, points_per_radius: f64, most: usize) -> Coarse {
        Coarse::on(generators, radius, points_per_radius, most, Isa::best())
    }

    /// The same on chosen instructions: same bits.
    pub fn on(generators: &[Generator], radius: f64, points_per_radius: f64, most: usize, isa: Isa) -> Coarse {
        let lattice = Lattice::around(generators, radius, points_per_radius, most);
        let coefficients = lattice.coefficients(generators, radius, isa);
        Coarse { lattice, coefficients, groups: Groups::new(generators), radius }
    }

    /// Density at each query: the spline, less the balls of the group that the query leaves out.
    pub fn densities(&self, queries: &[Query]) -> Vec<f32> {
        let task = |queries: &[Query]| {
            let own = self.groups.of_each(queries);
            queries.iter().zip(own).map(|(query, own)| self.density(query, own)).collect::<Vec<f32>>()
        };
        queries.par_chunks(TASK).flat_map_iter(task).collect()
    }

    fn density(&self, query: &Query, own: &[Generator]) -> f32 {
        let place = query.position / self.radius;
        let ball = |ball: &Generator| {
            let inside = (1.0 - (place - ball.position / self.radius).length_squared()).max(0.0);
            f64::from(ball.weight) * inside * inside
        };
        let density = f64::from(self.lattice.spline(&self.coefficients, place)) - own.iter().map(ball).sum::<f64>();
        density.max(0.0) as f32
    }
}
