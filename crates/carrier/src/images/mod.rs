//! Pictures: what format bytes really are, decoding to RGBA, encoding to PNG, and the maps that OBJ
//! materials need (joined alpha, normals from heights).

mod data;
mod maps;

pub(crate) use data::read_exr;
pub use data::{DataMap, read_map};
pub(crate) use maps::{alpha_joined, is_normal_map, normals_from_heights};

use crate::CarrierError;
use foliar_plant::Raster;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// Widest and highest picture that is decoded.
const MOST_PIXELS_PER_SIDE: u32 = 32_768;

/// Most memory that decoding a picture may take.
const MOST_BYTES: u64 = 2 << 30;

/// Deflate makes at most 1032 bytes of one, and a byte of a picture holds at most 8 pixels: a file
/// that claims more pixels per byte than this is damaged or hostile.
const MOST_PIXELS_PER_BYTE: u64 = 1032 * 8;

/// The same where nothing is deflated: runs of TGA and BMP make 128 pixels of a byte and more; a JPEG of one color
/// comes to 170, and what holds anything stays far below. A flipped bit in its header would take gigabytes.
const MOST_PIXELS_PER_BYTE_OF_RUNS: u64 = 128;

/// Pixels that any header may claim, however short the file: what is drawn in one color is small.
const PIXELS_ALWAYS_ALLOWED: u64 = 8 << 20;

/// What a file's bytes are, whatever its name says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics: a core glTF image.
    Png,
    /// JPEG: a core glTF image.
    Jpeg,
    /// Tagged Image File Format.
    Tiff,
    /// Truevision TGA (it has no magic bytes: told by its header).
    Tga,
    /// Windows bitmap.
    Bmp,
    /// WebP: known, not decoded.
    Webp,
    /// Khronos texture, Basis Universal inside: known, not decoded.
    Ktx,
    /// OpenEXR: known, no texture.
    Exr,
    /// DirectDraw surface: known, not decoded.
    Dds,
    /// GIF: known, not decoded.
    Gif,
    /// None of these.
    Unknown,
}

impl Format {
    /// Name for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Format::Png => "PNG",
            Format::Jpeg => "JPEG",
            Format::Tiff => "TIFF",
            Format::Tga => "TGA",
            Format::Bmp => "BMP",
            Format::Webp => "WebP",
            Format::Ktx => "KTX",
            Format::Exr => "EXR",
            Format::Dds => "DDS",
            Format::Gif => "GIF",
            Format::Unknown => "no known picture",
        }
    }

    /// MIME type, where it is a core glTF image.
    pub const fn gltf_mime(self) -> Option<&'static str> {
        match self {
            Format::Png => Some("image/png"),
            Format::Jpeg => Some("image/jpeg"),
            _ => None,
        }
    }

    pub(crate) const fn decoder(self) -> Option<ImageFormat> {
        match self {
            Format::Png => Some(ImageFormat::Png),
            Format::Jpeg => Some(ImageFormat::Jpeg),
            Format::Tiff => Some(ImageFormat::Tiff),
            Format::Tga => Some(ImageFormat::Tga),
            Format::Bmp => Some(ImageFormat::Bmp),
            _ => None,
        }
    }
}

/// Tells the format by the first bytes.
pub fn sniff(bytes: &[u8]) -> Format {
    const MAGIC: &[(&[u8], Format)] = &[
        (b"\x89PNG\r\n\x1a\n", Format::Png),
        (b"\xFF\xD8\xFF", Format::Jpeg),
        (b"II*\0", Format::Tiff),
        (b"MM\0*", Format::Tiff),
        (b"\xABKTX ", Format::Ktx),
        (b"\x76\x2F\x31\x01", Format::Exr),
        (b"DDS ", Format::Dds),
        (b"GIF8", Format::Gif),
        (b"BM", Format::Bmp),
    ];
    if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        return Format::Webp;
    }
    let known = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, format)| *format);
    known.unwrap_or(if is_tga(bytes) { Format::Tga } else { Format::Unknown })
}

/// Whether the 18 bytes of a TGA header make sense together.
fn is_tga(bytes: &[u8]) -> bool {
    let Some(header) = bytes.get(..18) else { return false };
    let word = |at: usize| u16::from_le_bytes([header[at], header[at + 1]]);
    let (color_map, kind, depth, descriptor) = (header[1], header[2], header[16], header[17]);
    let mapped = matches!(kind, 1 | 9);
    let kind_fits = mapped || matches!(kind, 2 | 3 | 10 | 11);
    kind_fits
        && (color_map == 1 || (color_map == 0 && !mapped))
        && matches!(depth, 8 | 15 | 16 | 24 | 32)
        && word(12) > 0
        && word(14) > 0
        && descriptor & 0xC0 == 0
}

