//! Symmetric filters of one dimension: taps, and what they leave of a wave.

/// Radius in standard deviations; beyond it lies 6e-5 of a Gaussian.
const REACH: f64 = 4.0;

/// A symmetric filter whose taps sum to one: the middle tap, then one side.
#[derive(Clone, Debug, PartialEq)]
pub struct Taps(pub Vec<f32>);

impl Taps {
    /// A Gaussian of this variance (texels squared), each tap integrated over its texel; the identity for none.
    pub fn gaussian(variance: f64) -> Taps {
        // Integration adds the variance of a texel.
        let sigma = (variance - 1.0 / 12.0).max(0.0).sqrt();
        if sigma < 0.05 {
            // Three taps of exactly this variance.
            let side = (variance / 2.0).clamp(0.0, 0.25);
            return Taps(if side > 0.0 { vec![(1.0 - 2.0 * side) as f32, side as f32] } else { vec![1.0] });
        }
        let edge = |x: f64| libm::erf(x / (sigma * std::f64::consts::SQRT_2));
        let radius = (REACH * sigma + 0.5).ceil() as usize;
        let tap = |k: usize| (edge(k as f64 + 0.5) - edge(k as f64 - 0.5)) / 2.0;
        let side: Vec<f64> = (0..=radius).map(tap).collect();
        let sum = side[0] + 2.0 * side[1..].iter().sum::<f64>();
        Taps(side.iter().map(|t| (t / sum) as f32).collect())
    }

    /// Texels to each side.
    pub fn radius(&self) -> usize {
        self.0.len() - 1
    }

    /// Share that it leaves of a wave of `angle` radians per texel.
    pub fn response(&self, angle: f64) -> f64 {
        let side: f64 =
            self.0.iter().enumerate().skip(1).map(|(k, t)| f64::from(*t) * libm::cos(k as f64 * angle)).sum();
        f64::from(self.0[0]) + 2.0 * side
    }
}
