//! Textures: bilinear, repeated, colors blended in linear light and weighted by alpha, so that what a
//! painter left in transparent texels never bleeds into a leaf's edge.

use crate::colors::to_linear;
use foliar_plant::{AlphaMode, Raster};
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
        let (first, part) = self.cell(uv);
        let (right, below) = (next(first.x, self.size.x), next(first.y, self.size.y));
        let texel = |x: i32, y: i32| self.rgba[self.index(IVec2::new(x, y))];
        (
            [texel(first.x, first.y), texel(right, first.y), texel(first.x, below), texel(right, below)],
            [(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y],
        )
    }

    /// The texel whose center lies to the upper left of a place, and how far beyond it the place lies.
    #[inline]
    fn cell(&self, uv: Vec2) -> (IVec2, Vec2) {
        let is_inside = uv.cmpge(Vec2::ZERO).all() && uv.cmple(Vec2::ONE).all();
        let wrapped = if is_inside { uv } else { uv - uv.floor() };
        let at = wrapped * self.size.as_vec2() - 0.5;
        // `at` is -0.5 at least: cutting off after adding 1 rounds down, without a call to floor.
        let low = (at + 1.0).as_ivec2() - 1;
        let first = IVec2::new(
            if low.x < 0 { self.size.x - 1 } else { low.x },
            if low.y < 0 { self.size.y - 1 } else { low.y },
        );
        (first.min(self.size - 1), at - low.as_vec2())
    }

    #[inline]
    fn index(&self, texel: IVec2) -> usize {
        texel.y as usize * self.size.x as usize + texel.x as usize
    }
}

/// The next of `count` texels; after the last the first.
#[inline]
fn next(texel: i32, count: i32) -> i32 {
    if texel + 1 < count { texel + 1 } else { 0 }
}

/// What is known of the alpha between four neighboring texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
enum Known {
    Holds,
    Passes,
    Depends,
}

/// Where a texture's alpha stops every ray, where none: a bilinear mean lies between its texels, so
/// that most alpha tests need one byte instead of sixteen.
pub(crate) struct Cover {
    alpha_mode: AlphaMode,
    factor: f32,
    /// Per texel, for the square between it and its neighbors to the right and below.
    known: Vec<Known>,
}

/// By so much the least and the greatest of four texels must clear the cutoff to be sure, since
/// bilinear weights in f32 do not quite sum to 1.
const SURE: f32 = 1e-4;

impl Cover {
    /// Looks at every texel once; `factor` is the material's own alpha.
    pub fn new(texture: &Texture, alpha_mode: AlphaMode, factor: f32) -> Cover {
        let (width, height) = (texture.size.x, texture.size.y);
        let alpha = |x, y| f32::from(texture.rgba[texture.index(IVec2::new(x, y))][3]) * factor / 255.0;
        let known = |x, y| {
            let (right, below) = (next(x, width), next(y, height));
            let four = [alpha(x, y), alpha(right, y), alpha(x, below), alpha(right, below)];
            let (least, most) = (four.into_iter().fold(f32::MAX, f32::min), four.into_iter().fold(0.0, f32::max));
            let (holds, passes) = match alpha_mode {
                AlphaMode::Opaque => (true, false),
                AlphaMode::Mask(cutoff) => (least >= cutoff + SURE, most < cutoff - SURE),
                AlphaMode::Blend => (least >= 1.0, most <= 0.0),
            };
            if holds {
                Known::Holds
            } else if passes {
                Known::Passes
            } else {
                Known::Depends
            }
        };
        let known = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| known(x, y)).collect();
        Cover { alpha_mode, factor, known }
    }

    /// Whether a ray that draws `chance` in [0, 1) is stopped here.
    #[inline]
    pub fn stops(&self, texture: &Texture, uv: Vec2, chance: impl FnOnce() -> f32) -> bool {
        match self.known[texture.index(texture.cell(uv).0)] {
            Known::Holds => true,
            Known::Passes => false,
            Known::Depends => stops(self.alpha_mode, texture.alpha(uv) * self.factor, chance),
        }
    }
}

/// Whether a ray is stopped: always by what is opaque, at or above the cutoff by a mask, with a
/// probability of alpha by what is blended.
#[inline]
pub(crate) fn stops(alpha_mode: AlphaMode, alpha: f32, chance: impl FnOnce() -> f32) -> bool {
    match alpha_mode {
        AlphaMode::Opaque => true,
        AlphaMode::Mask(cutoff) => alpha >= cutoff,
        AlphaMode::Blend => alpha > chance(),
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
    fn a_cover_decides_as_the_texture_does() {
        let noise = |i: u32| {
            [0, 0, 0, [0, 255, (crate::colors::mix(i) & 0xFF) as u8][(crate::colors::mix(i / 7) % 3) as usize]]
        };
        let rgba = (0..16 * 12).map(noise).collect::<Vec<_>>().concat();
        let raster = Raster { width: 16, height: 12, rgba, ..Raster::default() };
        let texture = Texture::new(&raster).unwrap();
        for (alpha_mode, factor) in [
            (AlphaMode::Mask(0.5), 1.0),
            (AlphaMode::Mask(0.3), 0.7),
            (AlphaMode::Blend, 1.0),
            (AlphaMode::Opaque, 0.2),
        ] {
            let cover = Cover::new(&texture, alpha_mode, factor);
            assert!(cover.known.contains(&Known::Holds), "a test of the short way too");
            for i in 0..20_000 {
                let uv = foliar_numerics::r2_point(i).as_vec2() * 3.0 - 1.0;
                let slow = stops(alpha_mode, texture.alpha(uv) * factor, || 0.4);
                assert_eq!(cover.stops(&texture, uv, || 0.4), slow, "{alpha_mode:?} at {uv}");
            }
        }
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
