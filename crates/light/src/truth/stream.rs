//! Numbers without pattern, from a seed and nothing else (splitmix64, Steele 2014).

use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A stream of numbers in [0, 1); equal seeds give equal streams.
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// The stream of a place in a computation, such as (seed, leaf, sample).
    pub fn new(seeds: &[u64]) -> Stream {
        Stream(seeds.iter().fold(0, |state, seed| mixed(state.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ mixed(*seed))))
    }

    /// The next number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        (mixed(self.0) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next point of the unit square.
    pub fn point(&mut self) -> DVec2 {
        let x = self.unit();
        DVec2::new(x, self.unit())
    }
}

fn mixed(bits: u64) -> u64 {
    let mut z = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A direction about a unit normal with density cosine / pi, from a point of the unit square.
pub(crate) fn cosine_direction(normal: DVec3, at: DVec2) -> DVec3 {
    let (across, along) = normal.any_orthonormal_pair();
    let (radius, turn) = (at.x.sqrt(), TAU * at.y);
    let level = across * libm::cos(turn) + along * libm::sin(turn);
    (level * radius + normal * (1.0 - at.x).max(0.0).sqrt()).normalize()
}
