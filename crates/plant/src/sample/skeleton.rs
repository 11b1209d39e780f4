//! The skeleton of a tree: space colonization (Runions et al. 2007) in a crown envelope, radii by
//! the pipe model (Shinozaki 1964), chains of nodes that continue through forks.

use super::noise::{signed, unit};
use super::tree::Recipe;
use foliar_numerics::radical_inverse;
use glam::DVec3;
use std::f64::consts::TAU;

/// A point of the skeleton; its parent always stands before it.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Meters, ground at 0.
    pub position: DVec3,
    /// Index of the parent; the root is its own.
    pub parent: usize,
    /// Nodes at and above it.
    pub load: f64,
    /// Radius of the wood, meters.
    pub radius: f64,
}

/// Nodes from a fork to a tip, thickest child first: one tube.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Node indices; the first is the fork on the parent's axis (for the trunk: the ground).
    pub nodes: Vec<usize>,
}

/// Nodes and chains of a tree.
#[derive(Clone, Debug)]
pub struct Skeleton {
    /// Parents first.
    pub nodes: Vec<Node>,
    /// The trunk first.
    pub chains: Vec<Chain>,
}

impl Skeleton {
    /// For each chain the one that its fork stands on; none for the trunk. Parents stand first.
    pub fn parents(&self) -> Vec<Option<u32>> {
        let mut owner = vec![0; self.nodes.len()];
        for (index, chain) in self.chains.iter().enumerate() {
            chain.nodes.iter().skip(usize::from(index > 0)).for_each(|&node| owner[node] = index as u32);
        }
        self.chains.iter().enumerate().map(|(i, chain)| (i > 0).then(|| owner[chain.nodes[0]])).collect()
    }
}

/// Grows the skeleton of a recipe.
pub fn grow(recipe: &Recipe) -> Skeleton {
    let points = attractors(recipe);
    let mut colony = Colony::new(recipe, points);
    colony.trunk(recipe);
    while colony.step(recipe) {}
    let mut nodes = colony.nodes;
    carry(&mut nodes);
    let main = main_children(&nodes);
    for _ in 0..2 {
        straighten(&mut nodes, &main);
    }
    thicken(&mut nodes, recipe);
    let chains = chains(&nodes, &main);
    Skeleton { nodes, chains }
}

/// Radius of the crown at `t` of its height (0 base, 1 top), as a share of its greatest radius.
pub fn profile(t: f64) -> f64 {
    if !(0.0..=1.0).contains(&t) {
        return 0.0;
    }
    // Widest at two fifths of the crown, round below, tapering to a dome.
    let below = libm::pow((t / 0.4).min(1.0), 0.5);
    let above = ((1.0 - t) / 0.6).min(1.0);
    below * libm::pow(above * (2.0 - above), 0.62)
}

/// Points that the tree grows toward: evenly in the crown, denser toward its rim.
fn attractors(recipe: &Recipe) -> Vec<DVec3> {
    let (base, radius) = (recipe.crown_base_m(), recipe.crown_width_m / 2.0);
    let wanted = recipe.attractors();
    let mut points = Vec::with_capacity(wanted);
    let mut index = 0u64;
    while points.len() < wanted {
        index += 1;
        let [x, y, z] = [2, 3, 5].map(|p| radical_inverse(index + (recipe.seed & 0xFFFF), p));
        let (x, z) = (2.0 * x - 1.0, 2.0 * z - 1.0);
        let bearing = libm::atan2(z, x);
        let lobes = 1.0 + 0.10 * libm::sin(3.0 * bearing + 7.0 * y + recipe.seed as f64);
        let share = libm::hypot(x, z) / (profile(y) * lobes).max(1e-9);
        // Light is taken at the rim: the inside of a crown is thin.
        if share < 1.0 && unit(recipe.seed, index) < 0.25 + 0.75 * share * share {
            points.push(DVec3::new(x * radius, base + y * (recipe.height_m - base), z * radius));
        }
    }
    points
}

struct Colony {
    nodes: Vec<Node>,
    points: Vec<DVec3>,
    /// Per point: least [`climb`] from a node, and that node; negative once reached.
    nearest: Vec<(f64, usize)>,
    cells: Vec<Vec<usize>>,
    low: DVec3,
    cell: f64,
    counts: [usize; 3],
    step: f64,
}

impl Colony {
    fn new(recipe: &Recipe, points: Vec<DVec3>) -> Self {
        let step = recipe.step_m();
        let cell = REACH * step;
        let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let counts = ((high - low) / cell).to_array().map(|n| n as usize + 1);
        let mut cells = vec![Vec::new(); counts.iter().product()];
        for (index, point) in points.iter().enumerate() {
            let [x, y, z] = ((point - low) / cell).to_array().map(|n| n as usize);
            cells[(z * counts[1] + y) * counts[0] + x].push(index);
        }
        let nearest = vec![(f64::INFINITY, 0); points.len()];
        Colony { nodes: Vec::new(), points, nearest, cells, low, cell, counts, step }
    }

    /// A trunk that sways a little, from the ground into the crown.
    fn trunk(&mut self, recipe: &Recipe) {
        let top = recipe.crown_base_m() + LEADER * (recipe.height_m - recipe.crown_base_m());
        let steps = (top / self.step).ceil().max(2.0) as usize;
        let phase = unit(recipe.seed, 1) * TAU;
        for index in 0..=steps {
            let t = index as f64 / steps as f64;
            let sway = 0.018 * recipe.height_m * t;
            let offset = DVec3::new(libm::sin(phase + 5.0 * t), 0.0, libm::sin(1.7 * phase + 4.0 * t)) * sway;
            self.add(index.saturating_sub(1), DVec3::Y * (top * t) + offset);
        }
    }

