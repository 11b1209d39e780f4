//! The exponential of many numbers at once: a loop without calls or branches, which compilers turn into vectors.
//! The same sequence of IEEE operations everywhere, so the same bits on every machine.

/// Adding and subtracting it rounds to an integer, whose low bits stand in the mantissa in between.
const ROUNDING: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts: the first has 32 bits, so that its multiples are exact.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
/// Below, the result is no normal number: it is taken as if it stood here, about 3e-308.
const LEAST: f64 = -708.0;
/// 1/n!, from n = 13 down: on |x| <= ln 2 / 2 the rest of the series is below half a bit.
const TAYLOR: [f64; 14] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
    1.0,
    1.0,
];

/// Replaces numbers, none above 0, by their exponentials, each within 4e-16 of itself; those below -708 by that of -708.
#[inline]
pub fn exp_of_negatives(values: &mut [f64]) {
    for value in values {
        // Not by `max`, which would make a number of what is none.
        let x = if *value < LEAST { LEAST } else { *value };
        let shifted = x * std::f64::consts::LOG2_E + ROUNDING;
        let whole = shifted - ROUNDING;
        let rest = (x - whole * LN_2[0]) - whole * LN_2[1];
        let mut series = TAYLOR[0];
        for term in &TAYLOR[1..] {
            series = series * rest + term;
        }
        let power = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
        *value = series * power;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_exponential() {
        let at: Vec<f64> =
            (0..200_000).map(|i| -708.0 * f64::from(i) / 199_999.0).chain([-0.0, -1e-300, -1e-9]).collect();
        let mut values = at.clone();
        exp_of_negatives(&mut values);
        for (x, y) in at.iter().zip(values) {
            let exact = libm::exp(*x);
            assert!((y - exact).abs() <= 4e-16 * exact, "{x}: {y}, not {exact}");
        }
    }

    #[test]
    fn it_ends_near_nothing() {
        let mut values = [-709.0, -1e300, f64::NEG_INFINITY];
        exp_of_negatives(&mut values);
        assert!(values.iter().all(|v| (0.0..1e-300).contains(v)), "{values:?}");
        let mut none = [f64::NAN];
        exp_of_negatives(&mut none);
        assert!(none[0].is_nan());
    }
}
