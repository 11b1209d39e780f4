//! How much of a known hierarchy was found (the metrics of Kusternig07's method against generators that know).

use super::continues;
use foliar_plant::{Axis, Branches, LEVELS, NO_BRANCH, OnBranch};
use std::collections::BTreeMap;

/// A hierarchy that is known because the plant was made.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Parent of each branch.
    pub parents: Vec<Option<u32>>,
    /// Per part, per vertex: branch, or [`NO_BRANCH`].
    pub vertices: Vec<Vec<u32>>,
    /// Branch of each leaf, or [`NO_BRANCH`].
    pub leaves: Vec<u32>,
}

/// Shares of what was found right, 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// Branches whose parent is right; one that is lost or split counts as wrong.
    pub parent: f64,
    /// Branches whose level is right.
    pub level: f64,
    /// Vertices whose whole chain of four is right.
    pub chain: f64,
    /// Vertices that belong to the branch that most of theirs was found as.
    pub purity: f64,
    /// Leaves on the right branch; 1 where there are none.
    pub leaf: f64,
    /// Branches there are.
    pub branches: usize,
}

/// A branch that was hung elsewhere than it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The true branch.
    pub branch: u32,
    /// What it was found as; none where it was lost.
    pub found: Option<u32>,
    /// Its true parent.
    pub right: Option<u32>,
    /// The true branch that its found parent is.
    pub parent: Option<u32>,
}

impl Truth {
    /// What a sample knows of itself, continuations merged by the rule of the step. Leaves that start where their
    /// branch is still inside its parent's wood are not counted: nobody could tell on which of both they hang.
    pub fn of_sample(branches: &Branches) -> Truth {
        let id = |place: &OnBranch| place.branch;
        let bark = |branch: u32| branches.attachments.get(branch as usize).map_or(0.0, |a| a.bark_arc);
        let leaf = |place: &OnBranch| {
            if f64::from(place.arc) < bark(place.branch) { NO_BRANCH } else { place.branch }
        };
        let truth = Truth {
            parents: branches.rows.iter().map(|r| (r.parent != NO_BRANCH).then_some(r.parent)).collect(),
            vertices: branches.vertices.iter().map(|list| list.iter().map(id).collect()).collect(),
            leaves: branches.leaves.iter().map(leaf).collect(),
        };
        truth.merged(&branches.axes)
    }

    /// Joins what the step joins: one branch that goes on at each tip, the straightest. Axes start at their roots.
    pub fn merged(self, axes: &[Axis]) -> Truth {
        let mut best: BTreeMap<u32, (f64, u32)> = BTreeMap::new();
        for (child, parent) in self.parents.iter().enumerate().filter_map(|(c, p)| Some((c, (*p)?))) {
            let (own, other) = (&axes[child], &axes[parent as usize]);
            if !own.points.is_empty() && !other.points.is_empty() && continues(own, other) {
                let straight = -other.heading(true).dot(own.heading(false));
                let entry = best.entry(parent).or_insert((straight, child as u32));
                if straight > entry.0 {
                    *entry = (straight, child as u32);
                }
            }
        }
        let mut first: Vec<u32> = (0..self.parents.len() as u32).collect();
        best.iter().for_each(|(parent, (_, child))| first[*child as usize] = *parent);
        let head = |mut branch: u32| {
            while first[branch as usize] != branch {
                branch = first[branch as usize];
            }
            branch
        };
        let mut names: Vec<u32> = vec![NO_BRANCH; self.parents.len()];
        let heads: Vec<u32> = (0..names.len() as u32).filter(|&b| head(b) == b).collect();
        heads.iter().enumerate().for_each(|(new, &old)| names[old as usize] = new as u32);
        let rename = |branch: u32| if branch == NO_BRANCH { NO_BRANCH } else { names[head(branch) as usize] };
        Truth {
            parents: heads.iter().map(|&b| self.parents[b as usize].map(rename)).collect(),
            vertices: self.vertices.iter().map(|list| list.iter().map(|&b| rename(b)).collect()).collect(),
            leaves: self.leaves.iter().map(|&b| rename(b)).collect(),
        }
    }

    fn level(&self, branch: u32) -> u32 {
        std::iter::successors(self.parents[branch as usize], |&p| self.parents[p as usize]).count() as u32
    }

    fn chain(&self, branch: u32) -> [u32; LEVELS] {
        let mut line: Vec<u32> = std::iter::successors(Some(branch), |&b| self.parents[b as usize]).collect();
        line.reverse();
        let mut chain = [NO_BRANCH; LEVELS];
        chain.iter_mut().zip(line).for_each(|(slot, b)| *slot = b);
        chain
    }

