//! The range that 8 bits span, per channel: the one that costs least.

use super::Texel;

/// Bins in which the best range of 8 bits is looked for.
const BINS: usize = 1024;
/// Shares of the texels that a range may leave out at either end.
const CUTS: [f64; 7] = [0.0, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3];

/// Counts of texels in each bin of each channel.
pub(super) type Bins = [Vec<u32>; 3];

pub(super) fn none() -> Bins {
    std::array::from_fn(|_| vec![0; BINS])
}

/// Least and greatest number of each channel, and the greatest mean.
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub channels: [(f32, f32); 3],
    pub mean: f32,
}

impl Default for Span {
    fn default() -> Span {
        Span { channels: [(f32::INFINITY, f32::NEG_INFINITY); 3], mean: 0.0 }
    }
}

impl Span {
    pub fn of<'a>(texels: impl Iterator<Item = &'a Texel>) -> Span {
        texels.fold(Span::default(), |span, t| span.and(Span { channels: [0, 1, 2].map(|c| (t[c], t[c])), mean: t[3] }))
    }

    pub fn and(self, other: Span) -> Span {
        let wider = |c: usize| {
            let ((a, b), (c, d)) = (self.channels[c], other.channels[c]);
            (a.min(c), b.max(d))
        };
        Span { channels: [0, 1, 2].map(wider), mean: self.mean.max(other.mean) }
    }

    pub fn bins<'a>(&self, texels: impl Iterator<Item = &'a Texel>) -> Bins {
        let mut bins = none();
        let scales = self.channels.map(|(least, most)| BINS as f64 / (f64::from(most) - f64::from(least)));
        for texel in texels {
            for (c, bins) in bins.iter_mut().enumerate() {
                // No number where there is one value alone: the first bin.
                let bin = (f64::from(texel[c]) - f64::from(self.channels[c].0)) * scales[c];
                bins[(bin as usize).min(BINS - 1)] += 1;
            }
        }
        bins
    }
}

/// Least and greatest number of a channel that 8 bits span: what lies beyond is cut where that costs less than coarser
/// steps for all.
pub(super) fn best_range(bins: &[u32], (least, most): (f32, f32)) -> (f64, f64) {
    let (least, most) = (f64::from(least), f64::from(most));
    if least >= most {
        // One number, or none: any step holds it.
        let only = if least.is_finite() { least } else { 0.0 };
        return (only, only + 1.0);
    }
    let width = (most - least) / BINS as f64;
    let total = bins.iter().map(|count| f64::from(*count)).sum::<f64>();
    // Bins that must be left out at an end before more than a share of the texels is.
    let edge = |cut: f64, bin: &dyn Fn(usize) -> usize| {
        let mut seen = 0.0;
        let first = (0..BINS).find(|at| {
            seen += f64::from(bins[bin(*at)]);
            seen > cut * total
        });
        bin(first.unwrap_or(0))
    };
    let lows: Vec<usize> = CUTS.iter().map(|cut| edge(*cut, &|at| at)).collect();
    let highs: Vec<usize> = CUTS.iter().map(|cut| edge(*cut, &|at| BINS - 1 - at)).collect();
    let mut best = (f64::MAX, least, most);
    for low in &lows {
        for high in highs.iter().filter(|high| *high >= low) {
            let (a, b) = (least + width * *low as f64, least + width * (*high + 1) as f64);
            let step = (b - a) / 255.0;
            let beyond = |bin: usize| {
                let center = least + width * (bin as f64 + 0.5);
                (a - center).max(center - b).max(0.0)
            };
            let outside = (0..*low).chain(*high + 1..BINS);
            let cut: f64 = outside.map(|bin| f64::from(bins[bin]) * beyond(bin) * beyond(bin)).sum();
            let cost = total * step * step / 12.0 + cut;
            if cost < best.0 {
                best = (cost, a, b);
            }
        }
    }
    (best.1, best.2)
}
