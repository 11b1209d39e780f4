//! The scene: the plant's triangles with all that light needs, in the picture's frame.

use crate::camera::PLANT_EDGE;
use crate::texture::{self, Cover, Decode, Texture};
use crate::values::{self, FalseColors, Legend};
use crate::{Shading, ViewError};
use foliar_bake::Layer;
use foliar_plant::{AlphaMode, Part, Plant};
use foliar_schema::{Role, names};
use foliar_space::{Hit, Rays};
use glam::{DVec3, Vec2, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Things that are no part of the plant and reach farther than so many times its longest edge are
/// left out: beside them the plant would be a dot to the BVH.
const FARTHEST_OTHER: f64 = 30.0;
/// Linear color of parts whose material says nothing, by role.
const BARK: Vec3 = Vec3::new(0.13, 0.085, 0.055);
const FOLIAGE: Vec3 = Vec3::new(0.10, 0.17, 0.04);
/// Gray from here on is taken for a color that nobody chose (Blender's own default is 0.8, many MTLs hold
/// it as sRGB: 0.6).
const LEAST_UNSET: f32 = 0.55;

/// Values at a vertex.
#[derive(Clone, Copy)]
struct Vertex {
    /// Unit, or zero where the triangle's own normal serves.
    normal: Vec3,
    uv: Vec2,
    /// Ambient coefficient.
    ambient: f32,
}

/// What the triangles of one part share.
struct Skin<'a> {
    /// Linear factor.
    color: Vec3,
    alpha: f32,
    alpha_mode: AlphaMode,
    texture: Option<Texture<'a>>,
    /// Where the texture has alpha that counts; parts of one material share it.
    cover: Option<Arc<Cover>>,
    leaf: bool,
    /// Normals say how the crown stands to the light, not which side of a leaf this is.
    soft: bool,
}

/// One triangle.
#[derive(Clone, Copy)]
struct Face {
    corners: [u32; 3],
    skin: u32,
}

/// A place on a surface that a ray met.
pub(crate) struct Surface {
    /// Toward the viewer, unless the skin's normals are soft.
    pub normal: Vec3,
    /// Normal of the triangle, toward the viewer.
    pub flat: Vec3,
    /// Linear color.
    pub color: Vec3,
    /// Ambient coefficient.
    pub ambient: f32,
    /// Lets light through.
    pub leaf: bool,
}

/// Triangles, skins, rays.
pub(crate) struct Scene<'a> {
    pub rays: Rays,
    pub triangles: Vec<[Vec3; 3]>,
    /// Vertices that the camera is fitted to.
    pub fitted: Vec<Vec3>,
    /// Lowest point that is drawn.
    pub floor: f32,
    pub legend: Option<Legend>,
    faces: Vec<Face>,
    vertices: Vec<Vertex>,
    /// False color per vertex; empty where the picture is lit.
    colors: Vec<Vec3>,
    skins: Vec<Skin<'a>>,
    decode: Decode,
}

