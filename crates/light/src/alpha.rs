//! Whether the texture of a part stops light at a point of it.

use foliar_plant::{AlphaMode, Part, Plant, Raster};
use glam::Vec2;

/// Alpha of a part.
pub(crate) struct Cover<'a> {
    part: &'a Part,
    /// Where it has alpha that counts.
    raster: Option<&'a Raster>,
    factor: f32,
    mode: AlphaMode,
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
        Cover { part, raster: raster.filter(whole), factor: material.map_or(1.0, |m| m.base_color[3]), mode }
    }

    /// Whether a triangle stops light at these weights of its second and third corner; what is blended does so by
    /// `chance`.
    pub fn stops(&self, triangle: [u32; 3], weights: [f32; 2], chance: u64) -> bool {
        match self.mode {
            AlphaMode::Opaque => true,
            AlphaMode::Mask(cutoff) => self.alpha(triangle, weights) >= cutoff,
            AlphaMode::Blend => self.alpha(triangle, weights) > unit(chance ^ u64::from(triangle[0]) << 32),
        }
    }

    fn alpha(&self, triangle: [u32; 3], [u, v]: [f32; 2]) -> f32 {
        let Some(raster) = self.raster else { return self.factor };
        let [a, b, c]: [Vec2; 3] = triangle.map(|vertex| self.part.uvs[vertex as usize]);
        let uv = a + (b - a) * u + (c - a) * v;
        let texel = |at: f32, size: u32| ((at - at.floor()) * size as f32) as u32 % size;
        let (x, y) = (texel(uv.x, raster.width), texel(uv.y, raster.height));
        let at = 4 * (y as usize * raster.width as usize + x as usize) + 3;
        f32::from(raster.rgba[at]) / 255.0 * self.factor
    }
}

/// A number from 0 to 1 without pattern (the finalizer of SplitMix64).
fn unit(seed: u64) -> f32 {
    let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 40) as f32 / (1u64 << 24) as f32
}
