//! The scene: the plant's triangles with all that light needs, in the picture's frame.

use crate::camera::PLANT_EDGE;
use crate::frame::{Frame, Standing};
use crate::key::{Key, Legend};
use crate::leaf_light::Baked;
use crate::scale::{self, Person};
use crate::skins::{Facing, Skin, skins};
use crate::texture::{self, Decode};
use crate::values;
use crate::{Normals, Shading, ViewError, colors, shade};
use foliar_bake::Layer;
use foliar_plant::{Part, Plant};
use foliar_schema::{Role, names};
use foliar_space::{Hit, Rays};
use glam::{DVec3, Vec2, Vec3};

/// Things that are no part of the plant and reach farther than so many times its longest edge are
/// left out: beside them the plant would be a dot to the BVH.
const FARTHEST_OTHER: f64 = 30.0;
/// Values at a vertex.
#[derive(Clone, Copy)]
struct Vertex {
    /// Unit, or zero where the triangle's own normal serves.
    normal: Vec3,
    uv: Vec2,
    /// Ambient coefficient.
    ambient: f32,
}

/// One triangle.
#[derive(Clone, Copy)]
struct Face {
    corners: [u32; 3],
    skin: u32,
}

/// A place on a surface that a ray met.
pub(crate) struct Surface {
    /// Toward the viewer, unless the skin's normals say otherwise.
    pub normal: Vec3,
    /// Normal of the triangle, toward the viewer.
    pub flat: Vec3,
    /// Linear color.
    pub color: Vec3,
    /// Ambient coefficient.
    pub ambient: f32,
    /// Lets light through.
    pub leaf: bool,
    /// Eight depths and nine numbers of the light room; zeros where it is not asked for.
    pub light: ([f32; 8], [f32; 9]),
}

/// Every vertex of a plant without a value.
fn grays(plant: &Plant) -> Vec<Vec<Vec3>> {
    plant.parts().iter().map(|part| vec![colors::NO_VALUE; part.positions.len()]).collect()
}

/// Triangles, skins, rays.
pub(crate) struct Scene<'a> {
    pub rays: Rays,
    pub triangles: Vec<[Vec3; 3]>,
    /// Vertices that the camera is fitted to.
    pub fitted: Vec<Vec3>,
    /// Lowest point that is drawn.
    pub floor: f32,
    /// Top of the person's head, where one stands there.
    pub head: Option<Vec3>,
    /// From the plant's rest frame to the picture's.
    pub frame: Frame,
    pub legend: Option<Legend>,
    faces: Vec<Face>,
    vertices: Vec<Vertex>,
    /// Whether it is drawn as a viewer would that never heard of foliar.
    pub stock: bool,
    /// False color per vertex, or a factor on its color; empty where there is neither.
    colors: Vec<Vec3>,
    skins: Vec<Skin<'a>>,
    decode: Decode,
    /// What the light room baked, where a picture asks for it.
    pub light: Option<Baked>,
}

