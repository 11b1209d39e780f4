//! Crowns of flat leaves and nothing else, for measuring light: balls, branches, clumps, or leaves that are given.

use super::Sample;
use super::build::{Build, LeafTruth, Piece};
use super::noise::{hash, unit};
use crate::{OnBranch, Plant};
use foliar_schema::Role;
use glam::{DAffine3, DVec3};
use std::f64::consts::{PI, TAU};

/// Leaves of each crown.
const LEAVES: usize = 1500;
/// Clumps, or twigs, of the crowns that have such.
const CLUMPS: u64 = 40;

/// A flat leaf with four corners: its center and half of each edge. Its front is where `across` x `along` points.
#[derive(Clone, Copy, Debug)]
pub struct Quad {
    /// Center.
    pub center: DVec3,
    /// Half an edge.
    pub across: DVec3,
    /// Half the other edge.
    pub along: DVec3,
}

/// Crowns of 1,500 leaves about 2 m wide, of four kinds that light takes differently:
/// - `thin-ball`, `dense-ball`: leaves anywhere in a ball, turned any way, tau R of 1 and of 4;
/// - `branched`: leaves along twigs, facing up rather than down, leaf area index 2;
/// - `clumps`: leaves in balls of normal spread, turned any way, leaf area index 4.
pub fn crowns() -> Vec<Sample> {
    let ball_area = |tau_r: f64| 2.0 * tau_r * 4.0 / 3.0 * PI;
    [
        ("thin-ball", quads(&ball(1, ball_area(1.0)))),
        ("dense-ball", quads(&ball(2, ball_area(4.0)))),
        ("branched", quads(&branched(3, 2.0 * PI))),
        ("clumps", quads(&clumps(4, 4.0 * PI))),
    ]
    .into_iter()
    .map(|(name, plant)| Sample { name, plant })
    .collect()
}

/// A plant of given leaves, each a group of its own.
pub fn quads(leaves: &[Quad]) -> Plant {
    let mut build = Build::default();
    let material = build.material("leaf", None);
    let part = build.part("leaves", Role::Leaf, material, DAffine3::IDENTITY);
    for leaf in leaves {
        let corner = |s: f64, t: f64| (leaf.center + leaf.across * s + leaf.along * t).as_vec3();
        let piece = Piece {
            positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Piece::default()
        };
        let petiole = (leaf.center - leaf.along).as_vec3();
        build.leaf(part, &piece, &LeafTruth { coverage: 1.0, petiole, group: None, on: OnBranch::NONE });
    }
    build.finish()
}

/// Numbers of one leaf.
struct Draw {
    seed: u64,
    next: u64,
}

impl Draw {
    fn new(seed: u64, leaf: usize) -> Draw {
        Draw { seed: hash(seed, leaf as u64), next: 0 }
    }

    fn unit(&mut self) -> f64 {
        self.next += 1;
        unit(self.seed, self.next)
    }

    /// Uniform over the sphere.
    fn direction(&mut self) -> DVec3 {
        let (y, turn) = (2.0 * self.unit() - 1.0, TAU * self.unit());
        let ring = (1.0 - y * y).max(0.0).sqrt();
        DVec3::new(ring * libm::cos(turn), y, ring * libm::sin(turn))
    }

    /// Uniform over the unit ball.
    fn inside(&mut self) -> DVec3 {
        self.direction() * libm::cbrt(self.unit())
    }

    /// Normal distribution of deviation 1 along each axis (Box and Muller's method).
    fn spread(&mut self) -> DVec3 {
        let mut pair = || (-2.0 * libm::log(1.0 - self.unit())).sqrt() * libm::cos(TAU * self.unit());
        DVec3::new(pair(), pair(), pair())
    }

    /// A leaf of this area, `slender` times as long as wide, turned any way about its normal.
    fn leaf(&mut self, center: DVec3, normal: DVec3, area: f64, slender: f64) -> Quad {
        let (a, b) = normal.any_orthonormal_pair();
        let turn = TAU * self.unit();
        let along = a * libm::cos(turn) + b * libm::sin(turn);
        let width = (area / slender).sqrt();
        Quad { center, across: along.cross(normal) * (width / 2.0), along: along * (width * slender / 2.0) }
    }
}

fn each(seed: u64, area: f64, leaf: impl Fn(&mut Draw, f64) -> Quad) -> Vec<Quad> {
    (0..LEAVES).map(|index| leaf(&mut Draw::new(seed, index), area / LEAVES as f64)).collect()
}

fn ball(seed: u64, area: f64) -> Vec<Quad> {
    each(seed, area, |draw, area| {
        let (center, normal) = (draw.inside(), draw.direction());
        draw.leaf(center, normal, area, 1.0)
    })
}

fn branched(seed: u64, area: f64) -> Vec<Quad> {
    each(seed, area, |draw, area| {
        let mut twig = Draw::new(seed.wrapping_add(1000), (draw.unit() * CLUMPS as f64) as usize);
        let (out, from) = (twig.direction(), DVec3::Y * (0.3 + 0.8 * twig.unit()));
        let tip = from + DVec3::new(out.x, 0.6 * out.y.abs(), out.z) * (0.5 + 0.5 * twig.unit());
        let center = from.lerp(tip, 0.3 + 0.7 * draw.unit()) + draw.spread() * 0.05;
        let normal = (draw.direction() + DVec3::Y * 0.8).normalize_or(DVec3::Y);
        draw.leaf(center, normal, area, 2.0)
    })
}

fn clumps(seed: u64, area: f64) -> Vec<Quad> {
    each(seed, area, |draw, area| {
        let middle = Draw::new(seed.wrapping_add(1000), (draw.unit() * CLUMPS as f64) as usize).inside();
        let (center, normal) = (middle * 0.85 + draw.spread() * 0.12, draw.direction());
        draw.leaf(center, normal, area, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowns_have_the_leaf_area_that_their_kind_says() {
        let area = |plant: &Plant| plant.leaves().iter().map(|leaf| f64::from(leaf.area)).sum::<f64>();
        let expected = [8.0 / 3.0 * PI, 32.0 / 3.0 * PI, 2.0 * PI, 4.0 * PI];
        for (crown, expected) in crowns().iter().zip(expected) {
            assert_eq!(crown.plant.leaves().len(), LEAVES);
            let found = area(&crown.plant);
            // Corners are f32.
            assert!((found / expected - 1.0).abs() < 1e-4, "{}: {found} {expected}", crown.name);
        }
    }

    #[test]
    fn leaves_of_twigs_face_up_and_others_any_way() {
        for crown in crowns() {
            let up: f64 = crown.plant.leaves().iter().map(|leaf| f64::from(leaf.normal.y)).sum::<f64>() / LEAVES as f64;
            // The mean of 1,500 directions strays by 0.58 / 39.
            let expected = if crown.name == "branched" { 0.3..0.7 } else { -0.06..0.06 };
            assert!(expected.contains(&up), "{}: {up}", crown.name);
        }
    }

    #[test]
    fn the_front_is_where_across_times_along_points() {
        let leaf = Quad { center: DVec3::Y, across: DVec3::Z * 0.1, along: DVec3::X * 0.2 };
        let plant = quads(&[leaf]);
        assert!(plant.leaves()[0].normal.y > 0.999 && (plant.leaves()[0].area - 0.08).abs() < 1e-6);
    }
}
