//! From crossed lattice edges to vertices: Newton steps along each edge, kept between its ends.
//!
//! A vertex never leaves its edge. So no triangle leaves its cell, and the mesh cannot fold or cut
//! itself, wherever the steps lead.

use super::march::Crossing;
use super::{DensityField, Probe};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Largest |S / tau - 1| of a vertex that is not refined further.
pub const TOLERANCE: f64 = 1e-4;
/// A stretch of an edge that is not divided further: f32 positions could not tell its ends apart.
const SHORTEST: f64 = 1.0 / (1 << 22) as f64;
/// A step that leaves more than this share of the miss is followed by a bisection: Newton steps crawl
/// where the field is nearly flat.
const SLOW: f64 = 0.5;
/// Enough steps to reach [`SHORTEST`] if every other one bisects.
const MOST_STEPS: usize = 48;

/// Vertices on the surface.
#[derive(Clone, Debug, Default)]
pub(super) struct Vertices {
    /// Meters from the surface's origin.
    pub positions: Vec<Vec3>,
    /// Unit, toward lower density.
    pub normals: Vec<Vec3>,
    /// Largest |S / tau - 1|.
    pub residual: f64,
}

/// Where the lattice lies, and the value looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub origin: DVec3,
    pub cell: f64,
    pub tau: f64,
}

/// An edge whose vertex is still looked for: `at` is the next place to try, between the bounds.
struct Search {
    index: u32,
    at: f64,
    inside: f64,
    outside: f64,
    best: f64,
}

impl Frame {
    /// Position from the origin, as it is stored.
    fn position(&self, crossing: &Crossing, at: f64) -> Vec3 {
        let mut corner = crossing.corner.as_dvec3();
        corner[crossing.axis] += at;
        (corner * self.cell).as_vec3()
    }
}

impl Vertices {
    /// Vertices at the crossings; unless `refined`, where linear interpolation puts them.
    pub fn new(field: &impl DensityField, crossings: &[Crossing], frame: Frame, refined: bool) -> Vertices {
        let mut vertices = Vertices {
            positions: vec![Vec3::ZERO; crossings.len()],
            normals: vec![Vec3::ZERO; crossings.len()],
            residual: 0.0,
        };
        let mut searches: Vec<Search> = crossings.iter().enumerate().map(Search::new).collect();
        for _ in 0..=MOST_STEPS {
            vertices.advance(field, crossings, frame, &mut searches);
            if searches.is_empty() || !refined {
                break;
            }
        }
        vertices.residual = searches.iter().map(|s| s.best).fold(vertices.residual, f64::max);
        vertices
    }

    /// One step of all searches; those that have arrived are dropped.
    fn advance(&mut self, field: &impl DensityField, crossings: &[Crossing], frame: Frame, searches: &mut Vec<Search>) {
        let at = |s: &Search| frame.position(&crossings[s.index as usize], s.at);
        let positions: Vec<Vec3> = searches.par_iter().map(at).collect();
        let places: Vec<DVec3> = positions.par_iter().map(|p| p.as_dvec3() + frame.origin).collect();
        let probes = field.probe(&places);
        for ((search, position), probe) in searches.iter_mut().zip(&positions).zip(&probes) {
            let crossing = &crossings[search.index as usize];
            let miss = ((probe.density - frame.tau) / frame.tau).abs();
            let slow = miss > SLOW * search.best;
            if miss < search.best {
                search.best = miss;
                self.positions[search.index as usize] = *position;
                self.normals[search.index as usize] = normal(crossing, probe);
            }
            search.step(crossing, probe, frame, slow);
        }
        let residual = &mut self.residual;
        searches.retain(|search| {
            let open = search.best > TOLERANCE && (search.inside - search.outside).abs() > SHORTEST;
            *residual = if open { *residual } else { residual.max(search.best) };
            open
        });
    }
}

/// Outward normal; where the gradient vanishes, along the edge.
fn normal(crossing: &Crossing, probe: &Probe) -> Vec3 {
    let along = Vec3::AXES[crossing.axis] * if crossing.inside_first { 1.0 } else { -1.0 };
    downhill(probe.gradient).unwrap_or(along)
}

/// Unit vector against a gradient of any size, if it has one.
pub(super) fn downhill(gradient: DVec3) -> Option<Vec3> {
    let steepest = gradient.abs().max_element();
    (steepest > 0.0 && steepest.is_finite()).then(|| (-gradient / steepest).normalize().as_vec3())
}

impl Search {
    fn new((index, crossing): (usize, &Crossing)) -> Search {
        let (inside, outside) = if crossing.inside_first { (0.0, 1.0) } else { (1.0, 0.0) };
        Search { index: index as u32, at: f64::from(crossing.at), inside, outside, best: f64::INFINITY }
    }

    /// Takes what was found at `at` as a new bound, and chooses the next place: Newton's where it lies between
    /// the bounds and the last step helped, else their middle.
    fn step(&mut self, crossing: &Crossing, probe: &Probe, frame: Frame, slow: bool) {
        if probe.density >= frame.tau {
            self.inside = self.at;
        } else {
            self.outside = self.at;
        }
        let slope = probe.gradient[crossing.axis] * frame.cell;
        let newton = self.at - (probe.density - frame.tau) / slope;
        let (low, high) = (self.inside.min(self.outside), self.inside.max(self.outside));
        let within = newton > low && newton < high;
        self.at = if within && !slow { newton } else { low.midpoint(high) };
    }
}
