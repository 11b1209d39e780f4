//! The implicit surface of the density (Luft07 eq. 3), as a closed triangle mesh, and normals from it.
//!
//! Marching cubes (Lorensen and Cline 1987) over a sparse lattice, in five steps: the blocks that balls
//! reach (`blocks`), density at their corners (`splat`), cells and triangles (`march`, `table`),
//! vertices on the surface itself (`refine`). Lists of blocks are in Morton order, so every step
//! gives the same bytes for any number of threads.

mod bins;
mod blocks;
mod dense;
mod error;

mod march;
mod mesh;
mod nearest;
mod probe;
mod refine;
mod splat;
mod table;
#[cfg(test)]
mod tests;

use crate::{Field, Generator, Isa, NO_GROUP, Query};
use blocks::{Lattice, TooMuch, bytes, touched};
pub(crate) use dense::dense;
pub use error::SurfaceError;
use glam::{DVec3, Vec3};
use march::{Blocks, Guess, March};
pub use mesh::{MeshFaults, Piece, check_mesh, pieces};
pub use nearest::{Foot, nearest};
use probe::{Nearby, Prober, Whole};
use rayon::prelude::*;
pub use refine::TOLERANCE;
use refine::{Frame, Vertices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Density and its gradient at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Probe {
    /// S of Luft07 eq. 2, with weights.
    pub density: f64,
    /// Its gradient, 1/m.
    pub gradient: DVec3,
}

/// Something that knows the density anywhere.
pub trait DensityField: Sync {
    /// Density and gradient at places in meters, relative to the plant's center.
    fn probe(&self, places: &[DVec3]) -> Vec<Probe>;
}

impl DensityField for Field {
    fn probe(&self, places: &[DVec3]) -> Vec<Probe> {
        let queries: Vec<Query> = places.par_iter().map(|&position| Query { position, skip: NO_GROUP }).collect();
        let exact = |s: &crate::Sample| Probe { density: f64::from(s.density), gradient: s.gradient.as_dvec3() };
        self.samples(&queries).par_iter().map(exact).collect()
    }
}

/// Where vertices are put.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Refinement {
    /// On the surface itself, by Newton steps.
    #[default]
    Newton,
    /// Where linear interpolation between lattice corners puts them.
    Linear,
}

/// How a surface is meshed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SurfaceParams {
    /// Edge of a cell, meters; nothing said: a quarter of the radius of influence.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub cell_m: Option<f64>,
    /// Where vertices are put.
    pub refinement: Refinement,
    /// Most memory that the mesh and its making may take, megabytes.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub memory_mb: f64,
}

impl Default for SurfaceParams {
    fn default() -> Self {
        SurfaceParams { cell_m: None, refinement: Refinement::default(), memory_mb: 4096.0 }
    }
}

/// What a surface is drawn around.
#[derive(Clone, Copy, Debug)]
pub struct Balls<'a> {
    /// The balls, relative to the plant's center.
    pub generators: &'a [Generator],
    /// Their radius of influence, meters (rho of Luft07 eq. 2).
    pub radius_m: f64,
    /// Density at the surface (tau of Luft07 eq. 3).
    pub threshold: f64,
}

/// A closed triangle mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Origin of its positions, meters, relative to the plant's center.
    pub origin: DVec3,
    /// Vertices, meters.
    pub positions: Vec<Vec3>,
    /// Unit normals, against the gradient of the density.
    pub normals: Vec<Vec3>,
    /// Vertices of each triangle, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Edge of its cells, meters.
    pub cell_m: f64,
    /// Largest |S / threshold - 1| at a vertex.
    pub residual: f64,
}

/// Cells per radius where nothing is said.
const CELLS_PER_RADIUS: f64 = 4.0;
/// Bytes per vertex while a mesh is made: position, normal, and two triangles.
const VERTEX_BYTES: usize = 24 + 24;
/// Bytes of a block that the surface passes through, with its share of vertices: what a proposed cell is judged by.
const FULL_BLOCK_BYTES: usize = 24_000;
/// Bytes of a block that a ball reaches, before anything is known of it.
const TOUCHED_BYTES: usize = 64;
const MEGABYTE: f64 = 1e6;

/// Meshes the surface on which the density of `balls` is their threshold; vertices by the same balls in `field`.
/// No vertices where the density stays below it everywhere.
///
/// # Errors
/// [`SurfaceError`] for parameters out of range and for cells too small for the memory allowed.
pub fn extract(field: &impl DensityField, balls: &Balls, params: &SurfaceParams) -> Result<Surface, SurfaceError> {
    SurfaceError::check(balls, params)?;
    let mesher = Mesher::new(balls, params, Isa::best());
    let made = mesher.and_then(|m| m.mesh(|| Whole { field, origin: m.frame.origin }));
    made.map_err(|TooMuch| refusal(balls, params))
}

