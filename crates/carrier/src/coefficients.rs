//! Maps of coefficients as files hold them: filled beyond the leaf so that no mip bleeds over its rim, and in 8 bits with
//! the scale and bias that cost least.

mod range;

use crate::{CarrierError, raster_file};
use foliar_bake::FloatRaster;
use foliar_schema::MapLink;
use half::f16;
use half::slice::HalfFloatSliceExt;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use range::{Span, best_range, none};
use rayon::prelude::*;

/// Numbers of a texel: three coefficients, and the mean transmission, which is 0 off the leaf and nowhere on it.
const CHANNELS: usize = 4;
const REPORT: &str = "report it: a fault of foliar";

type Texel = [f32; CHANNELS];

/// A map in 8 bits.
pub(crate) struct Stored {
    /// RGBA, alpha above 0 everywhere.
    pub rgba: Vec<u8>,
    /// What to make of the numbers, and what they cost; neither texture nor file named.
    pub link: MapLink,
}

/// How far half floats may be from a map, rms over rms: beyond, where a map is so dark that they run out of digits, it is
/// stored in 32 bits.
const HALF_COSTS: f64 = 1e-3;

/// The numbers as an EXR of these bits gives them back: what follows from them follows from the file as well; and whether
/// they are halves.
pub(crate) fn rounded(raster: &FloatRaster, half: bool) -> (FloatRaster, bool) {
    let mut data = raster.data.clone();
    if !half {
        return (FloatRaster { data, ..*raster }, false);
    }
    let sums = data.par_chunks_mut(CHUNK).zip(raster.data.par_chunks(CHUNK)).map(|(values, own)| {
        let mut halves = vec![f16::ZERO; values.len()];
        halves.convert_from_f32_slice(values);
        halves.convert_to_f32_slice(values);
        values.iter().zip(own).fold([0.0f64; 2], |sums, (back, own)| {
            let (back, own) = (f64::from(*back), f64::from(*own));
            [sums[0] + (own - back) * (own - back), sums[1] + own * own]
        })
    });
    let sums: Vec<[f64; 2]> = sums.collect();
    let [misses, squares] = sums.into_iter().fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    if misses > HALF_COSTS * HALF_COSTS * squares {
        return (FloatRaster { data: raster.data.clone(), ..*raster }, false);
    }
    (FloatRaster { data, ..*raster }, true)
}

/// One EXR: coefficients filled beyond the leaf, and the mean transmission, which says where the leaf is.
pub(crate) fn exr(raster: &FloatRaster, filled: &[Texel], half: bool) -> Result<Vec<u8>, CarrierError> {
    let value =
        |channel: usize, at: usize| if channel < 3 { filled[at][channel] } else { raster.data[at * CHANNELS + 3] };
    raster_file::exr_of((raster.width, raster.height), CHANNELS, half, value)
        .map_err(|e| CarrierError::input("EXR", "", e.to_string(), REPORT))
}

/// PNG bytes of a map in 8 bits.
pub(crate) fn png(rgba: &[u8], width: u32, height: u32) -> Result<Vec<u8>, CarrierError> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .map_err(|e| CarrierError::input("PNG", "", e.to_string(), REPORT))?;
    Ok(bytes)
}

/// One level of the pyramid; a texel without leaf has no mean.
struct Level {
    width: usize,
    height: usize,
    texels: Vec<Texel>,
}

fn is_leaf(texel: &Texel) -> bool {
    texel[3] > 0.0
}

