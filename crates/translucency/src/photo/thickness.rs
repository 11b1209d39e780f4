//! Thickness guessed from a photograph: veins are thick, the rim is thin, the mean is what the user says.
//!
//! Veins are ridges of brightness: where it bends sharply across and little along (eigenvalues of the Hessian over several
//! widths, after Frangi 1998).

use crate::kernel::Taps;
use crate::map::Image;
use foliar_numerics::Isa;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Widths of veins, standard deviations in shares of the leaf's size (square root of its area), and what a vein of each
/// adds to the blade's thickness: a midrib is some three times as thick as the blade, the net hardly thicker.
const WIDTHS: [(f64, f64); 5] = [(0.0015, 0.1), (0.003, 0.25), (0.006, 0.5), (0.012, 0.9), (0.02, 1.2)];
/// Share of the leaf that counts as no vein when strengths are scaled.
const USUAL: f64 = 0.985;
/// Width of the rim, in shares of the leaf's size, and its thickness over that of the blade.
const RIM_WIDTH: f64 = 0.012;
const RIM: f64 = 0.55;
/// A texel belongs to the leaf where its alpha reaches this.
const COVERED: f32 = 0.5;

/// How veins look in the photograph.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Veins {
    /// Whichever stands out more.
    #[default]
    Auto,
    /// Lighter than the blade: most leaves from their front.
    Light,
    /// Darker: backlit leaves.
    Dark,
}

/// What is known of a photographed leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Mean thickness of the leaf, mm.
    pub mean_mm: f64,
    /// How veins look.
    pub veins: Veins,
}

/// Thickness, mm, of every texel of a photograph (four numbers a texel: linear color, alpha); 0 where there is no leaf. The mean
/// over the leaf is `look.mean_mm`. An estimate: nothing but the mean is measured.
pub fn thickness_from_photo(rgba: &[f32], width: usize, look: &Look) -> Vec<f32> {
    let leaf: Vec<bool> = rgba.chunks_exact(4).map(|texel| texel[3] >= COVERED).collect();
    let count = leaf.iter().filter(|leaf| **leaf).count();
    if count == 0 || width == 0 {
        return vec![0.0; leaf.len()];
    }
    let size = (count as f64).sqrt();
    let veins = veins(rgba, &leaf, width, size, look.veins);
    let rims = distances(&leaf, width);
    let relative = |at: usize| {
        let rim = 1.0 - (1.0 - RIM) * libm::exp(-f64::from(rims[at]) / (RIM_WIDTH * size).max(1.0));
        if leaf[at] { (1.0 + f64::from(veins[at])) * rim } else { 0.0 }
    };
    let relative: Vec<f64> = (0..leaf.len()).into_par_iter().map(relative).collect();
    let scale = look.mean_mm * count as f64 / relative.iter().sum::<f64>();
    relative.into_iter().map(|v| (v * scale) as f32).collect()
}

/// What veins add to the thickness of the blade, as a share of it.
fn veins(rgba: &[f32], leaf: &[bool], width: usize, size: f64, look: Veins) -> Vec<f32> {
    // The cube root is nearly what eyes call even steps: veins stand out alike in dark and light leaves.
    let brightness = |texel: &[f32]| libm::cbrtf((0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]).max(0.0));
    let levels: Vec<f32> = rgba.par_chunks_exact(4).map(brightness).collect();
    let smooth = WIDTHS.map(|(share, _)| Smooth::of(&levels, leaf, width, (share * size).max(0.8)));
    let ridges = |sign: f32| smooth.each_ref().map(|smooth| smooth.ridges(leaf, sign));
    // Dark and light by what the widest veins say: of the net, gaps are as sharp as lines.
    let strength = |ridges: &[Vec<f32>; 5]| ridges[2..].iter().flatten().map(|v| f64::from(*v)).sum::<f64>();
    let found = match look {
        Veins::Light => ridges(-1.0),
        Veins::Dark => ridges(1.0),
        Veins::Auto => {
            let (light, dark) = (ridges(-1.0), ridges(1.0));
            if strength(&dark) > strength(&light) { dark } else { light }
        }
    };
    let mut added = vec![0.0f32; leaf.len()];
    for (ridge, (_, adds)) in found.iter().zip(WIDTHS) {
        let usual = quantile(ridge, leaf);
        if usual > 0.0 {
            // The widest that is there counts: widths of one vein do not add up.
            added.iter_mut().zip(ridge).for_each(|(sum, v)| *sum = sum.max(adds as f32 * (v / usual).min(1.0)));
        }
    }
    added
}

/// Brightness smoothed over the leaf alone, and the share of the smoothing that was leaf.
struct Smooth {
    width: usize,
    sigma: f64,
    levels: Vec<f32>,
    weights: Vec<f32>,
}

