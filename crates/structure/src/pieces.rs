//! Connected pieces of a part, over the file's own position ids; for triangle soup over equal positions.

use foliar_plant::Part;

/// Pieces of one part, numbered by their first vertices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    /// First vertex of each piece that a triangle uses.
    pub first_vertex: Vec<u32>,
    /// Piece of each vertex; `u32::MAX` for one that no triangle uses.
    pub of_vertex: Vec<u32>,
    /// Triangles, piece by piece.
    triangles: Vec<u32>,
    /// Where each piece starts in `triangles`, and the end.
    starts: Vec<u32>,
    /// Whether the part was triangle soup, welded at equal positions.
    pub soup: bool,
}

impl Pieces {
    pub fn count(&self) -> usize {
        self.first_vertex.len()
    }

    /// Triangles of one piece, in the order of the file.
    pub fn triangles(&self, piece: usize) -> &[u32] {
        &self.triangles[self.starts[piece] as usize..self.starts[piece + 1] as usize]
    }

    pub fn unused_vertices(&self) -> usize {
        self.of_vertex.iter().filter(|&&p| p == u32::MAX).count()
    }
}

/// Pieces of a part. Where most of them are single triangles the file shares no vertices at all: then
/// positions that are equal to the bit are one. `scratch` holds `u32::MAX` per position id, before and after.
pub(crate) fn find_pieces(part: &Part, scratch: &mut [u32]) -> Pieces {
    let mut joined = Sets::new(part.positions.len());
    join_by_id(part, scratch, &mut joined);
    join_triangles(part, &mut joined);
    let pieces = number(part, &mut joined);
    let single = (0..pieces.count()).filter(|&p| pieces.triangles(p).len() == 1).count();
    if pieces.count() < 2 || 2 * single <= pieces.count() {
        return pieces;
    }
    join_by_position(part, &mut joined);
    Pieces { soup: true, ..number(part, &mut joined) }
}

fn join_by_id(part: &Part, scratch: &mut [u32], joined: &mut Sets) {
    for (vertex, &id) in part.position_ids.iter().enumerate() {
        let first = &mut scratch[id as usize];
        if *first == u32::MAX {
            *first = vertex as u32;
        } else {
            joined.join(*first, vertex as u32);
        }
    }
    part.position_ids.iter().for_each(|&id| scratch[id as usize] = u32::MAX);
}

fn join_triangles(part: &Part, joined: &mut Sets) {
    for &[a, b, c] in &part.triangles {
        joined.join(a, b);
        joined.join(b, c);
    }
}

fn join_by_position(part: &Part, joined: &mut Sets) {
    let mut order: Vec<u32> = part.triangles.iter().flatten().copied().collect();
    order.sort_unstable();
    order.dedup();
    order.sort_by_key(|&v| position_bits(part, v));
    for pair in order.windows(2) {
        if position_bits(part, pair[0]) == position_bits(part, pair[1]) {
            joined.join(pair[0], pair[1]);
        }
    }
}

/// The position of a vertex as bits, -0 as 0.
pub(crate) fn position_bits(part: &Part, vertex: u32) -> [u32; 3] {
    part.positions[vertex as usize].to_array().map(|x| (x + 0.0).to_bits())
}

fn number(part: &Part, joined: &mut Sets) -> Pieces {
    let vertices = part.positions.len();
    let mut used = vec![false; vertices];
    part.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut piece_of_root = vec![u32::MAX; vertices];
    let mut pieces = Pieces { of_vertex: vec![u32::MAX; vertices], ..Pieces::default() };
    for vertex in (0..vertices).filter(|&v| used[v]) {
        let piece = &mut piece_of_root[joined.root(vertex as u32) as usize];
        if *piece == u32::MAX {
            *piece = pieces.first_vertex.len() as u32;
            pieces.first_vertex.push(vertex as u32);
        }
        pieces.of_vertex[vertex] = *piece;
    }
    sort_triangles(part, &mut pieces);
    pieces
}

/// Counting sort of the triangles by piece: the file's order stays inside each.
fn sort_triangles(part: &Part, pieces: &mut Pieces) {
    let piece_of = |t: &[u32; 3]| pieces.of_vertex[t[0] as usize] as usize;
    let mut starts = vec![0u32; pieces.first_vertex.len() + 1];
    part.triangles.iter().for_each(|t| starts[piece_of(t) + 1] += 1);
    (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
    let mut next = starts.clone();
    let mut sorted = vec![0u32; part.triangles.len()];
    for (index, triangle) in part.triangles.iter().enumerate() {
        let slot = &mut next[piece_of(triangle)];
        sorted[*slot as usize] = index as u32;
        *slot += 1;
    }
    (pieces.starts, pieces.triangles) = (starts, sorted);
}

/// Disjoint sets; the lowest member is the root.
pub(crate) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    pub fn new(count: usize) -> Self {
        Sets { parent: (0..count as u32).collect() }
    }

    pub fn root(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let grandparent = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn part(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Part {
        let position_ids = (0..positions.len() as u32).collect();
        Part { positions, triangles, position_ids, ..Part::default() }
    }

    fn pieces(part: &Part) -> Pieces {
        find_pieces(part, &mut vec![u32::MAX; part.positions.len()])
    }

    /// Two quads of two triangles that touch along an edge, each with vertices of its own.
    fn touching_quads() -> Part {
        let corner = |i: u32| Vec3::new((i / 2) as f32, (i % 2) as f32, 0.0);
        let positions = [0, 1, 2, 3, 2, 3, 4, 5].map(corner).to_vec();
        part(positions, vec![[0, 2, 3], [0, 3, 1], [4, 6, 7], [4, 7, 5]])
    }

    #[test]
    fn leaves_that_touch_do_not_fuse() {
        let found = pieces(&touching_quads());
        assert_eq!((found.count(), found.soup), (2, false));
        assert_eq!(found.first_vertex, [0, 4]);
        assert_eq!(found.triangles(1), [2, 3]);
    }

    #[test]
    fn shared_position_ids_join_vertices_that_differ_in_other_things() {
        let mut quads = touching_quads();
        quads.position_ids = vec![0, 1, 2, 3, 2, 3, 4, 5];
        assert_eq!(pieces(&quads).count(), 1);
    }

    #[test]
    fn triangle_soup_is_welded_where_positions_are_equal_to_the_bit() {
        let (a, b, c, d) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, -0.0));
        let far = Vec3::splat(9.0);
        let soup = part(
            vec![a, b, c, b, Vec3::new(1.0, 1.0, 0.0), c, far, far + b, far + d],
            vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
        );
        let found = pieces(&soup);
        assert_eq!((found.count(), found.soup), (2, true));
        assert_eq!(found.triangles(0), [0, 1]);
    }

    #[test]
    fn vertices_that_no_triangle_uses_belong_to_no_piece() {
        let mut quads = touching_quads();
        quads.triangles.truncate(2);
        let found = pieces(&quads);
        assert_eq!((found.count(), found.unused_vertices()), (1, 4));
    }
}
