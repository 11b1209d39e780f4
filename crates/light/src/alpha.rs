//! Whether the texture of a part stops light at a point of it.

use foliar_plant::{AlphaMode, Part, Plant, Raster};
use glam::Vec2;

/// Alpha of a part.
pub(crate) struct Cover<'a> {
    /// Where it has alpha that counts.
    raster: Option<&'a Raster>,
    factor: f32,
    mode: AlphaMode,
    /// Of a mask, which texels stop light, row by row: an eighth of what the picture takes, so that caches hold it.
    bits: Vec<u64>,
}

impl<'a> Cover<'a> {
    /// The alpha of a part of a plant.
    pub fn new(plant: &'a Plant, part: &'a Part) -> Cover<'a> {
        let base = plant.base();
        let material = part.material.and_then(|index| base.materials.get(index as usize));
        let mode = material.map_or(AlphaMode::Opaque, |material| material.alpha_mode);
        let raster = material.and_then(|m| m.base_color_raster).and_then(|index| base.rasters.get(index as usize));
        let whole = |raster: &&Raster| {
            let texels = raster.width as usize * raster.height as usize;
            texels > 0 && raster.rgba.len() == 4 * texels && raster.has_alpha && part.uvs.len() == part.positions.len()
        };
        let raster = raster.filter(whole);
        let mut cover = Cover { raster, factor: material.map_or(1.0, |m| m.base_color[3]), mode, bits: Vec::new() };
        if let (AlphaMode::Mask(cutoff), Some(raster)) = (mode, raster) {
            let stops = |texel: &[u8]| u64::from(cover.of_texel(texel[3]) >= cutoff);
            let word = |texels: &[u8]| texels.chunks(4).rev().fold(0, |bits, texel| bits << 1 | stops(texel));
            cover.bits = raster.rgba.chunks(4 * u64::BITS as usize).map(word).collect();
        }
        cover
    }

    /// Whether a triangle with these coordinates in the texture stops light at these weights of its second and third
    /// corner; what is blended does so by `chance`.
    pub fn stops(&self, uvs: &[Vec2; 3], weights: [f32; 2], chance: u64) -> bool {
        match (self.mode, self.raster) {
            (AlphaMode::Opaque, _) => true,
            (AlphaMode::Mask(cutoff), None) => self.factor >= cutoff,
            (AlphaMode::Blend, None) => self.factor > unit(chance),
            (AlphaMode::Mask(_), Some(raster)) => {
                let texel = texel(raster, uvs, weights);
                self.bits[texel / u64::BITS as usize] >> (texel % u64::BITS as usize) & 1 == 1
            }
            (AlphaMode::Blend, Some(raster)) => {
                self.of_texel(raster.rgba[4 * texel(raster, uvs, weights) + 3]) > unit(chance)
            }
        }
    }

    fn of_texel(&self, alpha: u8) -> f32 {
        f32::from(alpha) / 255.0 * self.factor
    }
}

/// Which texel of a repeated picture lies at these weights.
fn texel(raster: &Raster, [a, b, c]: &[Vec2; 3], [u, v]: [f32; 2]) -> usize {
    let uv = a + (b - a) * u + (c - a) * v;
    let along = |at: f32, size: u32| ((at - at.floor()) * size as f32) as u32 % size;
    along(uv.y, raster.height) as usize * raster.width as usize + along(uv.x, raster.width) as usize
}

/// A number from 0 to 1 without pattern (the finalizer of SplitMix64).
fn unit(seed: u64) -> f32 {
    let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 40) as f32 / (1u64 << 24) as f32
}
