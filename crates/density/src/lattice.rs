//! A lattice of points around the crown: density on it, optical depths by sweeps, interpolation.
//! Coordinates are in radii of the medium's balls, relative to the plant's center.

use crate::generators::Generator;
use glam::{DVec3, USizeVec3};
use rayon::prelude::*;

/// Points (i, j, k) at `low + step * (i, j, k)`, x fastest.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    low: DVec3,
    step: f64,
    size: USizeVec3,
    /// Radius of the balls, meters.
    pub radius: f64,
}

/// Eight points around a place, and their weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stencil {
    first: usize,
    strides: [usize; 2],
    weights: [f32; 8],
}

impl Stencil {
    /// Trilinear interpolation.
    pub fn value(&self, values: &[f32]) -> f32 {
        let [y, z] = self.strides;
        let pair = |at: usize, w: usize| self.weights[w] * values[at] + self.weights[w + 1] * values[at + 1];
        let at = self.first;
        (pair(at, 0) + pair(at + y, 2)) + (pair(at + z, 4) + pair(at + y + z, 6))
    }
}

impl Lattice {
    /// Covers all balls with a step of `radius / points_per_radius`. Where that takes more than `most`
    /// points the step grows, and the balls with it, so that none slips between the points.
    pub fn around(balls: &[Generator], radius: f64, points_per_radius: f64, most: usize) -> Lattice {
        let bounds = balls.iter().map(|ball| ball.position);
        let (low, high) =
            bounds.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let (low, high) = if balls.is_empty() { (DVec3::ZERO, DVec3::ZERO) } else { (low, high) };
        let step = 1.0 / points_per_radius;
        let mut lattice = Lattice { low, step, size: USizeVec3::ONE, radius };
        loop {
            // Multiples of the step: where the points lie does not depend on the outermost leaf.
            let first = ((low / lattice.radius - 1.0) / step).floor();
            let count = ((high / lattice.radius + 1.0) / step).ceil() - first + 1.0;
            if count.x * count.y * count.z <= most as f64 {
                lattice.low = first * step;
                lattice.size = count.as_usizevec3();
                return lattice;
            }
            lattice.radius *= 1.1;
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.size.element_product()
    }

    /// Density at each point (Luft07 eq. 2), summed in an order that depends on where the balls are only.
    pub fn splat(&self, balls: &[Generator]) -> Vec<f32> {
        let mut balls: Vec<(DVec3, f32)> =
            balls.iter().map(|b| ((b.position - self.low) / self.step, b.weight)).collect();
        balls.sort_unstable_by(|(p, v), (q, w)| {
            p.z.total_cmp(&q.z).then(p.y.total_cmp(&q.y)).then(p.x.total_cmp(&q.x)).then(v.total_cmp(w))
        });
        let mut density = vec![0.0f32; self.len()];
        density.par_chunks_mut((self.size.x * self.size.y).max(1)).enumerate().for_each(|(k, plane)| {
            let (z, reach) = (k as f64, 1.0 / self.step);
            let first = balls.partition_point(|(p, _)| p.z < z - reach);
            for (p, weight) in balls[first..].iter().take_while(|(p, _)| p.z <= z + reach) {
                self.splat_plane(*p, f64::from(*weight), z, plane);
            }
        });
        density
    }

    /// Adds one ball, given in steps, to the plane of points at `z`.
    fn splat_plane(&self, ball: DVec3, weight: f64, z: f64, plane: &mut [f32]) {
        let scale = self.step * self.step;
        let rest = 1.0 - (z - ball.z) * (z - ball.z) * scale;
        let half = (rest.max(0.0) / scale).sqrt();
        let range = |center: f64, count: usize| {
            ((center - half).ceil().max(0.0) as usize)..((center + half).floor() as usize + 1).min(count)
        };
        for j in range(ball.y, self.size.y) {
            let rest = rest - (j as f64 - ball.y) * (j as f64 - ball.y) * scale;
            for i in range(ball.x, self.size.x) {
                let inside = rest - (i as f64 - ball.x) * (i as f64 - ball.x) * scale;
                let inside = inside.max(0.0);
                plane[j * self.size.x + i] += (weight * inside * inside) as f32;
            }
        }
    }

    /// Integral of the density from each point toward `direction`, in radii: plane after plane along the
    /// axis nearest to the direction, against it; each point takes the value where its ray meets the plane
    /// before (bilinear), and the trapezoid between.
    pub fn sweep(&self, density: &[f32], direction: DVec3, depths: &mut [f32]) {
        let axis = direction.abs().max_position();
        let (b, c) = [(1, 2), (0, 2), (0, 1)][axis];
        let strides = [1, self.size.x, self.size.x * self.size.y];
        let size = self.size.to_array();
        let along = direction[axis].abs();
        let half_step = (self.step / along / 2.0) as f32;
        let shift = Shift::new(direction[b] / along, direction[c] / along);
        let planes = size[axis];
        for n in 1..planes {
            let (here, before) = if direction[axis] > 0.0 { (planes - 1 - n, planes - n) } else { (n, n - 1) };
            let (here, before) = (here * strides[axis], before * strides[axis]);
            for j in 0..size[c] {
                for i in 0..size[b] {
                    let sum = shift.sum(i, j, size[b], size[c], |i, j| {
                        let at = before + i * strides[b] + j * strides[c];
                        depths[at] + half_step * density[at]
                    });
                    let at = here + i * strides[b] + j * strides[c];
                    depths[at] = sum + half_step * density[at];
                }
            }
        }
    }

    /// The points around a place; `None` outside.
    pub fn stencil(&self, place: DVec3) -> Option<Stencil> {
        let steps = (place - self.low) / self.step;
        let last = (self.size - 1).as_dvec3();
        if steps.min_element() < 0.0 || (last - steps).min_element() < 0.0 {
            return None;
        }
        // A place on the last point belongs to the cell before it.
        let cell = steps.floor().min(last - 1.0);
        let (f, c) = ((steps - cell).as_vec3(), cell.as_usizevec3());
        let g = 1.0 - f;
        let strides = [self.size.x, self.size.x * self.size.y];
        let weights = [
            g.x * g.y * g.z,
            f.x * g.y * g.z,
            g.x * f.y * g.z,
            f.x * f.y * g.z,
            g.x * g.y * f.z,
            f.x * g.y * f.z,
            g.x * f.y * f.z,
            f.x * f.y * f.z,
        ];
        Some(Stencil { first: c.x + c.y * strides[0] + c.z * strides[1], strides, weights })
    }

    /// Where a ray from outside enters the lattice, pulled inside by rounding's worth; `None` if it misses.
    pub fn entry(&self, from: DVec3, toward: DVec3) -> Option<DVec3> {
        let high = self.low + self.step * (self.size - 1).as_dvec3();
        let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
        for axis in 0..3 {
            let (a, b) = ((self.low[axis] - from[axis]) / toward[axis], (high[axis] - from[axis]) / toward[axis]);
            // Parallel inside a slab gives 0 / 0 or infinities of both signs: min and max drop the NaN.
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter < leave).then(|| (from + toward * enter).clamp(self.low, high))
    }
}

/// A shift between planes, in steps, as offsets and bilinear weights.
struct Shift {
    low: [isize; 2],
    part: [f32; 2],
}

impl Shift {
    fn new(b: f64, c: f64) -> Shift {
        Shift { low: [b.floor() as isize, c.floor() as isize], part: [(b - b.floor()) as f32, (c - c.floor()) as f32] }
    }

    /// Weighted sum of `value` at the four points around (i, j) shifted; points outside count nothing.
    #[inline(always)]
    fn sum(&self, i: usize, j: usize, width: usize, height: usize, value: impl Fn(usize, usize) -> f32) -> f32 {
        let mut sum = 0.0;
        for (dj, wj) in [(0, 1.0 - self.part[1]), (1, self.part[1])] {
            for (di, wi) in [(0, 1.0 - self.part[0]), (1, self.part[0])] {
                let (i, j) = (i.wrapping_add_signed(self.low[0] + di), j.wrapping_add_signed(self.low[1] + dj));
                if i < width && j < height {
                    sum += wi * wj * value(i, j);
                }
            }
        }
        sum
    }
}
