//! Leaves in a binary tree, split at medians: blocks of sixteen that a kernel sums one by one, and above them nodes
//! that stand for all below by a few moments.

use crate::leaves::Source;
use crate::profile::Profile;
use glam::DVec3;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Leaves of a block; queries that are answered side by side.
pub(crate) const BLOCK: usize = 16;

/// Largest area of a leaf in f32 sums, in squares of the crown's extent: such a leaf hides half of everything from
/// anywhere inside the crown, and larger ones would only overflow.
const MOST_AREA: f64 = 1e12;

/// What stands for the leaves of a subtree. Areas here are over pi.
#[derive(Clone, Debug, Default)]
pub(crate) struct Node {
    /// Box of the centers.
    pub low: DVec3,
    pub high: DVec3,
    /// Mean of the centers by area; the box's middle where there is none.
    pub center: DVec3,
    /// Variance along each axis by area.
    pub variance: DVec3,
    pub area: f64,
    /// Sum of the squares of areas.
    pub squares: f64,
    pub largest: f64,
    /// Squared distance from the center to the box's farthest corner.
    pub radius_squared: f64,
    /// Half the edges of a uniform box with the spread of the leaves themselves, not of their centers alone.
    pub half: DVec3,
    /// What it adds to a depth, f being its share of an octant and d the distance: f m0 / d^2 + (f m1 + f^2 m2) / d^4.
    pub moments: [f32; 3],
    /// Leaves, in the order of the tree.
    pub first: u32,
    pub count: u32,
    /// Index after the subtree; its children follow the node itself.
    pub next: u32,
}

impl Node {
    /// Whether it is a block.
    pub fn is_block(&self) -> bool {
        self.count as usize <= BLOCK
    }

    fn of_block(first: usize, leaves: &[Source], order: &[u32], profile: Profile) -> Node {
        let leaves = || order.iter().map(|&i| &leaves[i as usize]);
        let mut node = Node { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, ..Node::default() };
        let mut moment = DVec3::ZERO;
        for leaf in leaves() {
            let area = capped(leaf.area) / PI;
            node.low = node.low.min(leaf.center);
            node.high = node.high.max(leaf.center);
            node.area += area;
            node.squares += area * area;
            node.largest = node.largest.max(area);
            moment += area * leaf.center;
        }
        node.center = if node.area > 0.0 { moment / node.area } else { node.low.midpoint(node.high) };
        let arm = |leaf: &Source| leaf.center - node.center;
        let squares: DVec3 = leaves().map(|leaf| capped(leaf.area) / PI * arm(leaf) * arm(leaf)).sum();
        node.variance = if node.area > 0.0 { squares / node.area } else { DVec3::ZERO };
        (node.first, node.count) = (first as u32, order.len() as u32);
        node.measured(profile)
    }

    /// What follows from the sums.
    fn measured(self, profile: Profile) -> Node {
        let arm = (self.center - self.low).max(self.high - self.center);
        // A disc turned at random has a quarter of its area over pi as its variance; o = x - 3/8 x^2 with x = a / d^2.
        let (widening, curve) = match profile {
            Profile::Cap if self.area > 0.0 => (0.25 * self.squares / self.area, 0.375 * self.squares),
            _ => (0.0, 0.0),
        };
        // a / d^2 over places spread with variance s^2 along each axis is a / d^2 + a s^2 / d^4: the Laplacian of
        // 1 / d^2 is 2 / d^4.
        let spread = self.area * self.variance.element_sum() / 3.0;
        Node {
            radius_squared: arm.length_squared(),
            half: (3.0 * (self.variance + widening)).map(|square| square.sqrt().max(profile.half_width(0.0))),
            moments: [self.area as f32, (spread - curve) as f32, (0.5 * self.squares) as f32],
            ..self
        }
    }

    fn above(a: &Node, b: &Node, profile: Profile) -> Node {
        let area = a.area + b.area;
        let mix = |x: DVec3, y: DVec3| if area > 0.0 { (a.area * x + b.area * y) / area } else { x.midpoint(y) };
        let center = mix(a.center, b.center);
        let (arm_a, arm_b) = (a.center - center, b.center - center);
        Node {
            low: a.low.min(b.low),
            high: a.high.max(b.high),
            center,
            variance: mix(a.variance + arm_a * arm_a, b.variance + arm_b * arm_b),
            area,
            squares: a.squares + b.squares,
            largest: a.largest.max(b.largest),
            first: a.first,
            count: a.count + b.count,
            ..Node::default()
        }
        .measured(profile)
    }
}

