//! Triangles of a polygon in space: exactly n - 2 of n corners, whatever the polygon is like.
//! Concave ones are cut by ear clipping on their Newell plane.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Most corners of a polygon into which left-out ones are put back: each takes a walk over all its
/// triangles, which a hostile polygon of millions would make last for hours.
const MOST_CORNERS_MENDED: usize = 4096;

/// Reused between polygons.
pub(crate) struct Cutter {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    indices: Vec<u32>,
}

impl Cutter {
    /// A cutter with nothing in it.
    pub fn new() -> Self {
        Cutter { earcut: Earcut::new(), flat: Vec::new(), indices: Vec::new() }
    }

    /// Appends n - 2 triangles (places within `points`, in the polygon's own turn) to `out`.
    pub fn cut(&mut self, points: &[DVec3], out: &mut Vec<[u32; 3]>) {
        match points {
            [] | [_] | [_, _] => {}
            [_, _, _] => out.push([0, 1, 2]),
            [a, b, c, d] => out.extend(quad([*a, *b, *c, *d])),
            _ => self.ngon(points, out),
        }
    }

    fn ngon(&mut self, points: &[DVec3], out: &mut Vec<[u32; 3]>) {
        let start = out.len();
        let wanted = points.len() - 2;
        if self.flatten(points) {
            if is_convex(&self.flat) {
                return fan(points.len(), out);
            }
            self.earcut.earcut(self.flat.iter().copied(), &[], &mut self.indices);
            out.extend(self.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]));
            self.turn(&mut out[start..]);
            // Ear clipping leaves out corners on straight edges and doubled corners.
            if points.len() <= MOST_CORNERS_MENDED {
                insert_left_out(points.len(), start, out);
            }
        }
        if out.len() - start != wanted {
            out.truncate(start);
            fan(points.len(), out);
        }
    }

    /// Projects on the Newell plane, so that the polygon turns counter-clockwise. Says whether it
    /// has an area there.
    fn flatten(&mut self, points: &[DVec3]) -> bool {
        let origin = points[0];
        let mut normal = DVec3::ZERO;
        for (index, point) in points.iter().enumerate() {
            let next = points[(index + 1) % points.len()];
            normal += (*point - origin).cross(next - origin);
        }
        let Some(normal) = normal.try_normalize() else { return false };
        let (x, y) = normal.any_orthonormal_pair();
        self.flat.clear();
        self.flat.extend(points.iter().map(|p| [x.dot(*p - origin), y.dot(*p - origin)]));
        true
    }

    /// Makes triangles turn as the polygon does: counter-clockwise on its plane.
    fn turn(&self, triangles: &mut [[u32; 3]]) {
        let area: f64 = triangles.iter().map(|t| doubled_area(t.map(|i| self.flat[i as usize]))).sum();
        if area < 0.0 {
            triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
    }
}

/// Two triangles along the diagonal that lies inside: from the first corner, unless the quad is
/// concave there.
fn quad([a, b, c, d]: [DVec3; 4]) -> [[u32; 3]; 2] {
    let one = (b - a).cross(c - a);
    let other = (c - a).cross(d - a);
    if one.dot(other) < 0.0 { [[0, 1, 3], [1, 2, 3]] } else { [[0, 1, 2], [0, 2, 3]] }
}

fn fan(corners: usize, out: &mut Vec<[u32; 3]>) {
    out.extend((1..corners as u32 - 1).map(|i| [0, i, i + 1]));
}

fn doubled_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(DVec2::from);
    (b - a).perp_dot(c - a)
}

/// Whether every triangle of the fan from the first corner, and every corner, turns left.
fn is_convex(flat: &[[f64; 2]]) -> bool {
    let count = flat.len();
    let left = |i: usize, j: usize, k: usize| doubled_area([flat[i], flat[j % count], flat[k % count]]) > 0.0;
    (0..count).all(|i| left(i, i + 1, i + 2)) && (1..count - 1).all(|i| left(0, i, i + 1))
}

/// Puts corners that no triangle uses back into the triangle at their edge.
fn insert_left_out(corners: usize, start: usize, out: &mut Vec<[u32; 3]>) {
    let mut used = vec![false; corners];
    out[start..].iter().flatten().for_each(|&i| used[i as usize] = true);
    let Some(first) = used.iter().position(|&u| u) else { return };
    let mut previous = first as u32;
    for step in 1..=corners {
        let corner = (first + step) % corners;
        if !used[corner] {
            let next = (1..corners).map(|n| (corner + n) % corners).find(|&n| used[n]).unwrap_or(first);
            split_edge(previous, corner as u32, next as u32, start, out);
        }
        previous = corner as u32;
    }
}

