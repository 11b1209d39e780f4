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
mod refine;
mod splat;
mod table;
#[cfg(test)]
mod tests;

use crate::{Field, Generator, NO_GROUP, Query};
use blocks::{Lattice, TooMuch, touched};
pub(crate) use dense::dense;
pub use error::SurfaceError;
use glam::{DVec3, Vec3};
use march::{Blocks, Crossing, Guess, March};
pub use mesh::{MeshFaults, Piece, check_mesh, pieces};
pub use nearest::{Foot, nearest};
use rayon::prelude::*;
pub use refine::TOLERANCE;
use refine::{Frame, Vertices};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use splat::Splatter;

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
/// Bytes per vertex while a mesh is made: positions, normals, two triangles; crossing, search and query.
const VERTEX_BYTES: f64 = 48.0 + 160.0;
/// Bytes of a block that the surface passes through, with its share of vertices: what a proposed cell is judged by.
const FULL_BLOCK_BYTES: f64 = 24e3;
/// Bytes of a block that a ball reaches, before anything is known of it.
const TOUCHED_BYTES: f64 = 64.0;
const MEGABYTE: f64 = 1e6;

/// Meshes the surface on which the density of `balls`, which `field` knows, is their threshold. No vertices
/// where the density stays below it everywhere.
///
/// # Errors
/// [`SurfaceError`] for parameters out of range and for cells too small for the memory allowed.
pub fn extract(field: &impl DensityField, balls: &Balls, params: &SurfaceParams) -> Result<Surface, SurfaceError> {
    extract_on(field, balls, params, Splatter::best())
}

/// [`extract`] on the fast field.
///
/// # Errors
/// As [`extract`].
pub fn extract_fast(balls: &Balls, params: &SurfaceParams) -> Result<Surface, SurfaceError> {
    SurfaceError::check(balls, params)?;
    extract(&Field::new(balls.generators, balls.radius_m), balls, params)
}

fn extract_on(
    field: &impl DensityField,
    balls: &Balls,
    params: &SurfaceParams,
    splatter: Splatter,
) -> Result<Surface, SurfaceError> {
    SurfaceError::check(balls, params)?;
    let cell = params.cell_m.unwrap_or(balls.radius_m / CELLS_PER_RADIUS);
    let origin = middle(balls.generators);
    let generators: Vec<Generator> =
        balls.generators.iter().map(|g| Generator { position: g.position - origin, ..*g }).collect();
    let frame = Frame { origin, cell, tau: balls.threshold };
    let budget = params.memory_mb * MEGABYTE;
    let refined = params.refinement == Refinement::Newton;
    let guess = if refined { Guess::Cubic } else { Guess::Linear };
    let (crossings, triangles) =
        march(&generators, balls.radius_m, frame, budget, (splatter, guess)).map_err(|TooMuch| {
            let fits = fitting_cell(&generators, balls.radius_m, cell, budget);
            SurfaceError::Memory { cell_m: cell, memory_mb: params.memory_mb, fits }
        })?;
    let vertices = Vertices::new(field, &crossings, frame, refined);
    let Vertices { positions, normals, residual } = vertices;
    Ok(Surface { origin, positions, normals, triangles, cell_m: cell, residual })
}

/// Everything but the vertices' places.
fn march(
    generators: &[Generator],
    radius: f64,
    frame: Frame,
    budget: f64,
    tools: (Splatter, Guess),
) -> Result<(Vec<Crossing>, Vec<[u32; 3]>), TooMuch> {
    let codes = touched(generators, radius, frame.cell, (budget / TOUCHED_BYTES) as usize)?;
    let lattice = Lattice::new(generators, radius, frame.cell, frame.tau, tools.0);
    let states = lattice.classify(&codes, budget as usize)?;
    let blocks = Blocks { codes: &codes, states: &states };
    let march = March::new(blocks);
    let vertices = march.vertex_count();
    if vertices == u32::MAX || f64::from(vertices) * VERTEX_BYTES > budget {
        return Err(TooMuch);
    }
    Ok((march.crossings(&lattice, blocks, frame.tau, tools.1), march.triangles()))
}

/// The smallest of the cells twice, four times ... as large whose mesh surely fits, up to the radius.
fn fitting_cell(generators: &[Generator], radius: f64, cell: f64, budget: f64) -> Option<f64> {
    let most = (budget / FULL_BLOCK_BYTES) as usize;
    let fits = |cell: &f64| touched(generators, radius, *cell, most).is_ok();
    std::iter::successors(Some(2.0 * cell), |cell| Some(2.0 * cell)).take_while(|&cell| cell <= radius).find(fits)
}

/// Middle of the box around the balls.
fn middle(generators: &[Generator]) -> DVec3 {
    let box_of = |(low, high): (DVec3, DVec3), g: &Generator| (low.min(g.position), high.max(g.position));
    let (low, high) = generators.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), box_of);
    if generators.is_empty() { DVec3::ZERO } else { low.midpoint(high) }
}
