//! Rasters as pictures: PNG of 16 bits, and EXR of 32-bit floats (compression ZIP16, lines increasing: the
//! settings of crate `exr` whose bytes do not change from run to run).

use crate::CarrierError;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    WritableImage,
};
use foliar_bake::FloatRaster;
use foliar_schema::raster;
use half::f16;
use half::slice::HalfFloatSliceExt;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use rayon::prelude::*;
use std::io::Cursor;
use std::path::Path;

const REPORT: &str = "report it: a fault of foliar";

/// The bytes of a raster, by the ending of `path`: `.exr`, else PNG over `range`, or the declared one.
pub(crate) fn encode(
    raster: &FloatRaster,
    name: &str,
    range: Option<(f64, f64)>,
    path: &Path,
) -> Result<Vec<u8>, CarrierError> {
    let fail = |problem: String| CarrierError::input(path.display().to_string(), name, problem, REPORT);
    if !raster.is_whole() || !(1..=4).contains(&raster.channels) {
        return Err(fail(format!("{} numbers for {} channels", raster.data.len(), raster.channels)));
    }
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("exr") => exr_bytes(raster, false).map_err(|e| fail(e.to_string())),
        _ => png_bytes(raster, range.unwrap_or_else(|| declared(name))).map_err(|e| fail(e.to_string())),
    }
}

fn declared(name: &str) -> (f64, f64) {
    raster(name).map_or((0.0, 1.0), |info| (f64::from(info.min), f64::from(info.max)))
}

/// The range over all 16-bit numbers: 0 is the least value, 65535 the greatest. Two channels go into red and
/// green of RGB, with a blue of 0: gray with alpha would be premultiplied by half of the readers.
fn png_bytes(floats: &FloatRaster, (min, max): (f64, f64)) -> Result<Vec<u8>, image::ImageError> {
    // A map of one value, its black and white the same, is black.
    let span = (max - min).max(f64::MIN_POSITIVE);
    let word = |value: f32| ((f64::from(value) - min) / span * 65_535.0).round().clamp(0.0, 65_535.0) as u16;
    let (stored, color) = match floats.channels {
        1 => (1, ExtendedColorType::L16),
        4 => (4, ExtendedColorType::Rgba16),
        _ => (3, ExtendedColorType::Rgb16),
    };
    let texel = |texel: &[f32]| (0..stored).map(|i| texel.get(i).map_or(0, |v| word(*v))).collect::<Vec<u16>>();
    let words: Vec<u16> = floats.data.chunks_exact(floats.channels as usize).flat_map(texel).collect();
    let mut bytes = Vec::new();
    // PngEncoder takes 16-bit numbers in the machine's own order.
    PngEncoder::new(&mut bytes).write_image(bytemuck::cast_slice(&words), floats.width, floats.height, color)?;
    Ok(bytes)
}

/// EXR bytes of a raster, of 16-bit floats where `half`.
pub(crate) fn exr_bytes(raster: &FloatRaster, half: bool) -> exr::error::Result<Vec<u8>> {
    let count = raster.channels as usize;
    exr_of((raster.width, raster.height), count, half, |channel, texel| raster.data[texel * count + channel])
}

/// The same of any numbers, by channel and texel.
pub(crate) fn exr_of(
    (width, height): (u32, u32),
    count: usize,
    half: bool,
    value: impl Fn(usize, usize) -> f32 + Sync,
) -> exr::error::Result<Vec<u8>> {
    let names: &[&str] = if count == 1 { &["Y"] } else { &["R", "G", "B", "A"] };
    let size = (width as usize, height as usize);
    let samples = |channel: usize| {
        let values: Vec<f32> = (0..size.0 * size.1).map(|texel| value(channel, texel)).collect();
        if !half {
            return FlatSamples::F32(values);
        }
        // By the slice: only so half asks the processor to do it.
        let mut halves = vec![f16::ZERO; values.len()];
        halves.convert_from_f32_slice(&values);
        FlatSamples::F16(halves)
    };
    let channels: Vec<_> = (0..count).into_par_iter().map(|i| AnyChannel::new(names[i], samples(i))).collect();
    let channels = channels.into_iter().collect();
    let encoding =
        Encoding { compression: Compression::ZIP16, line_order: LineOrder::Increasing, ..Encoding::UNCOMPRESSED };
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layer(layer);
    // exr keeps lines in order whatever thread packs them, and asks its own threads, not ours.
    match rayon::current_num_threads() {
        1 => image.write().non_parallel().to_buffered(&mut bytes)?,
        _ => image.write().to_buffered(&mut bytes)?,
    }
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};
    use foliar_schema::names;

    fn ramp() -> FloatRaster {
        let data = (0..2 * 8 * 4).map(|i| i as f32 / 31.5 - 1.0).collect();
        FloatRaster { width: 8, height: 4, channels: 2, data }
    }

    #[test]
    fn png_holds_the_value_to_half_a_step_of_16_bits() {
        let raster = ramp();
        let bytes = encode(&raster, names::RASTER_NOISE, None, Path::new("a.png")).unwrap();
        let picture = image::load_from_memory(&bytes).unwrap();
        assert_eq!(picture.color(), image::ColorType::Rgb16);
        for (texel, pixel) in raster.data.chunks(2).zip(picture.to_rgb16().pixels()) {
            for channel in [0, 1] {
                let back = 2.0 * f64::from(pixel[channel]) / 65_535.0 - 1.0;
                // Half a step of 2 / 65535, and the rounding of f32 numbers near 1.
                assert!((back - f64::from(texel[channel])).abs() <= 1.0 / 65_535.0 + 1e-7);
            }
        }
    }

    #[test]
    fn exr_holds_every_bit_and_comes_out_the_same_twice() {
        let raster = ramp();
        let bytes = encode(&raster, names::RASTER_NOISE, None, Path::new("a.exr")).unwrap();
        assert_eq!(bytes, encode(&raster, names::RASTER_NOISE, None, Path::new("a.exr")).unwrap());
        let image =
            read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
        let image = image.from_buffered(Cursor::new(bytes)).unwrap();
        // Channels of EXR stand in the order of the alphabet.
        for (channel, back) in [1, 0].into_iter().zip(&image.layer_data.channel_data.list) {
            let samples: Vec<f32> = back.sample_data.values_as_f32().collect();
            let written: Vec<f32> = raster.data.iter().skip(channel).step_by(2).copied().collect();
            assert_eq!(samples, written, "{}", back.name);
        }
    }

    #[test]
    fn a_torn_raster_is_refused() {
        let raster = FloatRaster { data: vec![0.0; 3], ..ramp() };
        assert!(encode(&raster, names::RASTER_NOISE, None, Path::new("a.png")).is_err());
    }
}
