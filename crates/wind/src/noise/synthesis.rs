//! Synthesis in the frequency domain: fixed amplitudes, random phases. Tiles by construction.
//!
//! No Fourier crate: the sums are separable and the band narrow, so they cost little, and their only
//! transcendental numbers come from crate `libm`, the same bits on every machine.

use super::NoiseParams;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// One wave of the field: amplitude and phase at a place of the half plane of frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Waves along a row; 0 or above.
    pub kx: i32,
    /// Waves along a column.
    pub ky: i32,
    /// Cosine and sine part in the first channel.
    pub first: [f64; 2],
    /// The same in the second: turned by a right angle, one way or the other.
    pub second: [f64; 2],
}

/// All waves of the band, in the order of (ky, kx). Amplitudes are k^(-(beta + 1) / 2) exactly, only phases are drawn: so
/// every texture has the slope, and not only their mean. Turning each wave by a right angle gives a second
/// channel of the same spectrum whose correlation with the first is zero; two seeds would give one of up to a half,
/// since few low waves carry most of the power.
pub fn modes(params: &NoiseParams) -> Vec<Mode> {
    let band = params.kmax as i32;
    let inside = |kx: i32, ky: i32| {
        let square = (kx * kx + ky * ky) as u32;
        (params.kmin * params.kmin..=params.kmax * params.kmax).contains(&square) && (kx > 0 || ky > 0)
    };
    let places = (-band..=band).flat_map(|ky| (0..=band).map(move |kx| (kx, ky)));
    places.filter(|&(kx, ky)| inside(kx, ky)).map(|(kx, ky)| mode(kx, ky, params)).collect()
}

fn mode(kx: i32, ky: i32, params: &NoiseParams) -> Mode {
    let square = f64::from(kx * kx + ky * ky);
    let amplitude = libm::pow(square, -(params.beta + 1.0) / 4.0);
    let bits = hash(u64::from(params.seed) << 32 ^ ((kx as u64) << 16 | u64::from(ky as u16)));
    let phase = TAU * ((bits >> 11) as f64 / (1u64 << 53) as f64);
    let first = [amplitude * libm::cos(phase), amplitude * libm::sin(phase)];
    let turn = if bits & 1 == 0 { 1.0 } else { -1.0 };
    Mode { kx, ky, first, second: [-turn * first[1], turn * first[0]] }
}

/// SplitMix64 (Steele 2014).
fn hash(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Cosine and sine of every whole fraction of a turn.
pub(super) fn turns(size: usize) -> Vec<[f64; 2]> {
    let angle = |i: usize| TAU * i as f64 / size as f64;
    (0..size).map(|i| [libm::cos(angle(i)), libm::sin(angle(i))]).collect()
}

/// Both channels at every texel, row by row: first sums over ky for each column of frequencies, then over kx.
pub(super) fn separable(modes: &[Mode], size: usize) -> Vec<[f64; 2]> {
    let turns = turns(size);
    let widest = modes.iter().map(|mode| mode.kx).max().unwrap_or(0) as usize;
    (0..size).into_par_iter().flat_map_iter(|y| row(modes, &turns, widest, y)).collect()
}

/// One row of texels.
fn row(modes: &[Mode], turns: &[[f64; 2]], widest: usize, y: usize) -> Vec<[f64; 2]> {
    let size = turns.len();
    // Per kx: real and imaginary part of both channels.
    let mut sums = vec![[[0.0; 2]; 2]; widest + 1];
    for mode in modes {
        let [c, s] = turns[phase_index(mode.ky, y, size)];
        for (sum, [re, im]) in sums[mode.kx as usize].iter_mut().zip([mode.first, mode.second]) {
            sum[0] += re * c - im * s;
            sum[1] += re * s + im * c;
        }
    }
    let texel = |x: usize| {
        let mut value = [0.0; 2];
        for (kx, sum) in sums.iter().enumerate() {
            let [c, s] = turns[kx * x % size];
            value[0] += sum[0][0] * c - sum[0][1] * s;
            value[1] += sum[1][0] * c - sum[1][1] * s;
        }
        value
    };
    (0..size).map(texel).collect()
}

fn phase_index(k: i32, at: usize, size: usize) -> usize {
    (i64::from(k) * at as i64).rem_euclid(size as i64) as usize
}

/// The same, wave by wave at each texel: the shortest correct program.
pub(super) fn direct(modes: &[Mode], size: usize) -> Vec<[f64; 2]> {
    let texel = |x: usize, y: usize| {
        modes.iter().fold([0.0; 2], |sum, mode| {
            let angle = TAU * (f64::from(mode.kx) * x as f64 + f64::from(mode.ky) * y as f64) / size as f64;
            let (c, s) = (libm::cos(angle), libm::sin(angle));
            let wave = |[re, im]: [f64; 2]| re * c - im * s;
            [sum[0] + wave(mode.first), sum[1] + wave(mode.second)]
        })
    };
    (0..size).flat_map(|y| (0..size).map(move |x| texel(x, y))).collect()
}
