//! A lattice of points around balls, and the density on it: read back as a smooth function (cubic B-spline),
//! or along columns (`columns`). Coordinates are in radii of influence, relative to the plant's center.

use crate::Isa;
use crate::generators::Generator;
use crate::surface::dense;
use glam::{DVec3, USizeVec3, Vec3};
use rayon::prelude::*;

/// Points (i, j, k) at `low + step * (i, j, k)`, x fastest.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    pub(crate) low: DVec3,
    pub(crate) step: f64,
    pub(crate) size: USizeVec3,
}

/// A place, in radii, and where it lies in a lattice, in steps from its first point; `None` outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub place: DVec3,
    pub steps: Option<Vec3>,
}

/// Share of the second differences that reading the lattice along columns adds: slices, trapezoids and lookups
/// are linear twice over along each axis, and a linear interpolation adds a twelfth.
const SHARPEN: f32 = 1.0 / 6.0;
/// Pole of the filter that takes samples to coefficients of a cubic B-spline (Unser 1999): the square root of 3, less 2.
const POLE: f32 = -0.267_949_2;
/// Points beyond the balls' reach on each side: what is read between the outermost points is exactly nothing.
const MARGIN: f64 = 2.0;

impl Lattice {
    /// Covers all balls with a step of one radius over `points_per_radius`. Where that takes more than `most`
    /// points the step grows until it does not.
    pub fn around(balls: &[Generator], radius: f64, points_per_radius: f64, most: usize) -> Lattice {
        let bounds = balls.iter().map(|ball| ball.position);
        let (low, high) =
            bounds.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let (low, high) = if balls.is_empty() { (DVec3::ZERO, DVec3::ZERO) } else { (low / radius, high / radius) };
        let mut step = 1.0 / points_per_radius;
        loop {
            // Multiples of the step: where the points lie does not depend on the outermost leaf.
            let first = ((low - 1.0) / step).floor() - MARGIN;
            let count = ((high + 1.0) / step).ceil() - first + 1.0 + MARGIN;
            if count.element_product() <= most as f64 {
                return Lattice { low: first * step, step, size: count.as_usizevec3() };
            }
            step *= 1.1;
        }
    }

    /// Whether it had to be coarser than asked for.
    pub fn is_coarser_than(&self, points_per_radius: f64) -> bool {
        self.step > 1.0 / points_per_radius
    }

    /// Where a place (radii) is.
    pub fn spot(&self, place: DVec3) -> Spot {
        let high = self.low + self.step * (self.size - 1).as_dvec3();
        let inside = place.cmpge(self.low).all() && place.cmple(high).all();
        Spot { place, steps: inside.then(|| self.steps(place)) }
    }

    /// Steps from the first point.
    pub fn steps(&self, place: DVec3) -> Vec3 {
        ((place - self.low) / self.step).as_vec3()
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.size.element_product()
    }

    /// Density at each point (Luft07 eq. 2), less what reading it along columns will add on average.
    pub fn splat(&self, balls: &[Generator], radius: f64, isa: Isa) -> Vec<f32> {
        self.sharpened(&self.density(balls, radius, isa))
    }

    /// Coefficients of the cubic B-spline that is the density at each point.
    pub fn coefficients(&self, balls: &[Generator], radius: f64, isa: Isa) -> Vec<f32> {
        let mut values = self.density(balls, radius, isa);
        let (line, plane) = (self.size.x, self.size.x * self.size.y);
        values.par_chunks_mut(plane).for_each(|plane| {
            plane.chunks_exact_mut(line).for_each(|line| interpolating(line, 1));
            interpolating(plane, line);
        });
        interpolating(&mut values, plane);
        values
    }

    fn density(&self, balls: &[Generator], radius: f64, isa: Isa) -> Vec<f32> {
        let first = (self.low / self.step).round().as_ivec3();
        dense(balls, radius, radius * self.step, (first, self.size), isa)
    }

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

    /// The cubic B-spline with these coefficients at a place; 0 near the border and outside, where no ball
    /// reaches.
    pub fn spline(&self, coefficients: &[f32], place: DVec3) -> f32 {
        let steps = (place - self.low) / self.step;
        let cell = steps.floor();
        let last = self.size.as_dvec3() - 3.0;
        if !(cell.cmpge(DVec3::ONE).all() && cell.cmple(last).all()) {
            return 0.0;
        }
        let [x, y, z] = weights((steps - cell).as_vec3());
        let first = cell.as_usizevec3() - 1;
        let (line, plane) = (self.size.x, self.size.x * self.size.y);
        let mut sums = [0.0f32; 4];
        for (k, z) in z.iter().enumerate() {
            for (j, y) in y.iter().enumerate() {
                let at = (first.z + k) * plane + (first.y + j) * line + first.x;
                let (share, row) = (y * z, &coefficients[at..at + 4]);
                sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += share * value);
            }
        }
        (sums[0] * x[0] + sums[1] * x[1]) + (sums[2] * x[2] + sums[3] * x[3])
    }
}

/// Samples to coefficients of cubic B-splines along one axis (Unser 1999), for rows of `row` entries, one after
/// the other along it. What lies beyond both ends is 0.
fn interpolating(values: &mut [f32], row: usize) {
    const GAIN: f32 = 6.0;
    const BEYOND: f32 = -POLE / (1.0 - POLE * POLE);
    let rows = values.len() / row;
    values.iter_mut().for_each(|value| *value *= GAIN);
    for at in 1..rows {
        let (before, from) = values[(at - 1) * row..(at + 1) * row].split_at_mut(row);
        from.iter_mut().zip(before).for_each(|(value, before)| *value += POLE * *before);
    }
    values[(rows - 1) * row..].iter_mut().for_each(|value| *value *= BEYOND);
    for at in (1..rows).rev() {
        let (to, after) = values[(at - 1) * row..(at + 1) * row].split_at_mut(row);
        to.iter_mut().zip(after).for_each(|(value, after)| *value = POLE * (*after - *value));
    }
}

/// Weights of the four points around a place, along each axis.
fn weights(part: Vec3) -> [[f32; 4]; 3] {
    part.to_array().map(|t| {
        let (u, squared) = (1.0 - t, t * t);
        let near = |t: f32, squared: f32| (2.0 / 3.0) - squared + squared * t * 0.5;
        [u * u * u / 6.0, near(t, squared), near(u, u * u), squared * t / 6.0]
    })
}