/// Splits the triangle with the edge `from` -> `to` at `middle`.
fn split_edge(from: u32, middle: u32, to: u32, start: usize, out: &mut Vec<[u32; 3]>) {
    let found = out[start..].iter().enumerate().find_map(|(index, t)| {
        (0..3).find(|&k| t[k] == from && t[(k + 1) % 3] == to).map(|k| (start + index, t[(k + 2) % 3]))
    });
    if let Some((index, tip)) = found {
        out[index] = [from, middle, tip];
        out.push([middle, to, tip]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f64; 3]]) -> Vec<[u32; 3]> {
        let points: Vec<_> = points.iter().map(|&p| DVec3::from(p)).collect();
        let mut out = Vec::new();
        Cutter::new().cut(&points, &mut out);
        out
    }

    fn area_vector(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> (DVec3, f64) {
        let mut sum = DVec3::ZERO;
        let mut absolute = 0.0;
        for t in triangles {
            let [a, b, c] = t.map(|i| DVec3::from(points[i as usize]));
            let area = (b - a).cross(c - a) / 2.0;
            sum += area;
            absolute += area.length();
        }
        (sum, absolute)
    }

    /// A polygon is covered once exactly where the areas' vector sum and their absolute sum agree.
    fn assert_covered(points: &[[f64; 3]], area: f64) {
        let triangles = cut(points);
        assert_eq!(triangles.len(), points.len() - 2);
        let (sum, absolute) = area_vector(points, &triangles);
        assert!((sum.length() - area).abs() < 1e-12 && (absolute - area).abs() < 1e-12, "{sum} {absolute}");
    }

    #[test]
    fn a_concave_quad_is_cut_along_its_inner_diagonal() {
        // Concave at the second corner: the fan from the first would leave the polygon.
        assert_covered(&[[0., 0., 0.], [1., 1., 0.], [2., 0., 0.], [1., 4., 0.]], 3.0);
        assert_covered(&[[1., 1., 0.], [2., 0., 0.], [1., 4., 0.], [0., 0., 0.]], 3.0);
    }

    #[test]
    fn an_l_on_a_slanted_plane_is_covered_once() {
        let flat = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
        for turn in 0..6 {
            let points: Vec<_> = (0..6).map(|i| flat[(i + turn) % 6]).map(|[x, y]| [x, 0.6 * y, 0.8 * y]).collect();
            assert_covered(&points, 3.0);
            let backward: Vec<_> = points.iter().rev().copied().collect();
            assert_covered(&backward, 3.0);
        }
    }

    #[test]
    fn corners_on_straight_edges_keep_their_triangles() {
        let points = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [2., 2., 0.], [1., 1., 0.], [0., 2., 0.], [0., 1., 0.]];
        assert_covered(&points, 3.0);
    }

    #[test]
    fn a_polygon_without_area_gives_its_triangles_too() {
        for count in 3..9 {
            assert_eq!(cut(&vec![[1., 2., 3.]; count]).len(), count - 2);
            let line: Vec<_> = (0..count).map(|i| [i as f64, 0., 0.]).collect();
            assert_eq!(cut(&line).len(), count - 2);
        }
    }

    #[test]
    fn a_doubled_corner_keeps_the_count() {
        let points = [[0., 0., 0.], [2., 0., 0.], [2., 0., 0.], [2., 2., 0.], [1., 0.5, 0.], [0., 2., 0.]];
        assert_eq!(cut(&points).len(), 4);
    }

    #[test]
    fn a_polygon_of_very_many_corners_ends_soon() {
        let side = 20_000;
        let along = |i: usize| i as f64 / side as f64;
        let mut points: Vec<_> = (0..side).map(|i| [along(i), 0.0, 0.0]).collect();
        points.extend((0..side).map(|i| [1.0 - along(i) / 2.0, along(i), 0.0]));
        points.extend((0..side).map(|i| [0.5 - along(i) / 2.0, 1.0 - along(i), 0.0]));
        assert_eq!(cut(&points).len(), points.len() - 2);
    }

    #[test]
    fn a_bow_tie_gives_its_triangles() {
        assert_eq!(cut(&[[0., 0., 0.], [2., 2., 0.], [2., 0., 0.], [0., 2., 0.], [-1., 1., 0.]]).len(), 3);
    }
}
