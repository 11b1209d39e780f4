//! A bank of Gaussians shared by all thicknesses, with weights of each thickness's own, none negative.
//!
//! Wide Gaussians run on images halved once or several times. The weights are fitted to what the filters really do to
//! waves (taps, halving, drawing up again), not to ideal Gaussians.

use super::Spread;
use super::nnls::nnls;
use super::taps::Taps;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Widest Gaussian that runs on an image of this level, in its texels: half of it must be wide enough to be drawn up
/// from the next level without steps.
const WIDEST: f64 = 3.6;
/// Halving by binomial taps 1 4 6 4 1: their variance in texels of the finer image.
const HALVING_VARIANCE: f64 = 1.0;
/// Waves along an axis and along the diagonal at which weights are fitted.
const WAVES: usize = 40;
/// Weight of uniform light in the fit, over that of one wave.
const UNIFORM: f64 = 100.0;
/// Widths that are tried: least in texels, greatest in units of the greatest thickness.
const LEAST: [f64; 5] = [0.4, 0.6, 0.9, 1.4, 2.2];
const GREATEST: [f64; 5] = [0.4, 0.6, 0.8, 1.1, 1.5];
/// Thicknesses at which widths are tried.
const PROBES: usize = 5;

/// One filter: a Gaussian on a halved image.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter {
    /// How often the image was halved.
    pub level: usize,
    /// Across.
    pub x: Taps,
    /// Down.
    pub y: Taps,
}

/// The bank, its first filter the identity.
#[derive(Clone, Debug, PartialEq)]
pub struct Bank {
    /// Filters by rising width.
    pub filters: Vec<Filter>,
    /// Per thickness, a weight per filter; they sum to one.
    pub weights: Vec<Vec<f64>>,
    /// Rms miss of the fitted spread over all thicknesses and waves.
    pub miss: f64,
}

impl Bank {
    /// Only the identity: light goes straight through.
    pub fn identity(thicknesses: usize) -> Bank {
        Bank { filters: vec![filter(0.0, [1.0; 2])], weights: vec![vec![1.0]; thicknesses], miss: 0.0 }
    }

    /// Filters that keep the bank within .3 % rms of the direct gather: one for each doubling of the width that spread can
    /// have in texels, since spread falls off as slowly as the leaf is thick.
    pub fn enough(greatest_mm: f64, texel_mm: [f64; 2]) -> usize {
        let texels = greatest_mm / texel_mm[0].min(texel_mm[1]);
        (libm::log2(texels.max(1.0)) + 3.5).clamp(4.0, 10.0) as usize
    }

    /// The best of a few sets of `count` Gaussians (the identity is one) for spreads whose greatest thickness is given,
    /// on texels of this size, mm.
    pub fn fit(spreads: &[Spread], greatest_mm: f64, texel_mm: [f64; 2], count: usize) -> Bank {
        if count < 2 {
            return Bank::identity(spreads.len());
        }
        let goals: Vec<Vec<f64>> = spreads.par_iter().map(|spread| goal(spread, texel_mm)).collect();
        let probe = |at: usize| &goals[at * (goals.len() - 1) / (PROBES - 1)];
        let probes: Vec<&Vec<f64>> = (0..PROBES).map(probe).collect();
        let texel = texel_mm[0].min(texel_mm[1]);
        let sets: Vec<(f64, f64)> =
            LEAST.iter().flat_map(|l| GREATEST.map(|g| (l * texel, (g * greatest_mm).max(l * texel)))).collect();
        let tried: Vec<(Vec<Filter>, f64)> = sets
            .par_iter()
            .map(|(least, greatest)| {
                let filters = geometric(*least, *greatest, count, texel_mm);
                let columns = columns(&filters);
                let miss = probes.iter().map(|goal| weights(&columns, goal).1).fold(0.0, f64::max);
                (filters, miss)
            })
            .collect();
        let best = tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((filters, _)) = best else { return Bank::identity(spreads.len()) };
        let columns = columns(&filters);
        let fitted: Vec<(Vec<f64>, f64)> = goals.par_iter().map(|goal| weights(&columns, goal)).collect();
        let miss = (fitted.iter().map(|f| f.1 * f.1).sum::<f64>() / fitted.len().max(1) as f64).sqrt();
        Bank { filters, weights: fitted.into_iter().map(|f| f.0).collect(), miss }
    }
}

