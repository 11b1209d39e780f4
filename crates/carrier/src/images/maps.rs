//! Maps of OBJ materials: alpha from a picture of its own, normals from heights.

use foliar_plant::Raster;
use glam::DVec3;

/// How far the mean color of a normal map may be from (.5, .5, 1): its mean normal tilts less than
/// this, while no gray height map comes nearer than .4 (gray has r = g = b).
const NORMAL_MAP_MEAN_DISTANCE: f64 = 0.25;

/// Slope that a step of full height over one texel makes, where the material says no `-bm`. A stated
/// choice: heights of OBJ materials have no unit.
const SLOPE_PER_TEXEL: f64 = 2.0;

/// Whether a picture under a bump keyword is a tangent-space normal map: mean color near (.5, .5, 1).
pub(crate) fn is_normal_map(raster: &Raster) -> bool {
    let mut sums = [0u64; 3];
    for pixel in raster.rgba.chunks_exact(4) {
        sums.iter_mut().zip(pixel).for_each(|(sum, &value)| *sum += u64::from(value));
    }
    let pixels = (raster.rgba.len() / 4).max(1) as f64;
    let mean = DVec3::from(sums.map(|sum| sum as f64 / pixels / 255.0));
    mean.distance(DVec3::new(0.5, 0.5, 1.0)) < NORMAL_MAP_MEAN_DISTANCE
}

/// Tangent-space normals (x right, y up, as glTF has them) of a height map that repeats at its
/// edges: central differences of its luminance times `strength`.
pub(crate) fn normals_from_heights(heights: &Raster, strength: f64) -> Raster {
    let (width, height) = (heights.width as usize, heights.height as usize);
    let level: Vec<f64> = heights.rgba.chunks_exact(4).map(|p| luminance(p) / 255.0).collect();
    let at = |x: usize, y: usize| level[(y % height) * width + x % width];
    let slope = strength * SLOPE_PER_TEXEL / 2.0;
    let mut rgba = Vec::with_capacity(level.len() * 4);
    for y in 0..height {
        for x in 0..width {
            let right = at(x + 1, y) - at(x + width - 1, y);
            // Rows run downward, tangent space y runs upward.
            let up = at(x, y + height - 1) - at(x, y + 1);
            let normal = DVec3::new(-right * slope, -up * slope, 1.0).normalize();
            rgba.extend(normal.to_array().map(|n| ((n * 0.5 + 0.5) * 255.0 + 0.5) as u8));
            rgba.push(255);
        }
    }
    Raster { name: heights.name.clone(), width: heights.width, height: heights.height, rgba, has_alpha: false }
}

/// Color with the alpha that a mask says: the mask's own alpha where it has one, else its luminance
/// (`map_d`'s default channel), sampled between texels at the color's size. Without a color: white,
/// at the mask's size.
pub(crate) fn alpha_joined(color: Option<&Raster>, mask: &Raster) -> Raster {
    let own = |p: &[u8]| if mask.has_alpha { f64::from(p[3]) } else { luminance(p) };
    let levels: Vec<f64> = mask.rgba.chunks_exact(4).map(own).collect();
    let mut joined =
        color.cloned().unwrap_or_else(|| Raster { rgba: vec![255; mask.rgba.len()], has_alpha: false, ..mask.clone() });
    let (width, height) = (joined.width as usize, joined.height as usize);
    for (index, pixel) in joined.rgba.chunks_exact_mut(4).enumerate() {
        let u = ((index % width) as f64 + 0.5) / width as f64;
        let v = ((index / width) as f64 + 0.5) / height as f64;
        pixel[3] = (between(&levels, mask.width, mask.height, u, v) + 0.5) as u8;
    }
    joined.has_alpha = joined.rgba.chunks_exact(4).any(|p| p[3] < 255);
    joined
}

/// Rec. 709 weights, 0 to 255.
fn luminance(pixel: &[u8]) -> f64 {
    0.2126 * f64::from(pixel[0]) + 0.7152 * f64::from(pixel[1]) + 0.0722 * f64::from(pixel[2])
}

/// Bilinear sample at (u, v) in 0 to 1, clamped at the edges.
fn between(levels: &[f64], width: u32, height: u32, u: f64, v: f64) -> f64 {
    let axis = |t: f64, size: u32| {
        let place = (t * f64::from(size) - 0.5).clamp(0.0, f64::from(size - 1));
        let low = place as usize;
        (low, (low + 1).min(size as usize - 1), place - low as f64)
    };
    let ((x0, x1, fx), (y0, y1, fy)) = (axis(u, width), axis(v, height));
    let row = |y: usize| {
        let [a, b] = [x0, x1].map(|x| levels[y * width as usize + x]);
        a + (b - a) * fx
    };
    row(y0) + (row(y1) - row(y0)) * fy
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Raster {
        let rgba: Vec<u8> = (0..width * height).flat_map(|i| pixel(i % width, i / width)).collect();
        let has_alpha = rgba.chunks_exact(4).any(|p| p[3] < 255);
        Raster { name: "made".into(), width, height, rgba, has_alpha }
    }

    #[test]
    fn heights_and_normals_are_told_apart() {
        assert!(is_normal_map(&picture(4, 4, |_, _| [128, 128, 255, 255])));
        assert!(is_normal_map(&picture(4, 4, |x, _| [[90, 166][x as usize % 2], 120, 230, 255])));
        for gray in [0, 64, 128, 191, 255] {
            assert!(!is_normal_map(&picture(4, 4, |_, _| [gray, gray, gray, 255])), "{gray}");
        }
    }

    #[test]
    fn a_flat_height_map_gives_the_straight_normal() {
        let normals = normals_from_heights(&picture(3, 2, |_, _| [77, 77, 77, 255]), 1.0);
        assert!(normals.rgba.chunks_exact(4).all(|p| p == [128, 128, 255, 255]));
    }

    #[test]
    fn a_slope_tilts_the_normal_against_it() {
        // Higher to the right: the normal leans left (r below 128). Higher at the top: it leans down.
        let right = normals_from_heights(&picture(8, 8, |x, _| [x as u8 * 10, x as u8 * 10, x as u8 * 10, 255]), 1.0);
        let up = normals_from_heights(&picture(8, 8, |_, y| [(70 - y * 10) as u8; 4]), 1.0);
        let middle = (3 * 8 + 3) * 4;
        assert!(right.rgba[middle] < 128 && right.rgba[middle + 1] == 128, "{:?}", &right.rgba[middle..middle + 3]);
        assert!(up.rgba[middle + 1] < 128 && up.rgba[middle] == 128, "{:?}", &up.rgba[middle..middle + 3]);
    }

    #[test]
    fn a_mask_of_another_size_is_joined() {
        let color = picture(4, 4, |x, y| [x as u8, y as u8, 9, 255]);
        let mask =
            picture(2, 2, |x, _| [255 * x as u8; 3].into_iter().chain([255]).collect::<Vec<_>>().try_into().unwrap());
        let joined = alpha_joined(Some(&color), &mask);
        assert_eq!((joined.width, joined.height, joined.has_alpha), (4, 4, true));
        assert_eq!(&joined.rgba[..4], &[0, 0, 9, 0]);
        assert_eq!(joined.rgba[15], 255);
        assert!(alpha_joined(None, &mask).rgba[..3] == [255, 255, 255]);
    }

    #[test]
    fn a_mask_with_alpha_uses_it() {
        let mask = picture(1, 1, |_, _| [255, 255, 255, 7]);
        assert_eq!(alpha_joined(None, &mask).rgba, [255, 255, 255, 7]);
    }
}
