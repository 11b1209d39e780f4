//! What a material's alpha and color say of a role.

use crate::evidence::{Evidence, Source};
use foliar_plant::{AlphaMode, Base, Material, Part, Raster};
use foliar_schema::Role;

/// Texels looked at, at most: enough for shares to a few per cent.
const TEXELS: usize = 4096;
/// A texture has holes where at least this share of its texels is more than half transparent.
const HOLES: f64 = 0.05;
/// A color is green where green is at least this much more than red and than blue, in linear light.
const GREEN: f64 = 1.2;

/// Evidence from alpha and color.
pub(crate) fn look_evidence(part: &Part, base: &Base) -> Vec<Evidence> {
    let Some(material) = part.material.and_then(|m| base.materials.get(m as usize)) else { return Vec::new() };
    let raster = material.base_color_raster.and_then(|r| base.rasters.get(r as usize)).filter(|_| !part.uvs.is_empty());
    let texture = raster.map(look_at);
    let mut found: Vec<Evidence> = alpha_evidence(material, texture).into_iter().collect();
    let factor = material.base_color.map(f64::from);
    let color = texture.map_or([1.0; 3], |t| t.color);
    let [red, green, blue] = [0, 1, 2].map(|i| factor[i] * color[i]);
    if green > GREEN * red.max(blue) {
        let reason = format!("its color is green ({red:.2} {green:.2} {blue:.2})");
        found.push(Evidence { source: Source::Look, role: Role::Leaf, weight: 0.7, reason });
    }
    found
}

fn alpha_evidence(material: &Material, texture: Option<Look>) -> Option<Evidence> {
    let holes = texture.map_or(0.0, |t| t.holes);
    let percent = 100.0 * holes;
    let (role, weight, reason) = match (holes >= HOLES, material.alpha_mode) {
        (true, AlphaMode::Mask(_)) => (Role::Leaf, 2.0, format!("alpha cuts away {percent:.0} % of its texture")),
        (true, AlphaMode::Blend) => (Role::Leaf, 1.5, format!("{percent:.0} % of its blended texture is transparent")),
        (true, AlphaMode::Opaque) => {
            (Role::Leaf, 0.5, format!("{percent:.0} % of its texture is transparent, though the material is opaque"))
        }
        (false, AlphaMode::Mask(_)) => (Role::Leaf, 1.0, "its material is masked by alpha".into()),
        (false, AlphaMode::Blend) => (Role::Other, 0.5, "it is transparent all over, as glass is".into()),
        (false, AlphaMode::Opaque) => return None,
    };
    Some(Evidence { source: Source::Look, role, weight, reason })
}

/// What a texture looks like.
#[derive(Clone, Copy)]
struct Look {
    /// Share of texels that are more than half transparent.
    holes: f64,
    /// Mean color of the others, about linear.
    color: [f64; 3],
}

fn look_at(raster: &Raster) -> Look {
    let texels = raster.rgba.len() / 4;
    // An odd step does not stay in one column of a picture whose width is a power of two.
    let step = (texels / TEXELS).max(1) | 1;
    let (mut count, mut solid, mut sum) = (0.0, 0.0, [0.0; 3]);
    for texel in raster.rgba.chunks_exact(4).step_by(step) {
        count += 1.0;
        if texel[3] >= 128 {
            solid += 1.0;
            // The square is near enough to sRGB's curve to tell green from brown.
            (0..3).for_each(|i| sum[i] += (f64::from(texel[i]) / 255.0) * (f64::from(texel[i]) / 255.0));
        }
    }
    let share = |x: f64, of: f64| if of > 0.0 { x / of } else { 0.0 };
    Look { holes: share(count - solid, count), color: sum.map(|s| share(s, solid)) }
}
