//! What a material's own color says of its leaf: where it is, and what color it shows by day.

use super::materials::material_name;
use foliar_bake::{FloatRaster, MapRaster};
use foliar_numerics::linear_of_srgb;
use foliar_plant::{AlphaMode, Material, Plant, Raster};

/// Alpha of a blended material from which it counts as leaf.
const BLEND_CUTOFF: f32 = 0.5;

/// Maps made of a material's own color.
#[derive(Clone, Debug)]
pub(super) struct Own {
    /// Its mean over the leaf, linear, one texel.
    pub albedo: MapRaster,
    /// The picture, red, green, blue as stored, where it is asked for.
    pub color: Option<MapRaster>,
    /// 1 where there is leaf, 0 elsewhere; none where all is.
    pub alpha: Option<MapRaster>,
}

impl Own {
    /// Whether what it makes of a set of maps is what another makes of it, but for a color that can be mixed.
    pub fn same(a: Option<&Own>, b: Option<&Own>) -> bool {
        let is_same = |of: fn(&Own) -> Option<&MapRaster>| a.and_then(of) == b.and_then(of);
        is_same(|own| own.color.as_ref()) && is_same(|own| own.alpha.as_ref())
    }

    /// The color of a material of this name; none where there is no such material.
    pub fn of(plant: Option<&Plant>, name: &str, with_color: bool) -> Option<Own> {
        let base = plant?.base();
        let index =
            (0..base.materials.len() as u32).find(|index| plant.is_some_and(|p| material_name(p, *index) == name))?;
        let material = base.materials.get(index as usize)?;
        let map = |(width, height): (u32, u32), channels: u32, data: Vec<f32>, bits: u32| MapRaster {
            raster: FloatRaster { width, height, channels, data },
            bits,
        };
        let raster = material.base_color_raster.and_then(|raster| base.rasters.get(raster as usize));
        let [r, g, b, _] = material.base_color;
        let Some(raster) = raster else {
            return Some(Own { albedo: map((1, 1), 3, vec![r, g, b], 32), color: None, alpha: None });
        };
        let size = (raster.width, raster.height);
        let color = || raster.rgba.chunks_exact(4).flat_map(|texel| [0, 1, 2].map(|c| f32::from(texel[c]) / 255.0));
        Some(Own {
            albedo: map((1, 1), 3, albedo(material, raster).to_vec(), 32),
            color: with_color.then(|| map(size, 3, color().collect(), 8)),
            alpha: alpha(material, raster).map(|data| map(size, 1, data, 8)),
        })
    }
}

/// Whether each texel belongs to the leaf.
fn alpha(material: &Material, raster: &Raster) -> Option<Vec<f32>> {
    let cutoff = match material.alpha_mode {
        AlphaMode::Opaque => return None,
        AlphaMode::Mask(cutoff) => cutoff,
        AlphaMode::Blend => BLEND_CUTOFF,
    };
    let factor = material.base_color[3];
    let covers = |texel: &[u8]| if f32::from(texel[3]) / 255.0 * factor >= cutoff { 1.0 } else { 0.0 };
    raster.has_alpha.then(|| raster.rgba.chunks_exact(4).map(covers).collect())
}

/// Mean linear color of the leaf.
fn albedo(material: &Material, raster: &Raster) -> [f32; 3] {
    let linear: Vec<f64> = (0..=u8::MAX).map(|stored| f64::from(linear_of_srgb(f32::from(stored) / 255.0))).collect();
    let covers = alpha(material, raster);
    let (mut sums, mut count) = ([0.0; 3], 0.0);
    for (at, texel) in raster.rgba.chunks_exact(4).enumerate() {
        if covers.as_ref().is_none_or(|covers| covers[at] > 0.0) {
            (0..3).for_each(|c| sums[c] += linear[usize::from(texel[c])]);
            count += 1.0;
        }
    }
    std::array::from_fn(|c| (sums[c] / f64::max(count, 1.0)) as f32 * material.base_color[c])
}
