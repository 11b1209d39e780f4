//! Weights of every branch along its length (Kusternig07 section 5): its own, which grows from where it leaves
//! its parent's bark, and those that it inherits there.

use foliar_plant::{Branches, LEVELS, NO_BRANCH};

/// Weights of the four levels.
pub type Weights = [f64; LEVELS];

/// Where a branch's own weight starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Exit {
    /// At the first ring that is wholly outside the parent's bark, so that nothing slides there.
    #[default]
    Bark,
    /// At the root inside the parent, as the paper has it: for comparison.
    Root,
}

/// What weights follow from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Levels with a weight of their own.
    pub levels: usize,
    /// Displacement is the weight to this power, level by level.
    pub exponents: Weights,
    /// Where own weights start.
    pub exit: Exit,
}

impl From<&crate::Params> for Rule {
    fn from(params: &crate::Params) -> Rule {
        Rule { levels: params.levels as usize, exponents: params.exponents, exit: Exit::Bark }
    }
}

/// A weight to its exponent. Most exponents are whole or a half more: those cost no logarithm.
pub fn power(weight: f64, exponent: f64) -> f64 {
    match exponent {
        1.0 => weight,
        1.5 => weight * weight.sqrt(),
        2.0 => weight * weight,
        _ => libm::pow(weight, exponent),
    }
}

/// The weight whose power this is.
pub fn root(power: f64, exponent: f64) -> f64 {
    match exponent {
        1.0 => power,
        2.0 => power.sqrt(),
        _ => libm::pow(power, 1.0 / exponent),
    }
}

/// Weights of all branches.
#[derive(Clone, Debug)]
pub struct Sway<'a> {
    /// The branches.
    pub branches: &'a Branches,
    /// The rule.
    pub rule: Rule,
    /// Arc length at which each branch's own weight starts.
    pub starts: Vec<f64>,
    /// Longest way from start to tip at each level, meters; 0 where there is none.
    pub longest_m: Weights,
    /// What each branch has of its ancestors, constant along it.
    pub inherited: Vec<Weights>,
}

impl<'a> Sway<'a> {
    /// Weights that start at these arc lengths.
    pub fn new(branches: &'a Branches, rule: Rule, starts: Vec<f64>) -> Sway<'a> {
        let mut longest_m = [0.0f64; LEVELS];
        for ((row, axis), start) in branches.rows.iter().zip(&branches.axes).zip(&starts) {
            if let Some(longest) = longest_m[..rule.levels.min(LEVELS)].get_mut(row.level as usize) {
                *longest = longest.max(axis.length() - start);
            }
        }
        Sway { branches, rule, starts, longest_m, inherited: vec![[0.0; LEVELS]; branches.count()] }
    }

    /// Weights of the parent's bark where a branch's axis comes out of it: the paper's rule asks where the axes meet.
    pub fn at_attachment(&self, branch: usize) -> Weights {
        let (row, attachment) = (&self.branches.rows[branch], &self.branches.attachments[branch]);
        let place = match self.rule.exit {
            Exit::Bark => attachment.bark_parent_arc,
            Exit::Root => attachment.axis_arc,
        };
        if row.parent == NO_BRANCH { [0.0; LEVELS] } else { self.on_bark(row.parent, place) }
    }

    /// Weights of a ring of a branch.
    pub fn of_ring(&self, branch: u32, arc: f64) -> Weights {
        let mut weights = self.inherited[branch as usize];
        let level = self.branches.rows[branch as usize].level as usize;
        if level < self.rule.levels
            && let Some(own) = weights.get_mut(level)
        {
            let longest = self.longest_m[level];
            let way = (arc - self.starts[branch as usize]).max(0.0);
            *own = if longest > 0.0 { (way / longest).min(1.0) } else { 0.0 };
        }
        weights
    }

    /// Displacements per unit of amplitude (weights to their exponents) of the bark at an arc length: a mesh draws
    /// straight lines from ring to ring.
    pub fn powers_on_bark(&self, branch: u32, arc: f64) -> Weights {
        let arcs = &self.branches.axes[branch as usize].arcs;
        let last = arcs.len().saturating_sub(1);
        let high = arcs.partition_point(|&a| a < arc).clamp(last.min(1), last);
        let low = high.saturating_sub(1);
        let share = ((arc - arcs[low]) / (arcs[high] - arcs[low])).clamp(0.0, 1.0);
        // Two rings at one place divide 0 by 0.
        let share = if share.is_finite() { share } else { 0.0 };
        let [low, high] = [low, high].map(|ring| self.powers(self.of_ring(branch, arcs[ring])));
        std::array::from_fn(|level| low[level] + (high[level] - low[level]) * share)
    }

    /// Weights that displace as the bark at an arc length is displaced.
    pub fn on_bark(&self, branch: u32, arc: f64) -> Weights {
        self.roots(self.powers_on_bark(branch, arc))
    }

    /// Weights to their exponents.
    pub fn powers(&self, weights: Weights) -> Weights {
        std::array::from_fn(|level| power(weights[level], self.rule.exponents[level]))
    }

    /// The weights of these powers.
    pub fn roots(&self, powers: Weights) -> Weights {
        std::array::from_fn(|level| root(powers[level].clamp(0.0, 1.0), self.rule.exponents[level]))
    }
}
