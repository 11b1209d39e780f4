//! Which triangles a cell of marching cubes holds, for each of its 256 sign patterns (Lorensen and
//! Cline 1987), derived here rather than listed.
//!
//! Two rules make every mesh closed and manifold, whatever the field:
//! - The segments in a face follow from the face's own four signs: inside corners that meet only across
//!   its diagonal are kept apart. Both cells that share the face see the same signs, so the same segments.
//! - No triangle has a side that crosses a face between two segments. Only such a side could occur in
//!   both cells. Every loop of every pattern can be cut so (a test).

use std::sync::LazyLock;

/// Most triangles of one cell.
const MOST: usize = 5;

/// The triangles of one sign pattern.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Case {
    triangles: [[u8; 3]; MOST],
    count: u8,
}

impl Case {
    /// Corners of the triangles: edges of the cell, see [`lower_corner`]; counter-clockwise from outside.
    pub fn triangles(&self) -> &[[u8; 3]] {
        &self.triangles[..usize::from(self.count)]
    }
}

/// By sign pattern: bit c tells whether corner c (x + 2 y + 4 z) is inside.
pub(super) static CASES: LazyLock<[Case; 256]> = LazyLock::new(|| std::array::from_fn(|pattern| case(pattern as u8)));

/// Axis of an edge of the cell.
pub(super) fn axis(edge: u8) -> usize {
    usize::from(edge / 4)
}

/// Corner of an edge with the lower coordinate along its axis.
pub(super) fn lower_corner(edge: u8) -> u8 {
    let (axis, across) = (edge / 4, edge % 4);
    (across >> axis) << (axis + 1) | across & ((1 << axis) - 1)
}

fn edge_between(a: u8, b: u8) -> u8 {
    let (axis, low) = ((a ^ b).trailing_zeros() as u8, a & b);
    4 * axis + ((low >> (axis + 1)) << axis | low & ((1 << axis) - 1))
}

/// Whether two edges lie in one face: along some third axis both stand at the same side.
fn share_face(a: u8, b: u8) -> bool {
    let differ = lower_corner(a) ^ lower_corner(b);
    (0..3).any(|k| k != axis(a) && k != axis(b) && differ >> k & 1 == 0)
}

/// Corners of the six faces, counter-clockwise from outside.
fn faces() -> [[u8; 4]; 6] {
    std::array::from_fn(|face| {
        let (axis, side) = (face / 2, face % 2);
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let square = [0, u, u | v, v].map(|c: u8| c | (side as u8) << axis);
        if side == 1 { square } else { [square[3], square[2], square[1], square[0]] }
    })
}

/// Closed lines in which the surface cuts the cell's faces, as edges of the cell, turning about the outward normal.
fn loops(pattern: u8) -> Vec<Vec<u8>> {
    let inside = |corner: u8| pattern >> corner & 1 == 1;
    let mut next = [None; 12];
    for face in faces() {
        for k in 0..4 {
            // A run of inside corners starts after corner k: one segment cuts it off, from where it
            // ends to where it starts.
            if !inside(face[k]) && inside(face[(k + 1) % 4]) {
                let last = (1..4).take_while(|step| inside(face[(k + step) % 4])).last().unwrap_or(1);
                let starts = edge_between(face[k], face[(k + 1) % 4]);
                let ends = edge_between(face[(k + last) % 4], face[(k + last + 1) % 4]);
                next[usize::from(starts)] = Some(ends);
            }
        }
    }
    let mut found = Vec::new();
    for start in 0..12 {
        let (mut line, mut at) = (Vec::new(), start);
        while let Some(edge) = next[at].take() {
            line.push(at as u8);
            at = usize::from(edge);
        }
        if !line.is_empty() {
            found.push(line);
        }
    }
    found
}