    fn add(&mut self, parent: usize, position: DVec3) {
        let node = self.nodes.len();
        self.nodes.push(Node { position, parent, load: 1.0, radius: 0.0 });
        let corner = |sign: f64| (position + DVec3::splat(sign * self.cell) - self.low) / self.cell;
        let (low, high) = (corner(-1.0).to_array(), corner(1.0).to_array());
        let range = |axis: usize| {
            let last = self.counts[axis] as i64 - 1;
            (low[axis].floor() as i64).max(0)..=(high[axis].floor() as i64).min(last)
        };
        let kill = (KILL * self.step).powi(2);
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    let cell = (z as usize * self.counts[1] + y as usize) * self.counts[0] + x as usize;
                    for &point in &self.cells[cell] {
                        let way = self.points[point] - position;
                        if way.length_squared() < kill {
                            self.nearest[point].0 = -1.0;
                        } else if climb(way) < self.nearest[point].0 {
                            self.nearest[point] = (climb(way), node);
                        }
                    }
                }
            }
        }
    }

    /// One round: each node that is nearest to some point takes a step; false when nothing grows.
    fn step(&mut self, recipe: &Recipe) -> bool {
        let mut pulls = vec![DVec3::ZERO; self.nodes.len()];
        for (point, &(distance, node)) in self.points.iter().zip(&self.nearest) {
            if distance > 0.0 && distance.is_finite() {
                pulls[node] += (point - self.nodes[node].position).normalize_or_zero();
            }
        }
        let before = self.nodes.len();
        for (node, pull) in pulls.into_iter().enumerate().filter(|(_, p)| *p != DVec3::ZERO) {
            let Node { position, parent, .. } = self.nodes[node];
            let along = (position - self.nodes[parent].position).normalize_or_zero();
            let chance = [0, 1, 2].map(|k| signed(recipe.seed + 11, 3 * self.nodes.len() as u64 + k));
            let turn = pull.normalize_or_zero() + 0.35 * along + 0.30 * DVec3::from(chance) + 0.06 * DVec3::Y;
            let next = position + turn.normalize_or(DVec3::Y) * self.step;
            let crowded = self.nodes[node + 1..]
                .iter()
                .rev()
                .take(before - node)
                .any(|n| n.parent == node && n.position.distance_squared(next) < (0.5 * self.step).powi(2));
            if !crowded {
                self.add(node, next);
            }
        }
        self.nodes.len() > before && self.nodes.len() < recipe.most_nodes()
    }
}

/// Reach of a point's pull, in steps.
const REACH: f64 = 9.0;
/// Distance at which a point is reached, in steps.
const KILL: f64 = 1.6;
/// How far the trunk goes up into the crown before the crown's points lead.
const LEADER: f64 = 0.45;

/// How far a way is for a branch: boughs rise, so the shortest way climbs by half of what it goes aside.
fn climb(way: DVec3) -> f64 {
    let aside = libm::hypot(way.x, way.z);
    aside * aside + (way.y - 0.5 * aside).powi(2)
}

/// Load of each node: itself and everything above.
fn carry(nodes: &mut [Node]) {
    for index in (1..nodes.len()).rev() {
        let (parent, load) = (nodes[index].parent, nodes[index].load);
        nodes[parent].load += load;
    }
}

/// The child that carries most, per node.
fn main_children(nodes: &[Node]) -> Vec<Option<usize>> {
    let mut main: Vec<Option<usize>> = vec![None; nodes.len()];
    for (index, node) in nodes.iter().enumerate().skip(1) {
        if main[node.parent].is_none_or(|best| nodes[best].load < node.load) {
            main[node.parent] = Some(index);
        }
    }
    main
}

/// Pulls every inner node a little toward the line between its neighbors.
fn straighten(nodes: &mut [Node], main: &[Option<usize>]) {
    let before: Vec<DVec3> = nodes.iter().map(|n| n.position).collect();
    for (index, node) in nodes.iter_mut().enumerate().skip(1) {
        if let Some(child) = main[index] {
            node.position = 0.5 * before[index] + 0.25 * (before[node.parent] + before[child]);
        }
    }
}

/// Radii by the pipe model: r = tip * load^(1/n), n such that the trunk has its radius.
fn thicken(nodes: &mut [Node], recipe: &Recipe) {
    let (tip, trunk) = (recipe.twig_radius_m(), recipe.trunk_radius_m());
    let power = libm::log(trunk / tip) / libm::log(nodes[0].load.max(2.0));
    nodes.iter_mut().for_each(|node| node.radius = tip * libm::pow(node.load, power));
}

fn chains(nodes: &[Node], main: &[Option<usize>]) -> Vec<Chain> {
    let starts = (0..nodes.len()).filter(|&n| n == 0 || main[nodes[n].parent] != Some(n));
    let chain = |start: usize| {
        let fork = (start > 0).then(|| nodes[start].parent);
        let run = std::iter::successors(Some(start), |&n| main[n]);
        Chain { nodes: fork.into_iter().chain(run).collect() }
    };
    starts.map(chain).collect()
}
