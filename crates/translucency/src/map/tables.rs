//! Everything that depends on thickness and tilt alone, solved once for a few dozen thicknesses.

use super::recipe::{Recipe, Spreading};
use crate::kernel::{Bank, Spread};
use crate::light::{Curve, Entrance, Entry, Projection};
use crate::transport::Boundary;
use rayon::prelude::*;

/// Thicknesses that are solved.
const SOLVED: usize = 64;
/// Thicknesses are spaced by ln(d + greatest / this): like logarithms, but not for what is next to nothing.
const THIN_SHARE: f64 = 50.0;
/// Entries by the square root of thickness, for weights; and for what enters.
const FINE: usize = 1024;
const COARSE: usize = 128;
/// Entries by the normal's z.
const TILTS: usize = 64;
/// A normal's z where the limit of no tilt is taken.
const NEARLY_FLAT: f64 = 1.0 - 1e-6;

/// Filters that a bank may have.
pub const MOST_FILTERS: usize = 16;
/// A weight for each filter.
pub type Weights = [f32; MOST_FILTERS];

/// Tables of one leaf.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The bank of filters.
    pub bank: Bank,
    /// The curve, where it was asked for.
    pub curve: Curve,
    /// Greatest thickness, mm.
    pub greatest_mm: f64,
    /// Per fine entry, transmittance times the weight of each filter.
    mix: Vec<Weights>,
    /// Per tilt and coarse entry: along the tilt over its sine, and along the axis.
    source: Vec<[f32; 2]>,
}

/// A thickness between two solved ones.
struct Grid {
    solved: Vec<f64>,
    offset: f64,
}

impl Grid {
    fn new(least: f64, greatest: f64) -> Grid {
        let offset = greatest / THIN_SHARE;
        let (low, high) = (libm::log(least + offset), libm::log(greatest + offset));
        let at = |i: usize| libm::exp(low + (high - low) * i as f64 / (SOLVED - 1) as f64) - offset;
        Grid { solved: if least < greatest { (0..SOLVED).map(at).collect() } else { vec![greatest] }, offset }
    }

    fn place(&self, d: f64) -> (usize, f64) {
        let last = self.solved.len() - 1;
        if last == 0 {
            return (0, 0.0);
        }
        let x = |d: f64| libm::log(d + self.offset);
        let whole = (x(d) - x(self.solved[0])) / (x(self.solved[last]) - x(self.solved[0])) * last as f64;
        let whole = whole.clamp(0.0, last as f64);
        let at = (whole as usize).min(last - 1);
        (at, whole - at as f64)
    }

    /// Value between two neighbors, by straight lines.
    fn between(&self, d: f64, value: impl Fn(usize) -> f64) -> f64 {
        let (at, share) = self.place(d);
        if share > 0.0 { value(at) * (1.0 - share) + value(at + 1) * share } else { value(at) }
    }
}

impl Tables {
    /// Solves a recipe for thicknesses of this range, mm; the curve is fitted at the median.
    pub fn new(recipe: &Recipe, (least, greatest): (f64, f64), median: f64) -> Tables {
        let grid = Grid::new(least, greatest);
        let entrances: Vec<Entrance> = grid.solved.par_iter().map(|d| recipe.entrance(*d)).collect();
        let curve = if recipe.curve { Curve::fit(&recipe.entrance(median), recipe.index()) } else { Curve::STRAIGHT };
        let bank = bank(recipe, &grid.solved, greatest);
        Tables {
            mix: mix(&grid, &entrances, &bank, greatest),
            source: source(recipe, &grid, &entrances, curve, greatest),
            bank,
            curve,
            greatest_mm: greatest,
        }
    }

    /// Entry for a thickness, and share of the next.
    #[inline(always)]
    fn place(&self, d: f32, entries: usize) -> (usize, f32) {
        let whole = (d / self.greatest_mm as f32).clamp(0.0, 1.0).sqrt() * (entries - 1) as f32;
        let at = (whole as usize).min(entries - 2);
        (at, whole - at as f32)
    }

