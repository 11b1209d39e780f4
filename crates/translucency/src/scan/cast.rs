//! A leaf projected on its plane: one ray per texel, straight through.

use super::solid::{Crossing, Solid};
use super::{Frame, Scan};
use glam::DVec3;
use rayon::prelude::*;

/// Empty texels around the leaf.
const MARGIN: usize = 2;
/// A ray that misses where it must not runs between two triangles, by rounding: moved by this share of a texel it does not.
const NUDGE: [f64; 4] = [0.0, 1e-3, -1.7e-3, 2.3e-3];

/// What one ray found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Found {
    /// No leaf.
    Nothing,
    /// Distances of front and back along the ray; whether more leaf lies behind.
    Leaf { front: f64, back: f64, folded: bool },
    /// Crossings that do not go in and out in turn.
    Broken,
}

/// Maps of `resolution` texels along the longer side of the leaf, margins included.
pub fn project(solid: &Solid, frame: &Frame, resolution: usize) -> Scan {
    let (low, high) = bounds(solid, frame);
    let size = high - low;
    let inner = resolution.saturating_sub(2 * MARGIN).max(1);
    let texel = size.x.max(size.y) / inner as f64;
    let count = |length: f64| ((length / texel - 1e-9).ceil() as usize).max(1) + 2 * MARGIN;
    let (width, height) = (count(size.x), count(size.y));
    let middle = (low + high) / 2.0;
    let start = high.z + size.max_element();
    let place = |at: usize, nudge: f64| {
        let x = ((at % width) as f64 + 0.5 - width as f64 / 2.0 + nudge) * texel + middle.x;
        let y = (height as f64 / 2.0 - (at / width) as f64 - 0.5 + nudge) * texel + middle.y;
        frame.x * x + frame.y * y + frame.z * start
    };
    let texels: Vec<Found> = (0..width * height)
        .into_par_iter()
        .map(|at| {
            let tries = NUDGE.map(|nudge| nudge * if at % 2 == 0 { 1.0 } else { 1.3 });
            let cast = |nudge: f64| sorted_out(&solid.crossings(place(at, nudge), -frame.z));
            tries.into_iter().map(cast).find(|found| *found != Found::Broken).unwrap_or(Found::Broken)
        })
        .collect();
    let mut scan = Scan::empty(width, height, [texel; 2]);
    for (at, found) in texels.into_iter().enumerate() {
        match found {
            Found::Nothing => {}
            Found::Broken => scan.broken.push(at),
            Found::Leaf { front, back, folded } => {
                scan.thickness_mm[at] = (back - front) as f32;
                scan.heights_mm[0][at] = (start - front) as f32;
                scan.heights_mm[1][at] = (back - start) as f32;
                scan.folded += usize::from(folded);
            }
        }
    }
    scan.with_normals()
}

/// In and out in turn, from outside.
pub(super) fn sorted_out(crossings: &[Crossing]) -> Found {
    let in_turn = crossings.iter().enumerate().all(|(i, crossing)| crossing.enters == (i % 2 == 0));
    match crossings {
        [] => Found::Nothing,
        [front, back, rest @ ..] if in_turn && rest.len() % 2 == 0 => {
            Found::Leaf { front: front.distance, back: back.distance, folded: !rest.is_empty() }
        }
        _ => Found::Broken,
    }
}

fn bounds(solid: &Solid, frame: &Frame) -> (DVec3, DVec3) {
    let own = |p: &DVec3| DVec3::new(frame.x.dot(*p), frame.y.dot(*p), frame.z.dot(*p));
    let points = solid.corners.iter().flatten().map(own);
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}
