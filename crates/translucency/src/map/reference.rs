//! The direct gather: every texel's own transport, projection and kernel, every pair of texels, in f64.
//!
//! The shortest correct program; cost grows with the square of the texels.

use super::{LeafMap, Recipe, Spreading};
use crate::light::{Curve, Projection, coefficients};
use crate::transport::Boundary;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Coefficients of every texel, row by row; zero where there is no leaf.
pub fn coefficient_map(map: &LeafMap, recipe: &Recipe) -> Vec<DVec3> {
    let texels = map.thickness_mm.len();
    let median = map.median_mm().unwrap_or(0.0);
    let curve = if recipe.curve { Curve::fit(&recipe.entrance(median), recipe.index()) } else { Curve::STRAIGHT };
    let leaf = |at: usize| Some(f64::from(map.thickness_mm[at])).filter(|d| *d > 0.0);
    let entered: Vec<(DVec3, f64)> = (0..texels)
        .into_par_iter()
        .map(|at| leaf(at).map_or((DVec3::ZERO, 0.0), |d| source(map, recipe, curve, at, d)))
        .collect();
    let period = (2 * map.width.max(map.height)).next_power_of_two();
    let boundary = Boundary::new(recipe.index());
    let gathered = |at: usize| {
        let Some(d) = leaf(at) else { return DVec3::ZERO };
        let (own, transmittance) = entered[at];
        match recipe.spread(d, &boundary).filter(|_| recipe.spreading == Spreading::Kernel) {
            None => own * transmittance,
            Some(spread) => {
                let kernel = kernel(&|q| spread.at(q), recipe.texel_mm, period);
                transmittance * gather(map, &entered, &kernel, period, at)
            }
        }
    };
    (0..texels).into_par_iter().map(gathered).collect()
}

/// What a texel takes in, as coefficients over the transmittance from straight ahead, and that transmittance.
fn source(map: &LeafMap, recipe: &Recipe, curve: Curve, at: usize, thickness: f64) -> (DVec3, f64) {
    let entrance = recipe.entrance(thickness);
    let [x, y, z] = map.normal(at).map(f64::from);
    let projection = Projection::new(z, recipe.entry, recipe.fit, curve, entrance.knots(), recipe.index());
    let [along, axis] = projection.vector(&entrance, recipe.entry);
    let side = (x * x + y * y).sqrt();
    let tilt = if side > 0.0 { along / side } else { 0.0 };
    (coefficients(DVec3::new(tilt * x, tilt * y, axis)), entrance.transmittance)
}

/// A quarter of the band-limited kernel, by its waves.
fn kernel(spread: &dyn Fn(f64) -> f64, texel_mm: [f64; 2], period: usize) -> Vec<f64> {
    let half = period / 2 + 1;
    let turns: Vec<f64> = (0..period).map(|i| libm::cos(TAU * i as f64 / period as f64)).collect();
    let waves = |k: usize, texel: f64| TAU * k as f64 / (period as f64 * texel);
    let count = |k: usize| if k == 0 || k == period / 2 { 1.0 } else { 2.0 };
    let mut rows = vec![0.0; half * half];
    for ky in 0..half {
        let level: Vec<f64> = (0..half)
            .map(|kx| {
                let (qx, qy) = (waves(kx, texel_mm[0]), waves(ky, texel_mm[1]));
                count(kx) * count(ky) * spread((qx * qx + qy * qy).sqrt())
            })
            .collect();
        for x in 0..half {
            rows[ky * half + x] = level.iter().enumerate().map(|(kx, l)| l * turns[kx * x % period]).sum();
        }
    }
    let scale = 1.0 / (period * period) as f64;
    let mut kernel = vec![0.0; half * half];
    for y in 0..half {
        for ky in 0..half {
            let turn = scale * turns[ky * y % period];
            (0..half).for_each(|x| kernel[y * half + x] += turn * rows[ky * half + x]);
        }
    }
    kernel
}

fn gather(map: &LeafMap, entered: &[(DVec3, f64)], kernel: &[f64], period: usize, at: usize) -> DVec3 {
    let half = period / 2 + 1;
    let (x, y) = (at % map.width, at / map.width);
    let mut sum = DVec3::ZERO;
    for (from, (source, _)) in entered.iter().enumerate() {
        let (dx, dy) = ((from % map.width).abs_diff(x), (from / map.width).abs_diff(y));
        sum += *source * kernel[dy * half + dx];
    }
    sum
}
