//! Leaves lit by what the light room baked, and the same light followed path by path: pictures of the model and of what it
//! stands for.

use crate::camera::PLANT_EDGE;
use crate::scene::{Scene, Surface};
use crate::{Shading, Standing, ViewError, shade, values};
use foliar_bake::Layer;
use foliar_light::model::{Leaf, ModelError, Optics, Sides, Sky, Sun, light, light_sh};
use foliar_light::truth::{Met, Stream, Surroundings, World, radiance_along};
use foliar_plant::{Part, Plant};
use foliar_schema::names;
use foliar_space::Beam;
use glam::{DVec3, Vec3};
use serde_json::Value;
use std::f64::consts::PI;

/// Radiance of the ground, beside [`shade::SKY`]: dry grass under an open sky.
const GROUND: Vec3 = Vec3::new(0.21, 0.20, 0.14);
/// A leaf passes so much of what it reflects, where no bake says.
pub(crate) const PASSES: Vec3 = Vec3::splat(0.6);
/// A leaf scatters at most this: what textures hold is a color, not a measured reflectance.
const MOST_ALBEDO: f32 = 0.95;
/// A path that goes on from a surface passes what is nearer than this: the other sheet of a doubled leaf.
const LIFT: f32 = 1e-4 * PLANT_EDGE as f32;

/// Eight depths and nine numbers of a vertex.
type Row = ([f32; 8], [f32; 9]);

/// What the light room baked for the vertices of a scene, and where light comes from.
pub(crate) struct Baked {
    rows: Vec<Row>,
    harmonics: bool,
    /// What a leaf passes over what it reflects.
    passes: Vec3,
}

impl Baked {
    /// Where the picture is lit by it.
    ///
    /// # Errors
    /// As [`Baked::new`]; [`ViewError::Neighbors`] where others stand around: octants of theirs are turned.
    pub fn asked(
        plant: &Plant,
        layers: &[&Layer],
        around: &[Standing],
        shading: &Shading,
    ) -> Result<Option<Baked>, ViewError> {
        match shading {
            Shading::Light | Shading::Traced if !around.is_empty() => Err(ViewError::Neighbors),
            Shading::Light | Shading::Traced => Baked::new(plant, layers).map(Some),
            _ => Ok(None),
        }
    }

    /// Rows of all vertices, part after part.
    ///
    /// # Errors
    /// [`ViewError::Channel`] where the light room has not baked, [`ViewError::Shape`] where its rows are another plant's.
    fn new(plant: &Plant, layers: &[&Layer]) -> Result<Baked, ViewError> {
        let column = |name: &str| values::leaf_column(plant, layers, names::CLASS_LIGHT, name);
        let none = || ViewError::Channel {
            name: names::OPTICAL_DEPTH.into(),
            known: "no light: bake it first (foliar-light)".into(),
        };
        let depths = column(names::OPTICAL_DEPTH)?.ok_or_else(none)?;
        let harmonics = column(names::SUN_HARMONICS)?;
        let wood = [names::LIGHT_DEPTH_0, names::LIGHT_DEPTH_1].map(|name| values::attribute(plant, layers, name, 4));
        let [low, high] = wood;
        let (low, high) = (low?, high?);
        let row = |part: usize, vertex: usize| -> Row {
            let four = |list: Option<&[f32]>, at: usize| list.and_then(|l| l.as_chunks::<4>().0.get(at)).copied();
            if let Some(leaf) = plant.leaf_of(part, vertex).map(|leaf| leaf as usize) {
                let nine = harmonics.and_then(|h| h.as_chunks::<9>().0.get(leaf)).copied();
                return (depths.as_chunks::<8>().0.get(leaf).copied().unwrap_or_default(), nine.unwrap_or_default());
            }
            let [a, b] = [four(low[part], vertex), four(high[part], vertex)].map(Option::unwrap_or_default);
            ([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]], [0.0; 9])
        };
        let part =
            |(index, part): (usize, &Part)| (0..part.positions.len()).map(move |v| (index, v)).collect::<Vec<_>>();
        let rows = plant.parts().iter().enumerate().flat_map(part).map(|(index, v)| row(index, v)).collect();
        Ok(Baked { rows, harmonics: harmonics.is_some(), passes: passes(layers).unwrap_or(PASSES) })
    }

    /// Depths and nine numbers between three vertices.
    pub fn blend(&self, corners: [u32; 3], weights: [f32; 3]) -> Row {
        let mut row = ([0.0; 8], [0.0; 9]);
        for (corner, weight) in corners.into_iter().zip(weights) {
            // What stands around the plant has no rows.
            let (depths, nine) = self.rows.get(corner as usize).copied().unwrap_or_default();
            row.0.iter_mut().zip(depths).for_each(|(sum, d)| *sum += weight * d);
            row.1.iter_mut().zip(nine).for_each(|(sum, c)| *sum += weight * c);
        }
        row
    }

    /// Reflectance and transmittance of a surface from its color; wood passes nothing.
    fn optics(&self, surface: &Surface) -> (Vec3, Vec3) {
        let reflected = surface.color.clamp(Vec3::ZERO, Vec3::splat(MOST_ALBEDO));
        let passed = if surface.leaf { reflected * self.passes } else { Vec3::ZERO };
        (reflected, passed.min(Vec3::splat(MOST_ALBEDO) - reflected))
    }
}

