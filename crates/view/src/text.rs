//! Words and boxes in pictures: the bitmap fonts of embedded-graphics.

use embedded_graphics::mono_font::{MonoFont, MonoTextStyle, ascii};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::{Dimensions, DrawTarget, Drawable, OriginDimensions, Pixel, Point, Size};
use embedded_graphics::text::{Baseline, Text};
use image::{Rgba, RgbaImage};

/// Captions and legends.
pub(crate) const SMALL: &MonoFont = &ascii::FONT_9X15;
/// Titles.
pub(crate) const LARGE: &MonoFont = &ascii::FONT_10X20;

/// A picture that words can be drawn on.
struct Canvas<'a>(&'a mut RgbaImage);

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb888;
    type Error = std::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        let area = self.bounding_box();
        for Pixel(at, color) in pixels {
            if area.contains(at) {
                self.0.put_pixel(at.x as u32, at.y as u32, Rgba([color.r(), color.g(), color.b(), 255]));
            }
        }
        Ok(())
    }
}

/// Writes one line with its upper left corner at `x`, `y`; letters beyond ASCII become `?`.
pub(crate) fn write(picture: &mut RgbaImage, font: &MonoFont, x: i64, y: i64, words: &str, gray: u8) {
    let style = MonoTextStyle::new(font, Rgb888::new(gray, gray, gray));
    // Cut to numbers that a picture's coordinates hold.
    let at = Point::new(x.clamp(-1 << 20, 1 << 20) as i32, y.clamp(-1 << 20, 1 << 20) as i32);
    let Ok(_) = Text::with_baseline(words, at, style, Baseline::Top).draw(&mut Canvas(picture));
}

/// Width of a line in pixels.
pub(crate) fn width(font: &MonoFont, words: &str) -> u32 {
    words.chars().count() as u32 * (font.character_size.width + font.character_spacing)
}

/// Height of a line in pixels.
pub(crate) fn height(font: &MonoFont) -> u32 {
    font.character_size.height
}

/// `words` cut to `pixels`, with two dots where something is missing.
pub(crate) fn fitted(font: &MonoFont, words: &str, pixels: u32) -> String {
    if width(font, words) <= pixels {
        return words.into();
    }
    let letters = (pixels / (font.character_size.width + font.character_spacing)) as usize;
    words.chars().take(letters.saturating_sub(2)).chain("..".chars()).take(letters).collect()
}

/// `words` in lines of at most `pixels`, broken between words; a word that is too long is cut.
pub(crate) fn wrapped(font: &MonoFont, words: &str, pixels: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(font, line) + width(font, " ") + width(font, word) <= pixels => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(fitted(font, word, pixels)),
        }
    }
    lines
}

/// A number with at most four digits that matter.
pub(crate) fn number(value: f32) -> String {
    let size = value.abs();
    if size >= 1e5 || (size > 0.0 && size < 1e-3) {
        return format!("{value:.2e}");
    }
    let text = format!(
        "{value:.*}",
        if size >= 100.0 {
            0
        } else if size >= 1.0 {
            2
        } else {
            4
        }
    );
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (0.25, "0.25"),
            (1234.4, "1234"),
            (2e-5, "2.00e-5"),
            (-12.5, "-12.5"),
            (100.0, "100"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn words_are_cut_to_the_width() {
        assert_eq!(fitted(SMALL, "sapling", 9 * 7), "sapling");
        assert_eq!(fitted(SMALL, "sapling", 9 * 5), "sap..");
        assert_eq!(fitted(SMALL, "sapling", 5), "");
        assert_eq!(wrapped(SMALL, "share of the sky", 9 * 9), ["share of", "the sky"]);
    }

    #[test]
    fn writing_outside_the_picture_draws_nothing_and_does_not_fail() {
        let mut picture = RgbaImage::from_pixel(20, 20, Rgba([1, 2, 3, 255]));
        let before = picture.clone();
        write(&mut picture, SMALL, -500, 7, "left", 0);
        write(&mut picture, SMALL, 5, i64::MAX, "below", 0);
        assert_eq!(picture, before);
        write(&mut picture, SMALL, 5, 5, "A", 0);
        assert_ne!(picture, before);
    }
}
