//! Optical depths by the chords of all balls, up to f32 rounding: for few places, for crowns of few balls, and
//! where no lattice is fine enough. Along each axis of the sky balls fall into squares across it, and each
//! place adds those within its reach ([`crate::chord_sums`]).

use crate::Isa;
use crate::chord_sums::{Balls, LANES, Runs};
use crate::directions::AXES;
use crate::field::Query;
use crate::generators::Generator;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// Edge of a square, in radii, and most squares for each ball.
const SQUARE: f64 = 0.25;
const SQUARES_PER_BALL: f64 = 2.0;
/// Reach of a ball across the axis, in radii: the excess covers f32 rounding.
const REACH: f64 = 1.0 + 1e-5;
/// Places of one task.
const TASK: usize = 64;

/// Depths at each place toward both ends of each axis, and how many pairs of ball and place were looked at.
pub(crate) struct Depths {
    pub axes: Vec<Vec<[f32; 2]>>,
    pub pairs: u64,
}

/// Depths in radii, before the extinction's scale.
pub(crate) fn depths(balls: &[Generator], radius: f64, queries: &[Query], axes: &[DVec3; AXES], isa: Isa) -> Depths {
    let along = |toward: &DVec3| {
        let shafts = Shafts::new(balls, radius, *toward);
        let task = |queries: &[Query]| {
            let mut sums = Vec::with_capacity(queries.len());
            let pairs = shafts.sum(queries, radius, isa, &mut sums);
            (sums, pairs)
        };
        let tasks: Vec<(Vec<[f32; 2]>, u64)> = queries.par_chunks(TASK).map(task).collect();
        let pairs = tasks.iter().map(|task| task.1).sum::<u64>();
        (tasks.into_iter().flat_map(|task| task.0).collect(), pairs)
    };
    let (axes, pairs): (Vec<_>, Vec<u64>) = axes.par_iter().map(along).unzip();
    Depths { axes, pairs: pairs.iter().sum() }
}

/// Balls by squares across one axis, in radii; padded to whole lanes.
struct Shafts {
    frame: [DVec3; 3],
    low: DVec2,
    edge: f64,
    columns: usize,
    rows: usize,
    /// First ball of each square, row after row, and their number at the end.
    starts: Vec<u32>,
    balls: Balls,
}

impl Shafts {
    fn new(balls: &[Generator], radius: f64, toward: DVec3) -> Shafts {
        let (x, y) = toward.any_orthonormal_pair();
        let frame = [x, y, toward];
        let seen: Vec<DVec3> = balls.iter().map(|ball| view(&frame, ball.position / radius)).collect();
        let fold = |(low, high): (DVec2, DVec2), p: &DVec3| (low.min(p.truncate()), high.max(p.truncate()));
        let (low, high) = seen.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), fold);
        let (low, extent) = if seen.is_empty() { (DVec2::ZERO, DVec2::ZERO) } else { (low, high - low) };
        let most = SQUARES_PER_BALL * (seen.len() as f64 + 1.0);
        let edge = SQUARE.max((extent.element_product() / most).sqrt()).max(extent.max_element() / most);
        let [columns, rows] = (extent / edge).to_array().map(|n| n as usize + 1);
        let mut shafts =
            Shafts { frame, low, edge, columns, rows, starts: vec![0; columns * rows + 1], balls: Balls::default() };
        shafts.fill(balls, &seen);
        shafts
    }

    /// Sorts balls into squares, in their own order within each.
    fn fill(&mut self, balls: &[Generator], seen: &[DVec3]) {
        let square = |p: &DVec3| {
            let cell = ((p.truncate() - self.low) / self.edge).as_usizevec2();
            cell.y.min(self.rows - 1) * self.columns + cell.x.min(self.columns - 1)
        };
        let squares: Vec<u32> = seen.iter().map(|p| square(p) as u32).collect();
        squares.iter().for_each(|&square| self.starts[square as usize + 1] += 1);
        (1..self.starts.len()).for_each(|i| self.starts[i] += self.starts[i - 1]);
        let padded = balls.len() + LANES;
        let Balls { across, along, weight, group } = &mut self.balls;
        for list in across.iter_mut().chain([&mut *along, &mut *weight]) {
            list.resize(padded, 0.0);
        }
        group.resize(padded, 0);
        let mut next = self.starts.clone();
        for ((ball, p), square) in balls.iter().zip(seen).zip(squares) {
            let slot = &mut next[square as usize];
            let at = *slot as usize;
            *slot += 1;
            (across[0][at], across[1][at], along[at]) = (p.x as f32, p.y as f32, p.z as f32);
            (weight[at], group[at]) = (ball.weight, ball.group);
        }
    }

    /// Appends the depths of queries, and counts the pairs.
    fn sum(&self, queries: &[Query], radius: f64, isa: Isa, sums: &mut Vec<[f32; 2]>) -> u64 {
        let (mut pairs, mut runs) = (0, Vec::new());
        for query in queries {
            let p = view(&self.frame, query.position / radius);
            runs.clear();
            runs.extend(self.touched(p.y, REACH, 1).map(|row| self.run(p, row)).filter(|run| !run.is_empty()));
            pairs += runs.iter().map(|run| run.len() as u64).sum::<u64>();
            let place = [p.x as f32, p.y as f32, p.z as f32];
            let found = isa.dispatch(Runs { balls: &self.balls, runs: &runs, place, skip: query.skip });
            let total = |lanes: &[f32; LANES]| lanes.iter().map(|&lane| f64::from(lane)).sum::<f64>();
            let (whole, part) = (total(&found.whole), total(&found.part));
            sums.push([(whole - part).max(0.0) as f32, (whole + part).max(0.0) as f32]);
        }
        pairs
    }

    /// Squares along an axis that an interval touches.
    fn touched(&self, middle: f64, half: f64, axis: usize) -> Range<usize> {
        let count = [self.columns, self.rows][axis];
        let cell = |v: f64| ((v - self.low[axis]) / self.edge).floor();
        let (first, last) = (cell(middle - half).max(0.0), cell(middle + half).min(count as f64 - 1.0));
        if first > last { 0..0 } else { first as usize..last as usize + 1 }
    }

    /// Balls of a row of squares that may reach a place across the axis.
    fn run(&self, p: DVec3, row: usize) -> Range<usize> {
        let low = self.low.y + row as f64 * self.edge;
        let gap = (low - p.y).max(p.y - (low + self.edge)).max(0.0);
        let squares = self.touched(p.x, (REACH * REACH - gap * gap).max(0.0).sqrt(), 0);
        let start = |square: usize| self.starts[row * self.columns + square] as usize;
        start(squares.start)..start(squares.end)
    }
}

/// Coordinates across and along an axis.
fn view(frame: &[DVec3; 3], place: DVec3) -> DVec3 {
    DVec3::new(place.dot(frame[0]), place.dot(frame[1]), place.dot(frame[2]))
}
