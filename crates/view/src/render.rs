//! Draws a plant: rays through pixels, alpha tested inside the traversal, one shadow ray for four samples.

use crate::camera::{self, Camera, PLANT_EDGE};
use crate::frame::{Frame, Standing};
use crate::key::Key;
use crate::leaf_light::{Lamps, Walk};
use crate::mask::Mask;
use crate::scene::Scene;
use crate::{Background, Ground, Scale, Shading, ViewError, ViewParams, colors, legend, lines, scale, shade};
use foliar_bake::Layer;
use foliar_numerics::{r2_point, radical_inverse};
use foliar_plant::Plant;
use foliar_space::{Beam, Hit};
use glam::{Vec2, Vec3, Vec4};
use image::RgbaImage;
use rayon::prelude::*;

/// Edge of the squares that threads take, pixels.
const TILE: u32 = 32;
/// Lit samples that share one shadow ray.
const SAMPLES_PER_SHADOW: u32 = 4;
/// Shadow rays start so far above the surface.
const LIFT: f32 = 1e-4 * PLANT_EDGE as f32;
/// The ground's shadow fades to nothing at this distance from the plant's axis.
const GROUND_RADIUS: f32 = 1.5 * PLANT_EDGE as f32;

/// Draws a plant with what its layers hold.
///
/// - Leaves and wood are seen from both sides: a normal of the file is turned to the viewer. A
///   realigned normal stays as it is, since it says how the crown stands to the light.
/// - Masks cut at their cutoff, blended materials stop a ray with the probability of their alpha.
/// - Light: sun with shadow, even sky times the ambient coefficient (1 where none was baked), half of
///   the sun's light on the back of a leaf shines through it. Below 0.6 tone mapping changes nothing.
/// - [`Shading::Stock`] is lit by what a viewer knows that never heard of foliar, see [`crate::Look::Stock`].
/// - [`Shading::Lines`] draws edges only, black on white (or on nothing, where the background is clear).
/// - False colors are not lit, so that they are those of the legend, which stands on a strip below: the picture is
///   higher by that.
///
/// The same bytes for any number of threads.
///
/// # Errors
/// [`ViewError`]: a parameter out of range, a layer that does not fit, a channel that is not there.
pub fn render(
    plant: &Plant,
    layers: &[&Layer],
    shading: &Shading,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    render_among(plant, layers, &[], shading, params)
}

/// The same with plants that stand around it; in false colors they are gray.
///
/// # Errors
/// As [`render`].
pub fn render_among(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    shading: &Shading,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    render_like(plant, layers, around, shading, None, params)
}

/// The same with false colors by the key of another picture.
pub(crate) fn render_like(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    shading: &Shading,
    like: Option<&Key>,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    params.check()?;
    let right = camera::right(params.azimuth_deg).as_vec3();
    let person = (params.scale == Scale::Person).then_some(right);
    let frame = Frame::around(plant, around);
    let scene = Scene::within(&frame, (plant, layers), around, (shading, like), person)?;
    let camera = Camera::fit(scene.fitted.iter().copied(), &scene.frame, params);
    draw(&scene, camera, shading, params)
}

/// The scene as a camera sees it, with its bar and legend.
///
/// # Errors
/// [`ViewError::Model`] for a sun that the light model does not take.
pub(crate) fn draw(
    scene: &Scene,
    camera: Camera,
    shading: &Shading,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let mask = Mask::new(&camera, &scene.triangles, params.width_px, params.height_px);
    let mut picture = match shading {
        Shading::Lines(_) => lines::draw(scene, camera, &mask, params),
        _ => Tracer::new(scene, camera, mask, params, shading)?.trace(),
    };
    if params.scale != Scale::None && !scene.fitted.is_empty() {
        scale::bar(&mut picture, &camera, scene.frame.per_meter());
        scale::label(&mut picture, scene.head.and_then(|head| camera.project(head)));
    }
    Ok(match &scene.legend {
        Some(words) => legend::below(picture, words),
        None => picture,
    })
}

struct Tracer<'a> {
    scene: &'a Scene<'a>,
    camera: Camera,
    mask: Mask,
    params: &'a ViewParams,
    sun: Vec3,
    /// Across the sun.
    sun_axes: [Vec3; 2],
    /// Places inside a pixel, and a number in [0, 1) that goes with each.
    samples: Vec<(Vec2, f32)>,
    ground: bool,
    /// Sun and sky of the light model, and whether its paths are followed.
    lamps: Option<(Lamps, bool)>,
}

