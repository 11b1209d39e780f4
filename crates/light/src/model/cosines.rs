//! How much of an octant a surface faces: exact integrals of the cosine, in closed form.
//!
//! The paper takes the cosine at the octant's middle times its solid angle (Boulanger08 eq. 6), which is off by -18 % to
//! +15 % of a full sky with the surface's normal.

use crate::octants::{OCTANTS, direction};
use glam::DVec3;
use std::f64::consts::FRAC_PI_4;

/// Integral of max(normal . w, 0) over each octant, for a unit normal; the eight add up to pi.
pub fn octant_cosines(normal: DVec3) -> [f64; OCTANTS] {
    std::array::from_fn(|octant| one(normal * direction(octant).signum()))
}

/// The integral over the octant of +x, +y, +z. An octant that the horizon cuts is a polygon of great arcs; half the sum
/// over its arcs of length times the cosine between normal and the arc's plane (Lambert's formula) is the integral.
fn one(n: DVec3) -> f64 {
    // The three coordinates play one part: sorted, the sign pattern is one of four.
    let mut sorted = n.to_array();
    sorted.sort_by(f64::total_cmp);
    let [low, middle, high] = sorted;
    if low >= 0.0 {
        FRAC_PI_4 * (low + middle + high)
    } else if middle >= 0.0 {
        one_corner_below(middle, high, -low)
    } else if high > 0.0 {
        one_corner_above(-low, -middle, high)
    } else {
        0.0
    }
}

/// The normal's third coordinate points `down`: a corner is cut off. `1 - down` is written as what it stands for, so that a
/// sliver of an octant keeps its digits.
fn one_corner_below(x: f64, y: f64, down: f64) -> f64 {
    let rest = (x * x + y * y) / (1.0 + down);
    let arcs = x * libm::atan2(y, down) + y * libm::atan2(x, down) - libm::atan2(x * y, down);
    (arcs / 2.0 + FRAC_PI_4 * rest).max(0.0)
}

/// Two coordinates point away: a corner of height `up` is left.
fn one_corner_above(x: f64, y: f64, up: f64) -> f64 {
    let arcs = libm::atan2(up, x * y) - y * libm::atan2(up, x) - x * libm::atan2(up, y);
    (arcs / 2.0).max(0.0)
}
