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

/// A map that a room reads: its numbers (0 to 1 where whole numbers were stored), and how finely they were stored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapRaster {
    /// The numbers, linear: no color curve was undone.
    pub raster: FloatRaster,
    /// Bits of a stored number: 8, 16, or 32 for floats.
    pub bits: u32,
}

impl FloatRaster {
    /// Whether there are as many numbers as its measures say.
    pub fn is_whole(&self) -> bool {
        self.data.len() as u64 == u64::from(self.width) * u64::from(self.height) * u64::from(self.channels)
    }
}
