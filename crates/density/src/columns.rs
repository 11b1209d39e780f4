//! Columns of a lattice along an axis of the sky: optical depths toward both its ends, with no interpolation
//! from plane to plane, which would blur them.

use crate::lattice::Lattice;
use glam::{DVec2, DVec3, USizeVec3, Vec2, Vec3};

/// Columns along one direction: they run through the planes across the axis nearest to it.
#[derive(Clone, Debug)]
pub(crate) struct Columns<'a> {
    lattice: &'a Lattice,
    toward: DVec3,
    axis: usize,
    across: [usize; 2],
    /// Steps across for a step along the axis.
    slope: DVec2,
    /// Where column (0, 0) meets plane 0, in steps.
    low: DVec2,
    width: [usize; 2],
    /// Whether the direction points up the axis.
    up: bool,
    /// Integral of the density along each column, from each plane on toward the direction, in radii.
    depths: Vec<f32>,
}

impl<'a> Columns<'a> {
    /// Sweeps the density on a lattice along a unit vector (trapezoids).
    pub fn new(lattice: &'a Lattice, density: &[f32], toward: DVec3) -> Columns<'a> {
        let mut columns = Columns::empty(lattice, toward);
        columns.sweep(density);
        columns
    }

    /// Number of points that a sweep along a unit vector fills: three times the lattice's where that is as high as it is
    /// wide, and without end where it is long and thin and the vector slants across.
    pub fn points(lattice: &Lattice, toward: DVec3) -> f64 {
        let columns = Columns::empty(lattice, toward);
        let planes = lattice.size[columns.axis] as f64;
        planes * columns.width[0] as f64 * columns.width[1] as f64
    }

    fn empty(lattice: &'a Lattice, toward: DVec3) -> Columns<'a> {
        let axis = toward.abs().max_position();
        let across = [[1, 2], [0, 2], [0, 1]][axis];
        let slope = DVec2::new(toward[across[0]], toward[across[1]]) / toward[axis];
        let size = lattice.size.to_array();
        let reach = slope * (size[axis] - 1) as f64;
        // Column (i, j) meets plane k at (i, j) + low + slope k: shifted so that every point has its column.
        let low = -reach.max(DVec2::ZERO).ceil();
        let high = DVec2::new((size[across[0]] - 1) as f64, (size[across[1]] - 1) as f64) - reach.min(DVec2::ZERO);
        let width = (high - low).ceil() + 1.0;
        let width = [width.x as usize, width.y as usize];
        let up = toward[axis] > 0.0;
        Columns { lattice, toward, axis, across, slope, low, width, up, depths: Vec::new() }
    }

    fn sweep(&mut self, density: &[f32]) {
        let planes = self.lattice.size[self.axis];
        let [width, height] = self.width;
        let half = (self.lattice.step / self.toward[self.axis].abs() / 2.0) as f32;
        let mut depths = vec![0.0f32; planes * width * height];
        let (mut here, mut before) = (vec![0.0f32; width * height], vec![0.0f32; width * height]);
        for n in 0..planes {
            let k = if self.up { planes - 1 - n } else { n };
            std::mem::swap(&mut here, &mut before);
            self.slice(density, k, &mut here);
            let (from, to) = (self.plane(if self.up { k + 1 } else { k.wrapping_sub(1) }), self.plane(k));
            if n > 0 {
                depths.copy_within(from, to.start);
                let lanes = depths[to].iter_mut().zip(here.iter().zip(&before));
                lanes.for_each(|(depth, (a, b))| *depth += half * (a + b));
            }
        }
        self.depths = depths;
    }

    fn plane(&self, k: usize) -> std::ops::Range<usize> {
        let points = self.width[0] * self.width[1];
        k.wrapping_mul(points)..k.wrapping_add(1).wrapping_mul(points)
    }

    /// Density where the columns meet plane `k`, bilinear; nothing outside (the outermost points are empty).
    fn slice(&self, density: &[f32], k: usize, plane: &mut [f32]) {
        plane.fill(0.0);
        let size = self.lattice.size;
        let strides = [1, size.x, size.x * size.y];
        let [b, c] = self.across;
        let (stride_b, stride_c) = (strides[b], strides[c]);
        let shift = self.low + self.slope * k as f64;
        let (whole, part) = (shift.floor(), (shift - shift.floor()).as_vec2());
        let range = |whole: f64, width: usize, size: usize| {
            let first = (-whole).max(0.0) as usize;
            first..width.min((size as f64 - 1.0 - whole).max(0.0) as usize).max(first)
        };
        let weights =
            [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y];
        let columns_i = range(whole.x, self.width[0], size[b]);
        for j in range(whole.y, self.width[1], size[c]) {
            let row = k * strides[self.axis] + (j as f64 + whole.y) as usize * stride_c;
            let first = row + (columns_i.start as f64 + whole.x) as usize * stride_b;
            let line = &mut plane[j * self.width[0]..][columns_i.clone()];
            for (n, value) in line.iter_mut().enumerate() {
                let at = first + n * stride_b;
                *value = (weights[0] * density[at] + weights[1] * density[at + stride_b])
                    + (weights[2] * density[at + stride_c] + weights[3] * density[at + stride_b + stride_c]);
            }
        }
    }

    /// Depths toward the direction and away from it at a place (radii), interpolated along its column and
    /// between columns; outside, those of the places where the rays enter, and 0 where they miss.
    pub fn depths(&self, place: DVec3) -> [f32; 2] {
        let (low, step) = (self.lattice.low, self.lattice.step);
        let high = low + step * (self.lattice.size - 1).as_dvec3();
        let inside = |place: DVec3| self.interpolate(((place - low) / step).as_vec3());
        if place.cmpge(low).all() && place.cmple(high).all() {
            return inside(place);
        }
        let entry = |toward: DVec3| entry(low, high, place, toward);
        [entry(self.toward).map_or(0.0, |p| inside(p)[0]), entry(-self.toward).map_or(0.0, |p| inside(p)[1])]
    }

    /// Linear along the column and across; `place` in steps from the lattice's first point, inside it.
    fn interpolate(&self, place: Vec3) -> [f32; 2] {
        let [b, c] = self.across;
        let along = place[self.axis];
        let column = Vec2::new(place[b], place[c]) - self.slope.as_vec2() * along - self.low.as_vec2();
        let steps = Vec3::new(column.x, column.y, along);
        let size = USizeVec3::new(self.width[0], self.width[1], self.lattice.size[self.axis]);
        let cell = steps.floor().clamp(Vec3::ZERO, (size - 2).as_vec3());
        let (part, first) = (steps - cell, cell.as_usizevec3());
        let (row, plane) = (size.x, size.x * size.y);
        let mix = |a: f32, b: f32, part: f32| a + (b - a) * part;
        let face = |at: usize| {
            let [a, b] = [&self.depths[at..at + 2], &self.depths[at + row..at + row + 2]];
            mix(mix(a[0], a[1], part.x), mix(b[0], b[1], part.x), part.y)
        };
        let at = first.x + first.y * row;
        let ahead = mix(face(at + first.z * plane), face(at + (first.z + 1) * plane), part.z);
        // What is not ahead is behind: the whole column stands in the plane where the sweep ended.
        let whole = face(at + if self.up { 0 } else { (size.z - 1) * plane });
        [ahead, (whole - ahead).max(0.0)]
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
