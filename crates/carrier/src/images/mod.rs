//! Decoding images (engineer "obj" fills this in).

use crate::CarrierError;
use foliar_plant::Raster;

/// Decodes PNG, JPEG, TIFF, TGA or BMP bytes to RGBA; `name` stands in messages and in the raster.
///
/// # Errors
/// [`CarrierError::Input`] for what is none of these, or truncated, or larger than its bytes can hold.
pub fn decode(bytes: &[u8], name: &str) -> Result<Raster, CarrierError> {
    let _ = bytes;
    Err(CarrierError::input(name, "", "not decoded yet", "wait"))
}