impl<'a> Scene<'a> {
    /// Gathers the plant and what stands around it; where `person` gives the camera's right, a person stands there.
    ///
    /// # Errors
    /// [`ViewError`] where a layer does not fit its plant or the channel is not there.
    pub fn new(
        plant: &'a Plant,
        layers: &[&Layer],
        around: &'a [Standing],
        shading: &Shading,
        person: Option<Vec3>,
    ) -> Result<Scene<'a>, ViewError> {
        Scene::within(&Frame::around(plant, around), (plant, layers), around, (shading, None), person)
    }

    /// The same in a frame of its own: a plant that moves keeps its scale. False colors by the key of another picture,
    /// where there is one.
    ///
    /// # Errors
    /// As [`Scene::new`].
    pub fn within(
        frame: &Frame,
        (plant, layers): (&'a Plant, &[&Layer]),
        around: &'a [Standing],
        (shading, like): (&Shading, Option<&Key>),
        person: Option<Vec3>,
    ) -> Result<Scene<'a>, ViewError> {
        let mut scene = Scene {
            rays: Rays::default(),
            triangles: Vec::new(),
            fitted: Vec::new(),
            floor: 0.0,
            head: None,
            frame: *frame,
            legend: None,
            faces: Vec::new(),
            vertices: Vec::new(),
            stock: *shading == Shading::Stock,
            colors: Vec::new(),
            skins: Vec::new(),
            decode: Decode::new(),
            light: Baked::asked(plant, layers, around, shading)?,
        };
        let shown = match shading {
            Shading::Channel(name) => Some(values::false_colors(plant, layers, name, like)?),
            _ => None,
        };
        scene.add(plant, layers, shading, frame, shown.as_ref().map(|s| s.colors.as_slice()))?;
        for other in around {
            // A neighbor's values are not the legend's: it stands there in gray.
            let gray = shown.is_some().then(|| grays(&other.plant));
            let frame = frame.of(other);
            let own: Vec<&Layer> = other.layers.iter().collect();
            scene.add(&other.plant, &own, shading, &frame, gray.as_deref())?;
        }
        if let Some(person) = person.and_then(|right| scale::person(&scene.fitted, right, frame.per_meter())) {
            scene.add_person(person);
        }
        scene.floor = scene.triangles.iter().flatten().map(|p| p.y).reduce(f32::min).unwrap_or_default();
        scene.rays = Rays::new(&scene.triangles)?;
        scene.legend = shown.map(|s| s.legend);
        Ok(scene)
    }

    /// Adds one plant.
    fn add(
        &mut self,
        plant: &'a Plant,
        layers: &[&Layer],
        shading: &Shading,
        frame: &Frame,
        shown: Option<&[Vec<Vec3>]>,
    ) -> Result<(), ViewError> {
        let none = || vec![None; plant.parts().len()];
        let soft = || values::attribute(plant, layers, names::SOFT_NORMAL, 3);
        let (ambient, soft) = match shading {
            Shading::Baked => (values::ambient(plant, layers)?, soft()?),
            Shading::Lines(Normals::Baked) => (none(), soft()?),
            _ => (none(), none()),
        };
        let first = self.skins.len();
        self.skins.extend(skins(plant, &soft, self.stock));
        let only_other = plant.structure().roles.iter().all(|&role| role == Role::Other);
        for (index, part) in plant.parts().iter().enumerate() {
            if let Some(shown) = shown {
                self.colors.extend(&shown[index]);
            } else if self.stock {
                let factor = |v| part.colors.get(v).copied().unwrap_or(Vec3::ONE);
                self.colors.extend((0..part.positions.len()).map(factor));
            }
            let places = self.add_part(part, ambient[index], soft[index], first + index, frame);
            if plant.role(index) != Role::Other || only_other {
                self.fitted.extend(places.iter().map(|p| p.as_vec3()));
            }
        }
        Ok(())
    }

    /// Adds vertices and triangles of a part; gives where its vertices are in the picture's frame.
    fn add_part(
        &mut self,
        part: &Part,
        ambient: Option<&[f32]>,
        soft: Option<&[f32]>,
        skin: usize,
        frame: &Frame,
    ) -> Vec<DVec3> {
        let places: Vec<DVec3> = (0..part.positions.len()).map(|v| frame.place(part.rest_position(v))).collect();
        let is_near = |p: DVec3| p.abs().max_element() <= FARTHEST_OTHER * PLANT_EDGE;
        let first = self.vertices.len() as u32;
        let rest = |normal: Vec3| frame.normal(part.normal_to_rest(normal.as_dvec3()));
        self.vertices.extend((0..places.len()).map(|v| Vertex {
            normal: match soft {
                Some(soft) => rest(Vec3::from_slice(&soft[3 * v..])),
                None => part.normals.get(v).map_or(Vec3::ZERO, |&n| rest(n)),
            },
            uv: part.uvs.get(v).copied().unwrap_or_default(),
            ambient: ambient.map_or(1.0, |a| a[v]),
        }));
        for corners in &part.triangles {
            let points = corners.map(|c| places[c as usize]);
            if points.iter().all(|&p| is_near(p)) {
                self.faces.push(Face { corners: corners.map(|c| first + c), skin: skin as u32 });
                self.triangles.push(points.map(|p| p.as_vec3()));
            }
        }
        places
    }

    /// Adds a person, gray in any light.
    fn add_person(&mut self, person: Person) {
        let (first, skin) = (self.vertices.len() as u32, self.skins.len() as u32);
        self.skins.push(Skin::of_clay());
        let vertex = |normal: Vec3| Vertex { normal, uv: Vec2::ZERO, ambient: 1.0 };
        self.vertices.extend(person.normals.iter().copied().map(vertex));
        if !self.colors.is_empty() {
            self.colors.extend(person.points.iter().map(|_| if self.stock { Vec3::ONE } else { colors::NO_VALUE }));
        }
        for corners in person.triangles {
            self.triangles.push(corners.map(|c| person.points[c as usize]));
            self.faces.push(Face { corners: corners.map(|c| first + c), skin });
        }
        self.head = person.points.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y));
        self.fitted.extend(person.points);
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

    /// Whether a ray that goes along `direction` sees this side of what it met.
    #[inline]
    pub fn shows(&self, hit: &Hit, direction: Vec3) -> bool {
        !self.skins[self.faces[hit.triangle as usize].skin as usize].one_sided || self.wound(hit).dot(direction) <= 0.0
    }

    /// Normal of a triangle as it is wound, any length.
    fn wound(&self, hit: &Hit) -> Vec3 {
        let [a, b, c] = self.triangles[hit.triangle as usize];
        (b - a).cross(c - a)
    }

    /// False color at a hit.
    pub fn false_color(&self, hit: &Hit) -> Vec3 {
        self.blend(&self.faces[hit.triangle as usize], hit, |v| self.colors[v])
    }

    /// Where the smooth surface would be that the normals at the corners promise, off the flat triangle toward `side` of it:
    /// rays to the sun start there, or shadows end in steps, triangle by triangle. `None` where they promise none.
    pub fn rounded(&self, hit: &Hit, place: Vec3, side: Vec3) -> Option<Vec3> {
        let face = &self.faces[hit.triangle as usize];
        let normals = face.corners.map(|v| self.vertices[v as usize].normal);
        let weights = [1.0 - hit.u - hit.v, hit.u, hit.v];
        shade::rounded(place, (self.triangles[hit.triangle as usize], normals), weights, side)
    }

    /// What light needs to know of a hit, seen along `direction`.
    pub fn surface(&self, hit: &Hit, direction: Vec3) -> Surface {
        let face = &self.faces[hit.triangle as usize];
        let skin = &self.skins[face.skin as usize];
        let wound = self.wound(hit).normalize_or_zero();
        let from_behind = wound.dot(direction) > 0.0;
        let flat = if from_behind { -wound } else { wound };
        let own = self.blend(face, hit, |v| self.vertices[v].normal).normalize_or(flat);
        let texel = skin.texture.as_ref().map_or(Vec3::ONE, |t| t.color(self.uv(face, hit), &self.decode));
        let factor = if self.stock { self.blend(face, hit, |v| self.colors[v]) } else { Vec3::ONE };
        Surface {
            normal: match skin.facing {
                Facing::Crown => own,
                Facing::Viewer if own.dot(flat) < 0.0 => -own,
                Facing::Winding if from_behind => -own,
                Facing::Viewer | Facing::Winding => own,
            },
            flat,
            color: skin.color * texel * factor,
            ambient: self.blend(face, hit, |v| Vec3::splat(self.vertices[v].ambient)).x,
            leaf: skin.leaf,
            light: self
                .light
                .as_ref()
                .map_or(([0.0; 8], [0.0; 9]), |baked| baked.blend(face.corners, [1.0 - hit.u - hit.v, hit.u, hit.v])),
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
