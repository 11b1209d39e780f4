//! Who tells density and gradient at places in a block, while its vertices are sought.

use super::bins::Run;
use super::blocks::{Lattice, block};
use super::splat::{LANES, Lanes, Spot, probe};
use super::{DensityField, Probe};
use glam::{DVec3, Vec3};

/// Something that is asked block by block.
pub(super) trait Prober {
    /// The next questions are about places in the cells of the block of this code.
    fn enter(&mut self, code: u64);
    /// Density and gradient at places in meters from the surface's origin.
    fn probe(&mut self, places: &[Vec3], found: &mut Vec<Probe>);
}

/// A field that knows everything at once.
pub(super) struct Whole<'a, F> {
    /// The field.
    pub field: &'a F,
    /// Origin of the surface, meters from the plant's center.
    pub origin: DVec3,
}

impl<F: DensityField> Prober for Whole<'_, F> {
    fn enter(&mut self, _: u64) {}

    fn probe(&mut self, places: &[Vec3], found: &mut Vec<Probe>) {
        let places: Vec<DVec3> = places.iter().map(|p| p.as_dvec3() + self.origin).collect();
        *found = self.field.probe(&places);
    }
}

/// The balls of a lattice near one block: gathered once, asked at every step. A place's bits do not depend on
/// what else is asked, nor on the instructions.
pub(super) struct Nearby<'a> {
    lattice: &'a Lattice,
    runs: Vec<Run>,
    spots: Vec<Spot>,
    middle: DVec3,
}

impl<'a> Nearby<'a> {
    /// Asks the balls of `lattice`.
    pub fn new(lattice: &'a Lattice) -> Self {
        Nearby { lattice, runs: Vec::new(), spots: Vec::new(), middle: DVec3::ZERO }
    }
}

impl Prober for Nearby<'_> {
    fn enter(&mut self, code: u64) {
        self.middle = self.lattice.around(block(code), &mut self.runs, &mut self.spots);
    }

    fn probe(&mut self, places: &[Vec3], found: &mut Vec<Probe>) {
        found.clear();
        let inverse = 1.0 / self.lattice.radius();
        let slope = -4.0 * inverse;
        for places in places.chunks(LANES) {
            let mut lanes = Lanes::default();
            for (lane, place) in places.iter().enumerate() {
                let local = (place.as_dvec3() * inverse - self.middle).as_vec3();
                for axis in 0..3 {
                    lanes.place[axis][lane] = local[axis];
                }
            }
            let sums = probe(self.lattice.isa(), &self.spots, &lanes);
            found.extend((0..places.len()).map(|lane| Probe {
                density: f64::from(sums.density[lane]),
                gradient: DVec3::from_array(sums.gradient.map(|g| f64::from(g[lane]))) * slope,
            }));
        }
    }
}
