//! The whole step: wood in, branches and a report of each out.

use super::contact::{Capsules, Ground};
use super::hang::{self, Hanging};
use super::mesh::Mesh;
use super::tube::{self, Graph, Tube};
use super::{BranchParams, BranchReport, Continuation, Found, Method, RootKind, fused};
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
    let Pieces { tubes, nodes, forks, first_vertex } = fit(&mesh, params.method);
    let ground = Ground::new(&tubes);
    let hangings = {
        let capsules = Capsules::new(&tubes);
        match params.method {
            Method::Robust | Method::Fused => hang::hang(&tubes, &forks, &capsules, &ground),
            Method::Kusternig07 => super::literal::hang(&mesh, &tubes),
        }
    };
    let kinds: Vec<RootKind> = (0..tubes.len()).map(|t| kind(&tubes[t], &hangings[t], &ground, t)).collect();
    let tubes: Vec<Tube> =
        tubes.into_iter().zip(&hangings).map(|(t, h)| if h.from_tip { t.turned() } else { t }).collect();
    let joined = match (params.continuation, params.method) {
        (Continuation::Merge, Method::Robust | Method::Fused) => hang::continuations(&tubes, &hangings),
        _ => vec![None; tubes.len()],
    };
    let runs = Runs::new(&tubes, &hangings, &joined);
    let fitted = Fitted { mesh: &mesh, tubes: &tubes, nodes: &nodes, first_vertex: &first_vertex };
    Ok(assemble(&geometry, structure, &fitted, &runs, &kinds))
}

/// Pieces as tubes, those that fork as several.
#[derive(Default)]
struct Pieces {
    tubes: Vec<Tube>,
    nodes: Vec<Nodes>,
    /// Tube that one forks from in the same piece.
    forks: Vec<Option<u32>>,
    first_vertex: Vec<u64>,
}

/// Nodes of a tube, in the order of its arcs.
enum Nodes {
    /// A whole piece, from its first node.
    Piece(u32),
    /// Some of a piece's.
    Some(Vec<u32>),
}

/// Pieces, and what belongs to each tube.
struct Fitted<'a> {
    mesh: &'a Mesh,
    tubes: &'a [Tube],
    nodes: &'a [Nodes],
    first_vertex: &'a [u64],
}

/// Fits every piece.
fn fit(mesh: &Mesh, method: Method) -> Pieces {
    let fork = match method {
        Method::Robust => super::report::FUSED,
        Method::Fused => f64::MIN_POSITIVE,
        Method::Kusternig07 => f64::INFINITY,
    };
    let one = |piece: usize| {
        let (from, to) = (mesh.starts[piece], mesh.starts[piece + 1]);
        let points = &mesh.points[from.0 as usize..to.0 as usize];
        let graph = Graph::new(points, &mesh.faces[from.1 as usize..to.1 as usize], from.0);
        let tube = tube::fit(&graph, fork)?;
        let limbs = if tube.split >= fork { fused::split(&graph, &tube) } else { Vec::new() };
        match limbs.len() {
            0 => Some((piece, limbs, tube)),
            // It bends, or has knots, but does not fork.
            1 => Some((piece, Vec::new(), tube::fit(&graph, f64::INFINITY)?)),
            _ => Some((piece, limbs, tube)),
        }
    };
    // A piece has a face and a face has nodes: none is left out.
    let fitted: Vec<_> = (0..mesh.count()).into_par_iter().filter_map(one).collect();
    let mut pieces = Pieces::default();
    for (piece, limbs, tube) in fitted {
        let (first, start) = (pieces.tubes.len() as u32, mesh.starts[piece].0);
        if limbs.is_empty() {
            pieces.push(tube, Nodes::Piece(start), None, mesh.first_vertex[piece]);
        }
        for fused::Limb { tube, nodes, parent } in limbs {
            let nodes: Vec<u32> = nodes.iter().map(|n| n + start).collect();
            pieces.push(tube, Nodes::Some(nodes), parent.map(|p| p + first), u64::MAX);
        }
    }
    name_first_vertices(mesh, &mut pieces);
    pieces
}

impl Pieces {
    fn push(&mut self, tube: Tube, nodes: Nodes, fork: Option<u32>, first_vertex: u64) {
        self.tubes.push(tube);
        self.nodes.push(nodes);
        self.forks.push(fork);
        self.first_vertex.push(first_vertex);
    }
}

/// First vertices of tubes that are no whole pieces.
fn name_first_vertices(mesh: &Mesh, pieces: &mut Pieces) {
    let mut of_node = vec![u32::MAX; if pieces.forks.iter().any(Option::is_some) { mesh.points.len() } else { 0 }];
    for (tube, nodes) in pieces.nodes.iter().enumerate() {
        if let Nodes::Some(list) = nodes {
            list.iter().for_each(|&n| of_node[n as usize] = tube as u32);
        }
    }
    for (part, list) in mesh.nodes.iter().enumerate().filter(|_| !of_node.is_empty()) {
        for (vertex, &node) in list.iter().enumerate() {
            if let Some(&tube) = of_node.get(node as usize).filter(|&&t| t != u32::MAX) {
                let first = &mut pieces.first_vertex[tube as usize];
                *first = (*first).min((part as u64) << 32 | vertex as u64);
            }
        }
    }
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

fn assemble(geometry: &Geometry, structure: &Structure, fitted: &Fitted, runs: &Runs, kinds: &[RootKind]) -> Found {
    let tubes = fitted.tubes;
    let stalk = |run: usize| Stalk {
        parent: runs.hangings[run].parent.map(|tube| runs.of_tube[tube as usize].0),
        axis: {
            let axis = &runs.axes[run];
            Axis { points: axis.points.iter().map(|p| *p + geometry.center).collect(), ..axis.clone() }
        },
        margin: runs.hangings[run].margin,
        first_vertex: runs.tubes[run].iter().map(|&t| fitted.first_vertex[t as usize]).min().unwrap_or(0),
    };
    let (mut branches, ids) = Branches::grow((0..runs.tubes.len()).map(stalk).collect());
    branches.vertices = vertices(fitted, runs, &ids);
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
fn vertices(fitted: &Fitted, runs: &Runs, ids: &[u32]) -> Vec<Vec<OnBranch>> {
    let mesh = fitted.mesh;
    let mut places = vec![OnBranch::NONE; mesh.points.len()];
    for (index, (tube, nodes)) in fitted.tubes.iter().zip(fitted.nodes).enumerate() {
        let (run, start) = runs.of_tube[index];
        let on = |arc: &f64| OnBranch { branch: ids[run as usize], arc: (start + arc) as f32 };
        match nodes {
            Nodes::Piece(first) => {
                let own = places[*first as usize..].iter_mut().zip(&tube.arcs);
                own.for_each(|(place, arc)| *place = on(arc));
            }
            Nodes::Some(list) => list.iter().zip(&tube.arcs).for_each(|(&node, arc)| places[node as usize] = on(arc)),
        }
    }
    let of = |&node: &u32| places.get(node as usize).copied().unwrap_or(OnBranch::NONE);
    mesh.nodes.iter().map(|list| list.iter().map(of).collect()).collect()
}
