//! Fewer generators: the paper's random subset beside centroids of voxels, on one tree.

use super::{normals::unit, room};
use anyhow::Result;
use foliar_density::{Field, Foliage, Generator, Params, Query, Sample, ambient_coefficient};
use foliar_numerics::{CompensatedSum, radical_inverse};
use foliar_plant::Plant;
use glam::DVec3;
use std::collections::BTreeMap;

/// What fewer generators cost and save.
pub struct Subset {
    /// Its name in tables.
    pub name: String,
    /// Generators left, percent.
    pub share: f64,
    /// Error of k_a, rms.
    pub ambient: f64,
    /// Mean angle between gradients, degrees.
    pub angle: f64,
    /// Seconds of the processor.
    pub seconds: f64,
}

/// All subsets at the leaf centers of a plant.
pub fn compare(plant: &Plant) -> Result<Vec<Subset>> {
    let foliage = Foliage::new(plant, &[], &Params::default());
    let all = foliage.own();
    let queries: Vec<Query> =
        all.iter().map(|g| Query { position: g.position, skip: foliar_density::NO_GROUP }).collect();
    let field = |balls: &[Generator]| Ok(Field::new(balls, foliage.radius).samples(&queries));
    let (exact, seconds) = room::cpu_seconds(|| field(all))?;
    let unit = unit(&foliage);
    let mut subsets = vec![Subset { name: "all".into(), share: 100.0, ambient: 0.0, angle: 0.0, seconds }];
    let mut add = |name: String, make: &dyn Fn() -> Vec<Generator>| -> Result<()> {
        let count = make().len();
        let (samples, seconds) = room::cpu_seconds(|| field(&make()))?;
        let [ambient, angle] = errors(&samples, &exact, unit);
        subsets.push(Subset { name, share: 100.0 * count as f64 / all.len() as f64, ambient, angle, seconds });
        Ok(())
    };
    for share in [0.5, 0.1] {
        add(format!("random {:.0} % (the paper)", 100.0 * share), &|| random(all, share))?;
    }
    for cells in [2.0, 4.0, 8.0] {
        add(format!("centroids of voxels of radius/{cells}"), &|| merged(all, foliage.radius / cells))?;
    }
    Ok(subsets)
}

/// Of each run of leaves as many as the share asks for, their weights grown by as much.
fn random(all: &[Generator], share: f64) -> Vec<Generator> {
    const MIX: u64 = 0x9E37_79B9_7F4A_7C15;
    // The top bits of a multiplicative hash, as a number in [0, 1).
    let chance = |index: u64| radical_inverse(index.wrapping_mul(MIX) >> 20, 2);
    let kept = all.iter().enumerate().filter(|(index, _)| chance(*index as u64) < share);
    kept.map(|(_, g)| Generator { weight: (f64::from(g.weight) / share) as f32, ..*g }).collect()
}

/// One generator per voxel, at the weighted mean of those in it.
fn merged(all: &[Generator], edge: f64) -> Vec<Generator> {
    let mut voxels: BTreeMap<[i64; 3], (f64, DVec3)> = BTreeMap::new();
    for ball in all {
        let sum = voxels.entry((ball.position / edge).floor().to_array().map(|v| v as i64)).or_default();
        sum.0 += f64::from(ball.weight);
        sum.1 += ball.position * f64::from(ball.weight);
    }
    let filled = voxels.into_values().filter(|(weight, _)| *weight > 0.0);
    let ball =
        |(weight, moment): (f64, DVec3)| Generator { position: moment / weight, weight: weight as f32, group: 0 };
    filled.map(ball).collect()
}

/// Rms error of k_a by default parameters, and mean angle between gradients in degrees.
fn errors(samples: &[Sample], exact: &[Sample], unit: f64) -> [f64; 2] {
    let params = Params::default();
    let ambient = |sample: &Sample| {
        let excess = f64::from(sample.density) - params.threshold * unit;
        ambient_coefficient(excess, params.darkest_density * unit, params.darkest_ambient, params.exponent)
    };
    let pairs = || samples.iter().zip(exact);
    let squares: CompensatedSum = pairs().map(|(a, b)| (ambient(a) - ambient(b)).powi(2)).collect();
    let angle = |(a, b): (&Sample, &Sample)| {
        let cosine = a.gradient.as_dvec3().normalize_or_zero().dot(b.gradient.as_dvec3().normalize_or_zero());
        libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees()
    };
    let angles: CompensatedSum = pairs().map(angle).collect();
    let count = exact.len().max(1) as f64;
    [(squares.value() / count).sqrt(), angles.value() / count]
}