impl<'a> Scene<'a> {
    /// Gathers the plant.
    ///
    /// # Errors
    /// [`ViewError`] where a layer does not fit the plant or the channel is not there.
    pub fn new(plant: &'a Plant, layers: &[&Layer], shading: &Shading) -> Result<Scene<'a>, ViewError> {
        let mut scene = Scene {
            rays: Rays::default(),
            triangles: Vec::new(),
            fitted: Vec::new(),
            floor: 0.0,
            legend: None,
            faces: Vec::new(),
            vertices: Vec::new(),
            colors: Vec::new(),
            skins: Vec::new(),
            decode: Decode::new(),
        };
        let none = || vec![None; plant.parts().len()];
        let (ambient, soft) = match shading {
            Shading::Baked => {
                (values::ambient(plant, layers)?, values::attribute(plant, layers, names::SOFT_NORMAL, 3)?)
            }
            Shading::Plain | Shading::Channel(_) => (none(), none()),
        };
        let shown = match shading {
            Shading::Channel(name) => Some(values::false_colors(plant, layers, name)?),
            Shading::Plain | Shading::Baked => None,
        };
        scene.skins = skins(plant, &soft);
        for (index, part) in plant.parts().iter().enumerate() {
            scene.add(plant, index, part, ambient[index], soft[index], shown.as_ref());
        }
        scene.floor = scene.triangles.iter().flatten().map(|p| p.y).reduce(f32::min).unwrap_or_default();
        scene.rays = Rays::new(&scene.triangles)?;
        scene.legend = shown.map(|s| s.legend);
        Ok(scene)
    }

    fn add(
        &mut self,
        plant: &Plant,
        index: usize,
        part: &Part,
        ambient: Option<&[f32]>,
        soft: Option<&[f32]>,
        shown: Option<&FalseColors>,
    ) {
        let edge = plant.size().max_element();
        let scale = if edge > 0.0 { PLANT_EDGE / edge } else { 1.0 };
        let place = |v| (part.rest_position(v) - plant.center()) * scale;
        let places: Vec<DVec3> = (0..part.positions.len()).map(place).collect();
        let is_near = |p: DVec3| p.abs().max_element() <= FARTHEST_OTHER * PLANT_EDGE;
        let first = self.vertices.len() as u32;
        let rest = |normal: Vec3| part.normal_to_rest(normal.as_dvec3()).as_vec3().normalize_or_zero();
        self.vertices.extend((0..places.len()).map(|v| Vertex {
            normal: match soft {
                Some(soft) => rest(Vec3::from_slice(&soft[3 * v..])),
                None => part.normals.get(v).map_or(Vec3::ZERO, |&n| rest(n)),
            },
            uv: part.uvs.get(v).copied().unwrap_or_default(),
            ambient: ambient.map_or(1.0, |a| a[v]),
        }));
        if let Some(shown) = shown {
            self.colors.extend(&shown.colors[index]);
        }
        for corners in &part.triangles {
            let points = corners.map(|c| places[c as usize]);
            if points.iter().all(|&p| is_near(p)) {
                self.faces.push(Face { corners: corners.map(|c| first + c), skin: index as u32 });
                self.triangles.push(points.map(|p| p.as_vec3()));
            }
        }
        let only_other = plant.structure().roles.iter().all(|&role| role == Role::Other);
        if plant.role(index) != Role::Other || only_other {
            self.fitted.extend(places.iter().map(|p| p.as_vec3()));
        }
    }

    /// Whether a ray that draws `chance` in [0, 1) is stopped by what it met.
    #[inline]
    pub fn stops(&self, hit: &Hit, chance: impl FnOnce() -> f32) -> bool {
        let face = &self.faces[hit.triangle as usize];
        let skin = &self.skins[face.skin as usize];
        match (&skin.texture, &skin.cover) {
            (Some(texture), Some(cover)) => cover.stops(texture, self.uv(face, hit), chance),
            _ => texture::stops(skin.alpha_mode, skin.alpha, chance),
        }
    }

    /// False color at a hit.
    pub fn false_color(&self, hit: &Hit) -> Vec3 {
        self.blend(&self.faces[hit.triangle as usize], hit, |v| self.colors[v])
    }

    /// What light needs to know of a hit, seen along `direction`.
    pub fn surface(&self, hit: &Hit, direction: Vec3) -> Surface {
        let face = &self.faces[hit.triangle as usize];
        let skin = &self.skins[face.skin as usize];
        let [a, b, c] = self.triangles[hit.triangle as usize];
        let toward_viewer = |n: Vec3| if n.dot(direction) > 0.0 { -n } else { n };
        let flat = toward_viewer((b - a).cross(c - a).normalize_or_zero());
        let own = self.blend(face, hit, |v| self.vertices[v].normal).normalize_or(flat);
        let texel = skin.texture.as_ref().map_or(Vec3::ONE, |t| t.color(self.uv(face, hit), &self.decode));
        Surface {
            normal: if skin.soft { own } else { facing(own, flat) },
            flat,
            color: skin.color * texel,
            ambient: self.blend(face, hit, |v| Vec3::splat(self.vertices[v].ambient)).x,
            leaf: skin.leaf,
        }
    }

    fn uv(&self, face: &Face, hit: &Hit) -> Vec2 {
        let [a, b, c] = face.corners.map(|v| self.vertices[v as usize].uv);
        a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
    }

    fn blend(&self, face: &Face, hit: &Hit, value: impl Fn(usize) -> Vec3) -> Vec3 {
        let [a, b, c] = face.corners.map(|v| value(v as usize));
        a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
    }
}

/// A vertex normal on the side of the triangle's: both sides of a leaf, and the inside of a tube, are lit.
fn facing(own: Vec3, flat: Vec3) -> Vec3 {
    if own.dot(flat) < 0.0 { -own } else { own }
}

/// Skins of all parts; `soft` says which have realigned normals.
fn skins<'a>(plant: &'a Plant, soft: &[Option<&[f32]>]) -> Vec<Skin<'a>> {
    let mut covers: BTreeMap<u32, Arc<Cover>> = BTreeMap::new();
    let mut skins: Vec<Skin> = (0..plant.parts().len()).map(|part| skin(plant, part, soft[part].is_some())).collect();
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

fn skin(plant: &Plant, index: usize, soft: bool) -> Skin<'_> {
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
        color: if texture.is_none() && says_nothing(own) { by_role } else { own },
        alpha,
        alpha_mode: material.map_or(AlphaMode::Opaque, |m| m.alpha_mode),
        texture,
        cover: None,
        leaf: role == Role::Leaf,
        soft,
    }
}

/// Light gray without a texture is what exporters write where nobody chose a color.
fn says_nothing(color: Vec3) -> bool {
    color.min_element() >= LEAST_UNSET && color.max_element() - color.min_element() <= 1e-3
}
