//! A lattice of points around the crown, the density on it, and columns of it along a direction: optical
//! depths with no interpolation from plane to plane, which would blur them.
//! Coordinates are in radii of the medium's balls, relative to the plant's center.

use crate::generators::Generator;
use glam::{DVec2, DVec3, USizeVec3};
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

/// Largest step, in radii, with which a ball still touches points on every side.
const COARSEST: f64 = 0.5;

/// Share of the second differences that reading the lattice adds: a twelfth, twice.
const SHARPEN: f32 = 1.0 / 6.0;

impl Lattice {
    /// Covers all balls with a step of `radius / points_per_radius`. Where that takes more than `most`
    /// points the step grows, to half a radius at most; from there on the balls grow with it, so that none
    /// slips between the points.
    pub fn around(balls: &[Generator], radius: f64, points_per_radius: f64, most: usize) -> Lattice {
        let bounds = balls.iter().map(|ball| ball.position);
        let (low, high) =
            bounds.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let (low, high) = if balls.is_empty() { (DVec3::ZERO, DVec3::ZERO) } else { (low, high) };
        let (mut step, mut radius) = (1.0 / points_per_radius, radius);
        loop {
            // Multiples of the step: where the points lie does not depend on the outermost leaf.
            let first = ((low / radius - 1.0) / step).floor();
            let count = ((high / radius + 1.0) / step).ceil() - first + 1.0;
            if count.element_product() <= most as f64 {
                return Lattice { low: first * step, step, size: count.as_usizevec3(), radius };
            }
            if step < COARSEST { step = (step * 1.1).min(COARSEST) } else { radius *= 1.1 }
        }
    }

    /// Density at each point (Luft07 eq. 2), summed in an order that depends on where the balls are only.
    pub fn splat(&self, balls: &[Generator]) -> Vec<f32> {
        let steps = |ball: &Generator| ((ball.position - self.low) / self.step, ball.weight);
        let mut balls: Vec<(DVec3, f32)> = balls.iter().map(steps).collect();
        balls.sort_unstable_by(|(p, v), (q, w)| {
            p.z.total_cmp(&q.z).then(p.y.total_cmp(&q.y)).then(p.x.total_cmp(&q.x)).then(v.total_cmp(w))
        });
        let mut density = vec![0.0f32; self.size.element_product()];
        density.par_chunks_mut(self.size.x * self.size.y).enumerate().for_each(|(k, plane)| {
            let (z, reach) = (k as f64, 1.0 / self.step);
            let first = balls.partition_point(|(p, _)| p.z < z - reach);
            for (p, weight) in balls[first..].iter().take_while(|(p, _)| p.z <= z + reach) {
                self.splat_plane(*p, *weight, z, plane);
            }
        });
        self.sharpened(&density)
    }

    /// The density less what reading it will add on average: slices of columns, trapezoids and lookups are
    /// linear twice over along each axis, and a linear interpolation adds a twelfth of the second difference.
    fn sharpened(&self, density: &[f32]) -> Vec<f32> {
        let (line, plane) = (self.size.x, self.size.x * self.size.y);
        let mut sharp = vec![0.0f32; density.len()];
        sharp.par_chunks_mut(plane).enumerate().filter(|(k, _)| (1..self.size.z - 1).contains(k)).for_each(
            |(k, out)| {
                for j in 1..self.size.y - 1 {
                    let row = k * plane + j * line;
                    for i in 1..line - 1 {
                        let at = row + i;
                        let around = (density[at - 1] + density[at + 1])
                            + (density[at - line] + density[at + line])
                            + (density[at - plane] + density[at + plane]);
                        out[j * line + i] = density[at] - (around - 6.0 * density[at]) * SHARPEN;
                    }
                }
            },
        );
        sharp
    }

    /// Adds one ball, given in steps, to the plane of points at `z`.
    fn splat_plane(&self, ball: DVec3, weight: f32, z: f64, plane: &mut [f32]) {
        let scale = self.step * self.step;
        let rest = 1.0 - (z - ball.z) * (z - ball.z) * scale;
        let half = (rest.max(0.0) / scale).sqrt();
        let range = |center: f64, count: usize| {
            ((center - half).ceil().max(0.0) as usize)..((center + half).floor() as usize + 1).min(count)
        };
        for j in range(ball.y, self.size.y) {
            let rest = rest - (j as f64 - ball.y) * (j as f64 - ball.y) * scale;
            for i in range(ball.x, self.size.x) {
                let inside = (rest - (i as f64 - ball.x) * (i as f64 - ball.x) * scale).max(0.0) as f32;
                plane[j * self.size.x + i] += weight * inside * inside;
            }
        }
    }

    /// The columns of this lattice along a unit vector.
    pub fn columns(&self, toward: DVec3) -> Columns {
        let axis = toward.abs().max_position();
        let across = [[1, 2], [0, 2], [0, 1]][axis];
        let slope = DVec2::new(toward[across[0]], toward[across[1]]) / toward[axis];
        let size = self.size.to_array();
        let reach = slope * (size[axis] - 1) as f64;
        // Column (i, j) meets plane k at (i, j) + low + slope k: shifted so that every point has its column.
        let low = -reach.max(DVec2::ZERO).ceil();
        let high = DVec2::new((size[across[0]] - 1) as f64, (size[across[1]] - 1) as f64) - reach.min(DVec2::ZERO);
        let width = (high - low).ceil() + 1.0;
        let spacing = self.step / toward[axis].abs();
        Columns {
            axis,
            across,
            slope,
            low,
            width: [width.x as usize, width.y as usize],
            spacing,
            up: toward[axis] > 0.0,
        }
    }