impl Level {
    /// The mean of each square of four texels, over those that are leaf.
    fn halved(&self) -> Level {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mut texels = vec![[0.0; CHANNELS]; width * height];
        texels.par_chunks_exact_mut(width).enumerate().for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                let mut count = 0.0f32;
                for (x, y) in [(2 * x, 2 * y), (2 * x + 1, 2 * y), (2 * x, 2 * y + 1), (2 * x + 1, 2 * y + 1)] {
                    let inside = x < self.width && y < self.height;
                    if let Some(own) = inside.then(|| self.texels[y * self.width + x]).filter(is_leaf) {
                        texel.iter_mut().zip(own).for_each(|(sum, v)| *sum += v);
                        count += 1.0;
                    }
                }
                if count > 1.0 {
                    texel.iter_mut().for_each(|sum| *sum /= count);
                }
            }
        });
        Level { width, height, texels }
    }

    /// Fills what is no leaf from the next level.
    fn fill(&mut self, above: &Level) {
        let width = self.width;
        self.texels.par_chunks_exact_mut(width).enumerate().for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate().filter(|(_, texel)| !is_leaf(texel)) {
                *texel = above.texels[y / 2 * above.width + x / 2];
            }
        });
    }
}

/// Every texel beyond the leaf gets the mean of the leaf around it, of the smallest square of the mip pyramid that holds
/// any: so each texel of each mip is the mean of what is leaf below it, and of nothing else.
pub(crate) fn filled(raster: &FloatRaster) -> Vec<Texel> {
    let texels = raster.data.par_chunks_exact(CHANNELS).map(|t| [t[0], t[1], t[2], t[3]]).collect();
    let mut levels = vec![Level { width: raster.width as usize, height: raster.height as usize, texels }];
    while let Some(last) = levels.last().filter(|level| level.width * level.height > 1) {
        let next = last.halved();
        levels.push(next);
    }
    for at in (0..levels.len() - 1).rev() {
        let (low, high) = levels.split_at_mut(at + 1);
        low[at].fill(&high[0]);
    }
    levels.swap_remove(0).texels
}

/// A map in 8 bits. Scale and bias are those, per channel, whose squared error over the leaf is least.
pub(crate) fn stored(raster: &FloatRaster, filled: &[Texel]) -> Stored {
    let chunks = || filled.par_chunks(CHUNK).zip(raster.data.par_chunks(CHUNK * CHANNELS));
    let spans = chunks().map(|(filled, own)| Span::of(leaf(filled, own))).reduce(Span::default, Span::and);
    let bins = chunks().map(|(filled, own)| spans.bins(leaf(filled, own)));
    let bins = bins.reduce(none, |a, b| std::array::from_fn(|c| a[c].iter().zip(&b[c]).map(|(a, b)| a + b).collect()));
    let ranges: [(f64, f64); 3] = std::array::from_fn(|c| best_range(&bins[c], spans.channels[c]));
    let greatest = if spans.mean > 0.0 { f64::from(spans.mean) } else { 1.0 };
    let [scale, bias] = [|r: &(f64, f64)| r.1 - r.0, |r: &(f64, f64)| r.0].map(|f| [0, 1, 2].map(|c| f(&ranges[c])));
    let link = MapLink { scale, bias, mean_scale: greatest, ..MapLink::default() };
    let mut rgba = vec![0u8; filled.len() * CHANNELS];
    let misses = rgba.par_chunks_mut(CHUNK * CHANNELS).zip(chunks()).map(|(rgba, (filled, own))| {
        let mut misses = Misses::default();
        for ((bytes, t), own) in rgba.chunks_exact_mut(CHANNELS).zip(filled).zip(own.chunks_exact(CHANNELS)) {
            bytes.copy_from_slice(&bytes_of(t, &link));
            if own[3] > 0.0 {
                misses.add(bytes, t, &ranges);
            }
        }
        misses
    });
    // Added in the order of the texels, whoever summed them.
    let misses: Vec<Misses> = misses.collect();
    let all = misses.iter().fold(Misses::default(), |a, b| a.and(b));
    let rms_error = (all.squares / (3 * all.count).max(1) as f64).sqrt();
    Stored { rgba, link: MapLink { rms_error, max_error: all.worst, ..link } }
}

