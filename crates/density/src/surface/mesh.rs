//! Facts about triangle meshes: closed, manifold, Euler number, connected pieces and their volumes.

use super::Surface;
use foliar_numerics::CompensatedSum;
use glam::{DVec3, Vec3};

/// What is wrong with a mesh; nothing where all lists are empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshFaults {
    /// Directed edges (from, to) that do not have exactly one partner in the other direction: open edges,
    /// and edges of more than two triangles or of two that turn against each other.
    pub edges: Vec<[u32; 2]>,
    /// Vertices whose triangles do not form one closed fan.
    pub vertices: Vec<u32>,
}

impl MeshFaults {
    /// Whether the mesh is closed, manifold and consistently oriented.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.vertices.is_empty()
    }
}

/// A connected piece of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Piece {
    /// Its lowest vertex.
    pub first: u32,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Enclosed volume, m^3; negative for the wall of a cavity.
    pub volume: f64,
    /// Area, m^2.
    pub area: f64,
}

impl Piece {
    /// Vertices - edges + triangles, of a closed piece: 2 for a ball, 0 for a ring.
    pub fn euler(&self) -> i64 {
        // Each triangle has three half edges.
        self.vertices as i64 - (self.triangles / 2) as i64
    }
}

/// Checks that every edge has two triangles, one in each direction, and every vertex one closed fan.
/// Triangles without area are as good as others; vertices without triangles are faults.
pub fn check_mesh(triangles: &[[u32; 3]], vertex_count: usize) -> MeshFaults {
    // (from, to, third corner), by from then to: a vertex's fan is one run.
    let mut sides: Vec<[u32; 3]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]]).collect();
    sides.sort_unstable();
    let count = |from: u32, to: u32| {
        let first = sides.partition_point(|s| (s[0], s[1]) < (from, to));
        sides[first..].iter().take_while(|s| (s[0], s[1]) == (from, to)).count()
    };
    let mut faults = MeshFaults::default();
    for run in sides.chunk_by(|a, b| a[..2] == b[..2]) {
        let [from, to, _] = run[0];
        if run.len() != 1 || from == to || count(to, from) != 1 {
            faults.edges.push([from, to]);
        }
    }
    let mut fans = sides.chunk_by(|a, b| a[0] == b[0]).peekable();
    for vertex in 0..vertex_count as u32 {
        let fan = fans.next_if(|fan| fan[0][0] == vertex);
        if !fan.is_some_and(is_cycle) {
            faults.vertices.push(vertex);
        }
    }
    faults
}

/// Whether the triangles about a vertex, sorted by their second corner, form one cycle.
fn is_cycle(fan: &[[u32; 3]]) -> bool {
    let mut at = fan[0][1];
    for step in 1..=fan.len() {
        let Ok(side) = fan.binary_search_by_key(&at, |s| s[1]) else { return false };
        at = fan[side][2];
        if at == fan[0][1] {
            return step == fan.len();
        }
    }
    false
}

/// Connected pieces, by their lowest vertex.
pub fn pieces(surface: &Surface) -> Vec<Piece> {
    let (piece_of, count) = label(surface);
    let mut pieces = vec![Piece { first: u32::MAX, ..Piece::default() }; count];
    let mut sums = vec![[CompensatedSum::default(); 2]; count];
    for (vertex, &piece) in piece_of.iter().enumerate() {
        pieces[piece as usize].first = pieces[piece as usize].first.min(vertex as u32);
        pieces[piece as usize].vertices += 1;
    }
    for triangle in &surface.triangles {
        let piece = piece_of[triangle[0] as usize] as usize;
        let [a, b, c] = triangle.map(|v| surface.positions[v as usize].as_dvec3());
        // About the piece's own first vertex, so that far pieces lose no digits.
        let [a, b, c] = [a, b, c].map(|p| p - surface.positions[pieces[piece].first as usize].as_dvec3());
        pieces[piece].triangles += 1;
        sums[piece][0].add(a.dot(b.cross(c)) / 6.0);
        sums[piece][1].add((b - a).cross(c - a).length() / 2.0);
    }
    for (piece, sums) in pieces.iter_mut().zip(sums) {
        [piece.volume, piece.area] = sums.map(CompensatedSum::value);
    }
    pieces
}