    /// Integral of the density along each column, from each plane on toward the direction (trapezoids),
    /// in radii: plane after plane.
    pub fn sweep(&self, density: &[f32], columns: &Columns) -> Vec<f32> {
        let planes = self.size[columns.axis];
        let [width, height] = columns.width;
        let half = (columns.spacing / 2.0) as f32;
        let mut depths = vec![0.0f32; planes * width * height];
        let (mut here, mut before) = (vec![0.0f32; width * height], vec![0.0f32; width * height]);
        for n in 0..planes {
            let k = if columns.up { planes - 1 - n } else { n };
            std::mem::swap(&mut here, &mut before);
            self.slice(density, columns, k, &mut here);
            let (from, to) = (columns.plane(if columns.up { k + 1 } else { k.wrapping_sub(1) }), columns.plane(k));
            if n > 0 {
                depths.copy_within(from, to.start);
                let lanes = depths[to].iter_mut().zip(here.iter().zip(&before));
                lanes.for_each(|(depth, (a, b))| *depth += half * (a + b));
            }
        }
        depths
    }

    /// Density where the columns meet plane `k`, bilinear; nothing outside (the outermost points are empty).
    fn slice(&self, density: &[f32], columns: &Columns, k: usize, plane: &mut [f32]) {
        plane.fill(0.0);
        let strides = [1, self.size.x, self.size.x * self.size.y];
        let [b, c] = columns.across;
        let (stride_b, stride_c) = (strides[b], strides[c]);
        let shift = columns.low + columns.slope * k as f64;
        let (whole, part) = (shift.floor(), (shift - shift.floor()).as_vec2());
        let range = |whole: f64, width: usize, size: usize| {
            let first = (-whole).max(0.0) as usize;
            first..width.min((size as f64 - 1.0 - whole).max(0.0) as usize).max(first)
        };
        let weights =
            [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y];
        let columns_i = range(whole.x, columns.width[0], self.size[b]);
        for j in range(whole.y, columns.width[1], self.size[c]) {
            let row = k * strides[columns.axis] + (j as f64 + whole.y) as usize * stride_c;
            let first = row + (columns_i.start as f64 + whole.x) as usize * stride_b;
            let line = &mut plane[j * columns.width[0]..][columns_i.clone()];
            for (n, value) in line.iter_mut().enumerate() {
                let at = first + n * stride_b;
                *value = (weights[0] * density[at] + weights[1] * density[at + stride_b])
                    + (weights[2] * density[at + stride_c] + weights[3] * density[at + stride_b + stride_c]);
            }
        }
    }

    /// Swept depth at a place, interpolated along its column and between columns; outside, that of the place
    /// where the ray enters, and 0 where it misses.
    pub fn value_toward(&self, depths: &[f32], columns: &Columns, place: DVec3, toward: DVec3) -> f32 {
        let high = self.low + self.step * (self.size - 1).as_dvec3();
        let inside = place.cmpge(self.low).all() && place.cmple(high).all();
        let entry = if inside { Some(place) } else { entry(self.low, high, place, toward) };
        entry.map_or(0.0, |entry| columns.interpolate(depths, (entry - self.low) / self.step, self.size))
    }
}

/// Where a ray from outside enters a box; `None` if it misses.
fn entry(low: DVec3, high: DVec3, from: DVec3, toward: DVec3) -> Option<DVec3> {
    let (mut enter, mut leave) = (0.0f64, f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = ((low[axis] - from[axis]) / toward[axis], (high[axis] - from[axis]) / toward[axis]);
        // Parallel inside a slab gives 0 / 0 or infinities of both signs: min and max drop the NaN.
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    (enter < leave).then(|| (from + toward * enter).clamp(low, high))
}

/// Columns along one direction: they run through the planes across the axis nearest to it.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    axis: usize,
    across: [usize; 2],
    /// Steps across for a step along the axis.
    slope: DVec2,
    /// Where column (0, 0) meets plane 0, in steps.
    low: DVec2,
    width: [usize; 2],
    /// Length of a column between two planes, in radii.
    spacing: f64,
    /// Whether the direction points up the axis.
    up: bool,
}

impl Columns {
    fn plane(&self, k: usize) -> std::ops::Range<usize> {
        let points = self.width[0] * self.width[1];
        k.wrapping_mul(points)..k.wrapping_add(1).wrapping_mul(points)
    }

    /// Linear along the column and across; `place` in steps from the lattice's first point, inside it.
    fn interpolate(&self, depths: &[f32], place: DVec3, size: USizeVec3) -> f32 {
        let [b, c] = self.across;
        let at = DVec3::new(place[self.axis], place[b], place[c]);
        let column = DVec2::new(at.y, at.z) - self.slope * at.x - self.low;
        let steps = DVec3::new(column.x, column.y, at.x);
        let last = USizeVec3::new(self.width[0], self.width[1], size[self.axis]) - 2;
        let cell = steps.floor().clamp(DVec3::ZERO, last.as_dvec3());
        let (part, first) = ((steps - cell).as_vec3(), cell.as_usizevec3());
        let (row, plane) = (self.width[0], self.width[0] * self.width[1]);
        let at = first.x + first.y * row + first.z * plane;
        let mix = |a: f32, b: f32, part: f32| a + (b - a) * part;
        let line = |at: usize| mix(depths[at], depths[at + 1], part.x);
        let face = |at: usize| mix(line(at), line(at + row), part.y);
        mix(face(at), face(at + plane), part.z)
    }
}
