//! Rasters that a room makes: floats, never encoded bytes.

/// Floats in rows of texels, from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloatRaster {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Numbers per texel.
    pub channels: u32,
    /// Texel after texel.
    pub data: Vec<f32>,
}

impl FloatRaster {
    /// Whether there are as many numbers as its measures say.
    pub fn is_whole(&self) -> bool {
        self.data.len() as u64 == u64::from(self.width) * u64::from(self.height) * u64::from(self.channels)
    }
}
