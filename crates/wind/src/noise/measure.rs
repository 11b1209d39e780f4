//! What a texture really is: measured on the numbers that are written, by a way of its own (Fourier sums over
//! rows and columns), not read off the parameters.

use super::NoiseParams;
use super::synthesis::turns;
use foliar_bake::FloatRaster;
use foliar_numerics::CompensatedSum;
use rayon::prelude::*;
use serde_json::{Value, json};

/// Measured figures of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Falling slope of the power spectrum along rows and columns, both channels; none where the band is too narrow.
    pub slope: Option<f64>,
    /// Rms step across the edge of the tile over the rms step inside; near 1 where no seam shows.
    pub seam_ratio: f64,
    /// Pearson correlation of the two channels.
    pub correlation: f64,
    /// Mean of the channel whose mean is farther from 0.
    pub mean: f64,
    /// Root mean square of both channels: the texture is scaled so that its peak is 1.
    pub rms: f64,
}

impl Measured {
    /// As the record keeps it.
    pub fn to_json(self) -> Value {
        json!({
            "slope": self.slope, "seamRatio": self.seam_ratio, "correlation": self.correlation,
            "mean": self.mean, "rms": self.rms,
        })
    }
}

/// Lowest frequency of the fit: below, a section of the discrete field is no power law yet.
const FIT_FROM: u32 = 3;

/// Frequencies over which the slope is fitted. The band ends in a circle, which steepens sections near its edge:
/// the fit stays in the lowest eighth, and takes four frequencies at least.
fn fit_band(params: &NoiseParams) -> Option<(u32, u32)> {
    let from = params.kmin.max(FIT_FROM);
    let to = (params.kmax / 8).max(from + 3);
    (2 * to <= params.kmax).then_some((from, to))
}

/// Measures a texture of two channels.
pub fn measure(raster: &FloatRaster, params: &NoiseParams) -> Measured {
    let texture = Texture { size: raster.width as usize, data: &raster.data };
    let means = [0, 1].map(|channel| texture.mean_of(|x, y| texture.at(x, y, channel)));
    let power =
        |a: usize, b: usize| texture.mean_of(|x, y| texture.at(x, y, a) * texture.at(x, y, b)) - means[a] * means[b];
    let (aa, bb, ab) = (power(0, 0), power(1, 1), power(0, 1));
    Measured {
        slope: fit_band(params).map(|(from, to)| slope(&texture, from, to)),
        seam_ratio: seam_ratio(&texture),
        correlation: ab / (aa * bb).sqrt().max(f64::MIN_POSITIVE),
        mean: if means[0].abs() > means[1].abs() { means[0] } else { means[1] },
        rms: f64::midpoint(aa, bb).sqrt(),
    }
}

struct Texture<'a> {
    size: usize,
    data: &'a [f32],
}

impl Texture<'_> {
    fn at(&self, x: usize, y: usize, channel: usize) -> f64 {
        f64::from(self.data[2 * (y * self.size + x) + channel])
    }

    fn mean_of(&self, value: impl Fn(usize, usize) -> f64) -> f64 {
        let mut sum = CompensatedSum::default();
        for y in 0..self.size {
            (0..self.size).for_each(|x| sum.add(value(x, y)));
        }
        sum.value() / (self.size * self.size) as f64
    }

    /// Power at `k` waves per tile, over all rows, columns and channels.
    fn power(&self, k: u32, turns: &[[f64; 2]]) -> f64 {
        let line = |value: &dyn Fn(usize) -> f64| {
            let (mut re, mut im) = (0.0, 0.0);
            for i in 0..self.size {
                let [c, s] = turns[k as usize * i % self.size];
                re += value(i) * c;
                im += value(i) * s;
            }
            re * re + im * im
        };
        let lines = (0..self.size).flat_map(|j| [(j, 0), (j, 1)]);
        lines.map(|(j, channel)| line(&|i| self.at(i, j, channel)) + line(&|i| self.at(j, i, channel))).sum()
    }
}

/// Least squares through log power over log frequency.
fn slope(texture: &Texture, from: u32, to: u32) -> f64 {
    let turns = turns(texture.size);
    let frequencies: Vec<u32> = (from..=to).collect();
    let power: Vec<f64> = frequencies.par_iter().map(|&k| libm::log(texture.power(k, &turns))).collect();
    let logs: Vec<f64> = frequencies.iter().map(|&k| libm::log(f64::from(k))).collect();
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    let (x, y) = (mean(&logs), mean(&power));
    let covariance: f64 = logs.iter().zip(&power).map(|(a, b)| (a - x) * (b - y)).sum();
    -covariance / logs.iter().map(|a| (a - x) * (a - x)).sum::<f64>()
}

fn seam_ratio(texture: &Texture) -> f64 {
    let (size, mut seam, mut inner) = (texture.size, 0.0, 0.0);
    for i in 0..size {
        for j in 0..size {
            for channel in [0, 1] {
                let next = (i + 1) % size;
                let along = texture.at(next, j, channel) - texture.at(i, j, channel);
                let down = texture.at(j, next, channel) - texture.at(j, i, channel);
                *if next == 0 { &mut seam } else { &mut inner } += along * along + down * down;
            }
        }
    }
    (seam * (size - 1) as f64 / inner.max(f64::MIN_POSITIVE)).sqrt()
}
