//! From candidates to a hierarchy: cheapest arborescence, siblings set straight, continuations joined.

use super::arborescence::{self, Edge};
use super::contact::{self, Candidate, Capsules, Ground};
use super::tube::Tube;
use foliar_plant::Axis;

/// Where the grandparent costs at most so much more, it is the parent: siblings born at one place would
/// otherwise hang on each other in a row (Occam's razor).
const OCCAM: f64 = 0.06;
/// A continuation starts within so many radii of its parent's tip.
const JOINT: f64 = 0.25;
/// The thinner of both is no thinner than this share of the thicker.
const SAME_RADIUS: f64 = 0.7;
/// Cosine of the greatest bend of a continuation: 30 degrees.
const STRAIGHT: f64 = 0.866_025_403_784_438_6;

/// What a tube hangs on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hanging {
    /// Index of the parent tube; none for what grows from the ground.
    pub parent: Option<u32>,
    /// Whether the end of its axis is its root.
    pub from_tip: bool,
    /// Cost of this parent.
    pub cost: f64,
    /// Cost of the next best less this one's, 0 or above; infinite where there is none.
    pub margin: f64,
    /// Distance between both barks, in radii of the child.
    pub gap: f64,
}

/// Hangs every tube.
pub(super) fn hang(tubes: &[Tube], forks: &[Option<u32>], capsules: &Capsules, ground: &Ground) -> Vec<Hanging> {
    let mut candidates = contact::candidates(tubes, capsules, ground);
    for (list, parent) in candidates.iter_mut().zip(forks).filter_map(|(list, fork)| Some((list, (*fork)?))) {
        // What forks in one piece has no choice.
        *list = vec![Candidate { parent, cost: 0, from_tip: false, gap: 0.0 }];
    }
    let edges: Vec<Edge> = contact::edges(&candidates);
    let chosen = arborescence::solve(tubes.len() + 1, tubes.len() as u32, &edges);
    let mut parents: Vec<u32> =
        (0..tubes.len()).map(|t| chosen[t].map_or(tubes.len() as u32, |e| edges[e].parent)).collect();
    straighten(&candidates, &mut parents);
    (0..tubes.len()).map(|t| hanging(&candidates[t], parents[t], tubes.len())).collect()
}

fn hanging(candidates: &[Candidate], parent: u32, tubes: usize) -> Hanging {
    let of = |c: &Candidate| (c.from_tip, c.cost, c.gap);
    let (from_tip, cost, gap) = candidates.iter().find(|c| c.parent == parent).map_or((false, 0, 0.0), of);
    let second = candidates.iter().filter(|c| c.parent != parent).map(|c| c.cost).min();
    Hanging {
        parent: (parent as usize != tubes).then_some(parent),
        from_tip,
        cost: contact::unit(cost),
        margin: second.map_or(f64::INFINITY, |s| contact::unit(s - cost).max(0.0)),
        gap,
    }
}

/// Re-hangs on grandparents what costs hardly more there, from the roots outward.
fn straighten(candidates: &[Vec<Candidate>], parents: &mut [u32]) {
    let ground = parents.len();
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); ground + 1];
    parents.iter().enumerate().for_each(|(c, &p)| children[p as usize].push(c as u32));
    let mut pending = children[ground].clone();
    while let Some(tube) = pending.pop() {
        for &child in &children[tube as usize] {
            let cost = |parent: u32| candidates[child as usize].iter().find(|c| c.parent == parent).map(|c| c.cost);
            let mut parent = tube;
            while let (Some(now), Some(upper)) = (cost(parent), upper(parents, parent).and_then(cost)) {
                if contact::unit(upper - now) > OCCAM {
                    break;
                }
                parent = parents[parent as usize];
            }
            parents[child as usize] = parent;
            pending.push(child);
        }
    }
}

/// The parent's own parent, where that is no ground.
fn upper(parents: &[u32], parent: u32) -> Option<u32> {
    parents.get(parent as usize).copied().filter(|&p| (p as usize) < parents.len())
}

/// Whether a branch goes on where its parent ends: same place, about the same radius, straight on. Both axes
/// start at their roots.
pub fn continues(child: &Axis, parent: &Axis) -> bool {
    let last = parent.points.len() - 1;
    let (end, start) = (parent.radii[last], child.radii[0]);
    let (thin, thick) = (end.min(start), end.max(start));
    // Straight on: from the parent's way into its tip to the child's way out of its root.
    let straight = -parent.heading(true).dot(child.heading(false));
    parent.points[last].distance(child.points[0]) <= JOINT * thick
        && thin >= SAME_RADIUS * thick
        && straight >= STRAIGHT
}

/// For each tube the one that it continues: at most one per tip, the straightest. Tubes start at their roots.
pub(super) fn continuations(tubes: &[Tube], hangings: &[Hanging]) -> Vec<Option<u32>> {
    let mut of_parent: Vec<Option<(f64, u32)>> = vec![None; tubes.len()];
    for (child, hanging) in hangings.iter().enumerate() {
        let Some(parent) = hanging.parent else { continue };
        let (own, other) = (&tubes[child].axis, &tubes[parent as usize].axis);
        if continues(own, other) {
            let straight = -other.heading(true).dot(own.heading(false));
            let slot = &mut of_parent[parent as usize];
            if slot.is_none_or(|(best, _)| straight > best) {
                *slot = Some((straight, child as u32));
            }
        }
    }
    let mut joined = vec![None; tubes.len()];
    for (parent, child) in of_parent.iter().enumerate().filter_map(|(p, c)| Some((p, (*c)?.1))) {
        joined[child as usize] = Some(parent as u32);
    }
    joined
}
