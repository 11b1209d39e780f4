//! Pictures that move: the plant on a turntable.

use crate::camera::{self, Camera};
use crate::frame::Standing;
use crate::scene::Scene;
use crate::{Scale, Shading, ViewError, ViewParams, render};
use foliar_bake::Layer;
use foliar_plant::Plant;
use glam::Vec3;
use image::RgbaImage;

/// Slices of the body that the plant sweeps as it turns, and places around each.
const SLICES: usize = 64;
const AROUND: usize = 48;

/// `frames` pictures (at least one) of the plant as it turns once before the camera, counter-clockwise seen from
/// above; sun and camera stay where they are, and all pictures have one scale.
///
/// # Errors
/// As [`crate::render()`].
pub fn turntable(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    shading: &Shading,
    params: &ViewParams,
    frames: u32,
) -> Result<Vec<RgbaImage>, ViewError> {
    params.check()?;
    let right = camera::right(params.azimuth_deg).as_vec3();
    let scene = Scene::new(plant, layers, around, shading, (params.scale == Scale::Person).then_some(right))?;
    let swept = swept(&scene.fitted);
    let frames = frames.max(1);
    let turned = |frame: u32| {
        let turn = f64::from(frame) / f64::from(frames) * 360.0;
        let params = ViewParams {
            azimuth_deg: params.azimuth_deg - turn,
            sun_azimuth_deg: params.sun_azimuth_deg - turn,
            ..params.clone()
        };
        render::draw(&scene, Camera::fit(swept.iter().copied(), &scene.frame, &params), shading, &params)
    };
    (0..frames).map(turned).collect()
}

/// Points on the body that points sweep as they turn around the vertical through the picture's center.
fn swept(points: &[Vec3]) -> Vec<Vec3> {
    let low = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
    let high = points.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
    let mut slices = [(f32::INFINITY, f32::NEG_INFINITY, 0f32); SLICES];
    for p in points {
        let share = (p.y - low) / (high - low).max(f32::MIN_POSITIVE);
        let slice = &mut slices[((share * SLICES as f32) as usize).min(SLICES - 1)];
        *slice = (slice.0.min(p.y), slice.1.max(p.y), slice.2.max((p.x * p.x + p.z * p.z).sqrt()));
    }
    let filled = slices.iter().filter(|(low, high, _)| low <= high);
    let ring = |&(low, high, radius): &(f32, f32, f32)| {
        (0..2 * AROUND).map(move |i| {
            let (sine, cosine) = libm::sincosf((i / 2) as f32 / AROUND as f32 * std::f32::consts::TAU);
            Vec3::new(radius * cosine, if i % 2 == 0 { low } else { high }, radius * sine)
        })
    };
    filled.flat_map(ring).collect()
}

/// Bytes of an animated PNG that repeats for ever; a viewer that knows none shows the first picture.
///
/// # Errors
/// [`ViewError::Apng`] where the encoder refuses the pictures (none, no pixels); [`ViewError::Sizes`] where
/// they differ in size.
pub fn apng_bytes(frames: &[RgbaImage], per_second: u16) -> Result<Vec<u8>, ViewError> {
    let (width, height) = frames.first().map_or((0, 0), RgbaImage::dimensions);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(frames.len() as u32, 0)?;
    encoder.set_frame_delay(1, per_second)?;
    let mut writer = encoder.write_header()?;
    for frame in frames {
        if frame.dimensions() != (width, height) {
            return Err(ViewError::Sizes(width, height, frame.width(), frame.height()));
        }
        writer.write_image_data(frame.as_raw())?;
    }
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{frontal, gray, plant, quad};
    use foliar_schema::Role;
    use image::{AnimationDecoder, Rgba, codecs::png::PngDecoder};

    /// A post beside the axis: 1 m high, from x = 2 to x = 3 m, with a spot at the other side of the axis.
    fn post() -> Plant {
        let beside = quad(Vec3::new(2.5, 0.5, 0.0), Vec3::X * 0.5, Vec3::Y * 0.5);
        let spot = quad(Vec3::new(-3.0, 0.5, 0.0), Vec3::X * 0.01, Vec3::Y * 0.01);
        plant(vec![(beside, Role::Wood, gray(0.2)), (spot, Role::Wood, gray(0.2))], vec![])
    }

    #[test]
    fn a_turned_plant_moves_across_and_keeps_its_size() {
        let params = ViewParams { fov_deg: 1.0, ..frontal() };
        let frames = turntable(&post(), &[], &[], &Shading::Plain, &params, 4).unwrap();
        let columns = |picture: &RgbaImage| {
            let solid = picture.enumerate_pixels().filter(|(_, _, p)| p.0[3] > 128).map(|(x, _, _)| x);
            solid.fold((u32::MAX, 0), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (first, half) = (columns(&frames[0]), columns(&frames[2]));
        // Half a turn mirrors the picture: a pixel more or less at either end.
        assert!(first.1.abs_diff(239 - half.0) <= 1 && first.0.abs_diff(239 - half.1) <= 1, "{first:?} {half:?}");
        assert!(first.1 > 200, "it fills the picture: {first:?}");
        let counter_clockwise = turntable(&post(), &[], &[], &Shading::Plain, &params, 8).unwrap();
        assert!(columns(&counter_clockwise[1]).1 < first.1, "it comes in from the right");
    }

    #[test]
    fn an_animation_holds_every_frame() {
        let frames = [9, 99, 199].map(|gray| RgbaImage::from_pixel(5, 4, Rgba([gray, 0, 0, 255])));
        let bytes = apng_bytes(&frames, 24).unwrap();
        let decoder = PngDecoder::new(std::io::Cursor::new(&bytes)).unwrap().apng().unwrap();
        let read: Vec<RgbaImage> = decoder.into_frames().map(|f| f.unwrap().into_buffer()).collect();
        assert_eq!(read, frames);
        assert!(apng_bytes(&[], 24).is_err());
        assert!(apng_bytes(&[frames[0].clone(), RgbaImage::new(1, 1)], 24).is_err());
    }
}
