//! How large it is: a person beside the plant, and a bar of a round length in the corner.

use crate::camera::{Camera, PLANT_EDGE};
use crate::text::{self, SMALL};
use glam::{Vec2, Vec3};
use image::{Rgba, RgbaImage};

/// Height of the person, meters.
const PERSON_M: f64 = 1.7;
/// A person stands beside plants whose longest edge is at least one and at most a thousand of its heights: beside
/// smaller ones it would fill the picture, beside larger ones nobody would see it.
const PLANT_PER_PERSON: [f64; 2] = [1.0, 1000.0];
/// Meters between the plant's outermost point and the person's middle.
const ASIDE_M: f32 = 0.6;
/// Share of the picture's width that the bar fills at most.
const BAR_SHARE: f32 = 0.22;
/// Free pixels around the bar.
const PAD: i64 = 12;
/// Thickness of the bar, pixels.
const THICK: i64 = 4;
/// Bars shorter than this say nothing, pixels.
const LEAST_BAR: f32 = 16.0;
/// Sides and rings of a limb.
const SIDES: usize = 10;
const RINGS: usize = 8;

/// A limb: a capsule with a radius at either end, meters.
struct Limb {
    ends: [Vec3; 2],
    radii: [f32; 2],
    /// Depth over width of its section.
    depth: f32,
}

const fn limb(a: [f32; 3], b: [f32; 3], radii: [f32; 2], depth: f32) -> Limb {
    Limb { ends: [Vec3::from_array(a), Vec3::from_array(b)], radii, depth }
}

/// Standing at the origin, facing +Z, 1.7 m tall.
const BODY: [Limb; 7] = [
    limb([0.0, 1.56, 0.0], [0.0, 1.60, 0.0], [0.09, 0.10], 1.1),
    limb([0.0, 1.36, 0.0], [0.0, 1.52, 0.0], [0.06, 0.05], 1.0),
    limb([0.0, 0.92, 0.0], [0.0, 1.28, 0.0], [0.15, 0.185], 0.62),
    limb([-0.10, 0.06, 0.0], [-0.09, 0.86, 0.0], [0.06, 0.09], 1.0),
    limb([0.10, 0.06, 0.0], [0.09, 0.86, 0.0], [0.06, 0.09], 1.0),
    limb([-0.26, 0.80, 0.0], [-0.21, 1.38, 0.0], [0.04, 0.055], 1.0),
    limb([0.26, 0.80, 0.0], [0.21, 1.38, 0.0], [0.04, 0.055], 1.0),
];

