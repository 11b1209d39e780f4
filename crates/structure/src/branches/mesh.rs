//! The wood of a base as one mesh over position ids: nodes where the file says that vertices are one place,
//! joined further only where the file is soup or a texture seam runs through a piece.

use crate::geometry::Geometry;
use crate::pieces::Sets;
use foliar_schema::Role;
use glam::DVec3;
use rayon::prelude::*;

/// Wood parts with fewer triangles per connected piece than this share no vertices: they are soup.
const SOUP_RATIO: usize = 6;
/// Soup that equal positions do not join is joined within this share of their faces' shortest edges.
const JITTER: f64 = 0.45;

/// All wood, cut into pieces that are joined through edges.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    /// Positions of nodes, relative to the geometry's center, piece by piece.
    pub points: Vec<DVec3>,
    /// Faces over nodes, piece by piece.
    pub faces: Vec<[u32; 3]>,
    /// Where the nodes and faces of each piece start, and the end.
    pub starts: Vec<(u32, u32)>,
    /// Per part, per vertex: node, or `u32::MAX` where no face uses it; empty for parts that are no wood.
    pub nodes: Vec<Vec<u32>>,
    /// Per piece: (part, vertex) of its first vertex.
    pub first_vertex: Vec<u64>,
}

/// Corner of a face: where it came from.
pub(super) struct Corners {
    /// Node of each corner, three per face.
    pub nodes: Vec<u32>,
    /// Part of each run of faces, and its first face.
    parts: Vec<(usize, usize)>,
    pub points: Vec<DVec3>,
}

impl Mesh {
    pub fn new(geometry: &Geometry, roles: &[Role]) -> Mesh {
        let mut corners = gather(geometry, roles);
        let mut pieces = pieces(&corners);
        let soup = soup_faces(&corners, &pieces);
        if soup.iter().any(|s| *s) {
            weld_equal(&mut corners, |face| soup[face].then_some(0), None);
            if pieces_are_few_faces(&corners, &soup) {
                weld_near(&mut corners, &soup);
            }
            pieces = self::pieces(&corners);
        }
        if has_seams(&corners, &pieces) {
            weld_equal(&mut corners, |face| Some(pieces[face]), Some(&pieces));
            pieces = self::pieces(&corners);
        }
        if super::caps::join(&mut corners, &pieces) {
            pieces = self::pieces(&corners);
        }
        sort(geometry, roles, &corners, &pieces)
    }

    pub fn count(&self) -> usize {
        self.first_vertex.len()
    }
}

/// Nodes over position ids. A vertex that shares an id but stands elsewhere (one list drawn by two
/// nodes) gets a node of its own.
fn gather(geometry: &Geometry, roles: &[Role]) -> Corners {
    let mut of_id = vec![u32::MAX; geometry.base.position_count as usize];
    let mut corners = Corners { nodes: Vec::new(), parts: Vec::new(), points: Vec::new() };
    for (index, part) in geometry.parts.iter().enumerate().filter(|(i, _)| roles[*i] == Role::Wood) {
        corners.parts.push((index, corners.nodes.len() / 3));
        let mut own = vec![u32::MAX; part.positions.len()];
        for &vertex in part.part.triangles.iter().flatten() {
            let node = &mut own[vertex as usize];
            if *node == u32::MAX {
                let (place, id) = (part.positions[vertex as usize], part.part.position_ids[vertex as usize] as usize);
                let known = of_id[id];
                *node = if known != u32::MAX && corners.points[known as usize] == place {
                    known
                } else {
                    corners.points.push(place);
                    corners.points.len() as u32 - 1
                };
                of_id[id] = *node;
            }
            corners.nodes.push(*node);
        }
    }
    corners
}

