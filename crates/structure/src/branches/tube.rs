//! One connected piece of wood as a chain of capsules: level sets of the way from one end are its rings.

use foliar_plant::Axis;
use foliar_space::Aabb;
use glam::DVec3;
use std::collections::BinaryHeap;

/// A ring whose radii deviate from their mean by more than this share is no ring: the next way is tried.
const ROUND: f64 = 0.30;
/// A fit that is as round as this needs no comparison.
const ROUND_ENOUGH: f64 = 0.05;
/// A point at a tube's end is its cap where it lies nearer to the next ring than this share of its radius.
const FLAT_CAP: f64 = 0.25;

/// A fitted piece. Its axis runs from one end to the other; which is the root is decided later.
#[derive(Clone, Debug)]
pub(super) struct Tube {
    pub axis: Axis,
    /// Arc length of each node of the piece.
    pub arcs: Vec<f64>,
    /// Mean deviation of rings from circles, over their radius.
    pub roughness: f64,
    /// Share of level sets that fall into several parts: forks in one piece.
    pub split: f64,
    pub around: Aabb,
}

impl Tube {
    /// Greater of the radii at both ends: how thick it is where it may hang.
    pub fn thickness(&self) -> f64 {
        self.end_radius(false).max(self.end_radius(true))
    }

    pub fn end_radius(&self, tip: bool) -> f64 {
        self.axis.radii[if tip { self.axis.radii.len() - 1 } else { 0 }]
    }

    pub fn end(&self, tip: bool) -> DVec3 {
        self.axis.points[if tip { self.axis.points.len() - 1 } else { 0 }]
    }

    /// Turned round, so that its axis starts where it ended.
    pub fn turned(mut self) -> Tube {
        let length = self.axis.length();
        self.axis.points.reverse();
        self.axis.radii.reverse();
        self.axis = Axis::new(self.axis.points, self.axis.radii);
        self.arcs.iter_mut().for_each(|arc| *arc = (length - *arc).max(0.0));
        self
    }
}

/// Neighbors of the nodes of one piece.
pub(super) struct Graph<'a> {
    pub points: &'a [DVec3],
    starts: Vec<u32>,
    ends: Vec<u32>,
    /// Each edge once, with its number of faces.
    edges: Vec<(u32, u32, u32)>,
}