    /// The branches whose parent is wrong.
    pub fn wrong(&self, found: &Branches) -> Vec<Wrong> {
        let pairs = self.overlaps(found);
        let of_found = majority(pairs.iter().map(|(&(t, f), &n)| (f, t, n)), found.count());
        let of_truth = majority(pairs.iter().map(|(&(t, f), &n)| (t, f, n)), self.parents.len());
        let wrong = |(branch, &right): (usize, &Option<u32>)| {
            let own = of_truth[branch].filter(|&f| of_found[f as usize] == Some(branch as u32));
            let hangs_on = own.map(|f| found.rows[f as usize].parent).filter(|&p| p != NO_BRANCH);
            let parent = hangs_on.and_then(|p| of_found[p as usize]);
            let is_right = own.is_some() && parent == right && hangs_on.is_some() == right.is_some();
            (!is_right).then_some(Wrong { branch: branch as u32, found: own, right, parent })
        };
        self.parents.iter().enumerate().filter_map(wrong).collect()
    }

    /// Compares what was found with the truth. Both belong to the same base.
    pub fn compare(&self, found: &Branches) -> Accuracy {
        let pairs = self.overlaps(found);
        let of_found = majority(pairs.iter().map(|(&(t, f), &n)| (f, t, n)), found.count());
        let of_truth = majority(pairs.iter().map(|(&(t, f), &n)| (t, f, n)), self.parents.len());
        let same = |found: Option<u32>, right: Option<u32>| match (found, right) {
            (None, None) => true,
            (Some(found), Some(right)) => of_found[found as usize] == Some(right),
            _ => false,
        };
        let parent = self.parents.len() - self.wrong(found).len();
        let own = |branch: usize| of_truth[branch].filter(|&f| of_found[f as usize] == Some(branch as u32));
        let right_level =
            |branch: &usize| own(*branch).is_some_and(|f| found.rows[f as usize].level == self.level(*branch as u32));
        let level = (0..self.parents.len()).filter(right_level).count();
        let (mut all, mut pure, mut chained) = (0u64, 0u64, 0u64);
        for (&(truth, own), &count) in &pairs {
            all += count;
            pure += if own != NO_BRANCH && of_found[own as usize] == Some(truth) { count } else { 0 };
            let right = own != NO_BRANCH && {
                let chain = found.rows[own as usize].chain.map(|b| if b == NO_BRANCH { None } else { Some(b) });
                let truth = self.chain(truth).map(|b| if b == NO_BRANCH { None } else { Some(b) });
                chain.iter().zip(truth).all(|(f, t)| same(*f, t))
            };
            chained += if right { count } else { 0 };
        }
        let leaves = self.leaves.iter().zip(&found.leaves).filter(|(t, _)| **t != NO_BRANCH);
        let (hung, right_leaves) = leaves.fold((0, 0), |(n, right), (t, f)| {
            (n + 1, right + usize::from(f.branch != NO_BRANCH && of_found[f.branch as usize] == Some(*t)))
        });
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 1.0 };
        let count = self.parents.len() as f64;
        Accuracy {
            parent: share(parent as f64, count),
            level: share(level as f64, count),
            chain: share(chained as f64, all as f64),
            purity: share(pure as f64, all as f64),
            leaf: share(right_leaves as f64, hung as f64),
            branches: self.parents.len(),
        }
    }

    /// Vertices for each pair of a true branch and a found one.
    fn overlaps(&self, found: &Branches) -> BTreeMap<(u32, u32), u64> {
        let mut pairs = BTreeMap::new();
        for (truth, own) in self.vertices.iter().zip(&found.vertices) {
            for (vertex, &branch) in truth.iter().enumerate().filter(|(_, b)| **b != NO_BRANCH) {
                let own = own.get(vertex).map_or(NO_BRANCH, |place| place.branch);
                *pairs.entry((branch, own)).or_insert(0) += 1;
            }
        }
        pairs
    }
}

/// For each key the value with the greatest count; the lower of equal ones.
fn majority(counts: impl Iterator<Item = (u32, u32, u64)>, keys: usize) -> Vec<Option<u32>> {
    let mut best: Vec<Option<(u64, u32)>> = vec![None; keys];
    for (key, value, count) in counts.filter(|c| c.0 != NO_BRANCH && c.1 != NO_BRANCH) {
        let slot = &mut best[key as usize];
        if slot.is_none_or(|(most, _)| count > most) {
            *slot = Some((count, value));
        }
    }
    best.into_iter().map(|slot| slot.map(|(_, value)| value)).collect()
}
