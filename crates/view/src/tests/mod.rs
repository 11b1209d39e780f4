//! Laws of pictures, on plants of a few quads whose light is known in closed form.

mod chosen;
mod laws;
mod leaf;
mod leaf_light;
mod light;
mod lines;

use crate::{Background, Ground, Scale, ViewParams};
use foliar_bake::{Array, AttributeKey, Layer};
use foliar_plant::{AlphaMode, Base, Material, Part, Place, Plant, Raster, Structure};
use foliar_schema::{Record, Role};
use glam::{DAffine3, Vec2, Vec3};
use image::{Rgba, RgbaImage};

/// A rectangle around `center` with half edges `right` and `up`, normal right x up, uv from the upper left.
pub(crate) fn quad(center: Vec3, right: Vec3, up: Vec3) -> Part {
    Part {
        transform: DAffine3::IDENTITY,
        positions: vec![center - right - up, center + right - up, center + right + up, center - right + up],
        normals: vec![right.cross(up).normalize(); 4],
        uvs: vec![Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        position_ids: vec![0; 4],
        ..Part::default()
    }
}

/// Parts with their roles and materials, as a plant.
pub(crate) fn plant(parts: Vec<(Part, Role, Material)>, rasters: Vec<Raster>) -> Plant {
    let mut base = Base { rasters, position_count: 1, ..Base::default() };
    let mut structure = Structure::default();
    for (index, (part, role, material)) in (0u32..).zip(parts) {
        base.parts.push(Part { place: Place { mesh: index, primitive: 0 }, material: Some(index), ..part });
        base.materials.push(material);
        structure.roles.push(role);
        structure.leaf_ids.push(Vec::new());
    }
    Plant::new(base, structure).unwrap()
}

/// An opaque material of one linear gray.
pub(crate) fn gray(value: f32) -> Material {
    Material { base_color: [value, value, value, 1.0], ..Material::default() }
}

/// A white material with the first raster as its texture.
pub(crate) fn textured(alpha_mode: AlphaMode) -> Material {
    Material { base_color_raster: Some(0), alpha_mode, ..gray(1.0) }
}

/// A raster of these pixels.
pub(crate) fn raster(width: u32, pixels: &[[u8; 4]]) -> Raster {
    Raster { width, height: pixels.len() as u32 / width, rgba: pixels.concat(), has_alpha: true, ..Raster::default() }
}

/// A layer of attributes of one part.
pub(crate) fn layer(mesh: u32, attributes: &[(&str, Array)]) -> Layer {
    let key = |name: &str| AttributeKey { place: Place { mesh, primitive: 0 }, name: name.into() };
    Layer {
        record: Record { room: "density".into(), version: 1, ..Record::default() },
        attributes: attributes.iter().map(|(name, array)| (key(name), array.clone())).collect(),
        ..Layer::default()
    }
}

/// From +Z, level, nothing but the plant: 240 x 180 pixels.
pub(crate) fn frontal() -> ViewParams {
    ViewParams {
        width_px: 240,
        height_px: 180,
        azimuth_deg: 0.0,
        elevation_deg: 0.0,
        background: Background::Clear,
        ground: Ground::None,
        scale: Scale::None,
        ..ViewParams::default()
    }
}

/// Pixels that are covered, partly covered ones by their share.
pub(crate) fn covered(picture: &RgbaImage) -> f64 {
    picture.pixels().map(|p| f64::from(p.0[3]) / 255.0).sum()
}

/// The pixel in the middle.
pub(crate) fn middle(picture: &RgbaImage) -> Rgba<u8> {
    *picture.get_pixel(picture.width() / 2, picture.height() / 2)
}

/// Whether two colors agree within one step: rounding of f32 light may tip the last bit.
pub(crate) fn close(a: [u8; 4], b: [u8; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1)
}