/// Decodes PNG, JPEG, TIFF, TGA or BMP bytes to RGBA, 8 bits each; `name` stands in messages and in
/// the raster. The format is told by the bytes, not by the name.
///
/// # Errors
/// [`CarrierError::Input`] for what is none of these, or truncated, or larger than its bytes can hold.
pub fn decode(bytes: &[u8], name: &str) -> Result<Raster, CarrierError> {
    let format = sniff(bytes);
    let Some(decoder) = format.decoder() else {
        let problem = format!("is {}, not PNG, JPEG, TIFF, TGA or BMP", format.name());
        return Err(CarrierError::input(name, "byte 0", problem, "convert it to PNG"));
    };
    if format == Format::Jpeg && !jpeg_ends(bytes) {
        let problem = format!("is JPEG cut short after {} bytes", bytes.len());
        return Err(CarrierError::input(name, "", problem, "copy or export the picture again"));
    }
    let picture = open(bytes, decoder, name)?.decode().map_err(|e| broken(format, name, e))?;
    let (width, height) = (picture.width(), picture.height());
    let rgba = picture.into_rgba8().into_raw();
    let has_alpha = rgba.chunks_exact(4).any(|p| p[3] < 255);
    Ok(Raster { name: name.into(), width, height, rgba, has_alpha })
}

fn broken(format: Format, name: &str, error: image::ImageError) -> CarrierError {
    CarrierError::input(name, "", format!("is damaged {}: {error}", format.name()), "export the picture again")
}

type Reader<'a> = ImageReader<Cursor<&'a [u8]>>;

/// A reader that takes no more memory than the bytes can fill.
fn open<'a>(bytes: &'a [u8], decoder: ImageFormat, name: &str) -> Result<Reader<'a>, CarrierError> {
    let sized = ImageReader::with_format(Cursor::new(bytes), decoder).into_dimensions();
    let (width, height) = sized.map_err(|e| broken(sniff(bytes), name, e))?;
    check_size(sniff(bytes), width, height, bytes.len(), name)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), decoder);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MOST_PIXELS_PER_SIDE), Some(MOST_PIXELS_PER_SIDE));
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    Ok(reader)
}

/// Whether the end marker follows the last scan: the decoder fills up what is missing with gray.
pub(crate) fn jpeg_ends(bytes: &[u8]) -> bool {
    let last_scan = memchr::memmem::rfind(bytes, b"\xFF\xDA").unwrap_or(0);
    memchr::memmem::find(&bytes[last_scan..], b"\xFF\xD9").is_some()
}

fn check_size(format: Format, width: u32, height: u32, bytes: usize, name: &str) -> Result<(), CarrierError> {
    let pixels = u64::from(width) * u64::from(height);
    let per_byte = match format {
        Format::Png | Format::Tiff => MOST_PIXELS_PER_BYTE,
        _ => MOST_PIXELS_PER_BYTE_OF_RUNS,
    };
    let possible = PIXELS_ALWAYS_ALLOWED + bytes as u64 * per_byte;
    let too_large = width.max(height) > MOST_PIXELS_PER_SIDE || pixels * 4 > MOST_BYTES;
    if pixels > 0 && pixels <= possible && !too_large {
        return Ok(());
    }
    let problem = format!("its header claims {width} x {height} pixels in {bytes} bytes");
    let remedy = format!("at most {MOST_PIXELS_PER_SIDE} a side and what the bytes can hold; scale it down");
    Err(CarrierError::input(name, "", problem, remedy))
}

/// PNG bytes of a raster: RGBA where it has alpha, else RGB. The same raster gives the same bytes.
///
/// # Errors
/// [`CarrierError::Input`] where the raster's length is not width times height times 4.
pub fn encode_png(raster: &Raster) -> Result<Vec<u8>, CarrierError> {
    let (pixels, color) = if raster.has_alpha {
        (raster.rgba.clone(), ExtendedColorType::Rgba8)
    } else {
        (raster.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect(), ExtendedColorType::Rgb8)
    };
    let mut png = Vec::new();
    PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive)
        .write_image(&pixels, raster.width, raster.height, color)
        .map_err(|error| CarrierError::input(&raster.name, "", error.to_string(), "report it"))?;
    Ok(png)
}
