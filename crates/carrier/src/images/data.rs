//! Maps of numbers (thickness, heights, normals): PNG, TIFF and EXR, and with a warning what stores colors, as linear floats.
//! Nothing undoes a color curve here: a number is what was stored.

use super::{Format, broken, check_size, jpeg_ends, open, sniff};
use crate::CarrierError;
use exr::image::{AnyChannel, AnyChannels, FlatSamples, Image, Layer};
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, read};
use foliar_bake::{FloatRaster, MapRaster};
use foliar_schema::{Finding, code};
use image::DynamicImage;
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

/// Most memory that the numbers of a map may take.
const MOST_BYTES: u64 = 2 << 30;
/// Words of channels in layers of EXR files, in the order of a raster.
const CHANNELS: [[&str; 3]; 2] = [["R", "G", "B"], ["X", "Y", "Z"]];

/// A map of numbers.
#[derive(Clone, Debug)]
pub struct DataMap {
    /// Its numbers, without alpha.
    pub map: MapRaster,
    /// Its alpha, where it has one.
    pub alpha: Option<MapRaster>,
    /// What a person should know.
    pub findings: Vec<Finding>,
}

/// Channels side by side, the last of them alpha or not.
struct Numbers {
    size: (u32, u32),
    channels: u32,
    has_alpha: bool,
    bits: u32,
    data: Vec<f32>,
    /// Why its numbers may mean colors.
    colored: Option<&'static str>,
}

/// Reads a map. The format is told by the bytes; `name` stands in messages.
///
/// # Errors
/// [`CarrierError::Input`] for what is no picture, damaged, cut, or larger than its bytes can hold.
pub fn read_map(bytes: &[u8], name: &str) -> Result<DataMap, CarrierError> {
    let format = sniff(bytes);
    let numbers = match format {
        Format::Exr => exr_numbers(bytes, name)?,
        Format::Tiff => tiff_numbers(bytes, name)?,
        _ => picture_numbers(bytes, format, name)?,
    };
    let finding = |why: &str| {
        let text = format!(
            "{why}: its numbers were taken as they are; where they are bent as sRGB is, half white is read as .50 and \
             meant as .21, 2.3 times too much: save it without a profile, as PNG of 16 bits, TIFF or EXR"
        );
        Finding::new(&code::MAP_COLOR, text).in_file(name)
    };
    let findings = numbers.colored.map(finding).into_iter().collect();
    Ok(numbers.split(findings))
}

impl Numbers {
    fn split(self, findings: Vec<Finding>) -> DataMap {
        let Numbers { size: (width, height), channels, has_alpha, bits, data, .. } = self;
        let raster = |channels, data| MapRaster { raster: FloatRaster { width, height, channels, data }, bits };
        if !has_alpha {
            return DataMap { map: raster(channels, data), alpha: None, findings };
        }
        let own = channels as usize - 1;
        let alpha = data.iter().skip(own).step_by(own + 1).copied().collect();
        let rest = data.chunks_exact(own + 1).flat_map(|texel| &texel[..own]).copied().collect();
        DataMap { map: raster(channels - 1, rest), alpha: Some(raster(1, alpha)), findings }
    }
}

/// Refuses sizes that no memory should be taken for.
fn check_memory(
    format: Format,
    (width, height): (u32, u32),
    channels: u32,
    bytes: usize,
    name: &str,
) -> Result<(), CarrierError> {
    check_size(format, width, height, bytes, name)?;
    let needed = u64::from(width) * u64::from(height) * u64::from(channels) * 4;
    if needed <= MOST_BYTES {
        return Ok(());
    }
    let problem = format!("{width} x {height} texels of {channels} channels take {needed} bytes");
    Err(CarrierError::input(name, "", problem, format!("at most {MOST_BYTES}: scale it down")))
}

