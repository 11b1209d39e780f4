//! Who may hang on whom, and what it costs: contact is measured at the ends of a piece against the capsules
//! of the others.

use super::arborescence::Edge;
use super::tube::Tube;
use foliar_space::{Aabb, BoxTree};
use glam::DVec3;
use rayon::prelude::*;

/// A gap of more than so many of the child's radii is no contact.
const REACH: f64 = 4.0;
/// Parents that are weighed for each branch.
const CANDIDATES: usize = 12;
/// Costs that differ by less say nothing (the limit of the Occam pass).
const TIE: f64 = 0.06;
/// Cost in whole steps: a billionth of the unit.
const STEPS: f64 = 1e9;
/// Radii below this share of the wood's diagonal count as it.
const LEAST_RADIUS: f64 = 1e-9;

/// Weights of the costs; measured on trees whose hierarchy is known.
mod weight {
    /// Of the distance from the parent's axis, in its radii.
    pub const AXIS: f64 = 0.5;
    /// The most that it may cost.
    pub const AXIS_LIMIT: f64 = 2.0;
    /// Of a logarithm of radii, squared.
    pub const RATIO: f64 = 4.0;
    /// The most that it may cost.
    pub const RATIO_LIMIT: f64 = 1.5;
    /// A child may be thicker than its parent by this much (ln 1.3) for nothing.
    pub const FAT: f64 = 0.26;
}

/// Costs of standing on the ground instead of on a branch.
mod ground {
    /// On the level of the stem's foot.
    pub const FOOT: f64 = 0.6;
    /// That level is so many heights of the wood thick.
    pub const LEVEL: f64 = 0.02;
    /// Above or below it.
    pub const AIR: f64 = 20.0;
    /// More for each height of the wood.
    pub const HEIGHT: f64 = 12.0;
    /// Per logarithm of how much thinner it is than the stem.
    pub const THIN: f64 = 0.3;
}

/// A possible parent of one tube.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// Index of the parent; the number of tubes for the ground.
    pub parent: u32,
    /// What it costs.
    pub cost: i64,
    /// Whether the end of the child's axis, not its start, is the root.
    pub from_tip: bool,
    /// Distance between both barks, in radii of the child.
    pub gap: f64,
}

/// All capsules of all tubes in a tree.
pub(super) struct Capsules<'a> {
    tubes: &'a [Tube],
    /// Tube and lower point of each capsule.
    owners: Vec<(u32, u32)>,
    tree: BoxTree,
}