fn geometric(least: f64, greatest: f64, count: usize, texel_mm: [f64; 2]) -> Vec<Filter> {
    let sigma = |j: usize| {
        let share = if count > 2 { (j - 1) as f64 / (count - 2) as f64 } else { 1.0 };
        least * libm::pow(greatest / least, share)
    };
    (0..count).map(|j| filter(if j == 0 { 0.0 } else { sigma(j) }, texel_mm)).collect()
}

/// A Gaussian of this width, mm, on the coarsest level that serves both axes.
fn filter(sigma_mm: f64, texel_mm: [f64; 2]) -> Filter {
    let sigma = texel_mm.map(|texel| sigma_mm / texel);
    let mut level = 0;
    while sigma[0].min(sigma[1]) / f64::from(1 << level) > WIDEST {
        level += 1;
    }
    // Halvings add 1 + 4 + 16 ... texels squared.
    let halved = HALVING_VARIANCE * (libm::pow(4.0, level as f64) - 1.0) / 3.0;
    let taps = |s: f64| Taps::gaussian((s * s - halved) / libm::pow(4.0, level as f64));
    Filter { level, x: taps(sigma[0]), y: taps(sigma[1]) }
}

/// Waves of the fit, in radians per texel of both axes.
fn waves() -> impl Iterator<Item = [f64; 2]> {
    let angle = |i: usize| PI * i as f64 / (WAVES - 1) as f64;
    (0..WAVES).flat_map(move |i| [[angle(i), 0.0], [0.0, angle(i)], [angle(i), angle(i)]])
}

/// Weight of a wave: low ones carry most of any picture.
fn importance([x, y]: [f64; 2]) -> f64 {
    let square = x * x + y * y;
    if square <= 0.0 { UNIFORM } else { 1.0 / (0.1 + square.sqrt()) }
}

fn goal(spread: &Spread, texel_mm: [f64; 2]) -> Vec<f64> {
    waves()
        .map(|wave| {
            let q = [wave[0] / texel_mm[0], wave[1] / texel_mm[1]];
            importance(wave) * spread.at((q[0] * q[0] + q[1] * q[1]).sqrt())
        })
        .collect()
}

fn columns(filters: &[Filter]) -> Vec<Vec<f64>> {
    let column = |f: &Filter| waves().map(|w| importance(w) * f.x_response(w[0]) * f.y_response(w[1])).collect();
    filters.iter().map(column).collect()
}

/// Weights that sum to one, and the rms miss over the weighted waves.
fn weights(columns: &[Vec<f64>], goal: &[f64]) -> (Vec<f64>, f64) {
    let mut found = nnls(columns, goal);
    let sum: f64 = found.iter().sum();
    if sum > 0.0 {
        found.iter_mut().for_each(|w| *w /= sum)
    } else {
        found[0] = 1.0
    }
    let miss = |row: usize| goal[row] - found.iter().zip(columns).map(|(w, c)| w * c[row]).sum::<f64>();
    let total: f64 = waves().map(|w| if importance(w) < UNIFORM { importance(w).powi(2) } else { 0.0 }).sum();
    let squares: f64 = (0..goal.len()).map(|row| miss(row) * miss(row)).sum();
    (found, (squares / total).sqrt())
}

impl Filter {
    fn x_response(&self, angle: f64) -> f64 {
        response(&self.x, self.level, angle)
    }

    fn y_response(&self, angle: f64) -> f64 {
        response(&self.y, self.level, angle)
    }
}

/// What halving, taps and drawing up by straight lines leave of a wave of the full image.
fn response(taps: &Taps, level: usize, angle: f64) -> f64 {
    let mut left = 1.0;
    let mut wave = angle;
    for _ in 0..level {
        left *= libm::pow(libm::cos(wave / 2.0), 4.0);
        wave *= 2.0;
    }
    if level == 0 {
        return taps.response(angle);
    }
    // Lines between samples 2^level apart: a comb of their triangle, mean over phases.
    let span = f64::from(1 << level);
    let triangle = if angle.abs() > f64::EPSILON {
        let ratio = libm::sin(angle * span / 2.0) / (span * libm::sin(angle / 2.0));
        ratio * ratio
    } else {
        1.0
    };
    left * taps.response(wave) * triangle
}
