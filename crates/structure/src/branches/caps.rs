//! Caps that share no vertex with their tube (flat-shaded ends of glTF files): discs whose whole rim lies on the
//! open end of one other piece.

use super::mesh::{Corners, bits, edges};
use std::collections::BTreeMap;

/// Faces, edges, margin edges and nodes of a piece.
#[derive(Clone, Copy, Default)]
struct Counts {
    faces: i64,
    edges: i64,
    margin: i64,
    nodes: i64,
}

impl Counts {
    /// A disc (Euler's number 1) of no more faces than its rim has edges: a fan, or a polygon cut into triangles.
    fn is_cap(&self) -> bool {
        self.nodes - self.edges + self.faces == 1 && self.margin >= 3 && self.faces <= self.margin
    }
}

/// Joins the rims of caps with the ends that they close; whether there were any.
pub(super) fn join(corners: &mut Corners, pieces: &[u32]) -> bool {
    let mut counts = vec![Counts::default(); pieces.len()];
    let mut margin: Vec<(u32, u32)> = Vec::new();
    edges(&corners.nodes, corners.points.len(), |a, b, faces| {
        let piece = pieces[faces[0].1 as usize];
        counts[piece as usize].edges += 1;
        if faces.len() == 1 {
            counts[piece as usize].margin += 1;
            margin.extend([(piece, a), (piece, b)]);
        }
    });
    // A face of two nodes is an edge, which is counted already.
    let has_area = |n: &[u32]| n[0] != n[1] && n[1] != n[2] && n[2] != n[0];
    for (_, &piece) in corners.nodes.chunks_exact(3).zip(pieces).filter(|(n, _)| has_area(n)) {
        counts[piece as usize].faces += 1;
    }
    // Nodes are told apart only where a cap is possible: tubes have far more faces than open edges.
    let possible = |piece: u32| counts[piece as usize].faces <= counts[piece as usize].margin;
    let few = corners.nodes.chunks_exact(3).zip(pieces).filter(|(_, piece)| possible(**piece));
    let mut nodes: Vec<(u32, u32)> = few.flat_map(|(n, &piece)| [0, 1, 2].map(|k| (piece, n[k]))).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes.iter().for_each(|&(piece, _)| counts[piece as usize].nodes += 1);
    if !margin.iter().any(|(piece, _)| counts[*piece as usize].is_cap()) {
        return false;
    }
    margin.sort_unstable();
    margin.dedup();
    let to = targets(corners, &counts, &margin);
    corners.nodes.iter_mut().for_each(|n| *n = to[*n as usize]);
    true
}

/// The node that each node becomes.
fn targets(corners: &Corners, counts: &[Counts], margin: &[(u32, u32)]) -> Vec<u32> {
    let place = |node: u32| bits(corners.points[node as usize]);
    let mut ends: BTreeMap<[u64; 3], Vec<(u32, u32)>> = BTreeMap::new();
    for &(piece, node) in margin.iter().filter(|(piece, _)| !counts[*piece as usize].is_cap()) {
        ends.entry(place(node)).or_default().push((piece, node));
    }
    let mut to: Vec<u32> = (0..corners.points.len() as u32).collect();
    for rim in margin.chunk_by(|a, b| a.0 == b.0).filter(|rim| counts[rim[0].0 as usize].is_cap()) {
        let on = |node: u32, piece: u32| ends.get(&place(node))?.iter().find(|e| e.0 == piece).map(|e| e.1);
        let first = ends.get(&place(rim[0].1)).map_or(&[][..], Vec::as_slice);
        let tube = first.iter().find(|(piece, _)| rim.iter().all(|(_, node)| on(*node, *piece).is_some()));
        if let Some((piece, _)) = tube {
            rim.iter().for_each(|(_, node)| to[*node as usize] = on(*node, *piece).unwrap_or(*node));
        }
    }
    to
}
