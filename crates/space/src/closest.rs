//! Closest points on triangles: best-first descent of a box tree, pruned by the best distance so far.

use glam::Vec3;

/// Triangles below which a node is not split.
const LEAF_SIZE: usize = 4;

/// The point of a triangle set nearest to a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The point.
    pub point: Vec3,
    /// Its squared distance from the query.
    pub distance_squared: f32,
    /// Index of the triangle that it lies on.
    pub triangle: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    /// First triangle of a leaf in `order`; else the left child, whose sibling follows it.
    first: u32,
    /// Triangles of a leaf; 0 for an inner node.
    count: u32,
}

/// A triangle while the tree is built: what is looked at together lies together.
#[derive(Clone, Copy, Debug)]
struct Item {
    middle: Vec3,
    index: u32,
}

impl Node {
    /// A leaf whose box is not known yet.
    fn of(start: usize, count: usize) -> Self {
        Node { low: Vec3::ZERO, high: Vec3::ZERO, first: start as u32, count: count as u32 }
    }

    #[inline]
    fn distance_squared(&self, point: Vec3) -> f32 {
        (self.low - point).max(point - self.high).max(Vec3::ZERO).length_squared()
    }
}

/// A box tree over triangles. Triangles without area, down to single points, are as good as others.
/// Coordinates are f32: give them relative to the plant's center.
#[derive(Clone, Debug, Default)]
pub struct TriangleTree {
    nodes: Vec<Node>,
    /// Corners in the order of the tree's leaves.
    corners: Vec<[Vec3; 3]>,
    /// Index of each of them as it was given.
    order: Vec<u32>,
}

impl TriangleTree {
    /// Builds the tree. Every coordinate must be finite. The same input gives the same tree.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        TriangleTree::halved(triangles, split)
    }

    /// Builds the tree by halving the list as it stands: many times faster, and as good where neighbors in the list
    /// are neighbors in space, as in Morton order. Finds the same in any order.
    pub fn in_order(triangles: &[[Vec3; 3]]) -> Self {
        TriangleTree::halved(triangles, |_, _| {})
    }

    /// Builds the tree by halves that `split` puts in order.
    fn halved(triangles: &[[Vec3; 3]], split: impl Fn(&mut [Item], usize)) -> Self {
        let mut tree = TriangleTree::default();
        if triangles.is_empty() {
            return tree;
        }
        let middle = |(index, t): (u32, &[Vec3; 3])| Item { middle: (t[0] + t[1] + t[2]) / 3.0, index };
        let mut items: Vec<Item> = (0..).zip(triangles).map(middle).collect();
        tree.nodes.push(Node::of(0, items.len()));
        let mut pending = vec![0usize];
        while let Some(node) = pending.pop() {
            let (start, count) = (tree.nodes[node].first as usize, tree.nodes[node].count as usize);
            if count <= LEAF_SIZE {
                continue;
            }
            split(&mut items[start..start + count], count / 2);
            let left = tree.nodes.len();
            tree.nodes.extend([Node::of(start, count / 2), Node::of(start + count / 2, count - count / 2)]);
            (tree.nodes[node].first, tree.nodes[node].count) = (left as u32, 0);
            pending.extend([left, left + 1]);
        }
        tree.order = items.iter().map(|item| item.index).collect();
        tree.corners = tree.order.iter().map(|&i| triangles[i as usize]).collect();
        tree.bound();
        tree
    }

    /// Boxes from the leaves up: children stand behind their parents.
    fn bound(&mut self) {
        for at in (0..self.nodes.len()).rev() {
            let Node { first, count, .. } = self.nodes[at];
            let (first, none) = (first as usize, (Vec3::INFINITY, Vec3::NEG_INFINITY));
            let (low, high) = if count == 0 {
                let [a, b] = [self.nodes[first], self.nodes[first + 1]];
                (a.low.min(b.low), a.high.max(b.high))
            } else {
                let corners = self.corners[first..first + count as usize].iter().flatten();
                corners.fold(none, |(low, high), p| (low.min(*p), high.max(*p)))
            };
            (self.nodes[at].low, self.nodes[at].high) = (low, high);
        }
    }

    /// Whether there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// The nearest point, or `None` where there are no triangles. Of triangles at exactly the same
    /// distance any may be named, always the same one for the same tree.
    pub fn closest(&self, point: Vec3) -> Option<Closest> {
        self.closest_within(point, f32::INFINITY)
    }

    /// The nearest point whose squared distance is below `limit_squared`, if there is one.
    pub fn closest_within(&self, point: Vec3, limit_squared: f32) -> Option<Closest> {
        // Halving splits keep the depth at log2 of the count, at most 30 for 2^32 triangles in leaves of four.
        let mut stack = [(0u32, 0.0f32); 64];
        let mut depth = 0;
        let (mut best, mut limit) = (None, limit_squared);
        if let Some(root) = self.nodes.first() {
            stack[0] = (0, root.distance_squared(point));
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (index, distance) = stack[depth];
            if distance >= limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                self.scan_leaf(node, point, &mut limit, &mut best);
                continue;
            }
            let child = |index: u32| (index, self.nodes[index as usize].distance_squared(point));
            let (left, right) = (child(node.first), child(node.first + 1));
            let (near, far) = if left.1 <= right.1 { (left, right) } else { (right, left) };
            if far.1 < limit {
                stack[depth] = far;
                depth += 1;
            }
            if near.1 < limit {
                stack[depth] = near;
                depth += 1;
            }
        }
        best
    }

    fn scan_leaf(&self, node: &Node, point: Vec3, limit: &mut f32, best: &mut Option<Closest>) {
        for slot in node.first as usize..(node.first + node.count) as usize {
            let on = closest_on_triangle(point, self.corners[slot]);
            let distance_squared = on.distance_squared(point);
            if distance_squared < *limit {
                *limit = distance_squared;
                *best = Some(Closest { point: on, distance_squared, triangle: self.order[slot] });
            }
        }
    }
}