/// A texel in 8 bits: alpha is 0 nowhere.
fn bytes_of(texel: &[f32], link: &MapLink) -> [u8; CHANNELS] {
    let word = |v: f64| ((v * 255.0).clamp(0.0, 255.0) + 0.5) as u8;
    let part = |c: usize| word((f64::from(texel[c]) - link.bias[c]) / link.scale[c]);
    [part(0), part(1), part(2), word(f64::from(texel[3]) / link.mean_scale).max(1)]
}

/// A map that [`from_png`] read, as it was stored.
pub(crate) fn to_8_bits(raster: &FloatRaster, link: &MapLink) -> Vec<u8> {
    raster.data.chunks_exact(CHANNELS).flat_map(|texel| bytes_of(texel, link)).collect()
}

/// Texels that one task looks at.
const CHUNK: usize = 1 << 15;

/// Those of these texels that are leaf.
fn leaf<'a>(filled: &'a [Texel], own: &'a [f32]) -> impl Iterator<Item = &'a Texel> {
    filled.iter().zip(own.chunks_exact(CHANNELS)).filter(|(_, own)| own[3] > 0.0).map(|(filled, _)| filled)
}

/// What 8 bits cost.
#[derive(Clone, Copy, Default)]
struct Misses {
    squares: f64,
    worst: f64,
    count: usize,
}

impl Misses {
    fn add(&mut self, bytes: &[u8], texel: &Texel, ranges: &[(f64, f64); 3]) {
        for (c, (low, high)) in ranges.iter().enumerate() {
            let miss = (low + (high - low) * f64::from(bytes[c]) / 255.0 - f64::from(texel[c])).abs();
            (self.squares, self.worst) = (self.squares + miss * miss, self.worst.max(miss));
        }
        self.count += 1;
    }

    fn and(self, other: &Misses) -> Misses {
        Misses {
            squares: self.squares + other.squares,
            worst: self.worst.max(other.worst),
            count: self.count + other.count,
        }
    }
}