fn picture_numbers(bytes: &[u8], format: Format, name: &str) -> Result<Numbers, CarrierError> {
    let Some(decoder) = format.decoder() else {
        let problem = format!("is {}, not PNG, TIFF or EXR", format.name());
        return Err(CarrierError::input(name, "byte 0", problem, "convert it to PNG of 16 bits, TIFF or EXR"));
    };
    if format == Format::Jpeg && !jpeg_ends(bytes) {
        let problem = format!("is JPEG cut short after {} bytes", bytes.len());
        return Err(CarrierError::input(name, "", problem, "copy or export the picture again"));
    }
    let picture = open(bytes, decoder, name)?.decode().map_err(|e| broken(format, name, e))?;
    let color = picture.color();
    let channels = u32::from(color.channel_count());
    let bits = 8 * u32::from(color.bytes_per_pixel()) / channels;
    let colored = match format {
        Format::Jpeg => Some("JPEG stores colors, with loss"),
        Format::Png => png_color(bytes),
        _ => None,
    };
    let size = (picture.width(), picture.height());
    check_memory(sniff(bytes), size, channels, bytes.len(), name)?;
    Ok(Numbers { size, channels, has_alpha: color.has_alpha(), bits, data: floats(&picture), colored })
}

/// Stored numbers over the greatest of their kind.
fn floats(picture: &DynamicImage) -> Vec<f32> {
    let bytes = picture.as_bytes();
    match picture {
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => words(bytemuck::cast_slice(bytes)),
        _ => octets(bytes),
    }
}

fn octets(bytes: &[u8]) -> Vec<f32> {
    bytes.iter().map(|v| f32::from(*v) / 255.0).collect()
}

fn words(words: &[u16]) -> Vec<f32> {
    words.iter().map(|v| f32::from(*v) / 65_535.0).collect()
}

/// Whether chunks before the picture's own data tag a PNG as colors.
fn png_color(bytes: &[u8]) -> Option<&'static str> {
    let mut at = 8;
    loop {
        let length = u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?) as usize;
        match bytes.get(at + 4..at + 8)? {
            b"sRGB" => return Some("PNG is tagged as sRGB"),
            b"iCCP" => return Some("PNG carries a color profile"),
            // A gamma of 1 says that nothing is bent.
            b"gAMA" if bytes.get(at + 8..at + 12)? != 100_000u32.to_be_bytes() => {
                return Some("PNG is tagged with a gamma");
            }
            b"IDAT" | b"IEND" => return None,
            _ => at = at.checked_add(length)?.checked_add(12)?,
        }
    }
}

fn tiff_numbers(bytes: &[u8], name: &str) -> Result<Numbers, CarrierError> {
    let broken = |e: tiff::TiffError| {
        let remedy = "export it again: whole numbers of 8 or 16 bits or floats, no palette";
        CarrierError::input(name, "", format!("is damaged or unusual TIFF: {e}"), remedy)
    };
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(broken)?;
    let size = decoder.dimensions().map_err(broken)?;
    let kind = decoder.colortype().map_err(broken)?;
    let channels = u32::from(kind.num_samples());
    check_memory(sniff(bytes), size, channels, bytes.len(), name)?;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES as usize;
    limits.intermediate_buffer_size = MOST_BYTES as usize;
    let mut decoder = decoder.with_limits(limits);
    let profile = decoder.find_tag(Tag::IccProfile).ok().flatten().is_some();
    let (bits, data) = match decoder.read_image().map_err(broken)? {
        DecodingResult::U8(data) => (8, octets(&data)),
        DecodingResult::U16(data) => (16, words(&data)),
        DecodingResult::F16(data) => (32, data.iter().map(|v| v.to_f32()).collect()),
        DecodingResult::F32(data) => (32, data),
        DecodingResult::F64(data) => (32, data.iter().map(|v| *v as f32).collect()),
        _ => {
            let problem = format!("stores {kind:?} of a kind that is not read");
            return Err(CarrierError::input(name, "", problem, "save it as 8 or 16 bits or as floats"));
        }
    };
    let wanted = u64::from(size.0) * u64::from(size.1) * u64::from(channels);
    if data.len() as u64 != wanted {
        let problem = format!("holds {} numbers for {} x {} texels of {kind:?}", data.len(), size.0, size.1);
        return Err(CarrierError::input(name, "", problem, "save it with its channels side by side"));
    }
    let has_alpha = matches!(kind, tiff::ColorType::GrayA(_) | tiff::ColorType::RGBA(_));
    Ok(Numbers { size, channels, has_alpha, bits, data, colored: profile.then_some("TIFF carries a color profile") })
}

