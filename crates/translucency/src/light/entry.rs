//! How light of each direction enters a bumpy leaf, over what enters a flat one from straight ahead.

use crate::transport::{AddingDoubling, Layer, fresnel_outside, refracted};
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Least z of a normal: steeper bumps would gather light without limit.
const LEAST_NORMAL_Z: f64 = 0.2;
/// A transmittance below this is none: its logarithm and quotients stay finite.
pub const LEAST_TRANSMITTANCE: f64 = 1e-300;

/// Models of the entry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Entry {
    /// The cosine alone, as Kusternig07 has it: slanting light is overestimated, by 30 to 110 % at 70 degrees.
    Lambert,
    /// Cosine and the surface's mirror.
    Fresnel,
    /// Cosine, mirror, and the way of the refracted ray through the leaf.
    #[default]
    Transport,
}

/// What one thickness of leaf lets in, by the cosine of the refracted ray to the leaf's axis: piecewise linear, drawn on
/// below the last refracted cosine (bumps lead rays there).
#[derive(Clone, Debug, PartialEq)]
pub struct Entrance {
    /// T for light from straight ahead.
    pub transmittance: f64,
    /// T over mirror loss, over the same straight ahead, at [`Entrance::knots`].
    pub levels: Vec<f64>,
    knots: Vec<f64>,
}

impl Entrance {
    /// From a solved leaf whose first asked cosine is 1.
    pub fn new(solved: &AddingDoubling, index: f64) -> Entrance {
        let ahead = solved.front.first().copied().unwrap_or_default();
        let entered = |cosine: f64, t: f64| t / (1.0 - fresnel_outside(cosine, index)).max(f64::MIN_POSITIVE);
        let scale = entered(1.0, ahead.transmittance.max(LEAST_TRANSMITTANCE));
        let mut rows: Vec<(f64, f64)> = solved
            .nodes
            .iter()
            .map(|node| (refracted(node.cosine, index), entered(node.cosine, node.transmittance.max(0.0)) / scale))
            .collect();
        rows.push((1.0, 1.0));
        Entrance {
            transmittance: ahead.transmittance.max(LEAST_TRANSMITTANCE),
            levels: rows.iter().map(|row| row.1).collect(),
            knots: rows.iter().map(|row| row.0).collect(),
        }
    }

    /// Solves layers and keeps their entrance.
    pub fn of(layers: &[Layer], nodes: usize) -> Entrance {
        let index = layers.first().map_or(1.0, |layer| layer.medium.index);
        Entrance::new(&AddingDoubling::solve(layers, &[1.0], nodes), index)
    }

    /// Cosines inside at which levels stand; the same for every thickness of a leaf.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// T(mu) / T(1) of a flat leaf, by the cosine in air.
    pub fn flat(&self, outside: f64, index: f64) -> f64 {
        let mirror = (1.0 - fresnel_outside(outside, index)) / (1.0 - fresnel_outside(1.0, index));
        mirror * self.level(refracted(outside, index))
    }

    /// Level at a cosine inside.
    pub fn level(&self, inside: f64) -> f64 {
        let (at, share) = place(&self.knots, inside);
        let next = (at + 1).min(self.levels.len() - 1);
        (self.levels[at] * (1.0 - share) + self.levels[next] * share).max(0.0)
    }
}

/// Segment of rising `knots` and share within it; outside, the end segments are drawn on.
pub fn place(knots: &[f64], x: f64) -> (usize, f64) {
    if knots.len() < 2 {
        return (0, 0.0);
    }
    let at = knots.partition_point(|knot| *knot <= x).clamp(1, knots.len() - 1) - 1;
    (at, (x - knots[at]) / (knots[at + 1] - knots[at]))
}

/// Light of direction `light` that a map's unit area of lit side with `normal` takes in, without levels: cosine over the
/// area's foreshortening, mirror, and the cosine of the refracted ray to the leaf's axis.
pub fn taken(normal: DVec3, light: DVec3, entry: Entry, index: f64) -> (f64, f64) {
    let cosine = normal.dot(light);
    if cosine <= 0.0 {
        return (0.0, 1.0);
    }
    let area = cosine / normal.z.max(LEAST_NORMAL_Z);
    if entry == Entry::Lambert {
        return (area, 1.0);
    }
    let mirror = (1.0 - fresnel_outside(cosine, index)) / (1.0 - fresnel_outside(1.0, index));
    // Snell about the bump's normal: into the leaf, so against both vectors.
    let inward = (light - normal * cosine) / index + normal * refracted(cosine, index);
    (area * mirror, inward.z)
}
