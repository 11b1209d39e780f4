//! Chance by rule: integer hashes (splitmix64, Steele 2014) and smooth noise that repeats.

/// Well-mixed bits of `index` under `seed`.
pub fn hash(seed: u64, index: u64) -> u64 {
    let mut z = seed.wrapping_mul(0xD1B5_4A32_D192_ED03).wrapping_add(index.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A number in [0, 1).
pub fn unit(seed: u64, index: u64) -> f64 {
    (hash(seed, index) >> 11) as f64 / (1u64 << 53) as f64
}

/// A number in [-1, 1).
pub fn signed(seed: u64, index: u64) -> f64 {
    2.0 * unit(seed, index) - 1.0
}

/// Smooth noise in [-1, 1] over the plane that repeats after `period` lattice cells in x and y.
pub fn tile(seed: u64, x: f64, y: f64, period: (i64, i64)) -> f64 {
    let (x0, y0) = (x.floor(), y.floor());
    let corner = |dx: i64, dy: i64| {
        let (i, j) = ((x0 as i64 + dx).rem_euclid(period.0), (y0 as i64 + dy).rem_euclid(period.1));
        signed(seed, (i as u64) << 32 | j as u64)
    };
    let (u, v) = (fade(x - x0), fade(y - y0));
    let low = mix(corner(0, 0), corner(1, 0), u);
    let high = mix(corner(0, 1), corner(1, 1), u);
    mix(low, high, v)
}

/// Four octaves of [`tile`], each half as strong and twice as fine; about [-1, 1].
pub fn cloud(seed: u64, x: f64, y: f64, period: (i64, i64)) -> f64 {
    let octave = |k: u32| {
        let scale = f64::from(1 << k);
        let period = (period.0 << k, period.1 << k);
        tile(seed.wrapping_add(u64::from(k)), x * scale, y * scale, period) / scale
    };
    (0..4).map(octave).sum::<f64>() / 1.5
}

/// Linear interpolation.
pub fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// 0 below `low`, 1 above `high`, smooth between.
pub fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}
