//! What the triangles of one part share: color, texture, alpha, and which way normals are turned.

use crate::texture::{Cover, Texture};
use foliar_plant::{AlphaMode, Plant};
use foliar_schema::Role;
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Linear color of parts whose material says nothing, by role.
const BARK: Vec3 = Vec3::new(0.13, 0.085, 0.055);
const FOLIAGE: Vec3 = Vec3::new(0.10, 0.17, 0.04);
/// Linear color of a person.
const CLAY: Vec3 = Vec3::new(0.10, 0.105, 0.115);
/// Gray from here on is taken for a color that nobody chose (Blender's own default is 0.8, many MTLs hold
/// it as sRGB: 0.6).
const LEAST_UNSET: f32 = 0.55;

/// What the triangles of one part share.
pub(crate) struct Skin<'a> {
    /// Linear factor.
    pub color: Vec3,
    pub alpha: f32,
    pub alpha_mode: AlphaMode,
    pub texture: Option<Texture<'a>>,
    /// Where the texture has alpha that counts; parts of one material share it.
    pub cover: Option<Arc<Cover>>,
    pub leaf: bool,
    pub facing: Facing,
    /// Seen from its front only: a viewer leaves out its back.
    pub one_sided: bool,
}

impl Skin<'_> {
    /// Gray without a texture, seen from both sides.
    pub fn of_clay() -> Self {
        Skin {
            color: CLAY,
            alpha: 1.0,
            alpha_mode: AlphaMode::Opaque,
            texture: None,
            cover: None,
            leaf: false,
            facing: Facing::Viewer,
            one_sided: false,
        }
    }
}

/// What a vertex normal is turned by.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Facing {
    /// To the viewer's side of the triangle.
    Viewer,
    /// By nothing: it says how the crown stands to the light, not which side of a leaf this is.
    Crown,
    /// By the triangle's side, whatever way it points itself (glTF 2.0, section "double sided").
    Winding,
}

/// Skins of all parts; `soft` says which have realigned normals.
pub(crate) fn skins<'a>(plant: &'a Plant, soft: &[Option<&[f32]>], stock: bool) -> Vec<Skin<'a>> {
    let mut covers: BTreeMap<u32, Arc<Cover>> = BTreeMap::new();
    let facing = |part: usize| match soft[part] {
        _ if stock => Facing::Winding,
        Some(_) => Facing::Crown,
        None => Facing::Viewer,
    };
    let mut skins: Vec<Skin> = (0..plant.parts().len()).map(|part| skin(plant, part, facing(part))).collect();
    for (skin, part) in skins.iter_mut().zip(plant.parts()) {
        if let (Some(texture), Some(material)) = (&skin.texture, part.material)
            && skin.alpha_mode != AlphaMode::Opaque
        {
            let new = || Arc::new(Cover::new(texture, skin.alpha_mode, skin.alpha));
            skin.cover = Some(covers.entry(material).or_insert_with(new).clone());
        }
    }
    skins
}

fn skin(plant: &Plant, index: usize, facing: Facing) -> Skin<'_> {
    let stock = facing == Facing::Winding;
    let role = plant.role(index);
    let base = plant.base();
    let material = base.parts[index].material.and_then(|m| base.materials.get(m as usize));
    let raster = material.and_then(|m| m.base_color_raster).and_then(|r| base.rasters.get(r as usize));
    // Without texture coordinates there is nothing to look up.
    let texture = raster.filter(|_| !base.parts[index].uvs.is_empty()).and_then(Texture::new);
    let [r, g, b, alpha] = material.map_or([1.0; 4], |m| m.base_color);
    let own = Vec3::new(r, g, b);
    let by_role = match role {
        Role::Wood => BARK,
        Role::Leaf => FOLIAGE,
        Role::Other => own,
    };
    Skin {
        color: if !stock && texture.is_none() && says_nothing(own) { by_role } else { own },
        alpha,
        alpha_mode: material.map_or(AlphaMode::Opaque, |m| m.alpha_mode),
        texture,
        cover: None,
        leaf: role == Role::Leaf && !stock,
        facing,
        one_sided: stock && !material.is_some_and(|m| m.double_sided),
    }
}

/// Light gray without a texture is what exporters write where nobody chose a color.
fn says_nothing(color: Vec3) -> bool {
    color.min_element() >= LEAST_UNSET && color.max_element() - color.min_element() <= 1e-3
}
