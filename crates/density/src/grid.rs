//! Balls in rows along x, so that all balls near a box of queries are a few contiguous runs.
//! Coordinates are in radii of influence, f64, relative to the plant's center.

use crate::generators::Generator;
use glam::DVec3;
use rayon::prelude::*;

/// Rows per radius along y and z: finer rows fit the ball better, coarser ones are longer runs.
const ROWS_PER_RADIUS: f64 = 3.0;
/// How far balls are looked for, in radii: the excess covers f32 rounding of coordinates (below 1e-6),
/// so that what is left out contributes exactly nothing.
const REACH: f64 = 1.0 + 1e-5;

/// A ball as the grid stores it.
#[derive(Clone, Copy, Debug)]
struct Stored {
    position: DVec3,
    weight: f32,
    group: u32,
}

/// Balls whose y and z fall into one square, sorted by x.
#[derive(Clone, Copy, Debug)]
struct Row {
    z: i32,
    y: i32,
    start: usize,
}

/// A ball relative to the origin of a block of queries, in radii.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub x: f32,
    pub y: f32,
    pub z: f32,
    pub weight: f32,
    pub group: u32,
}

/// A run of balls of one row that a block of queries may touch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    /// Lower corner of the row's square (y, z), relative to the block's origin.
    pub low: [f32; 2],
    /// First ball in [`Near::balls`].
    pub start: usize,
    /// One past the last.
    pub end: usize,
}

/// Everything near one block of queries.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    pub balls: Vec<Ball>,
    pub runs: Vec<Run>,
}

/// All balls, in rows.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    rows: Vec<Row>,
    balls: Vec<Stored>,
}

/// Edge of a row's square, in radii.
pub(crate) const ROW_EDGE: f64 = 1.0 / ROWS_PER_RADIUS;

/// Half the length along x that is within reach of a place whose distance across is `across`; `None`
/// where nothing is.
pub(crate) fn half_reach(across: [f64; 2]) -> Option<f64> {
    let rest = REACH * REACH - across[0] * across[0] - across[1] * across[1];
    (rest > 0.0).then(|| rest.sqrt())
}

/// Distance between the intervals [a, a + length] and [low, high]; 0 where they touch.
pub(crate) fn gap(a: f64, length: f64, low: f64, high: f64) -> f64 {
    (low - (a + length)).max(a - high).max(0.0)
}

impl Grid {
    /// Sorts balls into rows, in an order that depends on where they are, not on how they were listed.
    /// `inverse` is one over the radius of influence.
    pub fn new(generators: &[Generator], inverse: f64) -> Grid {
        let square = |p: DVec3| ((p.z * ROWS_PER_RADIUS).floor() as i32, (p.y * ROWS_PER_RADIUS).floor() as i32);
        let stored = |g: &Generator| {
            let position = g.position * inverse;
            (square(position), Stored { position, weight: g.weight, group: g.group })
        };
        let mut balls: Vec<((i32, i32), Stored)> =
            generators.par_iter().filter(|g| g.weight > 0.0).map(stored).collect();
        balls.par_sort_unstable_by(|(a_square, a), (b_square, b)| {
            let (p, q) = (a.position, b.position);
            a_square
                .cmp(b_square)
                .then(p.x.total_cmp(&q.x))
                .then(p.y.total_cmp(&q.y))
                .then(p.z.total_cmp(&q.z))
                .then(a.weight.total_cmp(&b.weight))
        });
        let mut rows: Vec<Row> = Vec::new();
        for (start, &((z, y), _)) in balls.iter().enumerate() {
            if rows.last().is_none_or(|row| (row.z, row.y) != (z, y)) {
                rows.push(Row { z, y, start });
            }
        }
        Grid { rows, balls: balls.into_iter().map(|(_, ball)| ball).collect() }
    }

    /// Collects what is within reach of the box `low..high` (radii), relative to `origin`.
    pub fn near(&self, low: DVec3, high: DVec3, origin: DVec3, near: &mut Near) {
        near.balls.clear();
        near.runs.clear();
        self.each_run(low, high, |balls, corner| {
            let start = near.balls.len();
            near.balls.extend(balls.iter().map(|b| {
                let p = (b.position - origin).as_vec3();
                Ball { x: p.x, y: p.y, z: p.z, weight: b.weight, group: b.group }
            }));
            let low = [(corner[0] - origin.y) as f32, (corner[1] - origin.z) as f32];
            near.runs.push(Run { low, start, end: near.balls.len() });
        });
    }

    /// Density at a place (radii), in f64: what f32 sums are measured against. And the balls looked at.
    pub fn exact(&self, place: DVec3, skip: u32) -> (f64, usize) {
        let (mut density, mut looked_at) = (0.0, 0);
        self.each_run(place, place, |balls, _| {
            looked_at += balls.len();
            for ball in balls.iter().filter(|ball| ball.group != skip) {
                let inside = (1.0 - (place - ball.position).length_squared()).max(0.0);
                density += f64::from(ball.weight) * inside * inside;
            }
        });
        (density, looked_at)
    }

    /// Calls `each` with every run of balls within reach of a box, and the lower corner (y, z) of its row.
    fn each_run(&self, low: DVec3, high: DVec3, mut each: impl FnMut(&[Stored], [f64; 2])) {
        let bound = |v: f64| (v * ROWS_PER_RADIUS).floor() as i32;
        for z in bound(low.z - REACH)..=bound(high.z + REACH) {
            let first = self.rows.partition_point(|r| (r.z, r.y) < (z, bound(low.y - REACH)));
            let last = bound(high.y + REACH);
            for (index, row) in self.rows.iter().enumerate().skip(first) {
                if row.z != z || row.y > last {
                    break;
                }
                let corner = [f64::from(row.y) * ROW_EDGE, f64::from(row.z) * ROW_EDGE];
                let across = [gap(corner[0], ROW_EDGE, low.y, high.y), gap(corner[1], ROW_EDGE, low.z, high.z)];
                if let Some(half) = half_reach(across) {
                    let end = self.rows.get(index + 1).map_or(self.balls.len(), |next| next.start);
                    let balls = &self.balls[row.start..end];
                    let from = balls.partition_point(|b| b.position.x < low.x - half);
                    let count = balls[from..].partition_point(|b| b.position.x <= high.x + half);
                    if count > 0 {
                        each(&balls[from..from + count], corner);
                    }
                }
            }
        }
    }
}
