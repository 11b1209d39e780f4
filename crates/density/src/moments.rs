//! Many balls that all reach a place, summed at once: eq. 2 of Luft07 is a polynomial of degree 4 inside a ball, and
//! fourteen moments of the centers say what all of them add up to. In f64, lengths in radii, so that nothing cancels.

use crate::field::Query;
use crate::generators::Generator;
use crate::groups::Groups;
use glam::{DMat3, DVec3};

/// Fewer balls are summed one by one: as fast, and 0 where nothing is in reach.
const FEWEST: usize = 256;
/// Reach of a ball in radii, less the rounding of a distance.
const REACH: f64 = 1.0 - 1e-9;

/// All balls of a field, for places that all of them reach.
#[derive(Clone, Debug)]
pub(crate) struct Moments {
    low: DVec3,
    high: DVec3,
    middle: DVec3,
    inverse: f64,
    groups: Groups,
    weight: f64,
    first: DVec3,
    second: DMat3,
    /// Weighted by the square of the distance from the middle.
    third: DVec3,
    /// Weighted by its fourth power.
    fourth: f64,
}

impl Moments {
    /// Moments of balls of a radius of one over `inverse`; `None` where balls are few, or no place is in reach of all.
    pub fn new(balls: &[Generator], inverse: f64) -> Option<Moments> {
        let places = || balls.iter().map(|ball| ball.position * inverse);
        let low = places().fold(DVec3::INFINITY, DVec3::min);
        let high = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        if balls.len() < FEWEST || (high - low).length() >= 2.0 * REACH {
            return None;
        }
        let middle = (low + high) / 2.0;
        let (mut weight, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
        let (mut third, mut fourth) = (DVec3::ZERO, 0.0);
        for (arm, ball) in places().map(|place| place - middle).zip(balls) {
            let (share, square) = (f64::from(ball.weight), arm.length_squared());
            weight += share;
            first += arm * share;
            second += DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z) * share;
            third += arm * (share * square);
            fourth += share * square * square;
        }
        let groups = Groups::new(balls);
        Some(Moments { low, high, middle, inverse, groups, weight, first, second, third, fourth })
    }

    /// Whether all balls reach a place (meters).
    pub fn reach(&self, position: DVec3) -> bool {
        let place = position * self.inverse;
        (place - self.low).max(self.high - place).length() < REACH
    }

    /// Density at a place that all balls reach, and its gradient in units of one over the radius; without the balls that
    /// the query leaves out. `None` elsewhere.
    pub fn sum(&self, query: &Query) -> Option<(f64, DVec3)> {
        if !self.reach(query.position) {
            return None;
        }
        let place = query.position * self.inverse;
        let own = self.groups.of(query.skip);
        if own.len() == self.groups.len() {
            return Some((0.0, DVec3::ZERO));
        }
        let (mut density, mut gradient) = self.all(place - self.middle);
        for ball in own {
            let arm = place - ball.position * self.inverse;
            let (inside, weight) = (1.0 - arm.length_squared(), f64::from(ball.weight));
            density -= weight * inside * inside;
            gradient += arm * (4.0 * weight * inside);
        }
        Some((density.max(0.0), gradient))
    }

    /// The sum over all p of w (a + 2 u.p - |p|^2)^2 with a = 1 - |u|^2, and its gradient, at u from the middle.
    fn all(&self, u: DVec3) -> (f64, DVec3) {
        let (a, squares, across) = (1.0 - u.length_squared(), self.spread(), self.second * u);
        let density = a * a * self.weight + 4.0 * u.dot(across) + self.fourth + 4.0 * a * u.dot(self.first)
            - 2.0 * a * squares
            - 4.0 * u.dot(self.third);
        let gradient = across * 8.0 + self.first * (4.0 * a)
            - self.third * 4.0
            - u * (4.0 * a * self.weight + 8.0 * u.dot(self.first) - 4.0 * squares);
        (density, gradient)
    }

    /// Sum of the squares of the distances from the middle.
    fn spread(&self) -> f64 {
        self.second.x_axis.x + self.second.y_axis.y + self.second.z_axis.z
    }
}