impl Smooth {
    fn of(levels: &[f32], leaf: &[bool], width: usize, sigma: f64) -> Smooth {
        let mut both = vec![0.0; 3 * leaf.len()];
        let texels = both.par_chunks_exact_mut(3).zip(levels.par_iter().zip(leaf)).filter(|(_, (_, leaf))| **leaf);
        texels.for_each(|(texel, (level, _))| texel[..2].copy_from_slice(&[*level, 1.0]));
        let taps = Taps::gaussian(sigma * sigma);
        let both = Image::new(width, leaf.len() / width, both).filtered((&taps, &taps), Isa::best());
        let texels = both.texels().par_chunks_exact(3);
        let (levels, weights) = texels.map(|t| (if t[1] > 1e-3 { t[0] / t[1] } else { 0.0 }, t[1])).unzip();
        Smooth { width, sigma, levels, weights }
    }

    /// How much each texel is a ridge of this width: bent across (with this sign), straight along.
    fn ridges(&self, leaf: &[bool], sign: f32) -> Vec<f32> {
        let (width, rows) = (self.width, leaf.len() / self.width);
        // As far as the blur reaches the rim is a ridge of its own making.
        let reach = (1.5 * self.sigma).ceil() as usize;
        let value = |at: usize| {
            let (x, y) = (at % width, at / width);
            let within = x >= reach && y >= reach && x + reach < width && y + reach < rows;
            if !(leaf[at] && within && self.weights[at] > 0.9) {
                return 0.0;
            }
            let v = |dx: i64, dy: i64| self.levels[(at as i64 + dy * width as i64 + dx) as usize];
            let (xx, yy) = (v(1, 0) + v(-1, 0) - 2.0 * v(0, 0), v(0, 1) + v(0, -1) - 2.0 * v(0, 0));
            let xy = (v(1, 1) + v(-1, -1) - v(1, -1) - v(-1, 1)) / 4.0;
            let (mean, half) = (sign * (xx + yy) / 2.0, ((xx - yy) * (xx - yy) / 4.0 + xy * xy).sqrt());
            let (across, along) = (mean + half, mean - half);
            (across - along.abs()).max(0.0) * (self.sigma * self.sigma) as f32
        };
        (0..leaf.len()).into_par_iter().map(value).collect()
    }
}

/// The strength that all but a few texels of the leaf stay below.
fn quantile(values: &[f32], leaf: &[bool]) -> f32 {
    let mut own: Vec<f32> = values.iter().zip(leaf).filter(|(_, leaf)| **leaf).map(|(v, _)| *v).collect();
    let at = ((own.len() as f64 * USUAL) as usize).min(own.len().saturating_sub(1));
    own.select_nth_unstable_by(at, f32::total_cmp);
    own[at]
}

/// Distance to the nearest texel that is no leaf, in texels (Felzenszwalb and Huttenlocher 2012); the edge of the picture is
/// none: a leaf may reach beyond it.
fn distances(leaf: &[bool], width: usize) -> Vec<f32> {
    let rows = leaf.len() / width;
    let far = (leaf.len() as f64 + 1.0).powi(2);
    let mut squares: Vec<f64> = leaf.iter().map(|leaf| if *leaf { far } else { 0.0 }).collect();
    for x in 0..width {
        let column: Vec<f64> = (0..rows).map(|y| squares[y * width + x]).collect();
        parabolas(&column).into_iter().enumerate().for_each(|(y, v)| squares[y * width + x] = v);
    }
    for row in squares.chunks_mut(width) {
        let found = parabolas(row);
        row.copy_from_slice(&found);
    }
    squares.into_iter().map(|v| v.sqrt() as f32).collect()
}

/// Lower envelope of parabolas on a line.
fn parabolas(heights: &[f64]) -> Vec<f64> {
    let mut hull: Vec<(usize, f64)> = Vec::with_capacity(heights.len());
    let meet = |a: usize, b: usize| {
        let (x, y) = (a as f64, b as f64);
        ((heights[b] + y * y) - (heights[a] + x * x)) / (2.0 * (y - x))
    };
    for q in 0..heights.len() {
        let mut from = f64::NEG_INFINITY;
        while let Some((last, start)) = hull.last() {
            from = meet(*last, q);
            if from > *start {
                break;
            }
            hull.pop();
            from = f64::NEG_INFINITY;
        }
        hull.push((q, from));
    }
    let mut at = 0;
    (0..heights.len())
        .map(|q| {
            while at + 1 < hull.len() && hull[at + 1].1 < q as f64 {
                at += 1;
            }
            let away = q as f64 - hull[at].0 as f64;
            away * away + heights[hull[at].0]
        })
        .collect()
}
