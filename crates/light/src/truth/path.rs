//! Paths of light, from where it arrives back to where it came from, in three wavelengths at once.

use super::Stream;
use super::stream::cosine_direction;
use foliar_space::Beam;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

/// From this bounce on a path ends with the chance of what it has lost.
const CERTAIN_BOUNCES: usize = 3;
/// Paths end here: leaves that lose nothing would keep one for ever.
const MOST_BOUNCES: usize = 400;

/// A place that a ray met.
#[derive(Clone, Copy, Debug)]
pub struct Met<M> {
    /// Where, in the frame of the beams.
    pub place: DVec3,
    /// Unit normal of the front.
    pub front: DVec3,
    /// Reflectance of front and back, three wavelengths.
    pub reflectance: [DVec3; 2],
    /// Share that goes through of light onto front and back.
    pub transmittance: [DVec3; 2],
    /// What rays that start here must not meet.
    pub mark: M,
}

/// What there is to be met.
pub trait World: Sync {
    /// Names a surface.
    type Mark: Copy;

    /// The nearest surface along a beam, other than `from`. `stream` decides about half-transparent ones.
    fn meet(&self, beam: &Beam, from: Option<Self::Mark>, stream: &mut Stream) -> Option<Met<Self::Mark>>;

    /// Whether nothing but `from` lies along a beam.
    fn is_open(&self, beam: &Beam, from: Option<Self::Mark>, stream: &mut Stream) -> bool;
}

/// Where light comes from, three wavelengths.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    /// Unit vector to the sun.
    pub toward_sun: DVec3,
    /// Irradiance of a surface that faces the sun.
    pub sun: DVec3,
    /// Radiance of the upper half.
    pub sky: DVec3,
    /// Radiance of the lower half.
    pub ground: DVec3,
}

impl Surroundings {
    fn radiance(&self, direction: DVec3) -> DVec3 {
        if direction.y > 0.0 { self.sky } else { self.ground }
    }
}

/// Light by the way it took: from sun and sky, by how many bounces.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ways {
    /// From the sun straight, by one bounce, by two or more.
    pub sun: [DVec3; 3],
    /// From the sky straight, by one bounce or more.
    pub sky: [DVec3; 2],
}

impl Ways {
    /// All of it.
    pub fn total(&self) -> DVec3 {
        self.sun.iter().chain(&self.sky).sum()
    }

    pub(crate) fn add(&mut self, other: &Ways) {
        self.sun.iter_mut().zip(other.sun).for_each(|(a, b)| *a += b);
        self.sky.iter_mut().zip(other.sky).for_each(|(a, b)| *a += b);
    }

    pub(crate) fn times(&self, factor: f64) -> Ways {
        Ways { sun: self.sun.map(|v| v * factor), sky: self.sky.map(|v| v * factor) }
    }
}

/// A path on its way.
struct Path<'a, W: World> {
    world: &'a W,
    around: &'a Surroundings,
    stream: &'a mut Stream,
    /// What radiance at its end counts for.
    weight: DVec3,
    ways: Ways,
}

/// One sample of the irradiance of a place on the side of `normal`; `first` in the unit square chooses where the path goes first.
pub fn irradiance_at<W: World>(
    world: &W,
    around: &Surroundings,
    (place, normal, mark): (DVec3, DVec3, W::Mark),
    first: DVec2,
    stream: &mut Stream,
) -> Ways {
    let mut path = Path { world, around, stream, weight: DVec3::splat(PI), ways: Ways::default() };
    path.ways.sun[0] = around.sun * path.sun_cosine(place, normal, mark).max(0.0);
    path.walk(place, cosine_direction(normal, first), Some(mark), 0);
    path.ways
}

/// One sample of the radiance that a beam brings back from what it meets, and the first thing met; none where it meets nothing.
pub fn radiance_along<W: World>(
    world: &W,
    around: &Surroundings,
    beam: &Beam,
    stream: &mut Stream,
) -> Option<(DVec3, Met<W::Mark>)> {
    let met = world.meet(beam, None, stream)?;
    let mut path = Path { world, around, stream, weight: DVec3::ONE, ways: Ways::default() };
    if let Some(next) = path.scatter(&met, beam.direction.as_dvec3(), 0) {
        path.walk(met.place, next, Some(met.mark), 0);
    }
    Some((path.ways.total(), met))
}

impl<W: World> Path<'_, W> {
    /// Cosine between a normal and the sun, 0 where the sun is hidden; negative where it stands behind.
    fn sun_cosine(&mut self, place: DVec3, normal: DVec3, mark: W::Mark) -> f64 {
        let cosine = normal.dot(self.around.toward_sun);
        let beam = beam(place, self.around.toward_sun);
        let lit = self.around.sun != DVec3::ZERO && self.world.is_open(&beam, Some(mark), self.stream);
        if lit { cosine } else { 0.0 }
    }

    /// Follows a path from a place until it leaves the crown or is lost; `bounces` counts those behind it.
    fn walk(&mut self, mut place: DVec3, mut direction: DVec3, mut from: Option<W::Mark>, mut bounces: usize) {
        while bounces < MOST_BOUNCES {
            let Some(met) = self.world.meet(&beam(place, direction), from, self.stream) else {
                self.ways.sky[bounces.min(1)] += self.weight * self.around.radiance(direction);
                return;
            };
            bounces += 1;
            let Some(next) = self.scatter(&met, direction, bounces) else { return };
            (place, direction, from) = (met.place, next, Some(met.mark));
        }
    }

    /// Adds the sun's light at a surface that is met along `direction`, and gives where the path goes on.
    fn scatter(&mut self, met: &Met<W::Mark>, direction: DVec3, bounces: usize) -> Option<DVec3> {
        let seen = usize::from(direction.dot(met.front) > 0.0);
        let normal = if seen == 0 { met.front } else { -met.front };
        let (reflected, passed) = (met.reflectance[seen], met.transmittance[1 - seen]);
        let cosine = self.sun_cosine(met.place, normal, met.mark);
        let lit = if cosine > 0.0 { reflected } else { passed };
        self.ways.sun[bounces.min(2)] += self.weight * lit * self.around.sun * (cosine.abs() * FRAC_1_PI);

        let (r, t) = (reflected.element_sum(), passed.element_sum());
        if r + t <= 0.0 {
            return None;
        }
        let reflects = self.stream.unit() * (r + t) < r;
        let (share, chance) = if reflects { (reflected, r / (r + t)) } else { (passed, t / (r + t)) };
        self.weight *= share / chance;
        if bounces >= CERTAIN_BOUNCES {
            let survival = (self.weight.max_element() * FRAC_1_PI).min(1.0);
            if self.stream.unit() >= survival {
                return None;
            }
            self.weight /= survival;
        }
        let side = if reflects { normal } else { -normal };
        Some(cosine_direction(side, self.stream.point()))
    }
}

fn beam(place: DVec3, direction: DVec3) -> Beam {
    Beam { origin: place.as_vec3(), direction: direction.as_vec3(), reach: f32::INFINITY }
}
