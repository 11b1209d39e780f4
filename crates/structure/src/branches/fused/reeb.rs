//! The Reeb graph of the way along the surface: connected parts of bands, joined where they touch. At a fork the
//! thickest, straightest, longest goes on.

use super::ring;
use crate::branches::tube::Graph;
use crate::pieces::Sets;
use glam::DVec3;

/// A fork is looked at so many radii further on, beyond the web between its arms.
const AHEAD: f64 = 2.5;
/// What leaves a branch for less than so many of its radii is a bump, no branch.
const BUMP: f64 = 1.0;
/// Weight of straightness (a cosine) beside the logarithm of the radius.
const STRAIGHT: f64 = 1.0;
/// Weight of the logarithm of the length that is left.
const LENGTH: f64 = 0.5;
/// Rings behind a fork whose least radius is that of the branch: the fork's own is swollen.
const BEHIND: usize = 4;
/// No part.
const NONE: u32 = u32::MAX;

/// Connected parts of bands.
pub(super) struct Reeb {
    /// Part that lies below.
    parent: Vec<u32>,
    children: Vec<Vec<u32>>,
    nodes: Vec<Vec<u32>>,
    center: Vec<DVec3>,
    radius: Vec<f64>,
    /// Least way of the part's nodes, and greatest way in all that hangs on it.
    way: Vec<f64>,
    reach: Vec<f64>,
    /// Parts from the foot outward.
    order: Vec<u32>,
}

/// Branches as runs of parts.
#[derive(Default)]
pub(super) struct Forks {
    /// Branch that it forks from.
    pub parent: Vec<Option<u32>>,
    /// Centers and radii of the parts that it runs through.
    pub rings: Vec<Vec<(DVec3, f64)>>,
    /// Per node: branch.
    pub of_node: Vec<u32>,
}

impl Reeb {
    /// Of a piece whose nodes all have a way; bands are `band` wide.
    pub fn new(graph: &Graph, ways: &[f64], band: f64) -> Reeb {
        let level = |n: u32| if ways[n as usize].is_finite() { (ways[n as usize] / band) as u32 } else { 0 };
        let mut sets = Sets::new(ways.len());
        graph.edges().filter(|(a, b)| level(*a) == level(*b)).for_each(|(a, b)| sets.join(a, b));
        // The first band is the foot, however it falls apart.
        let foot: Vec<u32> = (0..ways.len() as u32).filter(|&n| level(n) == 0).collect();
        foot.windows(2).for_each(|pair| sets.join(pair[0], pair[1]));
        let mut part = vec![NONE; ways.len()];
        let mut nodes: Vec<Vec<u32>> = Vec::new();
        for node in 0..ways.len() as u32 {
            let root = sets.root(node) as usize;
            if part[root] == NONE {
                part[root] = nodes.len() as u32;
                nodes.push(Vec::new());
            }
            part[node as usize] = part[root];
            nodes[part[root] as usize].push(node);
        }
        let parent = parents(graph, ways, &part, &nodes);
        let rings = nodes.iter().map(|list| ring(graph.points, list));
        let (center, radius) = rings.unzip();
        let way = nodes.iter().map(|list| list.iter().map(|&n| ways[n as usize]).fold(f64::INFINITY, f64::min));
        let way: Vec<f64> = way.collect();
        let mut order: Vec<u32> = (0..nodes.len() as u32).collect();
        order.sort_by(|&a, &b| way[a as usize].total_cmp(&way[b as usize]).then(a.cmp(&b)));
        let finite = |n: &u32| ways[*n as usize].is_finite();
        let far = |list: &Vec<u32>| list.iter().filter(|n| finite(n)).map(|&n| ways[n as usize]).fold(0.0, f64::max);
        let mut reach: Vec<f64> = nodes.iter().map(far).collect();
        let mut children = vec![Vec::new(); nodes.len()];
        for &own in order.iter().rev().filter(|&&p| parent[p as usize] != NONE) {
            let below = parent[own as usize] as usize;
            reach[below] = reach[below].max(reach[own as usize]);
            children[below].push(own);
        }
        Reeb { parent, children, nodes, center, radius, way, reach, order }
    }

