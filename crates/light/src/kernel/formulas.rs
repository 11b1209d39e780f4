//! What one leaf adds, in f32: occlusions, logarithms, shares (Boulanger08 section 6.1).

use super::lanes::Lanes;
use super::near::{POWER, WHOLE};
use pulp::Simd;

/// Occlusion of a whole leaf that is far, from its area over the squared distance.
#[inline(always)]
pub fn far_occlusion<const CAP: bool, S: Simd>(x: Lanes<S>) -> Lanes<S> {
    // 4 q / (r (r + 1)) with q = x / 2 and r = sqrt(1 + q), by powers of x.
    if CAP { x * (1.0 - x * (0.375 - x * (0.156_25 - x * 0.068_359_375))) } else { x }
}

/// -ln(1 - o) of a small o.
#[inline(always)]
pub fn far_depth<S: Simd>(o: Lanes<S>) -> Lanes<S> {
    o * (1.0 + o * (0.5 + o * (1.0 / 3.0 + o * (0.25 + o * 0.2))))
}

/// -ln(1 - o) of a whole leaf that is far, from its area over the squared distance.
#[inline(always)]
pub fn far_whole_depth<const CAP: bool, S: Simd>(x: Lanes<S>) -> Lanes<S> {
    if CAP {
        // -ln(4 / r - 3) by powers of x = 2 q: 2 q + q^2 / 2 + 11 q^3 / 12 + 17 q^4 / 32.
        x * (1.0 + x * (0.125 + x * (11.0 / 96.0 + x * (17.0 / 512.0))))
    } else {
        far_depth(x)
    }
}

/// -ln of a product that began at [`WHOLE`] and has come down to `passed`; `stopped` is 1 less its part of the whole.
#[inline(always)]
pub fn depth_of_product<S: Simd>(passed: Lanes<S>, stopped: Lanes<S>) -> Lanes<S> {
    const LN_2: f32 = std::f32::consts::LN_2;
    const { assert!(WHOLE == (1u32 << POWER as u32) as f32) };
    let (power, mantissa) = passed.power_and_mantissa();
    // Near the whole, what was stopped has digits that the rest has lost.
    let near_whole = power.equals(POWER);
    let above = near_whole.choose(0.0 - stopped, mantissa - 1.0);
    let sum = near_whole.choose(2.0 - stopped, mantissa + 1.0);
    let s = above / sum;
    let square = s * s;
    let series = 1.0 + square * (1.0 / 3.0 + square * (0.2 + square * (1.0 / 7.0 + square * (1.0 / 9.0))));
    (POWER - power) * LN_2 - 2.0 * (s * series)
}

/// Share of a leaf beyond a plane, its center `offset` beyond it.
#[inline(always)]
pub fn share<S: Simd>(offset: Lanes<S>, per_width: f32) -> Lanes<S> {
    (0.5 + offset * per_width).max(0.0).min(1.0)
}

/// `whole` in the parts of the eight octants, from the shares beyond each plane.
#[inline(always)]
pub fn parts<S: Simd>(whole: Lanes<S>, [x, y, z]: [Lanes<S>; 3]) -> [Lanes<S>; 8] {
    let [below, above] = halves(whole, y);
    let ([ba, bb], [aa, ab]) = (halves(below, z), halves(above, z));
    let ([a, b], [c, d], [e, f], [g, h]) = (halves(ba, x), halves(bb, x), halves(aa, x), halves(ab, x));
    [a, b, c, d, e, f, g, h]
}

#[inline(always)]
fn halves<S: Simd>(whole: Lanes<S>, above: Lanes<S>) -> [Lanes<S>; 2] {
    [whole * (1.0 - above), whole * above]
}

/// Squared length.
#[inline(always)]
pub fn square<S: Simd>([x, y, z]: [Lanes<S>; 3]) -> Lanes<S> {
    x * x + y * y + z * z
}
