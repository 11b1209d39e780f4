//! What one picture has and another has not.

use crate::key::{Key, Legend};
use crate::{ViewError, colors, legend};
use foliar_numerics::CompensatedSum;
use glam::Vec3;
use image::{Rgba, RgbaImage};

/// Difference of lightness at which the color scale ends, in steps of an 8-bit picture.
const SCALE_STEPS: f32 = 80.0;

/// Where and how much two pictures differ.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Blue where the second is darker, orange where it is brighter, white where nothing changed.
    pub picture: RgbaImage,
    /// Mean of |difference| of lightness over pixels that differ at all, in steps of an 8-bit picture.
    pub mean_steps: f64,
    /// Largest |difference| of lightness, in the same steps.
    pub max_steps: f64,
    /// Share of pixels that differ by a step or more.
    pub share: f64,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (mean, most, share) = (self.mean_steps, self.max_steps, 100.0 * self.share);
        write!(f, "difference: mean {mean:.1}, most {most:.0} steps of 255; {share:.0} % of pixels")
    }
}

/// Lightness of `b` less that of `a`, in steps of an 8-bit picture, as a picture with a legend.
///
/// # Errors
/// [`ViewError::Sizes`] where the pictures differ in size.
pub fn difference(a: &RgbaImage, b: &RgbaImage) -> Result<Difference, ViewError> {
    if a.dimensions() != b.dimensions() {
        return Err(ViewError::Sizes(a.width(), a.height(), b.width(), b.height()));
    }
    let steps: Vec<f32> = a.pixels().zip(b.pixels()).map(|(a, b)| lightness(b) - lightness(a)).collect();
    let color = |&step: &f32| colors::to_bytes(colors::diverging(step / SCALE_STEPS), 1.0);
    let bytes = steps.iter().flat_map(color).collect();
    let picture = RgbaImage::from_raw(a.width(), a.height(), bytes).unwrap_or_default();
    let changed: Vec<f64> = steps.iter().map(|s| f64::from(s.abs())).filter(|&s| s >= 1.0).collect();
    let sum = changed.iter().copied().collect::<CompensatedSum>().value();
    Ok(Difference {
        picture: legend::below(picture, &words()),
        mean_steps: sum / changed.len().max(1) as f64,
        max_steps: changed.iter().copied().fold(0.0, f64::max),
        share: changed.len() as f64 / steps.len().max(1) as f64,
    })
}

fn words() -> Legend {
    Legend {
        name: "difference of lightness".into(),
        doc: "blue: darker than before, orange: brighter".into(),
        unit: "steps of 255".into(),
        kind: Key::Diverging(SCALE_STEPS),
    }
}

/// Encoded luminance, 0 to 255.
fn lightness(pixel: &Rgba<u8>) -> f32 {
    let [r, g, b, _] = pixel.0.map(|byte| colors::to_linear(f32::from(byte) / 255.0));
    255.0 * colors::to_encoded(colors::luminance(Vec3::new(r, g, b)).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_steps_darker_is_ten_steps_darker() {
        let a = RgbaImage::from_pixel(8, 8, Rgba([120, 120, 120, 255]));
        let mut b = a.clone();
        b.put_pixel(3, 3, Rgba([110, 110, 110, 255]));
        let found = difference(&a, &b).unwrap();
        assert!((found.max_steps - 10.0).abs() < 1e-3 && (found.mean_steps - 10.0).abs() < 1e-3, "{found:?}");
        assert!((found.share - 1.0 / 64.0).abs() < 1e-12);
        let Rgba([r, _, blue, _]) = *found.picture.get_pixel(3, 3);
        assert!(blue > r, "darker is blue");
        let Rgba([r, _, blue, _]) = *found.picture.get_pixel(0, 0);
        assert!(r > 240 && blue > 240, "no change is white");
    }

    #[test]
    fn pictures_of_two_sizes_are_refused_with_both_sizes() {
        let message = difference(&RgbaImage::new(4, 3), &RgbaImage::new(4, 5)).unwrap_err().to_string();
        assert!(message.contains("4x3") && message.contains("4x5"), "{message}");
    }
}
