//! The shortest program for the same values: f64, every place against every leaf (Boulanger08 section 6.1).

use crate::leaves::{Foliage, Query, Source};
use crate::octants::OCTANTS;
use crate::profile::{MOST_DEPTH, Profile, depth, shares};
use foliar_numerics::CompensatedSum;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// What a place sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// Optical depth of each octant; not capped.
    pub depth: [f64; OCTANTS],
    /// Distance to the center of the farthest leaf of each octant; 0 where there is none.
    pub far: [f64; OCTANTS],
    /// How many leaves lie in each octant.
    pub count: [u32; OCTANTS],
}

/// What a place sees of leaves whose solid angle, steradians, is a function of their index and of the vector to them.
pub fn sum_with(
    sources: &[Source],
    query: &Query,
    half_width: impl Fn(f64) -> f64,
    solid_angle: impl Fn(usize, DVec3) -> f64,
) -> Sum {
    let mut sum = Sum::default();
    let others = sources.iter().enumerate().filter(|(_, source)| source.group != query.skip);
    for (index, source) in others {
        let toward = source.center - query.position;
        let angle = solid_angle(index, toward);
        for (j, share) in shares(toward, half_width(source.area)).into_iter().enumerate().filter(|(_, s)| *s > 0.0) {
            sum.depth[j] += depth(angle, share);
            sum.far[j] = sum.far[j].max(toward.length());
            sum.count[j] += 1;
        }
    }
    sum
}

/// What a place sees by a profile.
pub fn sum(sources: &[Source], query: &Query, profile: Profile) -> Sum {
    let angle = |index: usize, toward| profile.solid_angle(sources[index].area, toward);
    sum_with(sources, query, |area| profile.half_width(area), angle)
}

/// What every place sees.
pub fn sums(sources: &[Source], queries: &[Query], profile: Profile) -> Vec<Sum> {
    queries.par_iter().map(|query| sum(sources, query, profile)).collect()
}

/// Extinction of the medium that stands for the leaves, per unit of length: mean over what leaves see of depth over
/// way, octants without leaves left out (Boulanger08 section 6.2). No way is shorter than the radius of a mean leaf,
/// or a pair of leaves that touch would be all that counts. 0 where nothing shades anything.
pub fn extinction(sums: &[Sum], mean_area: f64) -> f64 {
    let least = (mean_area / PI).sqrt();
    let seen =
        sums.iter().flat_map(|sum| (0..OCTANTS).filter(|j| sum.count[*j] > 0).map(|j| (sum.depth[j], sum.far[j])));
    let (mut total, mut count) = (CompensatedSum::default(), 0u32);
    for (depth, far) in seen.filter(|(depth, far)| far.max(least) > 0.0 || *depth > 0.0) {
        total.add(depth / far.max(least));
        count += 1;
    }
    if count > 0 { total.value() / f64::from(count) } else { 0.0 }
}

/// Mean one-sided area of leaves, those without area included; 0 without leaves.
pub fn mean_area(sources: &[Source]) -> f64 {
    let total: CompensatedSum = sources.iter().map(|source| source.area).collect();
    if sources.is_empty() { 0.0 } else { total.value() / sources.len() as f64 }
}

/// Transmittance of a depth (Boulanger08 eq. 5).
pub fn transmittance(depth: f64) -> f64 {
    libm::exp(-depth.min(MOST_DEPTH))
}

/// Optical depths of all leaves of a plant, capped for a file.
pub fn depths(foliage: &Foliage, queries: &[Query], profile: Profile) -> Vec<[f32; OCTANTS]> {
    let capped = |sum: &Sum| sum.depth.map(|depth| depth.min(MOST_DEPTH) as f32);
    sums(&foliage.sources, queries, profile).iter().map(capped).collect()
}
