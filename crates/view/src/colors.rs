//! Colors: sRGB, mild tone mapping, and false colors that are even to the eye (Oklab, Ottosson 2020).

use foliar_schema::Role;
use glam::{Mat3, Vec3};

pub(crate) use foliar_numerics::{linear_of_srgb as to_linear, srgb_of_linear as to_encoded};

/// Eight bits per channel of linear light; alpha is linear as it is.
pub(crate) fn to_bytes(linear: Vec3, alpha: f32) -> [u8; 4] {
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    let [r, g, b] = linear.clamp(Vec3::ZERO, Vec3::ONE).to_array().map(|c| byte(to_encoded(c)));
    [r, g, b, byte(alpha)]
}

/// Below this tone mapping changes nothing.
pub(crate) const SHOULDER: f32 = 0.6;

/// The same below [`SHOULDER`]; above it a hyperbola of the same slope that never reaches 1.
pub(crate) fn tone(light: Vec3) -> Vec3 {
    let room = 1.0 - SHOULDER;
    let map = |c: f32| if c <= SHOULDER { c } else { SHOULDER + room * (c - SHOULDER) / (c - SHOULDER + room) };
    Vec3::new(map(light.x), map(light.y), map(light.z))
}

/// How bright linear light looks (Rec. 709 luminance).
pub(crate) fn luminance(linear: Vec3) -> f32 {
    linear.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Linear light of an Oklab color given by lightness, chroma and hue (degrees), cut to what a screen can show.
fn oklch(lightness: f32, chroma: f32, hue_deg: f32) -> Vec3 {
    let hue = hue_deg.to_radians();
    let (a, b) = (chroma * libm::cosf(hue), chroma * libm::sinf(hue));
    let lms = Vec3::new(
        lightness + 0.396_337_78 * a + 0.215_803_76 * b,
        lightness - 0.105_561_346 * a - 0.063_854_17 * b,
        lightness - 0.089_484_18 * a - 1.291_485_5 * b,
    );
    const TO_RGB: Mat3 = Mat3::from_cols(
        Vec3::new(4.076_741_7, -1.268_438, -0.004_196_086_3),
        Vec3::new(-3.307_711_6, 2.609_757_4, -0.703_418_6),
        Vec3::new(0.230_969_94, -0.341_319_38, 1.707_614_7),
    );
    (TO_RGB * (lms * lms * lms)).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Color of a number in [0, 1]: from dark violet over teal to light yellow, lightness rising evenly.
pub(crate) fn ramp(share: f32) -> Vec3 {
    let share = share.clamp(0.0, 1.0);
    oklch(0.22 + 0.70 * share, 0.10 + 0.06 * share, 310.0 - 205.0 * share)
}

/// Color of a signed number in [-1, 1]: blue below, white at 0, orange above.
pub(crate) fn diverging(share: f32) -> Vec3 {
    let share = share.clamp(-1.0, 1.0);
    let hue = if share < 0.0 { 260.0 } else { 50.0 };
    oklch(0.97 - 0.45 * share.abs(), 0.17 * share.abs(), hue)
}

/// Color of an id: neighbors differ, no order is implied.
pub(crate) fn of_id(id: u32) -> Vec3 {
    let mixed = mix(id);
    let hue = (mixed & 0xFFFF) as f32 * (360.0 / 65536.0);
    oklch(0.55 + 0.3 * (mixed >> 16) as f32 / 65536.0, 0.13, hue)
}

/// Color of a role.
pub(crate) fn of_role(role: Role) -> Vec3 {
    match role {
        Role::Wood => oklch(0.6, 0.13, 50.0),
        Role::Leaf => oklch(0.75, 0.17, 140.0),
        Role::Other => oklch(0.6, 0.13, 260.0),
    }
}

/// Color of a unit vector: its components as red, green, blue around middle gray (sRGB).
pub(crate) fn of_direction(unit: Vec3) -> Vec3 {
    let share = (unit * 0.5 + 0.5).clamp(Vec3::ZERO, Vec3::ONE);
    Vec3::from_array(share.to_array().map(to_linear))
}

/// Color of places without a value.
pub(crate) const NO_VALUE: Vec3 = Vec3::splat(0.35);

/// Thorough mixing of 32 bits (finalizer of MurmurHash3).
pub(crate) fn mix(bits: u32) -> u32 {
    let mut h = bits;
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_of_middle_gray_is_188() {
        // IEC 61966-2-1: linear 0.5 is 187.5 of 255; 188 decodes to 0.5029.
        assert_eq!(to_bytes(Vec3::splat(0.5), 1.0), [188, 188, 188, 255]);
        assert!((to_linear(188.0 / 255.0) - 0.5029).abs() < 1e-4);
    }

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        for byte in 0..=255u8 {
            let linear = to_linear(f32::from(byte) / 255.0);
            assert_eq!(to_bytes(Vec3::splat(linear), 1.0)[0], byte);
        }
    }

    #[test]
    fn tone_mapping_is_mild_rising_and_below_one() {
        assert_eq!(tone(Vec3::splat(0.3)), Vec3::splat(0.3));
        let values: Vec<f32> = (0..200).map(|i| tone(Vec3::splat(i as f32 * 0.05)).x).collect();
        assert!(values.windows(2).all(|w| w[0] < w[1]) && values[199] < 1.0);
    }

    #[test]
    fn the_ramp_gets_lighter_evenly() {
        let lightness = |c: Vec3| libm::cbrtf(luminance(c));
        let steps: Vec<f32> = (0..=10).map(|i| lightness(ramp(i as f32 / 10.0))).collect();
        let rises: Vec<f32> = steps.windows(2).map(|w| w[1] - w[0]).collect();
        let mean = (steps[10] - steps[0]) / 10.0;
        // Even within half a step: cube root of luminance is not quite Oklab's lightness.
        assert!(rises.iter().all(|r| (r - mean).abs() < 0.5 * mean), "{rises:?}");
    }

    #[test]
    fn the_diverging_map_is_symmetric_in_lightness_and_white_at_zero() {
        assert!(diverging(0.0).min_element() > 0.85);
        assert!(diverging(1.0).x > diverging(1.0).z && diverging(-1.0).x < diverging(-1.0).z);
    }
}