/// Piece of each vertex, numbered by lowest vertex, and how many there are.
fn label(surface: &Surface) -> (Vec<u32>, usize) {
    let mut parents: Vec<u32> = (0..surface.positions.len() as u32).collect();
    for &[a, b, c] in &surface.triangles {
        for other in [b, c] {
            let (one, other) = (root(&mut parents, a), root(&mut parents, other));
            parents[one.max(other) as usize] = one.min(other);
        }
    }
    let mut count = 0;
    for vertex in 0..parents.len() {
        // Parents are never above their children: a parent's number is final when its children's turn comes.
        let parent = parents[vertex] as usize;
        parents[vertex] = if parent == vertex { count } else { parents[parent] };
        count += u32::from(parent == vertex);
    }
    (parents, count as usize)
}

fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let above = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

impl Surface {
    /// The surface without the walls of its cavities: pieces whose volume is not above 0.
    pub fn without_cavities(self) -> Surface {
        let (piece_of, _) = label(&self);
        let outer: Vec<bool> = pieces(&self).iter().map(|p| p.volume > 0.0).collect();
        if outer.iter().all(|&outer| outer) {
            return self;
        }
        let keep = |vertex: u32| outer[piece_of[vertex as usize] as usize];
        let mut kept = 0u32;
        let renumbered: Vec<u32> = (0..self.positions.len() as u32)
            .map(|v| {
                kept += u32::from(keep(v));
                kept.saturating_sub(1)
            })
            .collect();
        let choose = |list: &[Vec3]| (0u32..).zip(list).filter(|&(v, _)| keep(v)).map(|(_, &p)| p).collect();
        let triangles = self.triangles.iter().filter(|t| keep(t[0])).map(|t| t.map(|v| renumbered[v as usize]));
        Surface {
            triangles: triangles.collect(),
            positions: choose(&self.positions),
            normals: choose(&self.normals),
            ..self
        }
    }

    /// Middle of a box around all vertices and half its edges, meters from the origin; `None` without vertices.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = self.positions.first()?;
        let (low, high) = self.positions.iter().fold((*first, *first), |(l, h), p| (l.min(*p), h.max(*p)));
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        Some((low.midpoint(high), (high - low) / 2.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    fn surface(triangles: &[[u32; 3]], positions: &[Vec3]) -> Surface {
        Surface { triangles: triangles.to_vec(), positions: positions.to_vec(), ..Surface::default() }
    }

    #[test]
    fn a_tetrahedron_is_sound_and_has_its_volume() {
        assert!(check_mesh(&TETRAHEDRON, 4).is_empty());
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let list = pieces(&surface(&TETRAHEDRON, &corners));
        assert_eq!((list.len(), list[0].euler(), list[0].vertices), (1, 2, 4));
        assert!((list[0].volume - 1.0 / 6.0).abs() < 1e-12);
        assert!((list[0].area - (1.5 + 0.75f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn holes_turned_triangles_and_crowded_edges_are_found() {
        assert_eq!(check_mesh(&TETRAHEDRON[1..], 4).edges.len(), 3);
        let mut turned = TETRAHEDRON;
        turned[0] = [0, 1, 2];
        assert_eq!(check_mesh(&turned, 4).edges.len(), 3);
        let twice: Vec<[u32; 3]> = TETRAHEDRON.into_iter().chain([[0, 1, 4], [1, 0, 4]]).collect();
        assert!(!check_mesh(&twice, 5).edges.is_empty());
    }

    #[test]
    fn a_vertex_that_joins_two_fans_and_one_without_triangles_are_found() {
        let second = TETRAHEDRON.map(|t| t.map(|v| if v == 0 { 0 } else { v + 3 }));
        let joined: Vec<[u32; 3]> = TETRAHEDRON.into_iter().chain(second).collect();
        let faults = check_mesh(&joined, 8);
        assert!(faults.edges.is_empty());
        assert_eq!(faults.vertices, [0, 7]);
    }

    #[test]
    fn pieces_are_told_apart_however_their_triangles_are_listed() {
        let apart = TETRAHEDRON.map(|t| t.map(|v| v + 4));
        let turned = apart.map(|[a, b, c]| [a, c, b]);
        let mixed: Vec<[u32; 3]> = turned.into_iter().zip(TETRAHEDRON).flat_map(|(a, b)| [a, b]).collect();
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let both: Vec<Vec3> = corners.into_iter().chain(corners.map(|c| c * 2.0)).collect();
        let mesh = Surface { normals: vec![Vec3::X; 8], ..surface(&mixed, &both) };
        let list = pieces(&mesh);
        assert_eq!((list.len(), list[1].first), (2, 4));
        assert!((list[1].volume + 8.0 / 6.0).abs() < 1e-6);
        let outer = mesh.without_cavities();
        assert_eq!(outer.triangles, TETRAHEDRON);
        assert_eq!((outer.positions.len(), outer.normals.len()), (4, 4));
    }
}
