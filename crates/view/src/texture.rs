//! Textures: bilinear, repeated, colors blended in linear light and weighted by alpha, so that what a
//! painter left in transparent texels never bleeds into a leaf's edge.

use crate::colors::to_linear;
use foliar_plant::Raster;
use glam::{IVec2, Vec2, Vec3};

/// Linear light of each of the 256 sRGB bytes.
pub(crate) struct Decode([f32; 256]);

impl Decode {
    /// The table.
    pub fn new() -> Decode {
        Decode(std::array::from_fn(|byte| to_linear(byte as f32 / 255.0)))
    }
}

/// A raster that holds as many bytes as it says.
#[derive(Clone, Copy)]
pub(crate) struct Texture<'a> {
    size: IVec2,
    rgba: &'a [[u8; 4]],
}

impl<'a> Texture<'a> {
    /// None for a raster without pixels (a format that was passed through undecoded).
    pub fn new(raster: &'a Raster) -> Option<Texture<'a>> {
        let (rgba, rest) = raster.rgba.as_chunks::<4>();
        let pixels = u64::from(raster.width) * u64::from(raster.height);
        let size = IVec2::new(raster.width.try_into().ok()?, raster.height.try_into().ok()?);
        (pixels > 0 && pixels == rgba.len() as u64 && rest.is_empty()).then_some(Texture { size, rgba })
    }

    /// Alpha in [0, 1].
    #[inline]
    pub fn alpha(&self, uv: Vec2) -> f32 {
        let (texels, weights) = self.neighbors(uv);
        (0..4).map(|i| f32::from(texels[i][3]) * weights[i]).sum::<f32>() / 255.0
    }

    /// Linear color, weighted by alpha; where all is transparent, unweighted.
    pub fn color(&self, uv: Vec2, decode: &Decode) -> Vec3 {
        let (texels, weights) = self.neighbors(uv);
        let mean = |weight: &dyn Fn(usize) -> f32| {
            let total: f32 = (0..4).map(weight).sum();
            let light = |texel: [u8; 4]| Vec3::from_array(std::array::from_fn(|c| decode.0[texel[c] as usize]));
            (total > 0.0).then(|| (0..4).map(|i| light(texels[i]) * weight(i)).sum::<Vec3>() / total)
        };
        mean(&|i| weights[i] * f32::from(texels[i][3])).or_else(|| mean(&|i| weights[i])).unwrap_or_default()
    }

    /// The four texels around a place and their bilinear weights.
    #[inline]
    fn neighbors(&self, uv: Vec2) -> ([[u8; 4]; 4], [f32; 4]) {
        let wrapped = uv - uv.floor();
        let at = wrapped * self.size.as_vec2() - 0.5;
        let low = at.floor();
        let part = at - low;
        // `low` is -1 at least and `size` at most (uv so large that its fraction rounds to 1).
        let first = low.as_ivec2().clamp(IVec2::NEG_ONE, self.size - 1);
        let wrap = |i: i32, n: i32| {
            if i < 0 {
                i + n
            } else if i >= n {
                i - n
            } else {
                i
            }
        };
        let column = |i| wrap(first.x + i, self.size.x) as usize;
        let row = |i| wrap(first.y + i, self.size.y) as usize * self.size.x as usize;
        let (left, right, top, bottom) = (column(0), column(1), row(0), row(1));
        (
            [self.rgba[top + left], self.rgba[top + right], self.rgba[bottom + left], self.rgba[bottom + right]],
            [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checker() -> Raster {
        let rgba = [[255, 255, 255, 255], [0, 0, 0, 0], [0, 0, 0, 0], [255, 255, 255, 255]];
        Raster { name: "checker".into(), width: 2, height: 2, rgba: rgba.concat(), has_alpha: true }
    }

    #[test]
    fn texel_centers_give_the_texel_and_the_middle_gives_the_mean() {
        let raster = checker();
        let texture = Texture::new(&raster).unwrap();
        let alpha = |u, v| texture.alpha(Vec2::new(u, v));
        assert!((alpha(0.25, 0.25) - 1.0).abs() < 1e-6 && alpha(0.75, 0.25).abs() < 1e-6);
        assert!((alpha(0.5, 0.5) - 0.5).abs() < 1e-6);
        assert!((alpha(1.25, -0.75) - 1.0).abs() < 1e-6, "repeats");
    }

    #[test]
    fn transparent_texels_do_not_bleed() {
        let raster = checker();
        let color = Texture::new(&raster).unwrap().color(Vec2::splat(0.5), &Decode::new());
        assert!((color - Vec3::ONE).abs().max_element() < 1e-6, "{color}");
    }

    #[test]
    fn colors_blend_in_linear_light() {
        let rgba = [[0, 0, 0, 255], [255, 255, 255, 255]].concat();
        let raster = Raster { width: 2, height: 1, rgba, ..Raster::default() };
        let color = Texture::new(&raster).unwrap().color(Vec2::new(0.5, 0.5), &Decode::new());
        assert!((color.x - 0.5).abs() < 1e-6, "{color}");
        let gray = Raster { width: 1, height: 1, rgba: vec![188, 188, 188, 255], ..Raster::default() };
        let color = Texture::new(&gray).unwrap().color(Vec2::ZERO, &Decode::new());
        assert!((color.x - 0.5029).abs() < 1e-3, "sRGB 188 is half the light: {color}");
    }

    #[test]
    fn absurd_coordinates_stay_inside() {
        let raster = checker();
        let texture = Texture::new(&raster).unwrap();
        for u in [-1e-9, 1e9, -1e9, 1e30, 0.999_999_94] {
            assert!((0.0..=1.0).contains(&texture.alpha(Vec2::new(u, u))));
        }
    }

    #[test]
    fn a_raster_that_lies_about_its_size_is_no_texture() {
        assert!(Texture::new(&Raster { width: 3, ..checker() }).is_none());
        assert!(Texture::new(&Raster::default()).is_none());
    }
}
