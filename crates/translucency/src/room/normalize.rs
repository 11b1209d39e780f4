//! What a map is divided by, and what it lets through on the mean.

use super::params::{Normalize, Params};
use crate::map::{LeafMap, Tables};
use rayon::prelude::*;

/// Least mean that anything is divided by: what lets nothing through stays dark.
const LEAST: f32 = 1e-6;

/// Measured on a map before it was divided.
pub struct Found {
    /// Mean over the leaf of the answer to diffuse light.
    pub mean: f64,
}

/// Divides the coefficients as the parameters ask.
pub fn finish(map: &LeafMap, coefficients: &mut [f32], tables: &Tables, params: &Params) -> Found {
    let diffuse = |c: &[f32]| diffuse(c, tables);
    let row = |(c, d): (&[f32], &[f32])| {
        let texels = c.chunks_exact(3).zip(d).filter(|(_, d)| **d > 0.0);
        texels.fold((0.0, 0usize), |(sum, count), (c, _)| (sum + f64::from(diffuse(c)), count + 1))
    };
    let width = map.width.max(1);
    let rows = coefficients.par_chunks(3 * width).zip(map.thickness_mm.par_chunks(width));
    // Added in the order of the rows, whoever summed them.
    let rows: Vec<(f64, usize)> = rows.map(row).collect();
    let (sum, count) = rows.into_iter().fold((0.0, 0), |(sum, count), (s, c)| (sum + s, count + c));
    let mean = sum / count.max(1) as f64;
    match params.normalize {
        Normalize::None => {}
        Normalize::Mean => {
            let by = (mean as f32).max(LEAST);
            coefficients.iter_mut().for_each(|c| *c /= by);
        }
        Normalize::Diffuse => coefficients.chunks_exact_mut(3).for_each(|c| {
            let by = diffuse(c).max(LEAST);
            c.iter_mut().for_each(|c| *c /= by);
        }),
    }
    Found { mean }
}

/// Answer to diffuse light of irradiance 1: v_z (a0 + 2 a1 / 3).
fn diffuse(c: &[f32], tables: &Tables) -> f32 {
    const SQRT_3: f32 = 1.732_050_8;
    let bend = (tables.curve.offset + 2.0 * tables.curve.slope / 3.0) as f32;
    ((c[0] + c[1] + c[2]) / SQRT_3 * bend).max(0.0)
}

/// Least mean that a texel of the leaf stores: 0 says that there is none. No half float is 0 there.
const LEAST_STORED: f32 = 1e-7;

/// Coefficients and the answer to diffuse light, four numbers a texel; nothing where there is no leaf.
pub fn with_mean(map: &LeafMap, coefficients: &[f32], tables: &Tables) -> Vec<f32> {
    let mut texels = vec![0.0; 4 * map.thickness_mm.len()];
    let leaf = texels.par_chunks_exact_mut(4).zip(coefficients.par_chunks_exact(3)).zip(&map.thickness_mm);
    leaf.filter(|(_, d)| **d > 0.0).for_each(|((texel, c), _)| {
        texel[..3].copy_from_slice(c);
        texel[3] = diffuse(c, tables).max(LEAST_STORED);
    });
    texels
}
