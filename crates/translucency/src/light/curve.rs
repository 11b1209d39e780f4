//! Two numbers that bend the linear function of the light's direction to how a flat leaf really answers.

use super::Entrance;
use foliar_numerics::gauss_legendre;

/// Nodes over the cosine: the curve is smooth but for grazing light, which weighs nothing.
const NODES: usize = 48;

/// t = (v . l)(offset + slope l_z).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// a0: not below 0.
    pub offset: f64,
    /// a1.
    pub slope: f64,
}

impl Curve {
    /// No bend.
    pub const STRAIGHT: Curve = Curve { offset: 1.0, slope: 0.0 };

    /// Least squares, weighted by the squared cosine that multiplies it, of T(mu) / T(1) of a flat leaf.
    pub fn fit(entrance: &Entrance, index: f64) -> Curve {
        let mut sums = [0.0; 5];
        for (mu, weight) in gauss_legendre(NODES, 0.0, 1.0) {
            let (w, value) = (weight * mu * mu, entrance.flat(mu, index));
            let terms = [w, w * mu, w * mu * mu, w * value, w * value * mu];
            sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
        let [one, mu, square, value, moment] = sums;
        let slope = (one * moment - mu * value) / (one * square - mu * mu);
        let offset = (value - slope * mu) / one;
        if offset < 0.0 { Curve { offset: 0.0, slope: moment / square } } else { Curve { offset, slope } }
    }

    /// Its value at a cosine.
    pub fn at(&self, cosine: f64) -> f64 {
        self.offset + self.slope * cosine
    }
}