fn capped(area: f64) -> f64 {
    area.min(MOST_AREA)
}

/// Leaves in the order of the tree, array by array.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slots {
    pub position: [Vec<f64>; 3],
    /// Over pi.
    pub area: Vec<f32>,
    /// One over the width of the slab that the leaf fills along each axis.
    pub per_width: Vec<f32>,
    pub group: Vec<u32>,
}

/// All leaves of a plant.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Each node before its children.
    pub nodes: Vec<Node>,
    pub slots: Slots,
    /// Which leaf stands in a slot.
    pub order: Vec<u32>,
    pub profile: Profile,
}

impl Tree {
    /// Sorts leaves.
    pub fn new(sources: &[Source], profile: Profile) -> Tree {
        let centers: Vec<DVec3> = sources.iter().map(|source| source.center).collect();
        let area = |i: u32| sources[i as usize].area;
        let order = sorted(&centers, &|a, b| area(a).total_cmp(&area(b)));
        let mut nodes = vec![Node::default(); nodes_of(order.len())];
        if !order.is_empty() {
            fill(&mut nodes, 0, 0, &order, (sources, profile));
        }
        let leaf = |&i: &u32| &sources[i as usize];
        let per_width = |area: f64| (0.5 / profile.half_width(capped(area))) as f32;
        let axis = |axis: usize| order.iter().map(|i| leaf(i).center[axis]).collect();
        let slots = Slots {
            position: [axis(0), axis(1), axis(2)],
            area: order.iter().map(|i| (capped(leaf(i).area) / PI) as f32).collect(),
            per_width: order.iter().map(|i| per_width(leaf(i).area)).collect(),
            group: order.iter().map(|i| leaf(i).group).collect(),
        };
        Tree { nodes, slots, order, profile }
    }
}

fn nodes_of(leaves: usize) -> usize {
    (2 * leaves.div_ceil(BLOCK)).saturating_sub(1)
}

/// Leaves of the left half: whole blocks.
fn half(count: usize) -> usize {
    count.div_ceil(BLOCK).div_ceil(2) * BLOCK
}

/// Indices of places in an order in which each sixteen in a row are near each other: split at the median of the
/// longest axis. Only where places are counts; `then` decides between places that coincide.
pub(crate) fn sorted(places: &[DVec3], then: &(dyn Fn(u32, u32) -> Ordering + Sync)) -> Vec<u32> {
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    split(&mut order, places, then);
    order
}

fn split(order: &mut [u32], places: &[DVec3], then: &(dyn Fn(u32, u32) -> Ordering + Sync)) {
    /// Below this many a task of its own costs more than it saves.
    const ALONE: usize = 4096;
    let place = |i: u32| places[i as usize];
    let middle = half(order.len());
    let bounds = |(low, high): (DVec3, DVec3), i: &u32| (low.min(place(*i)), high.max(place(*i)));
    let (low, high) = order.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), bounds);
    let axis = if order.is_empty() { 0 } else { (high - low).max_position() };
    let along = |a: &u32, b: &u32| {
        let by = |k: usize| place(*a)[k].total_cmp(&place(*b)[k]);
        by(axis)
            .then_with(|| by((axis + 1) % 3))
            .then_with(|| by((axis + 2) % 3))
            .then_with(|| then(*a, *b))
            .then(a.cmp(b))
    };
    if middle >= order.len() {
        order.sort_unstable_by(along);
        return;
    }
    order.select_nth_unstable_by(middle, along);
    let (left, right) = order.split_at_mut(middle);
    if left.len() < ALONE {
        split(left, places, then);
        split(right, places, then);
    } else {
        rayon::join(|| split(left, places, then), || split(right, places, then));
    }
}

/// Fills the nodes of a subtree whose root has index `root` and whose leaves start at `first`.
fn fill(nodes: &mut [Node], root: u32, first: usize, order: &[u32], leaves: (&[Source], Profile)) {
    let next = root + nodes.len() as u32;
    let middle = half(order.len());
    if middle >= order.len() {
        nodes[0] = Node { next, ..Node::of_block(first, leaves.0, order, leaves.1) };
        return;
    }
    let (top, below) = nodes.split_at_mut(1);
    let (left, right) = below.split_at_mut(nodes_of(middle));
    let to_right = root + 1 + left.len() as u32;
    rayon::join(
        || fill(left, root + 1, first, &order[..middle], leaves),
        || fill(right, to_right, first + middle, &order[middle..], leaves),
    );
    top[0] = Node { next, ..Node::above(&left[0], &right[0], leaves.1) };
}