/// Points, unit normals and triangles of a person in the picture's frame.
pub(crate) struct Person {
    pub points: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// A person to the right of what is shown, as seen by a camera whose right is `right` (unit, level), on its floor;
/// `per_meter` is a meter in the picture's frame. None beside a plant of which it would say nothing.
pub(crate) fn person(shown: &[Vec3], right: Vec3, per_meter: f64) -> Option<Person> {
    let plant = PLANT_EDGE / per_meter / PERSON_M;
    if shown.is_empty() || !(PLANT_PER_PERSON[0]..=PLANT_PER_PERSON[1]).contains(&plant) {
        return None;
    }
    let floor = shown.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
    let outermost = shown.iter().map(|p| p.dot(right)).fold(f32::NEG_INFINITY, f32::max);
    let meter = per_meter as f32;
    let feet = right * (outermost + ASIDE_M * meter) + Vec3::Y * floor;
    let facing = right.cross(Vec3::Y);
    let turn = |v: Vec3| right * v.x + Vec3::Y * v.y + facing * v.z;
    let mut body = Person { points: Vec::new(), normals: Vec::new(), triangles: Vec::new() };
    for limb in &BODY {
        body.add(limb);
    }
    body.points.iter_mut().for_each(|p| *p = feet + turn(*p) * meter);
    body.normals.iter_mut().for_each(|n| *n = turn(*n));
    Some(body)
}

impl Person {
    /// Rings from one pole of the capsule to the other, half of them around either end.
    fn add(&mut self, limb: &Limb) {
        let first = self.points.len() as u32;
        let axis = (limb.ends[1] - limb.ends[0]).normalize();
        let across = [axis.any_orthonormal_vector(), axis.cross(axis.any_orthonormal_vector())];
        for ring in 0..RINGS {
            let end = usize::from(ring >= RINGS / 2);
            // Quarter of a circle from the pole to the limb's side at either end.
            let step = (ring % (RINGS / 2)) as f32 / (RINGS / 2 - 1) as f32 * std::f32::consts::FRAC_PI_2;
            let angle = if end == 0 { step - std::f32::consts::FRAC_PI_2 } else { step };
            let (along, out) = libm::sincosf(angle);
            for side in 0..SIDES {
                let (y, x) = libm::sincosf(side as f32 / SIDES as f32 * std::f32::consts::TAU);
                let direction = axis * along + (across[0] * x + across[1] * y) * out;
                let flat = Vec3::new(1.0, 1.0, limb.depth);
                self.points.push(limb.ends[end] + direction * flat * limb.radii[end]);
                self.normals.push((direction / flat).normalize_or(axis));
            }
        }
        let at = |ring: usize, side: usize| first + (ring * SIDES + side % SIDES) as u32;
        for (ring, side) in (1..RINGS).flat_map(|ring| (0..SIDES).map(move |side| (ring - 1, side))) {
            let [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)];
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

/// Longest length of 1, 2 or 5 times a power of ten that is at most `length`.
fn round_length(length: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(length)));
    [5.0, 2.0, 1.0].map(|m| m * power).into_iter().find(|&l| l <= length).unwrap_or(power)
}

/// Draws the bar into the lower left corner: as long as it would be where the camera looks.
pub(crate) fn bar(picture: &mut RgbaImage, camera: &Camera, per_meter: f64) {
    let (Some(a), Some(b)) = (camera.project(camera.focus), camera.project(camera.focus + camera.right)) else {
        return;
    };
    let pixels_per_meter = (b - a).length() * per_meter as f32;
    let longest = BAR_SHARE * picture.width() as f32 / pixels_per_meter;
    if !longest.is_normal() {
        return;
    }
    let length = round_length(f64::from(longest)) as f32;
    let long = (length * pixels_per_meter).round();
    if long < LEAST_BAR {
        return;
    }
    let (left, low) = (PAD, i64::from(picture.height()) - PAD);
    let dark = |picture: &mut RgbaImage, low_corner: Vec2, size: Vec2, gray: u8| {
        for (x, y) in (0..size.x as u32).flat_map(|x| (0..size.y as u32).map(move |y| (x, y))) {
            let (x, y) = (low_corner.x as u32 + x, low_corner.y as u32 + y);
            if x < picture.width() && y < picture.height() {
                picture.put_pixel(x, y, Rgba([gray, gray, gray, 255]));
            }
        }
    };
    let corner = Vec2::new(left as f32, (low - THICK) as f32);
    dark(picture, corner - 1.0, Vec2::new(long + 2.0, THICK as f32 + 2.0), 245);
    dark(picture, corner, Vec2::new(long, THICK as f32), 20);
    outlined(picture, left, low - THICK - 4 - i64::from(text::height(SMALL)), &format!("{} m", text::number(length)));
}

/// Writes the person's height above its head, where that is in the picture.
pub(crate) fn label(picture: &mut RgbaImage, head: Option<Vec2>) {
    let words = format!("{PERSON_M} m");
    let size = Vec2::new(text::width(SMALL, &words) as f32, text::height(SMALL) as f32);
    let all = Vec2::new(picture.width() as f32, picture.height() as f32);
    let Some(corner) = head.map(|head| head - Vec2::new(size.x / 2.0, size.y + 4.0)) else { return };
    if corner.cmpge(Vec2::ZERO).all() && (corner + size).cmple(all).all() {
        outlined(picture, corner.x as i64, corner.y as i64, &words);
    }
}

/// Dark words with a light rim.
fn outlined(picture: &mut RgbaImage, left: i64, top: i64, words: &str) {
    for (x, y) in [(left - 1, top), (left + 1, top), (left, top - 1), (left, top + 1)] {
        text::write(picture, SMALL, x, y, words, 245);
    }
    text::write(picture, SMALL, left, top, words, 20);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round_and_fit() {
        for (length, round) in [(1.0, 1.0), (1.9, 1.0), (4.99, 2.0), (7.0, 5.0), (45.0, 20.0), (0.03, 0.02)] {
            assert!((round_length(length) / round - 1.0).abs() < 1e-12, "{length}");
        }
    }

    #[test]
    fn a_person_is_one_meter_seventy_and_stands_beside_the_plant_on_its_floor() {
        // A plant of 10 m in a frame of PLANT_EDGE: a meter is one.
        let shown = [Vec3::new(-3.0, -5.0, 0.0), Vec3::new(3.0, 5.0, 1.0)];
        let body = person(&shown, Vec3::X, 1.0).unwrap();
        let low = body.points.iter().copied().reduce(Vec3::min).unwrap();
        let high = body.points.iter().copied().reduce(Vec3::max).unwrap();
        assert!((low.y + 5.0).abs() < 1e-5 && (high.y - low.y - PERSON_M as f32).abs() < 1e-5, "{low} {high}");
        assert!(low.x > 3.0 && high.x < 4.0, "beside, near: {low} {high}");
        assert!(body.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        assert!(person(&shown, Vec3::X, 100.0).is_none(), "a seedling of 10 cm");
        assert!(person(&[], Vec3::X, 1.0).is_none());
    }
}