/// What a leaf passes over what it reflects, by the record of the bake: its texture knows one color alone.
fn passes(layers: &[&Layer]) -> Option<Vec3> {
    let record = layers.iter().map(|layer| &layer.record).find(|record| record.room == names::ROOM_LIGHT)?;
    let leaf = record.facts.get("leaf")?;
    let rgb = |name: &str| {
        let list = leaf.get(name)?.as_array()?;
        let [r, g, b] = [0, 1, 2].map(|c| list.get(c).and_then(Value::as_f64));
        Some(DVec3::new(r?, g?, b?))
    };
    let (reflected, passed) = (rgb("reflectanceFront")?, rgb("transmittanceFront")?);
    let share = (passed / reflected.max(DVec3::splat(1e-6))).as_vec3();
    share.is_finite().then(|| share.clamp(Vec3::ZERO, Vec3::splat(4.0)))
}

/// Sun and sky of a picture, in the model's terms.
pub(crate) struct Lamps {
    suns: [Sun; 3],
    skies: [Sky; 3],
    around: Surroundings,
}

impl Lamps {
    pub fn new(toward: Vec3) -> Result<Lamps, ModelError> {
        let toward = toward.as_dvec3();
        let (sun, sky, ground) = (shade::SUN.as_dvec3() * PI, shade::SKY.as_dvec3(), GROUND.as_dvec3());
        let [r, g, b] =
            [0, 1, 2].map(|c| Ok::<_, ModelError>((Sun::new(toward, sun[c])?, Sky::even(sky[c], ground[c])?)));
        let [r, g, b]: [(Sun, Sky); 3] = [r?, g?, b?];
        let around = Surroundings { toward_sun: toward.normalize(), sun, sky, ground };
        Ok(Lamps { suns: [r.0, g.0, b.0], skies: [r.1, g.1, b.1], around })
    }

    /// Light toward the viewer by the model.
    pub fn modeled(&self, baked: &Baked, surface: &Surface) -> Vec3 {
        let (depths, nine) = surface.light;
        // Depths of a file were checked; a normal of no length is no surface that could be seen.
        let Ok(leaf) = Leaf::new(depths.map(|d| f64::from(d.max(0.0))), facing(surface)) else { return Vec3::ZERO };
        let nine = nine.map(f64::from);
        let by_harmonics = baked.harmonics && surface.leaf;
        let (reflected, passed) = baked.optics(surface);
        let channel = |c: usize| {
            let (sun, sky) = (&self.suns[c], &self.skies[c]);
            let sides = |v: Vec3| Sides::both(f64::from(v[c]));
            let Ok(optics) = Optics::new(sides(reflected), sides(passed)) else { return 0.0 };
            let lit =
                if by_harmonics { light_sh(&leaf, &nine, &optics, sun, sky) } else { light(&leaf, &optics, sun, sky) };
            optics.radiance(lit.total()).front as f32
        };
        Vec3::new(channel(0), channel(1), channel(2))
    }
}

/// The side that is seen: leaves by their triangle, wood by its smooth normal.
fn facing(surface: &Surface) -> DVec3 {
    (if surface.leaf { surface.flat } else { surface.normal }).as_dvec3()
}

/// Paths through a picture's scene.
pub(crate) struct Walk<'a> {
    pub scene: &'a Scene<'a>,
    pub baked: &'a Baked,
}

impl Walk<'_> {
    /// Light toward the viewer by one path; none where a beam meets nothing.
    pub fn traced(&self, lamps: &Lamps, beam: &Beam, seeds: &[u64]) -> Option<Vec3> {
        radiance_along(self, &lamps.around, beam, &mut Stream::new(seeds)).map(|(light, _)| light.as_vec3())
    }
}

impl World for Walk<'_> {
    type Mark = ();

    fn meet(&self, beam: &Beam, from: Option<()>, stream: &mut Stream) -> Option<Met<()>> {
        let least = if from.is_some() { LIFT } else { 0.0 };
        let hit = self
            .scene
            .rays
            .nearest(beam, None, |hit| hit.distance >= least && self.scene.stops(hit, || stream.unit() as f32))?;
        let surface = self.scene.surface(&hit, beam.direction);
        let (reflected, passed) = self.baked.optics(&surface);
        let (r, t) = (reflected.as_dvec3(), passed.as_dvec3());
        let place = (beam.origin + beam.direction * hit.distance).as_dvec3();
        Some(Met { place, front: facing(&surface), reflectance: [r; 2], transmittance: [t; 2], mark: () })
    }

    fn is_open(&self, beam: &Beam, from: Option<()>, stream: &mut Stream) -> bool {
        let least = if from.is_some() { LIFT } else { 0.0 };
        !self.scene.rays.blocked(beam, |hit| hit.distance >= least && self.scene.stops(hit, || stream.unit() as f32))
    }
}
