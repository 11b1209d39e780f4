//! Least squares over the hemisphere: the linear function of the light's direction that stands for a bump's answer.
//!
//! The answer of a bump is symmetric about the plane of its tilt, so two numbers tell it: along the tilt, and along the
//! axis. The entry's levels enter linearly: their moments are integrated once per tilt, whatever the thickness.

use super::entry::{place, taken};
use super::{Curve, Entrance, Entry};
use foliar_numerics::gauss_legendre;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// How the fit weighs directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Fit {
    /// All alike.
    #[default]
    Uniform,
    /// By their cosine: better from ahead, worse from the side.
    Cosine,
    /// Exact from straight ahead; else all alike.
    Anchor,
}

/// Directions for the moments: Gauss over the cosine, even steps about the axis. The clamp at grazing light on a bump is
/// a kink, which leaves some 1e-4.
const POLAR: usize = 32;
const AROUND: usize = 64;

/// Moments of one tilt: along the tilt and along the axis, per knot of the entrance.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection {
    moments: Vec<[f64; 2]>,
    /// From straight ahead: answer per knot.
    ahead: Vec<f64>,
    scale: [f64; 2],
    anchored: bool,
    curve: Curve,
}

impl Projection {
    /// Integrates the answers of a bump tilted toward +x whose normal has this z.
    pub fn new(normal_z: f64, entry: Entry, fit: Fit, curve: Curve, knots: &[f64], index: f64) -> Projection {
        let normal = DVec3::new((1.0 - normal_z * normal_z).max(0.0).sqrt(), 0.0, normal_z);
        let mut moments = vec![[0.0; 2]; knots.len()];
        let mut scale = [0.0; 2];
        for (z, weight) in gauss_legendre(POLAR, 0.0, 1.0) {
            let radius = (1.0 - z * z).max(0.0).sqrt();
            let weight = weight * if fit == Fit::Cosine { z } else { 1.0 };
            let bend = curve.at(z);
            scale[0] += PI * weight * bend * bend * radius * radius;
            scale[1] += TAU * weight * bend * bend * z * z;
            for step in 0..AROUND {
                let angle = TAU * (step as f64 + 0.5) / AROUND as f64;
                let light = DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z);
                let share = weight * bend * TAU / AROUND as f64;
                add(&mut moments, knots, taken(normal, light, entry, index), [share * light.x, share * light.z]);
            }
        }
        let mut ahead = vec![[0.0; 2]; knots.len()];
        add(&mut ahead, knots, taken(normal, DVec3::Z, entry, index), [1.0, 0.0]);
        let ahead = ahead.iter().map(|pair| pair[0]).collect();
        Projection { moments, ahead, scale, anchored: fit == Fit::Anchor, curve }
    }

    /// (along the tilt, along the axis) for one thickness; 1 is what a flat leaf lets in from straight ahead.
    pub fn vector(&self, entrance: &Entrance, entry: Entry) -> [f64; 2] {
        let level = |knot: usize| if entry == Entry::Transport { entrance.levels[knot] } else { 1.0 };
        let sum = |of: &dyn Fn(usize) -> f64| (0..self.moments.len()).map(|knot| level(knot) * of(knot)).sum::<f64>();
        let along = sum(&|knot| self.moments[knot][0]) / self.scale[0];
        let axis = if self.anchored {
            sum(&|knot| self.ahead[knot]) / self.curve.at(1.0)
        } else {
            sum(&|knot| self.moments[knot][1]) / self.scale[1]
        };
        [along, axis]
    }
}

/// Shares an answer among the two knots beside its refracted cosine.
fn add(moments: &mut [[f64; 2]], knots: &[f64], (answer, inside): (f64, f64), shares: [f64; 2]) {
    let (at, share) = place(knots, inside);
    for (knot, part) in [(at, 1.0 - share), ((at + 1).min(knots.len() - 1), share)] {
        moments[knot][0] += answer * part * shares[0];
        moments[knot][1] += answer * part * shares[1];
    }
}
