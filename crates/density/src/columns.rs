//! Columns of a lattice along an axis of the sky: optical depths toward both its ends, with no interpolation
//! from plane to plane, which would blur them.

use crate::lattice::{Lattice, Spot};
use glam::{DVec2, DVec3, IVec3, USizeVec3, Vec2, Vec3};
use std::ops::Range;

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
        let (mut here, mut before) = (Slice::new(self.width), Slice::new(self.width));
        for n in 0..planes {
            let k = if self.up { planes - 1 - n } else { n };
            std::mem::swap(&mut here, &mut before);
            self.slice(density, k, &mut here);
            if n > 0 {
                let (from, to) = neighbors(&mut depths, k, width * height, self.up);
                to.copy_from_slice(from);
                let [columns, rows] = [0, 1].map(|axis| union(&here.filled[axis], &before.filled[axis]));
                for row in rows {
                    let line = row * width + columns.start..row * width + columns.end;
                    let lanes = to[line.clone()].iter_mut().zip(&here.values[line.clone()]).zip(&before.values[line]);
                    lanes.for_each(|((depth, a), b)| *depth += half * (a + b));
                }
            }
        }
        self.depths = depths;
    }

    /// Density where the columns meet plane `k`, bilinear; nothing outside (the outermost points are empty).
    fn slice(&self, density: &[f32], k: usize, plane: &mut Slice) {
        plane.clear();
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
        plane.filled = [columns_i.clone(), range(whole.y, self.width[1], size[c])];
        for j in plane.filled[1].clone() {
            let row = k * strides[self.axis] + (j as f64 + whole.y) as usize * stride_c;
            let first = row + (columns_i.start as f64 + whole.x) as usize * stride_b;
            let line = &mut plane.values[j * self.width[0]..][columns_i.clone()];
            for (n, value) in line.iter_mut().enumerate() {
                let at = first + n * stride_b;
                *value = (weights[0] * density[at] + weights[1] * density[at + stride_b])
                    + (weights[2] * density[at + stride_c] + weights[3] * density[at + stride_b + stride_c]);
            }
        }
    }

    /// Depths toward the direction and away from it at a place, interpolated along its column and
    /// between columns; outside, those of the places where the rays enter, and 0 where they miss.
    pub fn depths(&self, spot: &Spot) -> [f32; 2] {
        spot.steps.map_or_else(|| self.seen_from_outside(spot.place), |steps| self.interpolate(steps))
    }

    fn seen_from_outside(&self, place: DVec3) -> [f32; 2] {
        let low = self.lattice.low;
        let high = low + self.lattice.step * (self.lattice.size - 1).as_dvec3();
        let depths = |toward: DVec3| entry(low, high, place, toward).map(|p| self.interpolate(self.lattice.steps(p)));
        [depths(self.toward).map_or(0.0, |d| d[0]), depths(-self.toward).map_or(0.0, |d| d[1])]
    }

    /// Linear along the column and across; `place` in steps from the lattice's first point, inside it.
    fn interpolate(&self, place: Vec3) -> [f32; 2] {
        let [b, c] = self.across;
        let along = place[self.axis];
        let column = Vec2::new(place[b], place[c]) - self.slope.as_vec2() * along - self.low.as_vec2();
        let steps = Vec3::new(column.x, column.y, along);
        let size = USizeVec3::new(self.width[0], self.width[1], self.lattice.size[self.axis]);
        // Truncated, not rounded down: below 0 both end at the first cell.
        let first = steps.as_ivec3().clamp(IVec3::ZERO, (size - 2).as_ivec3());
        let (part, first) = (steps - first.as_vec3(), first.as_usizevec3());
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

/// Density where the columns meet a plane: nothing but in a rectangle of it.
struct Slice {
    width: usize,
    values: Vec<f32>,
    filled: [Range<usize>; 2],
}

impl Slice {
    fn new(width: [usize; 2]) -> Slice {
        Slice { width: width[0], values: vec![0.0; width[0] * width[1]], filled: [0..0, 0..0] }
    }

    fn clear(&mut self) {
        let [columns, rows] = &self.filled;
        let rows = self.values.chunks_exact_mut(self.width).take(rows.end).skip(rows.start);
        rows.for_each(|row| row[columns.clone()].fill(0.0));
    }
}

/// What holds both ranges.
fn union(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}

/// The plane before plane `k`, of `points` each, and that plane itself: the one above where the sweep runs down.
fn neighbors(depths: &mut [f32], k: usize, points: usize, down: bool) -> (&[f32], &mut [f32]) {
    if down {
        let (to, from) = depths[k * points..].split_at_mut(points);
        (&from[..points], to)
    } else {
        let (from, to) = depths.split_at_mut(k * points);
        (&from[(k - 1) * points..], &mut to[..points])
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
