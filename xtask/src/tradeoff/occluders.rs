//! A plant as rays see it: triangles whose transparent texels let light through.

use anyhow::Result;
use foliar_density::NO_GROUP;
use foliar_plant::{AlphaMode, Material, Plant, Raster};
use foliar_space::{Beam, Hit, Rays};
use glam::{DVec3, Vec2, Vec3};

/// Alpha from which a blended texel stops a ray: rays here are stopped or not.
const BLEND_CUTOFF: f32 = 0.5;

/// What stops light.
pub struct Occluders<'a> {
    rays: Rays,
    triangles: Vec<Triangle>,
    skins: Vec<Option<Skin<'a>>>,
}

struct Triangle {
    /// The leaf's group, or `NO_GROUP`.
    group: u32,
    part: u32,
    uvs: [Vec2; 3],
}

/// A cut-out texture.
struct Skin<'a> {
    raster: &'a Raster,
    factor: f32,
    cutoff: f32,
}

impl<'a> Occluders<'a> {
    /// All triangles of a plant, relative to its center.
    pub fn new(plant: &'a Plant) -> Result<Occluders<'a>> {
        let (mut shapes, mut triangles) = (Vec::new(), Vec::new());
        for (index, part) in plant.parts().iter().enumerate() {
            let places = plant.relative_positions(index);
            for corners in &part.triangles {
                let leaf = plant.leaf_of(index, corners[0] as usize);
                shapes.push(corners.map(|c| places[c as usize]));
                triangles.push(Triangle {
                    group: leaf.map_or(NO_GROUP, |leaf| plant.leaves()[leaf as usize].group),
                    part: index as u32,
                    uvs: corners.map(|c| part.uvs.get(c as usize).copied().unwrap_or_default()),
                });
            }
        }
        let skins = (0..plant.parts().len()).map(|part| skin(plant, part)).collect();
        Ok(Occluders { rays: Rays::new(&shapes)?, triangles, skins })
    }

    /// Whether light comes from `toward` (unit) to a place relative to the plant's center, past the leaves of `group`.
    pub fn is_lit(&self, from: Vec3, toward: DVec3, group: u32) -> bool {
        let beam = Beam { origin: from, direction: toward.as_vec3(), reach: f32::INFINITY };
        !self.rays.blocked(&beam, |hit| {
            let triangle = &self.triangles[hit.triangle as usize];
            (triangle.group != group || group == NO_GROUP) && self.stops(triangle, hit)
        })
    }

    fn stops(&self, triangle: &Triangle, hit: &Hit) -> bool {
        let [a, b, c] = triangle.uvs;
        is_opaque(self.skins[triangle.part as usize].as_ref(), a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v)
    }

    /// Whether a part has something at texture coordinates.
    pub fn is_there(&self, part: usize, uv: Vec2) -> bool {
        is_opaque(self.skins[part].as_ref(), uv)
    }
}

fn is_opaque(skin: Option<&Skin>, uv: Vec2) -> bool {
    skin.is_none_or(|skin| skin.alpha(uv) >= skin.cutoff)
}

impl Skin<'_> {
    /// Alpha of the texel, repeated without end.
    fn alpha(&self, uv: Vec2) -> f32 {
        let texel = |u: f32, count: u32| ((u * count as f32).floor().rem_euclid(count as f32) as u32).min(count - 1);
        let (x, y) = (texel(uv.x, self.raster.width), texel(uv.y, self.raster.height));
        f32::from(self.raster.rgba[4 * (y * self.raster.width + x) as usize + 3]) / 255.0 * self.factor
    }
}

/// The texture that cuts a part out, where one does.
fn skin(plant: &Plant, part: usize) -> Option<Skin<'_>> {
    let base = plant.base();
    let material: &Material = base.materials.get(base.parts[part].material? as usize)?;
    let cutoff = match material.alpha_mode {
        AlphaMode::Opaque => return None,
        AlphaMode::Mask(cutoff) => cutoff,
        AlphaMode::Blend => BLEND_CUTOFF,
    };
    let raster = base.rasters.get(material.base_color_raster? as usize)?;
    let whole = raster.rgba.len() == 4 * raster.width as usize * raster.height as usize && !raster.rgba.is_empty();
    whole.then_some(Skin { raster, factor: material.base_color[3], cutoff })
}