fn case(pattern: u8) -> Case {
    let mut case = Case::default();
    for triangle in loops(pattern).iter().filter_map(|line| cut(line)).flat_map(|(_, triangles)| triangles) {
        case.triangles[usize::from(case.count)] = triangle;
        case.count += 1;
    }
    case
}

/// Cuts a loop into triangles by the shortest allowed diagonals, and gives their summed squares;
/// `None` where no cut is allowed.
fn cut(line: &[u8]) -> Option<(u32, Vec<[u8; 3]>)> {
    let last = line.len() - 1;
    if last < 2 {
        return Some((0, Vec::new()));
    }
    let mut best: Option<(u32, Vec<[u8; 3]>)> = None;
    for middle in 1..last {
        let sides = [(0, middle, middle == 1), (middle, last, middle + 1 == last)];
        if sides.iter().any(|&(a, b, given)| !given && share_face(line[a], line[b])) {
            continue;
        }
        let length: u32 = sides.iter().filter(|side| !side.2).map(|&(a, b, _)| square(line[a], line[b])).sum();
        let (Some(left), Some(right)) = (cut(&line[..=middle]), cut(&line[middle..])) else { continue };
        let total = length + left.0 + right.0;
        if best.as_ref().is_none_or(|b| total < b.0) {
            let own = [line[0], line[middle], line[last]];
            best = Some((total, [left.1, right.1, vec![own]].concat()));
        }
    }
    best
}

/// Squared distance of two edges' middles, in quarters of the cell's squared edge.
fn square(a: u8, b: u8) -> u32 {
    let middle = |edge: u8, k: usize| {
        if k == axis(edge) { 1 } else { 2 * i32::from(lower_corner(edge) >> k & 1) }
    };
    (0..3).map(|k| (middle(a, k) - middle(b, k)).pow(2) as u32).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_numbered_one_to_one() {
        for edge in 0..12 {
            let low = lower_corner(edge);
            assert_eq!(edge_between(low, low | 1 << axis(edge)), edge);
        }
    }

    #[test]
    fn each_crossed_edge_is_on_exactly_one_loop_and_every_loop_can_be_cut() {
        for pattern in 0..=255u8 {
            let lines = loops(pattern);
            let mut met = [0; 12];
            lines.iter().flatten().for_each(|&edge| met[usize::from(edge)] += 1);
            for edge in 0..12u8 {
                let low = lower_corner(edge);
                let crossed = (pattern >> low ^ pattern >> (low | 1 << axis(edge))) & 1;
                assert_eq!(met[usize::from(edge)], crossed, "pattern {pattern}, edge {edge}");
            }
            let triangles: usize = lines.iter().map(|line| line.len() - 2).sum();
            assert_eq!(CASES[usize::from(pattern)].triangles().len(), triangles, "pattern {pattern}");
        }
    }

    #[test]
    fn sides_in_a_face_are_its_segments_and_all_other_sides_pair_up() {
        for pattern in 0..=255u8 {
            let lines = loops(pattern);
            let segment = |a, b| lines.iter().any(|l| (0..l.len()).any(|i| (l[i], l[(i + 1) % l.len()]) == (a, b)));
            let case = CASES[usize::from(pattern)];
            let sides: Vec<(u8, u8)> =
                case.triangles().iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
            for &(a, b) in &sides {
                let turned = sides.iter().filter(|&&side| side == (b, a)).count();
                assert_eq!(turned, usize::from(!segment(a, b)), "pattern {pattern}, side {a} {b}");
                assert!(segment(a, b) || !share_face(a, b), "pattern {pattern}, side {a} {b}");
            }
        }
    }

    #[test]
    fn one_inside_corner_is_cut_off_with_the_normal_away_from_it() {
        let t = CASES[1].triangles()[0];
        // Edges 0, 4, 8 leave the origin along x, y, z: x to y to z turns counter-clockwise from outside.
        let turns = [[0, 4, 8], [4, 8, 0], [8, 0, 4]];
        assert!(turns.contains(&t), "{t:?}");
    }
}
