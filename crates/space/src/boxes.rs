//! A tree of boxes: who is near a place, and who is nearest by a measure of the caller's own.

use glam::DVec3;

/// Boxes below which a node is not split.
const LEAF_SIZE: usize = 4;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least corner.
    pub low: DVec3,
    /// Greatest corner.
    pub high: DVec3,
}

impl Aabb {
    /// A box that holds nothing.
    pub const EMPTY: Aabb = Aabb { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The least box around points; [`Aabb::EMPTY`] around none.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |b, p| Aabb { low: b.low.min(p), high: b.high.max(p) })
    }

    /// Grown by `margin` on every side.
    pub fn grown(self, margin: f64) -> Aabb {
        Aabb { low: self.low - margin, high: self.high + margin }
    }

    /// The least box around both.
    pub fn union(self, other: Aabb) -> Aabb {
        Aabb { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether they share a point.
    pub fn touches(&self, other: &Aabb) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    /// Distance of a point from the box; 0 inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        (self.low - point).max(point - self.high).max(DVec3::ZERO).length()
    }
}

#[derive(Clone, Copy, Debug)]
struct Node {
    around: Aabb,
    /// First entry of a leaf in `order`; else the left child, whose sibling follows it.
    first: u32,
    /// Entries of a leaf; 0 for an inner node.
    count: u32,
}

/// A tree over boxes. The same boxes give the same tree.
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl BoxTree {
    /// Builds the tree over finite boxes.
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree = BoxTree { nodes: Vec::new(), order: (0..boxes.len() as u32).collect() };
        if boxes.is_empty() {
            return tree;
        }
        tree.nodes.push(leaf(&tree.order, boxes, 0));
        let mut pending = vec![(0usize, 0usize, boxes.len())];
        while let Some((node, start, end)) = pending.pop() {
            if end - start <= LEAF_SIZE {
                continue;
            }
            let half = start + (end - start) / 2;
            split(&mut tree.order[start..end], half - start, boxes);
            let left = tree.nodes.len();
            tree.nodes.push(leaf(&tree.order[start..half], boxes, start));
            tree.nodes.push(leaf(&tree.order[half..end], boxes, half));
            tree.nodes[node].first = left as u32;
            tree.nodes[node].count = 0;
            pending.push((left, start, half));
            pending.push((left + 1, half, end));
        }
        tree
    }

    /// Calls `visit` with every entry whose box may touch `around`; a few whose box does not come along.
    pub fn near(&self, around: &Aabb, mut visit: impl FnMut(u32)) {
        let mut stack = Vec::with_capacity(64);
        stack.extend(self.nodes.first().map(|_| 0u32));
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !node.around.touches(around) {
                continue;
            }
            if node.count > 0 {
                self.order[node.first as usize..(node.first + node.count) as usize].iter().for_each(|&e| visit(e));
            } else {
                stack.extend([node.first + 1, node.first]);
            }
        }
    }

    /// The entry of the least `measure` below `limit`; a measure must not be below the distance of `point` from the
    /// entry's box. The lowest entry of equal ones.
    pub fn least(&self, point: DVec3, limit: f64, mut measure: impl FnMut(u32) -> f64) -> Option<(u32, f64)> {
        let mut stack = Vec::with_capacity(64);
        stack.extend(self.nodes.first().map(|root| (0u32, root.around.distance(point))));
        let mut best: Option<(u32, f64)> = None;
        while let Some((index, distance)) = stack.pop() {
            if distance >= limit || best.is_some_and(|(_, least)| distance > least) {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for &entry in &self.order[node.first as usize..(node.first + node.count) as usize] {
                    let value = measure(entry);
                    if value < limit && best.is_none_or(|(e, least)| value < least || (value <= least && entry < e)) {
                        best = Some((entry, value));
                    }
                }
                continue;
            }
            let child = |index: u32| (index, self.nodes[index as usize].around.distance(point));
            let (left, right) = (child(node.first), child(node.first + 1));
            stack.extend(if left.1 <= right.1 { [right, left] } else { [left, right] });
        }
        best
    }
}

/// Puts the `half` boxes with the lowest middles along the longest axis first; ties by index.
fn split(order: &mut [u32], half: usize, boxes: &[Aabb]) {
    let middle = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
    let around = Aabb::around(order.iter().map(|&i| middle(i)));
    let axis = (around.high - around.low).max_position();
    order.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
}

fn leaf(order: &[u32], boxes: &[Aabb], first: usize) -> Node {
    let around = order.iter().fold(Aabb::EMPTY, |all, &i| all.union(boxes[i as usize]));
    Node { around, first: first as u32, count: order.len() as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::radical_inverse;

    fn places(count: u64) -> Vec<DVec3> {
        (1..=count).map(|i| DVec3::from([2, 3, 5].map(|p| radical_inverse(i, p)))).collect()
    }

    fn boxes() -> Vec<Aabb> {
        places(300).into_iter().map(|p| Aabb { low: p, high: p + 0.05 }).collect()
    }

    #[test]
    fn near_finds_every_box_that_touches() {
        let (boxes, tree) = (boxes(), BoxTree::new(&boxes()));
        for place in places(50) {
            let query = Aabb { low: place, high: place }.grown(0.1);
            let mut found = vec![false; boxes.len()];
            tree.near(&query, |e| found[e as usize] = true);
            assert!(boxes.iter().zip(&found).all(|(b, found)| *found || !b.touches(&query)));
        }
    }

    #[test]
    fn least_is_the_least_of_all() {
        let (boxes, tree) = (boxes(), BoxTree::new(&boxes()));
        for place in places(50) {
            let measure = |e: u32| boxes[e as usize].low.distance(place);
            let right = (0..boxes.len() as u32).map(measure).fold(f64::INFINITY, f64::min);
            let (entry, value) = tree.least(place, f64::INFINITY, measure).unwrap();
            assert_eq!((value.to_bits(), measure(entry).to_bits()), (right.to_bits(), right.to_bits()));
        }
        assert!(tree.least(DVec3::ZERO, 0.5, |_| 0.5).is_none());
        assert!(BoxTree::new(&[]).least(DVec3::ZERO, 1.0, |_| 0.0).is_none());
    }
}
