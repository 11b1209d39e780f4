//! The curve of sRGB.

/// Linear light of an sRGB value in [0, 1] (IEC 61966-2-1).
pub fn linear_of_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::powf((encoded + 0.055) / 1.055, 2.4) }
}

/// sRGB value of linear light in [0, 1].
pub fn srgb_of_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * libm::powf(linear, 1.0 / 2.4) - 0.055 }
}