    /// Branches, the one from the foot first, parents before children.
    pub fn branches(&self, points: &[DVec3]) -> Forks {
        let next = self.next();
        let mut forks = Forks { of_node: vec![0; points.len()], ..Forks::default() };
        let mut of_part = vec![NONE; self.nodes.len()];
        for &part in &self.order {
            let below = self.parent[part as usize];
            let branch = if below == NONE {
                if forks.rings.is_empty() { self.start(part, None, &next, &mut forks) } else { 0 }
            } else {
                let bearer = of_part[below as usize];
                let goes_on = next[below as usize] == part;
                let is_own = goes_on || !self.is_branch(part, below) || self.is_off(below, bearer, &of_part, &next);
                if is_own { bearer } else { self.start(part, Some(bearer), &next, &mut forks) }
            };
            of_part[part as usize] = branch;
            self.nodes[part as usize].iter().for_each(|&n| forks.of_node[n as usize] = branch);
        }
        forks
    }

    /// Whether a part is a bump's: it does not lie on the run of its branch, so nothing forks from it.
    fn is_off(&self, part: u32, branch: u32, of_part: &[u32], next: &[u32]) -> bool {
        let below = self.parent[part as usize];
        below != NONE && of_part[below as usize] == branch && next[below as usize] != part
    }

    /// Whether what forks off here is long enough.
    fn is_branch(&self, part: u32, below: u32) -> bool {
        self.reach[part as usize] - self.way[part as usize] > BUMP * self.radius_behind(below)
    }

    fn start(&self, part: u32, parent: Option<u32>, next: &[u32], forks: &mut Forks) -> u32 {
        let run = std::iter::successors(Some(part), |&p| Some(next[p as usize]).filter(|&n| n != NONE));
        forks.rings.push(run.map(|p| (self.center[p as usize], self.radius[p as usize])).collect());
        forks.parent.push(parent);
        forks.rings.len() as u32 - 1
    }

    /// For each part the one above it that goes on.
    fn next(&self) -> Vec<u32> {
        let mut next = vec![NONE; self.nodes.len()];
        for &part in self.order.iter().rev() {
            let score = |&child: &u32| self.score(part, child, &next);
            let best = self.children[part as usize].iter().map(|c| (score(c), *c));
            // Of equal ones the first node's wins.
            let best = best.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            next[part as usize] = best.map_or(NONE, |b| b.1);
        }
        next
    }

    fn score(&self, part: u32, child: u32, next: &[u32]) -> f64 {
        let radius = self.radius_behind(part);
        let far = self.way[child as usize] + AHEAD * radius;
        let mut ahead = child;
        while next[ahead as usize] != NONE && self.way[ahead as usize] < far {
            ahead = next[ahead as usize];
        }
        let mut behind = part;
        while self.parent[behind as usize] != NONE
            && self.way[behind as usize] > self.way[part as usize] - AHEAD * radius
        {
            behind = self.parent[behind as usize];
        }
        let place = |p: u32| self.center[p as usize];
        let (inward, outward) = (place(part) - place(behind), place(ahead) - place(part));
        let cosine = inward.normalize_or_zero().dot(outward.normalize_or_zero());
        let left = (self.reach[child as usize] - self.way[child as usize]).max(f64::MIN_POSITIVE);
        let thick = self.radius[ahead as usize].max(f64::MIN_POSITIVE);
        libm::log(thick) + STRAIGHT * cosine + LENGTH * libm::log(left)
    }

    /// Radius of the branch that a part lies on.
    fn radius_behind(&self, part: u32) -> f64 {
        let below = std::iter::successors(Some(part), |&p| Some(self.parent[p as usize]).filter(|&b| b != NONE));
        below.take(BEHIND).map(|p| self.radius[p as usize]).fold(f64::INFINITY, f64::min)
    }
}

/// For each part the part below that most of its edges lead to; of equal ones the nearer to the foot's other end.
fn parents(graph: &Graph, ways: &[f64], part: &[u32], nodes: &[Vec<u32>]) -> Vec<u32> {
    let least: Vec<f64> =
        nodes.iter().map(|list| list.iter().map(|&n| ways[n as usize]).fold(f64::INFINITY, f64::min)).collect();
    let mut down: Vec<(u32, u32)> = graph
        .edges()
        .map(|(a, b)| (part[a as usize], part[b as usize]))
        .filter(|(a, b)| a != b)
        .map(|(a, b)| if least[a as usize] < least[b as usize] { (b, a) } else { (a, b) })
        .collect();
    down.sort_unstable();
    let mut best = vec![(0usize, NONE); nodes.len()];
    for run in down.chunk_by(|a, b| a == b) {
        let slot = &mut best[run[0].0 as usize];
        if run.len() > slot.0 {
            *slot = (run.len(), run[0].1);
        }
    }
    best.into_iter().map(|slot| slot.1).collect()
}