/// What the samples of one pixel share.
struct Pixel {
    seed: u32,
    shadows: [Shadow; 2],
    /// What the last ray met.
    last: Option<Hit>,
}

/// The last shadow ray's answer and how many samples have used it.
#[derive(Clone, Copy, Default)]
struct Shadow {
    used: u32,
    open: bool,
}

impl<'a> Tracer<'a> {
    fn new(
        scene: &'a Scene,
        camera: Camera,
        mask: Mask,
        params: &'a ViewParams,
        shading: &Shading,
    ) -> Result<Self, ViewError> {
        let sun = camera::direction(params.sun_azimuth_deg, params.sun_elevation_deg).as_vec3();
        let (across, along) = sun.any_orthonormal_pair();
        let sample = |i: u64| (r2_point(i).as_vec2(), radical_inverse(i, 2) as f32);
        Ok(Tracer {
            scene,
            camera,
            mask,
            params,
            sun,
            sun_axes: [across, along],
            samples: (0..u64::from(params.samples)).map(sample).collect(),
            ground: params.ground == Ground::Shadow && scene.legend.is_none() && camera.eye.y > scene.floor,
            lamps: match shading {
                Shading::Light | Shading::Traced => Some((Lamps::new(sun)?, *shading == Shading::Traced)),
                _ => None,
            },
        })
    }

    fn trace(&self) -> RgbaImage {
        let (width, height) = (self.params.width_px, self.params.height_px);
        let (columns, rows) = (width.div_ceil(TILE), height.div_ceil(TILE));
        let tiles: Vec<Vec<[u8; 4]>> =
            (0..columns * rows).into_par_iter().map(|t| self.tile(t % columns * TILE, t / columns * TILE)).collect();
        RgbaImage::from_fn(width, height, |x, y| {
            let tile = &tiles[(y / TILE * columns + x / TILE) as usize];
            image::Rgba(tile[(y % TILE * TILE + x % TILE) as usize])
        })
    }

    fn tile(&self, left: u32, top: u32) -> Vec<[u8; 4]> {
        let places = (0..TILE * TILE).map(|i| (left + i % TILE, top + i / TILE));
        let inside = |x, y| x < self.params.width_px && y < self.params.height_px;
        places.map(|(x, y)| if inside(x, y) { self.pixel(x, y) } else { [0; 4] }).collect()
    }

    fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let seed = colors::mix(colors::mix(x).wrapping_add(y));
        let covered = self.mask.covers(x, y);
        let turn = Vec2::new((seed & 0xFFFF) as f32, (seed >> 16) as f32) / 65536.0;
        let mut pixel = Pixel { seed, shadows: [Shadow::default(); 2], last: None };
        let mut sum = Vec4::ZERO;
        for (index, (offset, _)) in self.samples.iter().enumerate() {
            let inside = (offset + turn).fract();
            let direction = self.camera.through(Vec2::new(x as f32, y as f32) + inside);
            sum += self.sample(&mut pixel, index, direction, covered);
        }
        let mean = sum / self.samples.len() as f32;
        let (light, alpha) = (mean.truncate(), mean.w);
        match self.background(y) {
            Some(behind) => colors::to_bytes(light + behind * (1.0 - alpha), 1.0),
            None => colors::to_bytes(if alpha > 0.0 { light / alpha } else { light }, alpha),
        }
    }

    /// Light and coverage of one ray, light weighted by coverage.
    fn sample(&self, pixel: &mut Pixel, index: usize, direction: Vec3, covered: bool) -> Vec4 {
        let beam = Beam { origin: self.camera.eye, direction, reach: f32::INFINITY };
        let stops = |hit: &Hit| {
            self.scene.shows(hit, direction) && self.scene.stops(hit, || self.chance(pixel.seed, index, hit.triangle))
        };
        let hit = if covered { self.scene.rays.nearest(&beam, pixel.last.as_ref(), stops) } else { None };
        pixel.last = hit.or(pixel.last);
        match hit {
            Some(hit) if self.scene.legend.is_some() => self.scene.false_color(&hit).extend(1.0),
            Some(hit) => self.lit(pixel, index, &beam, &hit).extend(1.0),
            None if self.ground => Vec3::ZERO.extend(self.ground_shadow(pixel, index, direction)),
            None => Vec4::ZERO,
        }
    }

    fn lit(&self, pixel: &mut Pixel, index: usize, beam: &Beam, hit: &Hit) -> Vec3 {
        if let (Some((lamps, traced)), Some(baked)) = (&self.lamps, &self.scene.light) {
            let light = if *traced {
                // The path meets what the ray met, up to textures that are half there.
                let walk = Walk { scene: self.scene, baked };
                walk.traced(lamps, beam, &[u64::from(pixel.seed), index as u64]).unwrap_or_default()
            } else {
                lamps.modeled(baked, &self.scene.surface(hit, beam.direction))
            };
            return colors::tone(light * self.params.exposure as f32);
        }
        let surface = self.scene.surface(hit, beam.direction);
        let mut sun = shade::sunlit(&surface, self.sun);
        if sun > 0.0 && !self.scene.stock {
            let lift = if surface.flat.dot(self.sun) < 0.0 { -surface.flat } else { surface.flat };
            let place = beam.origin + beam.direction * hit.distance;
            // Near its own edge of shadow a smooth body has triangles that the sun does not see, and that are lit all the same.
            let outward = if surface.flat.dot(surface.normal) < 0.0 { -surface.flat } else { surface.flat };
            let round = self.scene.rounded(hit, place, outward).filter(|_| surface.normal.dot(self.sun) > 0.0);
            let from = round.map_or(place + lift * LIFT, |round| round + outward * LIFT);
            if !self.sun_reaches(pixel, 0, index, from) {
                sun = 0.0;
            }
        }
        colors::tone(shade::light(&surface, sun) * self.params.exposure as f32)
    }

    /// How much the ground hides of the background: 0 in the sun, most under the tree.
    fn ground_shadow(&self, pixel: &mut Pixel, index: usize, direction: Vec3) -> f32 {
        let distance = (self.scene.floor - self.camera.eye.y) / direction.y;
        let place = self.camera.eye + direction * distance;
        let share = Vec2::new(place.x, place.z).length() / GROUND_RADIUS;
        // A ray that rises gives a negative distance, one that never meets the ground an endless share.
        if distance > 0.0 && share < 1.0 && !self.sun_reaches(pixel, 1, index, place + Vec3::Y * LIFT) {
            let fade = 1.0 - share * share;
            shade::GROUND_SHADOW * fade * fade
        } else {
            0.0
        }
    }

    /// Whether the sun is seen from a place; asked once for every few samples of a pixel.
    fn sun_reaches(&self, pixel: &mut Pixel, which: usize, index: usize, from: Vec3) -> bool {
        let seed = pixel.seed;
        let shadow = &mut pixel.shadows[which];
        if shadow.used.is_multiple_of(SAMPLES_PER_SHADOW) {
            let chance = |hit: &Hit| self.chance(!seed, index, hit.triangle);
            let beam = Beam { origin: from, direction: self.toward_sun(seed, index), reach: f32::INFINITY };
            shadow.open = !self.scene.rays.blocked(&beam, |hit| self.scene.stops(hit, || chance(hit)));
        }
        shadow.used += 1;
        shadow.open
    }

    /// A direction to somewhere on the sun's disc.
    fn toward_sun(&self, seed: u32, index: usize) -> Vec3 {
        let (offset, _) = self.samples[index];
        let turn = Vec2::new((seed >> 8 & 0xFFF) as f32, (seed >> 20) as f32) / 4096.0;
        let square = (offset + turn).fract();
        let (sine, cosine) = libm::sincosf(square.x * std::f32::consts::TAU);
        let disc = Vec2::new(cosine, sine) * (square.y.sqrt() * shade::SUN_RADIUS);
        (self.sun + self.sun_axes[0] * disc.x + self.sun_axes[1] * disc.y).normalize()
    }

    /// A number in [0, 1): spread evenly over the samples of a pixel, unrelated between triangles.
    fn chance(&self, seed: u32, index: usize, triangle: u32) -> f32 {
        let turn = (colors::mix(seed ^ triangle.wrapping_mul(0x9E37_79B9)) >> 8) as f32 / (1 << 24) as f32;
        (self.samples[index].1 + turn).fract()
    }

    /// Linear light behind everything; none where the picture stays clear.
    fn background(&self, y: u32) -> Option<Vec3> {
        let down = (y as f32 + 0.5) / self.params.height_px as f32;
        match self.params.background {
            Background::Studio => Some(Vec3::new(0.50, 0.53, 0.57).lerp(Vec3::new(0.68, 0.68, 0.67), down)),
            Background::White => Some(Vec3::ONE),
            Background::Black => Some(Vec3::ZERO),
            Background::Clear => None,
        }
    }
}
