//! The plane of a leaf: where its maps lie when its own texture coordinates do not say.

use super::Solid;
use glam::{DMat3, DVec3};

/// Sweeps of Jacobi's method: each squares what is left, eight leave rounding.
const SWEEPS: usize = 8;

/// Axes of a map in the mesh's frame, about the middle of the mesh's box: x image right, y image up, z out of the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Image right.
    pub x: DVec3,
    /// Image up: along the leaf.
    pub y: DVec3,
    /// Out of the front.
    pub z: DVec3,
}

impl Frame {
    /// The plane that the surface keeps nearest to (least squares, by area). The front looks the way `front` does, the
    /// leaf's long axis points up in the picture, toward where `front` does not decide: the greatest coordinate.
    pub fn of(solid: &Solid, front: DVec3) -> Frame {
        let mut total = 0.0;
        let mut sum = DVec3::ZERO;
        let weight = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a).length();
        for t in &solid.corners {
            total += weight(t);
            sum += weight(t) * (t[0] + t[1] + t[2]) / 3.0;
        }
        let middle = sum / total;
        let mut spread = [[0.0; 3]; 3];
        for t in &solid.corners {
            // Second moments of a triangle's area: its corners and their sum, a twelfth each.
            let away = t.map(|p| p - middle);
            for p in [away[0], away[1], away[2], away[0] + away[1] + away[2]] {
                let (w, p) = (weight(t) / total / 12.0, p.to_array());
                (0..9).for_each(|k| spread[k / 3][k % 3] += w * p[k / 3] * p[k % 3]);
            }
        }
        let (values, axes) = principal(spread);
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        let thin = axes[order[0]];
        let z = if thin.dot(front) < 0.0 { -thin } else { thin };
        let long = axes[order[2]];
        let lead =
            long.to_array().into_iter().fold(0.0f64, |lead, v| if v.abs() > lead.abs() + 1e-9 { v } else { lead });
        let y = if lead < 0.0 { -long } else { long };
        Frame { x: y.cross(z), y, z }
    }
}

/// Values and unit axes of a symmetric matrix, by Jacobi's rotations.
fn principal(mut m: [[f64; 3]; 3]) -> ([f64; 3], [DVec3; 3]) {
    let mut axes = DMat3::IDENTITY;
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if m[p][q].abs() <= f64::MIN_POSITIVE {
                continue;
            }
            let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            m.iter_mut().for_each(|row| (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]));
            let (upper, lower) = (m[p], m[q]);
            m[p] = std::array::from_fn(|k| c * upper[k] - s * lower[k]);
            m[q] = std::array::from_fn(|k| s * upper[k] + c * lower[k]);
            let (a, b) = (axes.col(p), axes.col(q));
            *axes.col_mut(p) = c * a - s * b;
            *axes.col_mut(q) = s * a + c * b;
        }
    }
    ([m[0][0], m[1][1], m[2][2]], [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::normalize))
}
