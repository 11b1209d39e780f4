//! The whole step: wood in, branches and a report of each out.

use super::contact::{Capsules, Ground};
use super::hang::{self, Hanging};
use super::mesh::Mesh;
use super::tube::{self, Graph, Tube};
use super::{BranchParams, BranchReport, Continuation, Found, Method, RootKind};
use crate::StructureError;
use crate::geometry::Geometry;
use foliar_plant::{Axis, Base, Branches, OnBranch, Stalk, Structure};
use rayon::prelude::*;

/// Finds the branches of a plant.
///
/// # Errors
/// [`StructureError`]: a base that breaks an invariant, wood too far from its origin for its coordinates to
/// tell tubes, more than 2^24 branches.
pub fn find(base: &Base, structure: &Structure, params: &BranchParams) -> Result<Found, StructureError> {
    base.check()?;
    let geometry = Geometry::of(base, |part| structure.roles.get(part) == Some(&foliar_schema::Role::Wood));
    super::limits::check_precision(&geometry, &structure.roles)?;
    let mesh = Mesh::new(&geometry, &structure.roles);
    super::limits::check_count(mesh.count())?;
    let tubes = fit(&mesh);
    let ground = Ground::new(&tubes);
    let hangings = {
        let capsules = Capsules::new(&tubes);
        match params.method {
            Method::Robust => hang::hang(&tubes, &capsules, &ground),
            Method::Kusternig07 => super::literal::hang(&mesh, &tubes),
        }
    };
    let kinds: Vec<RootKind> = (0..tubes.len()).map(|t| kind(&tubes[t], &hangings[t], &ground, t)).collect();
    let tubes: Vec<Tube> =
        tubes.into_iter().zip(&hangings).map(|(t, h)| if h.from_tip { t.turned() } else { t }).collect();
    let joined = match (params.continuation, params.method) {
        (Continuation::Merge, Method::Robust) => hang::continuations(&tubes, &hangings),
        _ => vec![None; tubes.len()],
    };
    let runs = Runs::new(&tubes, &hangings, &joined);
    Ok(assemble(&geometry, structure, &mesh, &tubes, &runs, &kinds))
}

/// Fits every piece.
fn fit(mesh: &Mesh) -> Vec<Tube> {
    let one = |piece: usize| {
        let (from, to) = (mesh.starts[piece], mesh.starts[piece + 1]);
        let points = &mesh.points[from.0 as usize..to.0 as usize];
        let graph = Graph::new(points, &mesh.faces[from.1 as usize..to.1 as usize], from.0);
        tube::fit(&graph)
    };
    // A piece has a face and a face has nodes: none is left out.
    (0..mesh.count()).into_par_iter().filter_map(one).collect()
}

fn kind(tube: &Tube, hanging: &Hanging, ground: &Ground, index: usize) -> RootKind {
    match hanging.parent {
        Some(_) => RootKind::Branch,
        None if index as u32 == ground.stem() || ground.is_foot(tube, hanging.from_tip) => RootKind::Stem,
        None => RootKind::Island,
    }
}

/// Tubes that are one branch, each run from its root outward.
struct Runs {
    /// Per run: its tubes in order, and what the first hangs on.
    tubes: Vec<Vec<u32>>,
    hangings: Vec<Hanging>,
    axes: Vec<Axis>,
    /// Per tube: run, and arc length at which it starts.
    of_tube: Vec<(u32, f64)>,
}

impl Runs {
    fn new(tubes: &[Tube], hangings: &[Hanging], joined: &[Option<u32>]) -> Runs {
        let mut next: Vec<Option<u32>> = vec![None; tubes.len()];
        joined.iter().enumerate().for_each(|(child, parent)| {
            if let Some(parent) = parent {
                next[*parent as usize] = Some(child as u32);
            }
        });
        let mut runs =
            Runs { tubes: Vec::new(), hangings: Vec::new(), axes: Vec::new(), of_tube: vec![(0, 0.0); tubes.len()] };
        for first in (0..tubes.len() as u32).filter(|&t| joined[t as usize].is_none()) {
            let list: Vec<u32> = std::iter::successors(Some(first), |&t| next[t as usize]).collect();
            runs.push(tubes, list, hangings[first as usize]);
        }
        runs
    }

    fn push(&mut self, tubes: &[Tube], list: Vec<u32>, hanging: Hanging) {
        let run = self.tubes.len() as u32;
        let (mut points, mut radii) = (Vec::new(), Vec::new());
        let mut starts = Vec::with_capacity(list.len());
        for &tube in &list {
            let axis = &tubes[tube as usize].axis;
            starts.push(points.len());
            points.extend(&axis.points);
            radii.extend(&axis.radii);
        }
        let axis = Axis::new(points, radii);
        for (&tube, start) in list.iter().zip(starts) {
            self.of_tube[tube as usize] = (run, axis.arcs[start]);
        }
        self.tubes.push(list);
        self.hangings.push(hanging);
        self.axes.push(axis);
    }
}

fn assemble(
    geometry: &Geometry,
    structure: &Structure,
    mesh: &Mesh,
    tubes: &[Tube],
    runs: &Runs,
    kinds: &[RootKind],
) -> Found {
    let stalk = |run: usize| Stalk {
        parent: runs.hangings[run].parent.map(|tube| runs.of_tube[tube as usize].0),
        axis: {
            let axis = &runs.axes[run];
            Axis { points: axis.points.iter().map(|p| *p + geometry.center).collect(), ..axis.clone() }
        },
        margin: runs.hangings[run].margin,
        first_vertex: runs.tubes[run].iter().map(|&t| mesh.first_vertex[t as usize]).min().unwrap_or(0),
    };
    let (mut branches, ids) = Branches::grow((0..runs.tubes.len()).map(stalk).collect());
    branches.vertices = vertices(mesh, tubes, runs, &ids);
    branches.leaves = super::bind::leaves(&branches, geometry.base, structure, geometry);
    let mut reports: Vec<BranchReport> = vec![BranchReport::default(); ids.len()];
    for (run, &id) in ids.iter().enumerate() {
        let (list, hanging) = (&runs.tubes[run], &runs.hangings[run]);
        let worst = |get: fn(&Tube) -> f64| list.iter().map(|&t| get(&tubes[t as usize])).fold(0.0, f64::max);
        reports[id as usize] = BranchReport {
            kind: kinds[list[0] as usize],
            cost: hanging.cost,
            margin: hanging.margin,
            gap: hanging.gap,
            roughness: worst(|t| t.roughness),
            split: worst(|t| t.split),
            tubes: list.len() as u32,
        };
    }
    Found { branches, reports }
}

/// Branch and arc length of every vertex of wood.
fn vertices(mesh: &Mesh, tubes: &[Tube], runs: &Runs, ids: &[u32]) -> Vec<Vec<OnBranch>> {
    let starts: Vec<u32> = mesh.starts.iter().map(|s| s.0).collect();
    let mut places = vec![OnBranch::NONE; mesh.points.len()];
    for (piece, tube) in tubes.iter().enumerate() {
        let (run, start) = runs.of_tube[piece];
        for (place, arc) in places[starts[piece] as usize..].iter_mut().zip(&tube.arcs) {
            *place = OnBranch { branch: ids[run as usize], arc: (start + arc) as f32 };
        }
    }
    let of = |&node: &u32| places.get(node as usize).copied().unwrap_or(OnBranch::NONE);
    mesh.nodes.iter().map(|list| list.iter().map(of).collect()).collect()
}
