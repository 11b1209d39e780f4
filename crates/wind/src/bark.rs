//! The bark rule: a branch's own weight starts where none of its edges reaches into its parent any more, and what it has of
//! its ancestors up to there is such that both surfaces move as one where they meet.

use crate::joint::{Crossing, Joint};
use crate::sway::{Rule, Sway, Weights};
use crate::wood::{Vertex, Wood};
use foliar_plant::{Branches, LEVELS, NO_BRANCH};
use rayon::prelude::*;

/// What moving a place outside counts beside one that is hidden inside: what is seen should stay as rigid as it can.
const SEEN: f64 = 40.0;
/// Most rounds over all crossings of a joint, and the slip that ends them where a level's longest branch swings by its own
/// length, in radii: a storm swings it by a seventh.
const ROUNDS: usize = 64;
const CLOSE: f64 = 0.005;

/// Weights of vertices of a branch where it meets its parent, by vertex.
pub(crate) type Met = Vec<(Vertex, Weights)>;

/// Weights of all branches, and of the vertices at their joints.
pub(crate) struct Fitted<'a> {
    pub sway: Sway<'a>,
    met: Vec<Met>,
}

impl<'a> Fitted<'a> {
    /// From parents to children: what a branch inherits is what its parent has where they meet.
    pub fn new(wood: &Wood, branches: &'a Branches, rule: Rule, joints: &[Joint]) -> Fitted<'a> {
        let sway = Sway::new(branches, rule, joints.iter().map(|joint| joint.start).collect());
        let mut fitted = Fitted { sway, met: vec![Vec::new(); branches.count()] };
        let mut first = 0;
        while first < branches.count() {
            let level = branches.rows[first].level;
            let last = first + branches.rows[first..].partition_point(|row| row.level == level);
            let met: Vec<(Weights, Met)> =
                (first..last).into_par_iter().map(|branch| fitted.meet(wood, branch, &joints[branch])).collect();
            for (branch, (inherited, met)) in (first..last).zip(met) {
                fitted.sway.inherited[branch] = inherited;
                fitted.met[branch] = met;
            }
            first = last;
        }
        fitted
    }

    /// Weights of a vertex of wood.
    pub fn of(&self, vertex: Vertex, branch: u32, arc: f64) -> Weights {
        let met = &self.met[branch as usize];
        let found = if arc <= self.sway.starts[branch as usize] {
            met.binary_search_by_key(&vertex, |m| m.0).ok()
        } else {
            None
        };
        found.map_or_else(|| self.sway.of_ring(branch, arc), |index| met[index].1)
    }

    /// Displacements per unit of amplitude of a place of a face.
    pub fn powers(&self, wood: &Wood, branch: u32, face: [Vertex; 3], shares: [f64; 3]) -> Weights {
        let corners = face.map(|v| self.sway.powers(self.of(v, branch, wood.arc(v).into())));
        std::array::from_fn(|level| (0..3).map(|k| corners[k][level] * shares[k]).sum())
    }

    fn meet(&self, wood: &Wood, branch: usize, joint: &Joint) -> (Weights, Met) {
        let (row, sway) = (&self.sway.branches.rows[branch], &self.sway);
        if row.parent == NO_BRANCH {
            return ([0.0; LEVELS], Vec::new());
        }
        let targets: Vec<Weights> =
            joint.crossings.iter().map(|c| self.powers(wood, row.parent, c.face, c.shares)).collect();
        if targets.is_empty() {
            return (sway.at_attachment(branch), Vec::new());
        }
        let count = targets.len() as f64;
        let mean: Weights = std::array::from_fn(|level| targets.iter().map(|t| t[level]).sum::<f64>() / count);
        // Powers that move a place by the radius where amplitudes are as long as branches.
        let radius = f64::from(row.radius).max(f64::MIN_POSITIVE);
        let close = sway.longest_m.map(|longest| CLOSE * radius / longest.max(f64::MIN_POSITIVE));
        let powers = solve(&joint.crossings, &targets, joint.places.len(), mean, close);
        let met = joint.vertices.iter().map(|&(vertex, place)| (vertex, sway.roots(powers[place as usize]))).collect();
        (sway.roots(mean), met)
    }
}

/// Powers of places that, interpolated along each edge, are what the parent has there, and differ from the mean as little
/// as they can (Kaczmarz' projections: they end at the nearest solution, weighted, and stay in range).
fn solve(crossings: &[Crossing], targets: &[Weights], places: usize, mean: Weights, close: Weights) -> Vec<Weights> {
    let mut ease = vec![1.0 / SEEN; places];
    crossings.iter().for_each(|crossing| ease[crossing.ends[0] as usize] = 1.0);
    let mut powers = vec![mean; places];
    for _ in 0..ROUNDS {
        let mut done = true;
        for (crossing, target) in crossings.iter().zip(targets) {
            let [low, high] = crossing.ends.map(|end| end as usize);
            let shares = [1.0 - crossing.share, crossing.share];
            let pull = [shares[0] * ease[low], shares[1] * ease[high]];
            let total = shares[0] * pull[0] + shares[1] * pull[1];
            for level in 0..LEVELS {
                let off = target[level] - shares[0] * powers[low][level] - shares[1] * powers[high][level];
                done &= off.abs() <= close[level];
                for (place, pull) in [low, high].into_iter().zip(pull) {
                    powers[place][level] = (powers[place][level] + off * pull / total).clamp(0.0, 1.0);
                }
            }
        }
        if done {
            break;
        }
    }
    powers
}