/// The map that a PNG of 8 bits stands for, off the leaf too: what is left where no EXR lies beside the file.
pub(crate) fn from_png(rgba: &[u8], width: u32, height: u32, link: &MapLink) -> FloatRaster {
    let texel = |t: &[u8]| {
        let part = |c: usize| (link.bias[c] + link.scale[c] * f64::from(t[c]) / 255.0) as f32;
        [part(0), part(1), part(2), (link.mean_scale * f64::from(t[3]) / 255.0) as f32]
    };
    let data = rgba.chunks_exact(CHANNELS).flat_map(texel).collect();
    FloatRaster { width, height, channels: CHANNELS as u32, data }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What 8 bits stand for is stored in the same 8 bits again, whatever the range.
    #[test]
    fn eight_bits_come_back_as_they_were() {
        let rgba: Vec<u8> = (0..4 * 256).map(|i| if i % 4 == 3 { (i / 4).max(1) } else { i / 4 } as u8).collect();
        for (scale, bias) in [(1.0, 0.0), (0.3, -0.02), (1e-6, 3e-7), (0.01, -0.4), (1e3, -5.0)] {
            let link = MapLink { scale: [scale; 3], bias: [bias, -bias, 0.0], mean_scale: scale, ..MapLink::default() };
            assert_eq!(to_8_bits(&from_png(&rgba, 256, 1, &link), &link), rgba, "{scale} {bias}");
        }
    }

    /// A disk of leaf in a square of nothing.
    fn disk(size: u32) -> FloatRaster {
        let texel = |at: u32| {
            let (x, y) = ((at % size) as f32 + 0.5, (at / size) as f32 + 0.5);
            let (dx, dy) = (x / size as f32 - 0.5, y / size as f32 - 0.5);
            if dx * dx + dy * dy < 0.16 { [0.1 + 0.1 * dx, 0.05 * dy, -0.02 * dx, 0.1 + 0.05 * dy] } else { [0.0; 4] }
        };
        FloatRaster { width: size, height: size, channels: 4, data: (0..size * size).flat_map(texel).collect() }
    }

    /// Box mips of the filled map are means of leaf alone, at every level.
    #[test]
    fn mips_do_not_bleed_over_the_rim() {
        for size in [1, 7, 64] {
            let raster = disk(size);
            let mut level = Level { width: size as usize, height: size as usize, texels: filled(&raster) };
            let own = raster.data.chunks(4).map(|t| [t[0], t[1], t[2], t[3]]).collect();
            let mut truth = Level { width: size as usize, height: size as usize, texels: own };
            while level.width > 1 {
                (level, truth) = (level.halved(), truth.halved());
                for (mip, leaf) in level.texels.iter().zip(&truth.texels).filter(|(_, leaf)| is_leaf(leaf)) {
                    assert!(mip.iter().zip(leaf).all(|(a, b)| (a - b).abs() < 1e-6), "{mip:?} {leaf:?}");
                }
            }
        }
    }

    #[test]
    fn eight_bits_cost_half_a_step_and_alpha_is_above_zero() {
        let raster = disk(64);
        let filled = filled(&raster);
        let map = stored(&raster, &filled);
        let back = from_png(&map.rgba, 64, 64, &map.link);
        let step = map.link.scale.into_iter().fold(0.0, f64::max) / 255.0;
        assert!(map.link.max_error <= 0.5 * step + 1e-7, "{} of {step}", map.link.max_error);
        assert!(map.link.rms_error < 0.3 * step);
        assert!(map.rgba.chunks(4).all(|t| t[3] > 0));
        for (a, b) in back.data.chunks(4).zip(&filled) {
            assert!((f64::from(a[3]) - f64::from(b[3])).abs() <= map.link.mean_scale / 255.0);
        }
    }

    /// One texel far off coarsens all others where they are few. Cutting it costs the square of how far it is off, keeping it
    /// that over 255 squared times 12 for each texel: they are even at 780,300 texels, whatever its height.
    #[test]
    fn a_spike_is_cut_where_that_costs_less() {
        for (size, is_cut) in [(256u32, false), (1400, true)] {
            let mut raster = disk(size);
            let middle = 4 * (size / 2 * size + size / 2) as usize;
            raster.data[middle] = 2.0;
            let map = stored(&raster, &filled(&raster));
            let plain = stored(&disk(size), &filled(&disk(size)));
            assert_eq!(map.link.scale[0] < 3.0 * plain.link.scale[0], is_cut, "{size}: {:?}", map.link.scale);
            assert_eq!(map.link.max_error > 1.0, is_cut, "{size}: {}", map.link.max_error);
        }
    }

    #[test]
    fn maps_of_one_number_or_none_are_stored() {
        let one = FloatRaster { width: 1, height: 1, channels: 4, data: vec![0.25, 0.0, -0.1, 0.2] };
        let map = stored(&one, &filled(&one));
        assert!(map.link.max_error < 1e-9 && map.rgba[3] == 255);
        let none = FloatRaster { width: 2, height: 3, channels: 4, data: vec![0.0; 24] };
        assert!(stored(&none, &filled(&none)).rgba.chunks(4).all(|t| t[3] > 0));
    }

    /// Halves hold a map to .05 % until it is darker than their digits reach; then floats do.
    #[test]
    fn maps_too_dark_for_halves_are_floats() {
        for (scale, is_half) in [(1.0, true), (1e-3, true), (1e-6, false)] {
            let bright = disk(32);
            let raster = FloatRaster { data: bright.data.iter().map(|v| v * scale).collect(), ..bright };
            let (stored, half) = rounded(&raster, true);
            let off = |f: fn(f32, f32) -> f32| {
                let squares = stored.data.iter().zip(&raster.data).map(|(a, b)| f64::from(f(*a, *b)).powi(2));
                squares.sum::<f64>().sqrt()
            };
            assert_eq!(half, is_half, "{scale}");
            assert!(off(|a, b| a - b) <= 5e-4 * off(|_, b| b), "{scale}");
        }
    }
}
