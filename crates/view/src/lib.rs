//! Pictures of what was baked: the lit tree, a channel in false colors, differences and contact
//! sheets, by ray casting. Nothing here touches a file.

mod animation;
mod camera;
mod colors;
mod difference;
mod error;
mod frame;
mod key;
mod leaf;
mod leaf_light;
mod legend;
mod lines;
mod mask;
mod params;
mod render;
mod scale;
mod scene;
mod shade;
mod sheet;
mod skins;
mod sway;
mod text;
mod texture;
mod values;

#[cfg(test)]
mod tests;

pub use animation::{apng_bytes, turntable};
pub use difference::{Difference, difference};
pub use error::ViewError;
pub use frame::Standing;
pub use leaf::{leaf_comparison, leaf_names, leaf_sheet};
pub use params::{Background, Ground, Look, Normals, Scale, Shading, ViewParams};
pub use render::{render, render_among};
pub use sheet::{Panel, bake_sheet, channel_sheet, comparison, contact_sheet, light_sheet};
pub use sway::{FRAME_S, sway_sheet, swaying};

use image::{ExtendedColorType, ImageEncoder, RgbaImage, codecs::png};

/// PNG bytes of a picture, the same on every run.
///
/// # Errors
/// [`ViewError::Png`] where the encoder refuses the picture (no pixels).
pub fn png_bytes(picture: &RgbaImage) -> Result<Vec<u8>, ViewError> {
    let mut bytes = Vec::new();
    let encoder =
        png::PngEncoder::new_with_quality(&mut bytes, png::CompressionType::Default, png::FilterType::Adaptive);
    encoder.write_image(picture.as_raw(), picture.width(), picture.height(), ExtendedColorType::Rgba8)?;
    Ok(bytes)
}