/// Puts the `half` triangles with the lowest middles along the longest axis first; ties by index.
fn split(items: &mut [Item], half: usize) {
    let (low, high) = items
        .iter()
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), i| (low.min(i.middle), high.max(i.middle)));
    let axis = (high - low).max_position();
    items.select_nth_unstable_by(half, |a, b| a.middle[axis].total_cmp(&b.middle[axis]).then(a.index.cmp(&b.index)));
}

/// The point of a triangle nearest to `point`. Any triangle will do: where the plane says nothing
/// (no area), the edges answer.
pub fn closest_on_triangle(point: Vec3, [a, b, c]: [Vec3; 3]) -> Vec3 {
    let (ab, ac, from) = (b - a, c - a, point - a);
    let normal = ab.cross(ac);
    // Barycentric coordinates of the foot, times the squared normal.
    let square = normal.length_squared();
    let across = from.cross(normal);
    let (w_b, w_c) = (-ac.dot(across), ab.dot(across));
    let w_a = square - w_b - w_c;
    if w_a > 0.0 && w_b > 0.0 && w_c > 0.0 {
        return a + ab * (w_b / square) + ac * (w_c / square);
    }
    // The foot lies beyond one edge, or two: the nearest point is on one of those.
    let (mut best, mut least) = (a, f32::INFINITY);
    for (beyond, start, end) in [(w_c, a, b), (w_a, b, c), (w_b, c, a)] {
        if beyond <= 0.0 {
            let on = closest_on_segment(point, start, end);
            let distance = on.distance_squared(point);
            if distance < least {
                (best, least) = (on, distance);
            }
        }
    }
    best
}

/// The point of a segment nearest to `point`.
pub fn closest_on_segment(point: Vec3, from: Vec3, to: Vec3) -> Vec3 {
    let along = to - from;
    let square = along.length_squared();
    if square > 0.0 { from + along * ((point - from).dot(along) / square).clamp(0.0, 1.0) } else { from }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::r2_point;

    /// A point of the cube of edge 2, one of a low-discrepancy set.
    fn cube_point(index: u64) -> Vec3 {
        let (p, q) = (r2_point(index), r2_point(index.wrapping_mul(7919).wrapping_add(13)));
        Vec3::new(p.x as f32, p.y as f32, q.x as f32) * 2.0 - 1.0
    }

    fn soup(count: u64, size: f32) -> Vec<[Vec3; 3]> {
        (0..count)
            .map(|i| {
                let corner = cube_point(4 * i);
                [corner, corner + cube_point(4 * i + 1) * size, corner + cube_point(4 * i + 2) * size]
            })
            .collect()
    }

    fn brute(triangles: &[[Vec3; 3]], point: Vec3) -> f32 {
        triangles.iter().map(|&t| closest_on_triangle(point, t).distance_squared(point)).fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn the_tree_finds_what_a_search_over_all_triangles_finds() {
        let triangles = soup(500, 0.3);
        let trees = [TriangleTree::new(&triangles), TriangleTree::in_order(&triangles)];
        for (query, tree) in (0..300).flat_map(|query| trees.iter().map(move |tree| (query, tree))) {
            let point = cube_point(9000 + query) * 2.0;
            let found = tree.closest(point).unwrap();
            assert_eq!(found.distance_squared.to_bits(), brute(&triangles, point).to_bits());
            let on = closest_on_triangle(point, triangles[found.triangle as usize]);
            assert_eq!(on, found.point);
        }
    }

    #[test]
    fn the_foot_on_a_triangle_is_right_in_every_region() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        for (point, foot) in [
            (Vec3::new(0.25, 0.25, 3.0), Vec3::new(0.25, 0.25, 0.0)),
            (Vec3::new(-1.0, -1.0, 1.0), Vec3::ZERO),
            (Vec3::new(0.5, -2.0, 0.0), Vec3::new(0.5, 0.0, 0.0)),
            (Vec3::new(2.0, 2.0, -1.0), Vec3::new(0.5, 0.5, 0.0)),
            (Vec3::new(5.0, 0.0, 0.0), Vec3::X),
        ] {
            // The coordinates are sums of a few halves: exact.
            assert_eq!(closest_on_triangle(point, triangle), foot, "{point}");
        }
    }

    #[test]
    fn points_and_needles_are_triangles_too() {
        let spot = Vec3::new(1.0, 2.0, 3.0);
        let tree = TriangleTree::new(&[[spot; 3], [Vec3::ZERO, Vec3::X, Vec3::X * 2.0]]);
        assert_eq!(tree.closest(Vec3::new(1.0, 2.0, 4.0)).unwrap().point, spot);
        assert_eq!(tree.closest(Vec3::new(1.5, -1.0, 0.0)).unwrap().point, Vec3::X * 1.5);
    }

    #[test]
    fn equal_triangles_by_the_thousand_make_a_tree_all_the_same() {
        let tree = TriangleTree::new(&vec![[Vec3::ONE; 3]; 5000]);
        assert_eq!(tree.closest(Vec3::ZERO).unwrap().point, Vec3::ONE);
    }

    #[test]
    fn a_limit_is_kept_and_nothing_has_no_closest_point() {
        let tree = TriangleTree::new(&[[Vec3::X; 3]]);
        assert!(tree.closest_within(Vec3::ZERO, 1.0).is_none());
        assert!(tree.closest_within(Vec3::ZERO, 1.5).is_some());
        assert!(TriangleTree::new(&[]).closest(Vec3::ZERO).is_none());
    }
}