impl<'a> Capsules<'a> {
    pub fn new(tubes: &'a [Tube]) -> Capsules<'a> {
        let (mut owners, mut boxes) = (Vec::new(), Vec::new());
        for (index, tube) in tubes.iter().enumerate() {
            let axis = &tube.axis;
            for low in 0..axis.points.len().saturating_sub(1).max(1) {
                let high = (low + 1).min(axis.points.len() - 1);
                owners.push((index as u32, low as u32));
                boxes.push(
                    Aabb::around([axis.points[low], axis.points[high]]).grown(axis.radii[low].max(axis.radii[high])),
                );
            }
        }
        Capsules { tubes, owners, tree: BoxTree::new(&boxes) }
    }

    /// Distance from a capsule's axis, and the capsule's radius there.
    fn distance(&self, entry: u32, point: DVec3) -> (f64, f64) {
        let (tube, low) = self.owners[entry as usize];
        let axis = &self.tubes[tube as usize].axis;
        let low = low as usize;
        let high = (low + 1).min(axis.points.len() - 1);
        let (a, b) = (axis.points[low], axis.points[high]);
        let along = b - a;
        let square = along.length_squared();
        let share = if square > 0.0 { ((point - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
        (point.distance(a + along * share), axis.radii[low] + (axis.radii[high] - axis.radii[low]) * share)
    }

    /// What one end of a tube is in contact with: (tube, gap, distance from the axis, radius there).
    fn contacts(&self, child: u32, point: DVec3, thickness: f64) -> Vec<(u32, f64, f64, f64)> {
        let mut found: Vec<(u32, f64, f64, f64)> = Vec::new();
        self.tree.near(&Aabb::around([point]).grown(REACH * thickness), |entry| {
            let parent = self.owners[entry as usize].0;
            if parent != child {
                let (distance, radius) = self.distance(entry, point);
                let gap = (distance - radius).max(0.0) / thickness;
                if gap <= REACH {
                    found.push((parent, gap, distance, radius));
                }
            }
        });
        found.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.2.total_cmp(&b.2)));
        let each = found.chunk_by(|a, b| a.0 == b.0);
        each.map(|run| (run[0].0, run.iter().map(|c| c.1).fold(f64::INFINITY, f64::min), run[0].2, run[0].3)).collect()
    }
}

/// The frame of all costs.
pub(super) struct Ground {
    stem: u32,
    foot: f64,
    height: f64,
    stem_radius: f64,
    least_radius: f64,
}

impl Ground {
    /// Chooses the stem: thick at its lower end, and that end low.
    pub fn new(tubes: &[Tube]) -> Ground {
        let around = tubes.iter().fold(Aabb::EMPTY, |all, t| all.union(t.around));
        let size = around.high - around.low;
        let (height, least_radius) = (size.y.max(f64::MIN_POSITIVE), LEAST_RADIUS * size.length());
        let low_end = |t: &Tube| t.end(t.end(true).y < t.end(false).y).y;
        let base_radius = |t: &Tube| t.end_radius(t.end(true).y < t.end(false).y).max(least_radius);
        let score = |t: &Tube| libm::log(base_radius(t)) - 1.5 * (low_end(t) - around.low.y) / height;
        let stem = (0..tubes.len()).max_by(|&a, &b| score(&tubes[a]).total_cmp(&score(&tubes[b])).then(b.cmp(&a)));
        let stem = stem.unwrap_or(0);
        let (foot, stem_radius) = tubes.get(stem).map_or((0.0, 0.0), |t| (low_end(t), base_radius(t)));
        Ground { stem: stem as u32, foot, height, stem_radius, least_radius }
    }

    pub fn stem(&self) -> u32 {
        self.stem
    }

    /// Whether an end of a tube stands on the level of the stem's foot.
    pub fn is_foot(&self, tube: &Tube, tip: bool) -> bool {
        (tube.end(tip).y - self.foot).abs() < (ground::LEVEL * self.height).max(tube.thickness())
    }

    /// The root end is the thick one.
    fn taper(&self, tube: &Tube, tip: bool) -> f64 {
        let ratio = tube.end_radius(!tip).max(self.least_radius) / tube.end_radius(tip).max(self.least_radius);
        (weight::RATIO * libm::log(ratio).max(0.0).powi(2)).min(weight::RATIO_LIMIT)
    }

    /// The cost of growing from the ground.
    fn candidate(&self, index: u32, tube: &Tube, tubes: usize) -> Candidate {
        let cost = |tip: bool| {
            let rise = (tube.end(tip).y - self.foot).abs() / self.height;
            let place = if self.is_foot(tube, tip) { ground::FOOT } else { ground::AIR + ground::HEIGHT * rise };
            let thin = libm::log(self.stem_radius / tube.thickness().max(self.least_radius)).max(0.0);
            place + self.taper(tube, tip) + ground::THIN * thin
        };
        let from_tip = cost(true) < cost(false);
        let cost = if index == self.stem { 0.0 } else { cost(from_tip) };
        let from_tip = if index == self.stem { tube.end(true).y < tube.end(false).y } else { from_tip };
        Candidate { parent: tubes as u32, cost: steps(cost), from_tip, gap: 0.0 }
    }

    fn cost(&self, tube: &Tube, tip: bool, (_, gap, distance, radius): (u32, f64, f64, f64)) -> f64 {
        let (parent, own) = (radius.max(self.least_radius), tube.end_radius(tip).max(self.least_radius));
        let fat = (libm::log(own / parent) - weight::FAT).max(0.0);
        gap * gap
            + weight::AXIS * (distance / parent).min(weight::AXIS_LIMIT)
            + (weight::RATIO * fat * fat).min(weight::RATIO_LIMIT)
            + self.taper(tube, tip)
    }
}

fn steps(cost: f64) -> i64 {
    (cost * STEPS).round() as i64
}

/// A cost as a number again.
pub(super) fn unit(cost: i64) -> f64 {
    cost as f64 / STEPS
}

/// Possible parents of every tube, cheapest first, the ground among them.
pub(super) fn candidates(tubes: &[Tube], capsules: &Capsules, ground: &Ground) -> Vec<Vec<Candidate>> {
    let of = |(index, tube): (usize, &Tube)| {
        let thickness = tube.thickness().max(ground.least_radius);
        let mut list: Vec<Candidate> = Vec::new();
        for tip in [false, true] {
            for contact in capsules.contacts(index as u32, tube.end(tip), thickness) {
                let cost = steps(ground.cost(tube, tip, contact));
                list.push(Candidate { parent: contact.0, cost, from_tip: tip, gap: contact.1 });
            }
        }
        list.sort_by_key(|c| (c.cost, c.parent, c.from_tip));
        let mut kept: Vec<Candidate> = Vec::with_capacity(CANDIDATES + 2);
        for candidate in list {
            if kept.iter().all(|k| k.parent != candidate.parent) {
                kept.push(candidate);
            }
        }
        keep_few(&mut kept, tubes);
        kept.push(ground.candidate(index as u32, tube, tubes.len()));
        kept.sort_by_key(|c| (c.cost, c.parent));
        kept
    };
    tubes.par_iter().enumerate().map(of).collect()
}

/// The cheapest, and beside them the thickest of those that cost as good as nothing more: where many are born at
/// one place, what bears them must not drop out.
fn keep_few(list: &mut Vec<Candidate>, tubes: &[Tube]) {
    let Some(best) = list.first().map(|c| c.cost) else { return };
    let equal = list.iter().filter(|c| unit(c.cost - best) <= TIE);
    let thickness = |c: &Candidate| tubes[c.parent as usize].thickness();
    let thickest = equal.copied().reduce(|a, b| if thickness(&b) > thickness(&a) { b } else { a });
    list.truncate(CANDIDATES);
    if let Some(thickest) = thickest.filter(|t| list.iter().all(|c| c.parent != t.parent)) {
        list.push(thickest);
    }
}

/// The candidates as edges, in the order of children and costs.
pub(super) fn edges(candidates: &[Vec<Candidate>]) -> Vec<Edge> {
    let of = |(child, list): (usize, &Vec<Candidate>)| {
        list.iter().map(|c| Edge { parent: c.parent, child: child as u32, cost: c.cost }).collect::<Vec<_>>()
    };
    candidates.iter().enumerate().flat_map(of).collect()
}
