//! A leaf's transmittance over all directions in nine numbers: real spherical harmonics of order 2 (Ramamoorthi 2001).

use glam::DVec3;

/// Coefficients: one of degree 0, three of degree 1, five of degree 2.
pub const COUNT: usize = 9;

/// Added to the diagonal of the normal equations, relative to the number of samples: directions that cannot tell two
/// harmonics apart give small coefficients instead of endless ones.
const RIDGE: f64 = 1e-6;

/// The nine functions at a unit vector, orthonormal over the sphere, in the order 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2.
pub fn basis(d: DVec3) -> [f64; COUNT] {
    let (x, y, z) = (d.x, d.y, d.z);
    [
        0.282_094_791_773_878_14,
        0.488_602_511_902_919_9 * y,
        0.488_602_511_902_919_9 * z,
        0.488_602_511_902_919_9 * x,
        1.092_548_430_592_079_2 * x * y,
        1.092_548_430_592_079_2 * y * z,
        0.315_391_565_252_520_05 * (3.0 * z * z - 1.0),
        1.092_548_430_592_079_2 * x * z,
        0.546_274_215_296_039_6 * (x * x - y * y),
    ]
}

/// Transmittance toward a unit vector, cut to [0, 1]: nine functions overshoot near a gap.
pub fn transmittance(coefficients: &[f64; COUNT], toward: DVec3) -> f64 {
    basis(toward).iter().zip(coefficients).map(|(b, c)| b * c).sum::<f64>().clamp(0.0, 1.0)
}

/// Coefficients that come nearest to samples (unit vector, transmittance), by least squares.
pub fn fit(samples: impl IntoIterator<Item = (DVec3, f64)>) -> [f64; COUNT] {
    let (mut matrix, mut right, mut count) = ([[0.0; COUNT]; COUNT], [0.0; COUNT], 0.0);
    for (direction, value) in samples {
        let row = basis(direction);
        count += 1.0;
        for i in 0..COUNT {
            right[i] += row[i] * value;
            for j in 0..COUNT {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    if count == 0.0 {
        return [0.0; COUNT];
    }
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] += RIDGE * count;
    }
    solve(matrix, right)
}

/// Solves a positive definite system by elimination, which needs no pivots there.
fn solve(mut matrix: [[f64; COUNT]; COUNT], mut right: [f64; COUNT]) -> [f64; COUNT] {
    for pivot in 0..COUNT {
        for row in pivot + 1..COUNT {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            for column in pivot..COUNT {
                matrix[row][column] -= factor * matrix[pivot][column];
            }
            right[row] -= factor * right[pivot];
        }
    }
    for row in (0..COUNT).rev() {
        let known: f64 = (row + 1..COUNT).map(|column| matrix[row][column] * right[column]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}
