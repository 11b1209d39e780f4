//! Pictures by their headers: what the bytes are, what name and type claim, whether they can hold alpha.

use super::Survey;
use crate::images::{self, Format};
use image::{ImageDecoder, ImageReader};
use std::io::Cursor;

/// Most pixels that are decoded over all: enough to tell leaves from bark on the pictures of one tree,
/// little enough that checking stays a matter of headers.
const MOST_DECODED: u64 = 4 << 20;

/// What lies where a picture should.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// Nothing, and why.
    Missing(String),
    /// Bytes that are no whole picture, and why.
    Broken(String),
    /// A picture.
    Picture {
        /// What the bytes are.
        format: Format,
        /// Whether it can hold alpha; where it was decoded, whether a pixel has any.
        has_alpha: bool,
        /// Pixels.
        pixels: u64,
    },
}

/// A picture that a material names.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its name, as a person knows it.
    pub name: String,
    /// Where it is named: a JSON pointer or `line N`.
    pub place: String,
    /// The file that names it.
    pub file: String,
    /// What its names and types claim that it is: each claim with what it says.
    pub claims: Vec<(String, Format)>,
    /// Whether a core slot of glTF holds it, which takes PNG and JPEG alone.
    pub in_core: bool,
    /// What lies there.
    pub found: Found,
    /// The bytes again, for the few that are decoded.
    pub(super) bytes: Bytes,
}

/// Where a picture's bytes can be had again.
#[derive(Clone, Debug)]
pub(super) enum Bytes {
    /// In a file.
    File(std::path::PathBuf),
    /// In a buffer view.
    View(usize),
    /// Nowhere.
    None,
}

/// What a word for a picture's kind means: a MIME type or the ending of a name.
pub(super) fn claim(word: &str) -> Option<Format> {
    let word = word.rsplit(['/', '.']).next().unwrap_or(word).to_ascii_lowercase();
    Some(match word.as_str() {
        "png" => Format::Png,
        "jpg" | "jpeg" => Format::Jpeg,
        "tif" | "tiff" => Format::Tiff,
        "tga" => Format::Tga,
        "bmp" => Format::Bmp,
        "webp" => Format::Webp,
        "ktx" | "ktx2" => Format::Ktx,
        "exr" | "x-exr" => Format::Exr,
        "dds" | "vnd-ms.dds" => Format::Dds,
        "gif" => Format::Gif,
        _ => return None,
    })
}

/// The claim of a file's name.
pub(super) fn name_claim(name: &str) -> Option<(String, Format)> {
    let (_, ending) = name.rsplit_once('.')?;
    Some((format!("its name {name:?}"), claim(ending)?))
}

/// What bytes are, by their header and their end.
pub(super) fn look(bytes: &[u8]) -> Found {
    let format = images::sniff(bytes);
    let Some(decoder) = format.decoder() else {
        return match format {
            Format::Unknown => Found::Broken(format!("its {} bytes are no picture that is known", bytes.len())),
            _ => Found::Picture { format, has_alpha: true, pixels: u64::MAX },
        };
    };
    let cut = match format {
        Format::Jpeg => !images::jpeg_ends(bytes),
        Format::Png => memchr::memmem::rfind(bytes, b"IEND").is_none(),
        _ => false,
    };
    if cut {
        return Found::Broken(format!("it is {} cut short after {} bytes", format.name(), bytes.len()));
    }
    match ImageReader::with_format(Cursor::new(bytes), decoder).into_decoder() {
        Ok(decoder) => {
            let (width, height) = decoder.dimensions();
            let has_alpha = decoder.color_type().has_alpha();
            Found::Picture { format, has_alpha, pixels: u64::from(width) * u64::from(height) }
        }
        Err(error) => Found::Broken(format!("it is damaged {}: {error}", format.name())),
    }
}

impl Survey {
    /// Decodes base color pictures, smallest first, while they are few pixels in all.
    pub(super) fn decode_a_few(&mut self) {
        let mut order: Vec<usize> = self.base_pictures.iter().flatten().copied().collect();
        let pixels = |index: &usize| match self.pictures[*index].found {
            Found::Picture { format, pixels, .. } if format.decoder().is_some() => pixels,
            _ => u64::MAX,
        };
        order.sort_by_key(|index| (pixels(index), *index));
        order.dedup();
        let mut left = MOST_DECODED;
        let affordable = order.into_iter().take_while(|index| {
            let fits = pixels(index) <= left;
            left = left.saturating_sub(pixels(index));
            fits
        });
        for index in affordable.collect::<Vec<_>>() {
            self.decode(index);
        }
    }

    fn decode(&mut self, index: usize) {
        let picture = &mut self.pictures[index];
        let source = crate::accessor::Source { document: &self.document, file: "" };
        let decoded = match &picture.bytes {
            Bytes::File(path) => std::fs::read(path).ok().map(|bytes| images::decode(&bytes, &picture.name)),
            Bytes::View(view) => source.view(*view).ok().map(|bytes| images::decode(bytes, &picture.name)),
            Bytes::None => None,
        };
        match decoded {
            None => {}
            Some(Err(error)) => picture.found = Found::Broken(error.to_string()),
            Some(Ok(raster)) => {
                if let Found::Picture { has_alpha, .. } = &mut picture.found {
                    *has_alpha = raster.has_alpha;
                }
                let number = self.base.rasters.len() as u32;
                self.base.rasters.push(raster);
                let users = self.base_pictures.iter().zip(&mut self.base.materials);
                users
                    .filter(|(picture, _)| **picture == Some(index))
                    .for_each(|(_, material)| material.base_color_raster = Some(number));
            }
        }
    }
}