/// Calls `visit` with the faces of each edge of the mesh, and the edge's lower and higher node. Faces of one
/// node or two count by the edges that they have.
pub(super) fn edges(nodes: &[u32], points: usize, mut visit: impl FnMut(u32, u32, &[(u32, u32)])) {
    let mut starts = vec![0u32; points + 1];
    let sides = |face: &[u32]| [(face[0], face[1]), (face[1], face[2]), (face[2], face[0])];
    for face in nodes.chunks_exact(3) {
        for (a, b) in sides(face) {
            starts[a.min(b) as usize + 1] += u32::from(a != b);
        }
    }
    (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
    let mut slots = vec![(0u32, 0u32); starts.last().copied().unwrap_or(0) as usize];
    let mut next = starts.clone();
    for (index, face) in nodes.chunks_exact(3).enumerate() {
        for (a, b) in sides(face).into_iter().filter(|(a, b)| a != b) {
            let slot = &mut next[a.min(b) as usize];
            slots[*slot as usize] = (a.max(b), index as u32);
            *slot += 1;
        }
    }
    for low in 0..points {
        let list = &mut slots[starts[low] as usize..starts[low + 1] as usize];
        list.sort_unstable();
        for run in list.chunk_by(|a, b| a.0 == b.0) {
            visit(low as u32, run[0].0, run);
        }
    }
}

/// Piece of each face, as the lowest face of it: joined through edges, never through single vertices.
fn pieces(corners: &Corners) -> Vec<u32> {
    let mut sets = Sets::new(corners.nodes.len() / 3);
    edges(&corners.nodes, corners.points.len(), |_, _, faces| {
        faces.windows(2).for_each(|pair| sets.join(pair[0].1, pair[1].1));
    });
    let mut of_face: Vec<u32> = (0..corners.nodes.len() as u32 / 3).map(|face| sets.root(face)).collect();
    // A face that is one point has no edge: it goes with a face that has one.
    let is_point = |face: &[u32]| face[0] == face[1] && face[1] == face[2];
    let mut of_node = vec![u32::MAX; corners.points.len()];
    for (nodes, &piece) in corners.nodes.chunks_exact(3).zip(&of_face).filter(|(n, _)| !is_point(n)) {
        nodes.iter().for_each(|&n| of_node[n as usize] = of_node[n as usize].min(piece));
    }
    for (nodes, piece) in corners.nodes.chunks_exact(3).zip(&mut of_face).filter(|(n, _)| is_point(n)) {
        *piece = (*piece).min(of_node[nodes[0] as usize]);
        of_node[nodes[0] as usize] = *piece;
    }
    of_face
}

/// Faces of parts whose pieces have few faces each.
fn soup_faces(corners: &Corners, pieces: &[u32]) -> Vec<bool> {
    let mut soup = vec![false; pieces.len()];
    for (index, &(_, start)) in corners.parts.iter().enumerate() {
        let end = corners.parts.get(index + 1).map_or(pieces.len(), |next| next.1);
        let roots = (start..end).filter(|&face| pieces[face] as usize == face).count();
        let is_soup = end - start < SOUP_RATIO * roots;
        soup[start..end].fill(is_soup);
    }
    soup
}

fn pieces_are_few_faces(corners: &Corners, soup: &[bool]) -> bool {
    let pieces = pieces(corners);
    let faces = soup.iter().filter(|s| **s).count();
    let roots = (0..soup.len()).filter(|&f| soup[f] && pieces[f] as usize == f).count();
    faces < SOUP_RATIO * roots
}

/// The position as bits, -0 as 0: what is equal is one place.
pub(super) fn bits(place: DVec3) -> [u64; 3] {
    place.to_array().map(|x| (x + 0.0).to_bits())
}

/// Joins nodes at equal positions whose faces have the same key; faces without a key stay alone.
fn weld_equal(corners: &mut Corners, key: impl Fn(usize) -> Option<u32>, thin: Option<&[u32]>) {
    let mut keys = vec![u32::MAX; corners.points.len()];
    for (corner, &node) in corners.nodes.iter().enumerate() {
        if let Some(key) = key(corner / 3) {
            keys[node as usize] = key;
        }
    }
    let mut order: Vec<u32> = (0..keys.len() as u32).filter(|&n| keys[n as usize] != u32::MAX).collect();
    let value = |n: u32| (keys[n as usize], bits(corners.points[n as usize]), n);
    order.par_sort_unstable_by_key(|&n| value(n));
    let mut to: Vec<u32> = (0..keys.len() as u32).collect();
    for run in order.chunk_by(|&a, &b| (value(a).0, value(a).1) == (value(b).0, value(b).1)) {
        run.iter().for_each(|&n| to[n as usize] = run[0]);
    }
    if let Some(pieces) = thin {
        keep_thin(corners, pieces, &mut to);
    }
    corners.nodes.iter_mut().for_each(|n| *n = to[*n as usize]);
}

/// Takes back what would leave a piece without a single face of three nodes: a tube of no thickness at all.
fn keep_thin(corners: &Corners, pieces: &[u32], to: &mut [u32]) {
    let (mut before, mut after) = (vec![false; pieces.len()], vec![false; pieces.len()]);
    let distinct = |n: [u32; 3]| n[0] != n[1] && n[1] != n[2] && n[2] != n[0];
    for (nodes, &piece) in corners.nodes.chunks_exact(3).zip(pieces) {
        before[piece as usize] |= distinct([0, 1, 2].map(|k| nodes[k]));
        after[piece as usize] |= distinct([0, 1, 2].map(|k| to[nodes[k] as usize]));
    }
    for (nodes, &piece) in corners.nodes.chunks_exact(3).zip(pieces) {
        if before[piece as usize] && !after[piece as usize] {
            nodes.iter().for_each(|&n| to[n as usize] = n);
        }
    }
}

/// Joins nodes of soup that lie within a share of their faces' shortest edges: scans and printed files jitter.
fn weld_near(corners: &mut Corners, soup: &[bool]) {
    let points = &corners.points;
    let mut shortest = vec![f64::INFINITY; points.len()];
    for (_, face) in corners.nodes.chunks_exact(3).enumerate().filter(|(f, _)| soup[*f]) {
        // The face's shortest edge, for all its corners: the one opposite may be far shorter than those at a corner.
        let length = |a: usize, b: usize| points[face[a] as usize].distance(points[face[b] as usize]);
        let least =
            [length(0, 1), length(1, 2), length(2, 0)].into_iter().filter(|l| *l > 0.0).fold(f64::INFINITY, f64::min);
        face.iter().for_each(|&n| shortest[n as usize] = shortest[n as usize].min(least));
    }
    let used: Vec<u32> = (0..points.len() as u32).filter(|&n| shortest[n as usize].is_finite()).collect();
    let boxes: Vec<foliar_space::Aabb> = used
        .iter()
        .map(|&n| foliar_space::Aabb::around([points[n as usize]]).grown(JITTER * shortest[n as usize]))
        .collect();
    let tree = foliar_space::BoxTree::new(&boxes);
    let mut sets = Sets::new(points.len());
    for (entry, &node) in used.iter().enumerate() {
        let (place, reach) = (points[node as usize], JITTER * shortest[node as usize]);
        tree.near(&boxes[entry], |other| {
            let other = used[other as usize];
            let limit = reach.min(JITTER * shortest[other as usize]);
            if other < node && points[other as usize].distance(place) <= limit {
                sets.join(other, node);
            }
        });
    }
    corners.nodes.iter_mut().for_each(|n| *n = sets.root(*n));
}

/// Whether nodes on the margin of a piece lie on one another: a texture seam.
fn has_seams(corners: &Corners, pieces: &[u32]) -> bool {
    let mut margin: Vec<(u32, [u64; 3], u32)> = Vec::new();
    edges(&corners.nodes, corners.points.len(), |a, b, faces| {
        if faces.len() == 1 {
            let piece = pieces[faces[0].1 as usize];
            margin.extend([a, b].map(|n| (piece, bits(corners.points[n as usize]), n)));
        }
    });
    margin.par_sort_unstable();
    margin.windows(2).any(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1) && w[0].2 != w[1].2)
}