    /// Weights of the filters at a thickness, transmittance included; 0 beyond the last filter.
    #[inline(always)]
    pub fn mix(&self, d: f32) -> Weights {
        let (at, share) = self.place(d, FINE);
        let (low, high) = (&self.mix[at], &self.mix[at + 1]);
        std::array::from_fn(|j| low[j] + share * (high[j] - low[j]))
    }

    /// What a texel takes in: (along the tilt over its sine, along the axis), 1 for a flat leaf from straight ahead.
    #[inline(always)]
    pub fn source(&self, d: f32, normal_z: f32) -> [f32; 2] {
        let tilt = normal_z.clamp(0.0, 1.0) * (TILTS - 1) as f32;
        let row = (tilt as usize).min(TILTS - 2);
        let up = tilt - row as f32;
        let (at, share) = self.place(d, COARSE);
        let entry = |row: usize, at: usize| self.source[row * COARSE + at];
        let mix = |a: [f32; 2], b: [f32; 2], s: f32| [a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])];
        mix(mix(entry(row, at), entry(row, at + 1), share), mix(entry(row + 1, at), entry(row + 1, at + 1), share), up)
    }

    /// Transmittance from straight ahead at a thickness, mm.
    pub fn transmittance(&self, d: f32) -> f32 {
        self.mix(d).iter().sum()
    }
}

fn bank(recipe: &Recipe, solved: &[f64], greatest: f64) -> Bank {
    if recipe.spreading == Spreading::None {
        return Bank::identity(solved.len());
    }
    let boundary = Boundary::new(recipe.index());
    let spreads: Vec<Spread> = solved.par_iter().filter_map(|d| recipe.spread(*d, &boundary)).collect();
    let count = recipe.filters.unwrap_or_else(|| Bank::enough(greatest, recipe.texel_mm)).min(MOST_FILTERS);
    Bank::fit(&spreads, greatest, recipe.texel_mm, count)
}

/// Thickness of an entry.
fn thickness(entry: usize, entries: usize, greatest: f64) -> f64 {
    let share = entry as f64 / (entries - 1) as f64;
    greatest * share * share
}

fn mix(grid: &Grid, entrances: &[Entrance], bank: &Bank, greatest: f64) -> Vec<Weights> {
    let row = |entry: usize| {
        let d = thickness(entry, FINE, greatest);
        let t = libm::exp(grid.between(d, |at| libm::log(entrances[at].transmittance)));
        let weight = move |j: usize| (t * grid.between(d, |at| bank.weights[at][j])) as f32;
        std::array::from_fn(|j| if j < bank.filters.len() { weight(j) } else { 0.0 })
    };
    (0..FINE).into_par_iter().map(row).collect()
}

fn source(recipe: &Recipe, grid: &Grid, entrances: &[Entrance], curve: Curve, greatest: f64) -> Vec<[f32; 2]> {
    let knots = entrances[0].knots();
    let tilt = |row: usize| {
        let z = (row as f64 / (TILTS - 1) as f64).min(NEARLY_FLAT);
        let projection = Projection::new(z, recipe.entry, recipe.fit, curve, knots, recipe.index());
        let sine = (1.0 - z * z).sqrt();
        let solved: Vec<[f64; 2]> = match recipe.entry {
            // Only transport asks how thick the leaf is.
            Entry::Transport => entrances.iter().map(|e| projection.vector(e, recipe.entry)).collect(),
            _ => vec![projection.vector(&entrances[0], recipe.entry); entrances.len()],
        };
        let entry = move |entry: usize| {
            let d = thickness(entry, COARSE, greatest);
            [(grid.between(d, |at| solved[at][0]) / sine) as f32, grid.between(d, |at| solved[at][1]) as f32]
        };
        (0..COARSE).map(entry).collect::<Vec<_>>()
    };
    (0..TILTS).into_par_iter().flat_map_iter(tilt).collect()
}