fn exr_numbers(bytes: &[u8], name: &str) -> Result<Numbers, CarrierError> {
    let (size, channels) = exr_channels(bytes, name)?;
    let find = |wanted: &str| channels.iter().find(|(channel, _)| channel == wanted).map(|(_, data)| data);
    let alpha = find("A");
    let three = CHANNELS.iter().find_map(|names| names.map(find).into_iter().collect::<Option<Vec<_>>>());
    let first = channels.iter().find(|(name, _)| name != "A").or(channels.first()).map(|(_, data)| data);
    let mut planes = three.or_else(|| first.map(|data| vec![data])).unwrap_or_default();
    let alpha = alpha.filter(|alpha| planes.iter().all(|plane| !std::ptr::eq(*plane, *alpha)));
    planes.extend(alpha);
    let texels = planes.first().map_or(0, |plane| plane.len());
    let data = (0..texels).flat_map(|at| planes.iter().map(move |plane| plane[at])).collect();
    Ok(Numbers { size, channels: planes.len() as u32, has_alpha: alpha.is_some(), bits: 32, data, colored: None })
}

type Planes = Vec<(String, Vec<f32>)>;

/// Every channel of the first layer, by the last word of its name.
fn exr_channels(bytes: &[u8], name: &str) -> Result<((u32, u32), Planes), CarrierError> {
    let broken = |e: exr::error::Error| {
        CarrierError::input(name, "", format!("is damaged or unusual EXR: {e}"), "export it again, without deep data")
    };
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(broken)?;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.x(), header.layer_size.y());
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        check_memory(Format::Exr, (side(width), side(height)), header.channels.list.len() as u32, bytes.len(), name)?;
    }
    let reader = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image: Image<Layer<AnyChannels<FlatSamples>>> = reader.from_buffered(Cursor::new(bytes)).map_err(broken)?;
    let layer = image.layer_data;
    let size = (layer.size.x() as u32, layer.size.y() as u32);
    let texels = layer.size.x() * layer.size.y();
    let plane = |channel: AnyChannel<FlatSamples>| {
        let word = channel.name.to_string().rsplit('.').next().unwrap_or_default().to_uppercase();
        (word, channel.sample_data.values_as_f32().collect::<Vec<f32>>())
    };
    let planes: Planes = layer.channel_data.list.into_iter().map(plane).collect();
    match planes.iter().find(|(_, plane)| plane.len() != texels) {
        None => Ok((size, planes)),
        Some((channel, _)) => {
            Err(CarrierError::input(name, channel.as_str(), "is a channel of fewer texels", "export it unsubsampled"))
        }
    }
}

/// An EXR of R, G, B and A as it was written.
///
/// # Errors
/// [`CarrierError::Input`] where it is none.
pub(crate) fn read_exr(bytes: &[u8], name: &str) -> Result<FloatRaster, CarrierError> {
    let ((width, height), channels) = exr_channels(bytes, name)?;
    let find = |wanted: &str| channels.iter().find(|(channel, _)| channel == wanted).map(|(_, data)| data);
    let planes: Option<Vec<&Vec<f32>>> = ["R", "G", "B", "A"].into_iter().map(find).collect();
    let planes = planes.ok_or_else(|| CarrierError::input(name, "", "has not R, G, B and A", "bake again"))?;
    let texels = width as usize * height as usize;
    let data = (0..texels).flat_map(|at| planes.iter().map(move |plane| plane[at])).collect();
    Ok(FloatRaster { width, height, channels: 4, data })
}
