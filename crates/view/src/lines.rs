//! A pen drawing (Luft07 section 5, Figure 7): ink where neighboring samples of the buffer of normals or of
//! depth differ, and round the silhouette.

use crate::camera::{Camera, PLANT_EDGE};
use crate::mask::Mask;
use crate::scene::Scene;
use crate::{Background, ViewParams};
use foliar_space::{Beam, Hit};
use glam::{IVec2, Vec2, Vec3};
use image::{Rgba, RgbaImage};
use rayon::prelude::*;

/// Edge of the squares that threads take, pixels.
const TILE: i32 = 64;
/// Jumps of depth from which something stands before something else, whatever their normals.
const DEPTH_JUMP: f32 = 0.1 * PLANT_EDGE as f32;
/// Samples along the edge of the window that decides together: odd, so that its middle is one.
const TAPS: i32 = 7;
/// Share of the window that lies before a sample from which it is taken for a gap: well above the half that lies
/// beside a straight edge.
const GAP: f32 = 0.6;
/// Ink, in bytes.
const INK: f32 = 24.0;
/// Paper, in bytes.
const PAPER: f32 = 255.0;

/// What one ray met.
#[derive(Clone, Copy)]
struct Met {
    /// Infinite where it met nothing.
    depth: f32,
    /// Unit, or zero.
    normal: Vec3,
}

/// Draws the scene's edges; the same bytes for any number of threads.
pub(crate) fn draw(scene: &Scene, camera: Camera, mask: &Mask, params: &ViewParams) -> RgbaImage {
    let per_pixel = f64::from(params.samples).sqrt().ceil() as i32;
    let pen = Pen {
        scene,
        camera,
        mask,
        size: IVec2::new(params.width_px as i32, params.height_px as i32),
        per_pixel,
        radius: params.line_width_px as f32 / 2.0 * per_pixel as f32,
        detail: (params.line_detail_px * f64::from(per_pixel) / 2.0).round() as i32,
        cosine: libm::cosf(params.line_angle_deg.to_radians() as f32),
    };
    let tiles = (pen.size + TILE - 1) / TILE;
    let shares: Vec<Vec<f32>> =
        (0..tiles.x * tiles.y).into_par_iter().map(|t| pen.tile(IVec2::new(t % tiles.x, t / tiles.x) * TILE)).collect();
    let place = |i: i32| {
        let at = IVec2::new(i % pen.size.x, i / pen.size.x);
        let (tile, inside) = (at / TILE, at % TILE);
        shares[(tile.y * tiles.x + tile.x) as usize][(inside.y * TILE + inside.x) as usize]
    };
    let mut ink: Vec<f32> = (0..pen.size.x * pen.size.y).map(place).collect();
    drop_specks(&mut ink, pen.size, params.line_detail_px);
    RgbaImage::from_fn(params.width_px, params.height_px, |x, y| {
        let share = ink[(y * params.width_px + x) as usize];
        let gray = (PAPER + (INK - PAPER) * share + 0.5) as u8;
        match params.background {
            Background::Clear => Rgba([INK as u8, INK as u8, INK as u8, (255.0 * share + 0.5) as u8]),
            _ => Rgba([gray, gray, gray, 255]),
        }
    })
}

/// Takes away ink that hangs together and is no longer than `largest` pixels along either edge.
fn drop_specks(ink: &mut [f32], size: IVec2, largest: f64) {
    let mut seen = vec![false; ink.len()];
    let index = |at: IVec2| (at.y * size.x + at.x) as usize;
    for start in 0..ink.len() {
        if ink[start] <= 0.0 || seen[start] {
            continue;
        }
        seen[start] = true;
        let (mut blot, mut next) = (vec![start], 0);
        let (mut low, mut high) = (IVec2::MAX, IVec2::MIN);
        while let Some(&here) = blot.get(next) {
            next += 1;
            let at = IVec2::new(here as i32 % size.x, here as i32 / size.x);
            (low, high) = (low.min(at), high.max(at));
            let around = (0..9).map(|i| at + IVec2::new(i % 3 - 1, i / 3 - 1));
            for there in around.filter(|p| p.cmpge(IVec2::ZERO).all() && p.cmplt(size).all()).map(index) {
                if ink[there] > 0.0 && !seen[there] {
                    seen[there] = true;
                    blot.push(there);
                }
            }
        }
        if f64::from((high - low).max_element() + 1) <= largest {
            blot.into_iter().for_each(|here| ink[here] = 0.0);
        }
    }
}

struct Pen<'a> {
    scene: &'a Scene<'a>,
    camera: Camera,
    mask: &'a Mask,
    size: IVec2,
    /// Samples along a pixel's edge.
    per_pixel: i32,
    /// Of a line, in samples.
    radius: f32,
    /// Half the edge of the window that decides together, in samples.
    detail: i32,
    /// Of the largest angle between normals that is no edge.
    cosine: f32,
}