/// [`extract`] by the balls near each block, summed in f32.
///
/// # Errors
/// As [`extract`].
pub fn extract_fast(balls: &Balls, params: &SurfaceParams) -> Result<Surface, SurfaceError> {
    extract_on(balls, params, Isa::best())
}

fn extract_on(balls: &Balls, params: &SurfaceParams, isa: Isa) -> Result<Surface, SurfaceError> {
    SurfaceError::check(balls, params)?;
    let made = Mesher::new(balls, params, isa).and_then(|m| m.mesh(|| Nearby::new(&m.lattice)));
    made.map_err(|TooMuch| refusal(balls, params))
}

/// Balls in a lattice, ready to be meshed.
struct Mesher {
    lattice: Lattice,
    codes: Vec<u64>,
    frame: Frame,
    guess: Guess,
    /// Bytes.
    budget: usize,
}

impl Mesher {
    fn new(balls: &Balls, params: &SurfaceParams, isa: Isa) -> Result<Mesher, TooMuch> {
        let (radius, origin, cell) = (balls.radius_m, middle(balls.generators), params.cell(balls.radius_m));
        let generators = relative(balls.generators, origin);
        let budget = (params.memory_mb * MEGABYTE) as usize;
        let codes = touched(&generators, radius, cell, budget / TOUCHED_BYTES)?;
        let lattice = Lattice::new(&generators, radius, cell, balls.threshold, isa);
        let guess = if params.refinement == Refinement::Newton { Guess::Cubic } else { Guess::Linear };
        Ok(Mesher { lattice, codes, frame: Frame { origin, cell, tau: balls.threshold }, guess, budget })
    }

    /// The mesh, its vertices by probers that `make` makes, one for each thread.
    fn mesh<P: Prober>(&self, make: impl Fn() -> P + Sync + Send) -> Result<Surface, TooMuch> {
        let states = self.lattice.classify(&self.codes, self.budget)?;
        let blocks = Blocks { codes: &self.codes, states: &states };
        let march = March::new(blocks);
        let count = march.vertex_count();
        let needed = (count as usize).saturating_mul(VERTEX_BYTES).saturating_add(bytes(&states));
        if count == u32::MAX || needed > self.budget {
            return Err(TooMuch);
        }
        let density = |code| blocks.density(code);
        let Vertices { positions, normals, residual } = Vertices::new(&march, &density, (self.frame, self.guess), make);
        drop(states);
        let triangles = march.triangles();
        let Frame { origin, cell, .. } = self.frame;
        Ok(Surface { origin, positions, normals, triangles, cell_m: cell, residual })
    }
}

impl SurfaceParams {
    /// Edge of a cell around balls of some radius, meters.
    fn cell(&self, radius: f64) -> f64 {
        self.cell_m.unwrap_or(radius / CELLS_PER_RADIUS)
    }
}

/// Balls relative to another origin.
fn relative(generators: &[Generator], origin: DVec3) -> Vec<Generator> {
    generators.iter().map(|g| Generator { position: g.position - origin, ..*g }).collect()
}

/// What is said where memory does not do: the smallest of the cells twice, four times ... as large whose mesh surely
/// fits, up to the radius.
fn refusal(balls: &Balls, params: &SurfaceParams) -> SurfaceError {
    let (radius, cell, memory_mb) = (balls.radius_m, params.cell(balls.radius_m), params.memory_mb);
    let generators = relative(balls.generators, middle(balls.generators));
    let most = (memory_mb * MEGABYTE) as usize / FULL_BLOCK_BYTES;
    let fits = |cell: &f64| touched(&generators, radius, *cell, most).is_ok();
    let larger = std::iter::successors(Some(2.0 * cell), |cell| Some(2.0 * cell)).take_while(|&cell| cell <= radius);
    SurfaceError::Memory { cell_m: cell, memory_mb, fits: { larger }.find(fits) }
}

/// Middle of the box around the balls.
fn middle(generators: &[Generator]) -> DVec3 {
    let box_of = |(low, high): (DVec3, DVec3), g: &Generator| (low.min(g.position), high.max(g.position));
    let (low, high) = generators.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), box_of);
    if generators.is_empty() { DVec3::ZERO } else { low.midpoint(high) }
}
