//! Triangles of one part, told apart by the points that they stand on, whatever their indices are.

use foliar_plant::Part;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// A triangle has no area where twice its area is below this share of its longest edge squared: a sliver as thin as
/// the rounding of its own f32 corners.
const FLAT: f64 = 1e-7;

/// What is odd about the triangles of a part.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Facts {
    /// Triangles without area.
    pub flat: usize,
    /// Triangles that stand on the same points as another one, facing the same way.
    pub duplicates: usize,
    /// Pairs of triangles back to back on the same points.
    pub coincident: usize,
    /// Triangles that stand on three points.
    pub solid: usize,
}

/// Three points in ascending order, and whether that order turns the triangle over.
type Face = ([u32; 3], bool);

/// Looks at every triangle.
pub(crate) fn facts(part: &Part) -> Facts {
    let mut faces = faces(part, &points(part));
    faces.par_sort_unstable();
    let mut facts = Facts { solid: faces.len(), flat: flat(part), ..Facts::default() };
    for same in faces.chunk_by(|a, b| a.0 == b.0) {
        let turned = same.iter().filter(|face| face.1).count();
        let straight = same.len() - turned;
        facts.duplicates += straight.saturating_sub(1) + turned.saturating_sub(1);
        facts.coincident += straight.min(turned);
    }
    facts
}

/// Whether the triangles leave more than a tenth of their edges open, as leaves do and closed shapes do not.
pub(crate) fn is_open(part: &Part) -> bool {
    let points = points(part);
    let mut edges: Vec<(u32, u32)> =
        faces(part, &points).iter().flat_map(|(p, _)| [(p[0], p[1]), (p[1], p[2]), (p[0], p[2])]).collect();
    edges.par_sort_unstable();
    let (mut open, mut all) = (0usize, 0usize);
    for same in edges.chunk_by(|a, b| a == b) {
        all += 1;
        open += usize::from(same.len() == 1);
    }
    open * 10 > all
}

/// By part, how many of its triangles stand on the points of a triangle of an earlier part, facing the same way, and which
/// part that is for the first of them.
pub(crate) fn twins(parts: &[&Part]) -> BTreeMap<usize, (usize, usize)> {
    let keys = |(at, part): (usize, &&Part)| {
        let key = |triangle: usize| Some((hash(&corners(part, triangle)?), at as u32, triangle as u32));
        (0..part.triangles.len()).into_par_iter().filter_map(key).collect::<Vec<_>>()
    };
    let mut keys: Vec<(u64, u32, u32)> = parts.iter().enumerate().flat_map(keys).collect();
    keys.par_sort_unstable();
    let mut found = BTreeMap::new();
    for same in keys.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        let corners = |at: usize| corners(parts[same[at].1 as usize], same[at].2 as usize);
        for later in 1..same.len() {
            let earlier = (0..later).find(|at| same[*at].1 != same[later].1 && corners(*at) == corners(later));
            if let Some(earlier) = earlier {
                found.entry(same[later].1 as usize).or_insert((0, same[earlier].1 as usize)).0 += 1;
            }
        }
    }
    found
}

/// Where a triangle's corners stand in the rest frame, the least first and the others in their order; `None` where two are
/// one.
fn corners(part: &Part, triangle: usize) -> Option<[[u32; 3]; 3]> {
    // -0 and 0 are one place.
    let corner = |vertex: u32| part.rest_position(vertex as usize).as_vec3().to_array().map(|c| (c + 0.0).to_bits());
    let mut own = part.triangles[triangle].map(corner);
    let least = (0..3).min_by_key(|i| own[*i])?;
    own.rotate_left(least);
    (own[0] != own[1] && own[1] != own[2] && own[0] != own[2]).then_some(own)
}

fn hash(corners: &[[u32; 3]; 3]) -> u64 {
    let mut hasher = DefaultHasher::new();
    corners.hash(&mut hasher);
    hasher.finish()
}

fn faces(part: &Part, points: &[u32]) -> Vec<Face> {
    let face = |triangle: &[u32; 3]| {
        let p = triangle.map(|vertex| points[vertex as usize]);
        let turned = (p[0] > p[1]) ^ (p[1] > p[2]) ^ (p[0] > p[2]);
        let mut sorted = p;
        sorted.sort_unstable();
        (sorted[0] != sorted[1] && sorted[1] != sorted[2]).then_some((sorted, turned))
    };
    part.triangles.par_iter().filter_map(face).collect()
}

/// Per vertex a number that all vertices at the same point share.
fn points(part: &Part) -> Vec<u32> {
    // -0 and 0 are one place.
    let key = |vertex: u32| part.positions[vertex as usize].to_array().map(|c| (c + 0.0).to_bits());
    let mut order: Vec<u32> = (0..part.positions.len() as u32).collect();
    order.par_sort_unstable_by_key(|vertex| key(*vertex));
    let mut points = vec![0; order.len()];
    for (number, same) in order.chunk_by(|a, b| key(*a) == key(*b)).enumerate() {
        same.iter().for_each(|vertex| points[*vertex as usize] = number as u32);
    }
    points
}

fn flat(part: &Part) -> usize {
    let is_flat = |triangle: &&[u32; 3]| {
        let [a, b, c]: [DVec3; 3] = triangle.map(|vertex| part.positions[vertex as usize].as_dvec3());
        let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        (b - a).cross(c - a).length() <= FLAT * longest
    };
    part.triangles.par_iter().filter(is_flat).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn part(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Part {
        let positions = positions.iter().copied().map(Vec3::from).collect();
        Part { positions, triangles: triangles.to_vec(), ..Part::default() }
    }

    const SQUARE: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn copies_backs_and_slivers_are_told_apart_whatever_their_first_corner() {
        let copies = part(&SQUARE, &[[0, 1, 2], [1, 2, 0], [2, 1, 0], [0, 2, 3], [0, 1, 1]]);
        let found = facts(&copies);
        assert_eq!((found.duplicates, found.coincident, found.flat, found.solid), (1, 1, 1, 4));
    }

    #[test]
    fn vertices_at_one_point_are_one_corner() {
        let doubled = part(&[SQUARE, SQUARE].concat(), &[[0, 1, 2], [4, 5, 6]]);
        assert_eq!(facts(&doubled).duplicates, 1);
        let apart = part(&[SQUARE, SQUARE.map(|[x, y, _]| [x, y, 1.0])].concat(), &[[0, 1, 2], [4, 5, 6]]);
        assert_eq!(facts(&apart).duplicates, 0);
    }

    #[test]
    fn parts_that_share_triangles_are_told_wherever_their_own_frames_are() {
        let card = part(&SQUARE, &[[0, 1, 2], [0, 2, 3]]);
        let moved = SQUARE.map(|[x, y, z]| [x - 2.0, y, z]);
        let mut again = part(&moved, &[[1, 2, 0], [0, 3, 2], [0, 1, 3]]);
        again.transform = glam::DAffine3::from_translation(DVec3::new(2.0, 0.0, 0.0));
        // One is the same, one lies back to back, one is another.
        assert_eq!(twins(&[&card, &again]), BTreeMap::from([(1, (1, 0))]));
        assert_eq!(twins(&[&card, &card, &again]), BTreeMap::from([(1, (2, 0)), (2, (1, 0))]));
        assert_eq!(twins(&[&again]), BTreeMap::new());
    }

    #[test]
    fn a_card_is_open_and_a_tetrahedron_is_not() {
        assert!(is_open(&part(&SQUARE, &[[0, 1, 2], [0, 2, 3]])));
        let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(!is_open(&part(&corner, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])));
    }
}
