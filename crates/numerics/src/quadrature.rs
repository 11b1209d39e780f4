//! Quadrature: nodes and weights of Gauss and Legendre.

use std::f64::consts::PI;

/// Newton's steps from Tricomi's start: four already reach the last bit for every size in use.
const NEWTON_STEPS: usize = 12;

/// Nodes (rising) and weights of Gauss-Legendre on [`from`, `to`] with `count` nodes: exact for polynomials of degree
/// 2 `count` - 1.
pub fn gauss_legendre(count: usize, from: f64, to: f64) -> Vec<(f64, f64)> {
    let (half, middle) = ((to - from) / 2.0, (to + from) / 2.0);
    let node = |i: usize| {
        let mut x = -libm::cos(PI * (i as f64 + 0.75) / (count as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..NEWTON_STEPS {
            let (value, derivative) = legendre_and_slope(count, x);
            slope = derivative;
            x -= value / derivative;
        }
        (middle + half * x, half * 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

/// Legendre's polynomials P_0 to P_(count - 1) at `x`.
pub fn legendre(count: usize, x: f64) -> Vec<f64> {
    let mut values = vec![1.0, x];
    for l in 1..count.max(2) - 1 {
        let n = l as f64;
        values.push(((2.0 * n + 1.0) * x * values[l] - n * values[l - 1]) / (n + 1.0));
    }
    values.truncate(count);
    values
}

fn legendre_and_slope(degree: usize, x: f64) -> (f64, f64) {
    let values = legendre(degree + 1, x);
    let (last, before) = (values[degree], if degree == 0 { 0.0 } else { values[degree - 1] });
    (last, degree as f64 * (x * last - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact up to degree 2n - 1; the sum of n terms of rounding stands above it.
    const ROUNDING: f64 = 1e-13;

    #[test]
    fn polynomials_up_to_twice_the_count_are_exact() {
        for count in [1, 2, 5, 16, 48] {
            let nodes = gauss_legendre(count, 0.5, 2.0);
            for degree in 0..(2 * count).min(24) as i32 {
                let sum: f64 = nodes.iter().map(|(x, w)| w * x.powi(degree)).sum();
                let exact = (2.0f64.powi(degree + 1) - 0.5f64.powi(degree + 1)) / f64::from(degree + 1);
                assert!((sum / exact - 1.0).abs() < ROUNDING, "{count} nodes, degree {degree}: {sum} {exact}");
            }
        }
    }

    #[test]
    fn legendre_at_one_is_one_and_alternates_at_minus_one() {
        assert!(legendre(9, 1.0).iter().all(|p| (p - 1.0).abs() < ROUNDING));
        assert!(legendre(9, -1.0).iter().enumerate().all(|(l, p)| (p - [1.0, -1.0][l % 2]).abs() < ROUNDING));
        assert_eq!(legendre(1, 0.3), [1.0]);
    }
}
