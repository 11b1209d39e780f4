//! What one leaf adds, in f32: occlusions, logarithms, shares (Boulanger08 section 6.1).

/// Occlusion of a whole leaf that is far, from its area over the squared distance.
#[inline(always)]
pub fn far_occlusion<const CAP: bool>(x: f32) -> f32 {
    // 4 q / (r (r + 1)) with q = x / 2 and r = sqrt(1 + q), by powers of x.
    if CAP { x * (1.0 - x * (0.375 - x * (0.156_25 - x * 0.068_359_375))) } else { x }
}

/// -ln(1 - o) of a small o.
#[inline(always)]
pub fn far_depth(o: f32) -> f32 {
    o * (1.0 + o * (0.5 + o * (1.0 / 3.0 + o * (0.25 + o * 0.2))))
}

/// -ln(1 - o) of a whole leaf that is far, from its area over the squared distance.
#[inline(always)]
pub fn far_whole_depth<const CAP: bool>(x: f32) -> f32 {
    if CAP {
        // -ln(4 / r - 3) by powers of x = 2 q: 2 q + q^2 / 2 + 11 q^3 / 12 + 17 q^4 / 32.
        x * (1.0 + x * (0.125 + x * (11.0 / 96.0 + x * (17.0 / 512.0))))
    } else {
        far_depth(x)
    }
}

/// -ln(1 - o) of any o from 0 to the most there is.
#[inline(always)]
pub fn any_depth(o: f32) -> f32 {
    const LN_2: f32 = std::f32::consts::LN_2;
    /// Bits of the square root of 1/2: mantissas are brought between it and its double.
    const ROOT: u32 = 0x3f35_04f3;
    let rest = 1.0 - o;
    // The power of two of the rest (0 to -8), and its mantissa.
    let shift = (rest.to_bits().wrapping_sub(ROOT) as i32) >> 23;
    let mantissa = f32::from_bits(rest.to_bits().wrapping_sub((shift << 23) as u32));
    // Near 1 the rest has lost digits that o still has.
    let (above, sum) = if shift == 0 { (-o, 2.0 - o) } else { (mantissa - 1.0, mantissa + 1.0) };
    let s = above / sum;
    let square = s * s;
    let series = 1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0 + square * (1.0 / 9.0))));
    -(shift as f32 * LN_2 + 2.0 * s * series)
}

/// Share of a leaf beyond a plane, its center `offset` beyond it.
#[inline(always)]
pub fn share(offset: f32, per_width: f32) -> f32 {
    let share = 0.5 + offset * per_width;
    let share = if share > 0.0 { share } else { 0.0 };
    if share < 1.0 { share } else { 1.0 }
}

/// Shares of the eight octants from those beyond each plane.
#[inline(always)]
pub fn octant_shares(x: f32, y: f32, z: f32) -> [f32; 8] {
    let [below, above] = [(1.0 - z), z].map(|z| [(1.0 - x) * z, x * z]);
    let y_below = 1.0 - y;
    [
        below[0] * y_below,
        below[1] * y_below,
        above[0] * y_below,
        above[1] * y_below,
        below[0] * y,
        below[1] * y,
        above[0] * y,
        above[1] * y,
    ]
}