impl Pen<'_> {
    /// Share of ink of each pixel of a tile.
    fn tile(&self, corner: IVec2) -> Vec<f32> {
        // Lines of samples beyond the tile reach into it; one more has the neighbors of the last.
        let apron = self.radius.ceil() as i32 + 1;
        let (met, edge) = self.simplified(corner * self.per_pixel - apron, TILE * self.per_pixel + 2 * apron);
        let mut ink = vec![false; met.len()];
        for y in 0..edge - 1 {
            for x in 0..edge - 1 {
                let here = y * edge + x;
                for there in [here + 1, here + edge] {
                    if let Some(nearer) = self.edge(&met, here as usize, there as usize) {
                        self.dot(&mut ink, edge, nearer as i32);
                    }
                }
            }
        }
        (0..TILE * TILE)
            .map(|i| self.share(&ink, edge, apron + IVec2::new(i % TILE, i / TILE) * self.per_pixel))
            .collect()
    }

    /// What a square of samples met, details smaller than the window left out.
    fn simplified(&self, first: IVec2, edge: i32) -> (Vec<Met>, i32) {
        let wide = edge + 2 * self.detail;
        let at = |i: i32| first - self.detail + IVec2::new(i % wide, i / wide);
        let met: Vec<Met> = (0..wide * wide).map(|i| self.sample(at(i))).collect();
        if self.detail == 0 {
            return (met, edge);
        }
        let middle = |i: i32| IVec2::new(i % edge, i / edge) + self.detail;
        ((0..edge * edge).map(|i| self.voted(&met, wide, middle(i))).collect(), edge)
    }

    /// What most of a window agree on: a gap that is small is closed, and of the samples there that one is taken
    /// whose normal is nearest to their mean. So edges stay where they are: on either side most are of that side.
    fn voted(&self, met: &[Met], wide: i32, middle: IVec2) -> Met {
        let own = met[(middle.y * wide + middle.x) as usize];
        let taps = || {
            (0..TAPS * TAPS).map(|i| {
                let offset = (IVec2::new(i % TAPS, i / TAPS) * 2 - (TAPS - 1)) * self.detail / (TAPS - 1);
                let at = middle + offset;
                met[(at.y * wide + at.x) as usize]
            })
        };
        let before = |tap: &Met| tap.depth < own.depth - DEPTH_JUMP;
        let is_gap = taps().filter(before).count() as f32 > GAP * (TAPS * TAPS) as f32;
        if !is_gap && own.depth.is_infinite() {
            return own;
        }
        let beside = |tap: &Met| if is_gap { before(tap) } else { (tap.depth - own.depth).abs() <= DEPTH_JUMP };
        let mean: Vec3 = taps().filter(beside).map(|tap| tap.normal).sum();
        let nearer = |a: Met, b: Met| if b.normal.dot(mean) > a.normal.dot(mean) { b } else { a };
        let voted = taps().filter(beside).reduce(nearer).unwrap_or(own);
        Met { depth: if is_gap { voted.depth } else { own.depth }, ..voted }
    }

    /// The nearer of two neighboring samples with an edge between them.
    fn edge(&self, met: &[Met], here: usize, there: usize) -> Option<usize> {
        let (a, b) = (met[here], met[there]);
        let is_hit = (a.depth.is_finite(), b.depth.is_finite());
        let differ = match is_hit {
            (false, false) => false,
            (true, true) => (a.depth - b.depth).abs() > DEPTH_JUMP || a.normal.dot(b.normal) < self.cosine,
            _ => true,
        };
        differ.then_some(if a.depth <= b.depth { here } else { there })
    }

    /// Inks a disc around a sample.
    fn dot(&self, ink: &mut [bool], edge: i32, center: i32) {
        let reach = self.radius as i32;
        let center = IVec2::new(center % edge, center / edge);
        let range = |middle: i32| (middle - reach).max(0)..=(middle + reach).min(edge - 1);
        for y in range(center.y) {
            for x in range(center.x) {
                if (IVec2::new(x, y) - center).as_vec2().length() <= self.radius {
                    ink[(y * edge + x) as usize] = true;
                }
            }
        }
    }

    /// Share of ink of the pixel whose first sample this is.
    fn share(&self, ink: &[bool], edge: i32, first: IVec2) -> f32 {
        let n = self.per_pixel;
        let inked = (0..n * n).filter(|i| ink[((first.y + i / n) * edge + first.x + i % n) as usize]).count();
        inked as f32 / (n * n) as f32
    }

    fn sample(&self, sample: IVec2) -> Met {
        let nothing = Met { depth: f32::INFINITY, normal: Vec3::ZERO };
        let pixel = sample.div_euclid(IVec2::splat(self.per_pixel));
        let inside = pixel.clamp(IVec2::ZERO, self.size - 1).as_uvec2();
        if !self.mask.covers(inside.x, inside.y) {
            return nothing;
        }
        let place: Vec2 = (sample.as_vec2() + 0.5) / self.per_pixel as f32;
        let beam = Beam { origin: self.camera.eye, direction: self.camera.through(place), reach: f32::INFINITY };
        // Blended materials count from half their alpha on.
        let stops = |hit: &Hit| self.scene.stops(hit, || 0.5);
        let met = |hit: Hit| Met { depth: hit.distance, normal: self.scene.surface(&hit, beam.direction).normal };
        self.scene.rays.nearest(&beam, None, stops).map_or(nothing, met)
    }
}