/// Nodes and faces piece by piece; a node of two pieces is doubled.
fn sort(geometry: &Geometry, roles: &[Role], corners: &Corners, pieces: &[u32]) -> Mesh {
    let mut mesh = Mesh { nodes: vec![Vec::new(); geometry.parts.len()], ..Mesh::default() };
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    order.par_sort_unstable_by_key(|&face| (pieces[face as usize], face));
    let mut node_of_face = vec![[0u32; 3]; pieces.len()];
    // New node of an old one, valid where its piece is the one at work.
    let mut renamed = vec![(u32::MAX, 0u32); corners.points.len()];
    for run in order.chunk_by(|&a, &b| pieces[a as usize] == pieces[b as usize]) {
        mesh.starts.push((mesh.points.len() as u32, mesh.faces.len() as u32));
        let piece = pieces[run[0] as usize];
        for &face in run {
            let first = 3 * face as usize;
            let nodes = [0, 1, 2].map(|k| {
                let old = corners.nodes[first + k] as usize;
                if renamed[old].0 != piece {
                    renamed[old] = (piece, mesh.points.len() as u32);
                    mesh.points.push(corners.points[old]);
                }
                renamed[old].1
            });
            node_of_face[face as usize] = nodes;
            mesh.faces.push(nodes);
        }
    }
    mesh.starts.push((mesh.points.len() as u32, mesh.faces.len() as u32));
    name_vertices(geometry, roles, &node_of_face, &mut mesh);
    mesh
}

fn name_vertices(geometry: &Geometry, roles: &[Role], node_of_face: &[[u32; 3]], mesh: &mut Mesh) {
    mesh.first_vertex = vec![u64::MAX; mesh.starts.len() - 1];
    let piece_starts: Vec<u32> = mesh.starts.iter().map(|s| s.0).collect();
    let mut face = 0;
    for (index, part) in geometry.parts.iter().enumerate().filter(|(i, _)| roles[*i] == Role::Wood) {
        let mut list = vec![u32::MAX; part.positions.len()];
        for triangle in &part.part.triangles {
            for (&vertex, &node) in triangle.iter().zip(&node_of_face[face]) {
                if list[vertex as usize] == u32::MAX {
                    list[vertex as usize] = node;
                }
            }
            face += 1;
        }
        for (vertex, &node) in list.iter().enumerate().filter(|(_, n)| **n != u32::MAX) {
            let piece = piece_starts.partition_point(|&s| s <= node) - 1;
            let first = &mut mesh.first_vertex[piece];
            *first = (*first).min((index as u64) << 32 | vertex as u64);
        }
        mesh.nodes[index] = list;
    }
}