impl<'a> Graph<'a> {
    /// Of faces over nodes that start at `first`.
    pub fn new(points: &'a [DVec3], faces: &[[u32; 3]], first: u32) -> Graph<'a> {
        let mut all: Vec<(u32, u32)> = Vec::with_capacity(3 * faces.len());
        for face in faces {
            let [a, b, c] = face.map(|n| n - first);
            all.extend([(a, b), (b, c), (c, a)].into_iter().filter(|(a, b)| a != b).map(|(a, b)| (a.min(b), a.max(b))));
        }
        all.sort_unstable();
        let edges: Vec<(u32, u32, u32)> =
            all.chunk_by(|a, b| a == b).map(|run| (run[0].0, run[0].1, run.len() as u32)).collect();
        let mut starts = vec![0u32; points.len() + 1];
        for &(a, b, _) in &edges {
            starts[a as usize + 1] += 1;
            starts[b as usize + 1] += 1;
        }
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let mut ends = vec![0u32; 2 * edges.len()];
        for &(a, b, _) in &edges {
            for (from, to) in [(a, b), (b, a)] {
                ends[next[from as usize] as usize] = to;
                next[from as usize] += 1;
            }
        }
        Graph { points, starts, ends, edges }
    }

    pub fn neighbors(&self, node: u32) -> &[u32] {
        &self.ends[self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize]
    }

    /// Loops of edges that have one face: the open ends.
    fn margins(&self) -> Vec<Vec<u32>> {
        let open: Vec<(u32, u32)> = self.edges.iter().filter(|e| e.2 == 1).map(|e| (e.0, e.1)).collect();
        let mut nodes: Vec<u32> = open.iter().flat_map(|e| [e.0, e.1]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let index = |n: u32| nodes.partition_point(|&m| m < n) as u32;
        let mut sets = crate::pieces::Sets::new(nodes.len());
        open.iter().for_each(|&(a, b)| sets.join(index(a), index(b)));
        let mut loops: Vec<(u32, Vec<u32>)> = Vec::new();
        let mut of_root = vec![usize::MAX; nodes.len()];
        for (i, &node) in nodes.iter().enumerate() {
            let root = sets.root(i as u32) as usize;
            if of_root[root] == usize::MAX {
                of_root[root] = loops.len();
                loops.push((root as u32, Vec::new()));
            }
            loops[of_root[root]].1.push(node);
        }
        loops.into_iter().map(|l| l.1).collect()
    }

    /// Edges to each node from the nearest of `sources`; `u32::MAX` for what they do not reach.
    fn hops(&self, sources: &[u32]) -> Vec<u32> {
        let mut hops = vec![u32::MAX; self.points.len()];
        sources.iter().for_each(|&s| hops[s as usize] = 0);
        let mut front = sources.to_vec();
        let mut hop = 0;
        while !front.is_empty() {
            hop += 1;
            let mut next = Vec::new();
            for &node in &front {
                for &other in self.neighbors(node) {
                    if hops[other as usize] == u32::MAX {
                        hops[other as usize] = hop;
                        next.push(other);
                    }
                }
            }
            front = next;
        }
        hops
    }

    /// Way along edges to each node from the nearest of `sources`.
    pub fn ways(&self, sources: &[u32]) -> Vec<f64> {
        let mut ways = vec![f64::INFINITY; self.points.len()];
        let mut heap = BinaryHeap::new();
        for &source in sources {
            ways[source as usize] = 0.0;
            heap.push(Step { way: 0.0, node: source });
        }
        while let Some(Step { way, node }) = heap.pop() {
            if way > ways[node as usize] {
                continue;
            }
            for &other in self.neighbors(node) {
                let length = way + self.points[node as usize].distance(self.points[other as usize]);
                if length < ways[other as usize] {
                    ways[other as usize] = length;
                    heap.push(Step { way: length, node: other });
                }
            }
        }
        ways
    }

    /// Mean edge.
    pub fn mean_edge(&self) -> f64 {
        let length = |e: &(u32, u32, u32)| self.points[e.0 as usize].distance(self.points[e.1 as usize]);
        self.edges.iter().map(length).sum::<f64>() / self.edges.len().max(1) as f64
    }

    /// Edges whose ends are in the same level set.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.edges.iter().map(|e| (e.0, e.1))
    }
}

/// An entry of the queue of [`Graph::ways`], the shortest way first.
struct Step {
    way: f64,
    node: u32,
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Step {}
impl PartialOrd for Step {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Step {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        other.way.total_cmp(&self.way).then(other.node.cmp(&self.node))
    }
}

/// Fits one piece by one tube; none where it has no node. A piece whose level sets fall into parts as often as `fork`
/// says comes back as these left it: it is no tube.
pub(super) fn fit(graph: &Graph, fork: f64) -> Option<Tube> {
    if graph.points.is_empty() {
        return None;
    }
    let mut best: Option<Tube> = None;
    for source in sources(graph) {
        let tube = rings(graph, &source);
        if best.as_ref().is_none_or(|b| tube.roughness < b.roughness) {
            best = Some(tube);
        }
        if best.as_ref().is_some_and(|b| b.roughness <= ROUND_ENOUGH) {
            break;
        }
    }
    let best = best?;
    if best.roughness <= ROUND || best.split >= fork {
        return Some(best);
    }
    let bands = super::bands::fit(graph, &best);
    Some(if bands.roughness < best.roughness { bands } else { best })
}

/// Sets of nodes that may be one end of the tube, likeliest first.
fn sources(graph: &Graph) -> Vec<Vec<u32>> {
    let margins = graph.margins();
    let middle = |l: &Vec<u32>| l.iter().map(|&n| graph.points[n as usize]).sum::<DVec3>() / l.len() as f64;
    let middles: Vec<DVec3> = margins.iter().map(middle).collect();
    if margins.len() >= 2 {
        // The pair farthest apart, found by going to the farthest twice; the first is the lexicographically lower.
        let farthest = |from: DVec3| {
            let distance = |i: &usize| middles[*i].distance_squared(from);
            (0..middles.len()).max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let a = farthest(middles[0]);
        let b = farthest(middles[a]);
        return vec![margins[a].clone(), margins[b].clone()];
    }
    let mut sources: Vec<Vec<u32>> = margins.into_iter().collect();
    if sources.is_empty() {
        let degree = |n: u32| graph.neighbors(n).len();
        let count = graph.points.len() as u32;
        if let Some(hub) = (0..count).max_by_key(|&n| (degree(n), std::cmp::Reverse(n))) {
            // The other cap's hub is the one of most neighbors that is no neighbor of the first.
            let others = (0..count).filter(|&n| n != hub && !graph.neighbors(hub).contains(&n));
            let second = others.max_by_key(|&n| (degree(n), std::cmp::Reverse(n)));
            sources.extend([Some(vec![hub]), second.map(|n| vec![n])].into_iter().flatten());
        }
        sources.extend(extremes(graph).into_iter().map(|n| vec![n]));
    }
    sources
}

/// The two nodes farthest from each other along edges, nearly.
pub(super) fn extremes(graph: &Graph) -> [u32; 2] {
    let farthest = |from: u32| {
        let ways = graph.ways(&[from]);
        let reached = (0..ways.len() as u32).filter(|&n| ways[n as usize].is_finite());
        let key = |n: u32| (ways[n as usize], graph.points[n as usize].to_array());
        reached
            .max_by(|&a, &b| {
                key(a).0.total_cmp(&key(b).0).then(key(a).1.partial_cmp(&key(b).1).unwrap_or(std::cmp::Ordering::Equal))
            })
            .unwrap_or(from)
    };
    let a = farthest(0);
    [a, farthest(a)]
}

/// Level sets of the number of edges from `source`: exact rings of a structured tube.
fn rings(graph: &Graph, source: &[u32]) -> Tube {
    let mut levels = graph.hops(source);
    let last = levels.iter().filter(|h| **h != u32::MAX).max().copied().unwrap_or(0);
    levels.iter_mut().for_each(|h| *h = (*h).min(last));
    of_levels(graph, &levels, last as usize + 1)
}

/// The tube whose rings are level sets.
pub(super) fn of_levels(graph: &Graph, levels: &[u32], count: usize) -> Tube {
    let (mut middles, mut sizes) = (vec![DVec3::ZERO; count], vec![0.0f64; count]);
    for (point, &level) in graph.points.iter().zip(levels) {
        middles[level as usize] += *point;
        sizes[level as usize] += 1.0;
    }
    middles.iter_mut().zip(&sizes).for_each(|(m, n)| *m /= n.max(1.0));
    let (mut radii, mut squares) = (vec![0.0f64; count], vec![0.0f64; count]);
    for (point, &level) in graph.points.iter().zip(levels) {
        let distance = point.distance(middles[level as usize]);
        radii[level as usize] += distance;
        squares[level as usize] += distance * distance;
    }
    radii.iter_mut().zip(&sizes).for_each(|(r, n)| *r /= n.max(1.0));
    let roughness = roughness(&radii, &squares, &sizes);
    let split = split_share(graph, levels, &sizes);
    let (axis, arc_of_level) = without_caps(middles, radii);
    let arcs = levels.iter().map(|&level| arc_of_level[level as usize]).collect();
    Tube { axis, arcs, roughness, split, around: Aabb::around(graph.points.iter().copied()) }
}

/// Mean of the rings' deviations over the mean of their radii.
fn roughness(radii: &[f64], squares: &[f64], sizes: &[f64]) -> f64 {
    let rings = radii.iter().zip(squares).zip(sizes).filter(|(_, n)| **n >= 3.0);
    let (deviation, radius) = rings.fold((0.0, 0.0), |(d, r), ((radius, square), n)| {
        (d + (square / n - radius * radius).max(0.0).sqrt(), r + radius)
    });
    if radius > 0.0 { deviation / radius } else { 0.0 }
}

/// Share of level sets that fall into several parts of three nodes or more.
fn split_share(graph: &Graph, levels: &[u32], sizes: &[f64]) -> f64 {
    let mut sets = crate::pieces::Sets::new(levels.len());
    for (a, b) in graph.edges().filter(|(a, b)| levels[*a as usize] == levels[*b as usize]) {
        sets.join(a, b);
    }
    let mut members = vec![0u32; levels.len()];
    (0..levels.len() as u32).for_each(|n| members[sets.root(n) as usize] += 1);
    let mut parts = vec![0u32; sizes.len()];
    members.iter().enumerate().filter(|(_, m)| **m >= 3).for_each(|(n, _)| parts[levels[n] as usize] += 1);
    parts.iter().filter(|p| **p > 1).count() as f64 / sizes.len() as f64
}

/// The axis without the points of flat caps, and the arc length of each level.
fn without_caps(mut middles: Vec<DVec3>, mut radii: Vec<f64>) -> (Axis, Vec<f64>) {
    let levels = middles.len();
    let is_cap = |end: usize, next: usize, middles: &[DVec3], radii: &[f64]| {
        radii[end] < 0.05 * radii[next] && middles[end].distance(middles[next]) < FLAT_CAP * radii[next]
    };
    let last_is_cap = levels > 2 && is_cap(levels - 1, levels - 2, &middles, &radii);
    if last_is_cap {
        middles.pop();
        radii.pop();
    }
    let first_is_cap = middles.len() > 2 && is_cap(0, 1, &middles, &radii);
    if first_is_cap {
        middles.remove(0);
        radii.remove(0);
    }
    let axis = Axis::new(middles, radii);
    let mut arcs = Vec::with_capacity(levels);
    arcs.extend(first_is_cap.then_some(0.0));
    arcs.extend(&axis.arcs);
    arcs.extend(last_is_cap.then_some(axis.length()));
    (axis, arcs)
}
