//! From crossed lattice edges to vertices: Newton steps along each edge, kept between its ends, block by
//! block.
//!
//! A vertex never leaves its edge. So no triangle leaves its cell, and the mesh cannot fold or cut
//! itself, wherever the steps lead.

use super::Probe;
use super::march::{Corner, Crossing, Guess, March, Marched, TASK, shares, zero_between};
use super::probe::Prober;
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

/// Blocks of one task and where their vertices go.
struct Task<'a> {
    blocks: &'a [Marched],
    positions: &'a mut [Vec3],
    normals: &'a mut [Vec3],
}

impl Vertices {
    /// Vertices at all crossings of a march, in its order. `make` makes the prober of a thread.
    pub fn new<P: Prober>(
        march: &March,
        density: &Corner,
        (frame, guess): (Frame, Guess),
        make: impl Fn() -> P + Sync + Send,
    ) -> Vertices {
        let count = march.vertex_count() as usize;
        let (mut positions, mut normals) = (vec![Vec3::ZERO; count], vec![Vec3::ZERO; count]);
        let sizes = || march.blocks().chunks(TASK).map(|blocks| blocks.iter().map(Marched::vertices).sum());
        let places = shares(&mut positions, sizes()).into_iter().zip(shares(&mut normals, sizes()));
        let task = |(blocks, (positions, normals))| Task { blocks, positions, normals };
        let tasks: Vec<Task> = march.blocks().chunks(TASK).zip(places).map(task).collect();
        let work = |(prober, searcher): &mut (P, Searcher), task: Task| {
            let (mut first, mut residual) = (0, 0.0f64);
            for block in task.blocks {
                block.crossings(density, frame.tau, guess, &mut searcher.crossings);
                let range = first..first + searcher.crossings.len();
                first = range.end;
                prober.enter(block.code());
                let (positions, normals) = (&mut task.positions[range.clone()], &mut task.normals[range]);
                residual = residual.max(searcher.block(prober, frame, guess, positions, normals));
            }
            residual
        };
        let residuals = tasks.into_par_iter().map_init(|| (make(), Searcher::default()), work);
        let residual = residuals.reduce(|| 0.0, f64::max);
        Vertices { positions, normals, residual }
    }
}

/// The searches of one block; buffers of one thread.
#[derive(Default)]
struct Searcher {
    crossings: Vec<Crossing>,
    searches: Vec<Search>,
    places: Vec<Vec3>,
    probes: Vec<Probe>,
}

impl Searcher {
    /// Steps until all have arrived; once where the guess is all that was asked for. The largest |S / tau - 1|.
    fn block(
        &mut self,
        prober: &mut impl Prober,
        frame: Frame,
        guess: Guess,
        positions: &mut [Vec3],
        normals: &mut [Vec3],
    ) -> f64 {
        self.complete(prober, frame);
        self.searches.clear();
        self.searches.extend(self.crossings.iter().enumerate().map(Search::new));
        let mut residual = 0.0;
        for _ in 0..=MOST_STEPS {
            self.advance(prober, frame, positions, normals);
            self.searches.retain(|search| {
                let open = search.best > TOLERANCE && (search.inside - search.outside).abs() > SHORTEST;
                residual = if open { residual } else { search.best.max(residual) };
                open
            });
            if self.searches.is_empty() || guess == Guess::Linear {
                break;
            }
        }
        self.searches.iter().map(|s| s.best).fold(residual, f64::max)
    }

    /// Interpolates along edges whose ends lie where no densities were kept.
    fn complete(&mut self, prober: &mut impl Prober, frame: Frame) {
        let missing = self.crossings.iter().filter(|crossing| crossing.at.is_none());
        self.places.clear();
        self.places.extend(missing.flat_map(|c| [frame.position(c, 0.0), frame.position(c, 1.0)]));
        if self.places.is_empty() {
            return;
        }
        prober.probe(&self.places, &mut self.probes);
        let missing = self.crossings.iter_mut().filter(|crossing| crossing.at.is_none());
        for (crossing, ends) in missing.zip(self.probes.chunks_exact(2)) {
            crossing.at = Some(zero_between([ends[0].density - frame.tau, ends[1].density - frame.tau]));
        }
    }

    /// One step of all searches.
    fn advance(&mut self, prober: &mut impl Prober, frame: Frame, positions: &mut [Vec3], normals: &mut [Vec3]) {
        let crossings = &self.crossings;
        self.places.clear();
        self.places.extend(self.searches.iter().map(|s| frame.position(&crossings[s.index as usize], s.at)));
        prober.probe(&self.places, &mut self.probes);
        for ((search, position), probe) in self.searches.iter_mut().zip(&self.places).zip(&self.probes) {
            let crossing = &crossings[search.index as usize];
            let miss = ((probe.density - frame.tau) / frame.tau).abs();
            let slow = miss > SLOW * search.best;
            if miss < search.best {
                search.best = miss;
                positions[search.index as usize] = *position;
                normals[search.index as usize] = normal(crossing, probe);
            }
            search.step(crossing, probe, frame, slow);
        }
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
        Search { index: index as u32, at: crossing.at.unwrap_or(0.5), inside, outside, best: f64::INFINITY }
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
