//! Alpha coverage of triangles: the share of a leaf's surface that its texture does not cut away.

use foliar_plant::{AlphaMode, Base, Material, Part, Raster};
use glam::DVec2;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Fewest and most scan lines per triangle.
const LINES: (f64, f64) = (16.0, 1024.0);
/// Scan lines per row of texels, as far as the most allows.
const LINES_PER_ROW: f64 = 2.0;
/// Texture coordinates beyond this have no texel to speak of in f32: the mean of the picture answers.
const FARTHEST: f64 = 1e5;

/// Alpha of one material as sums along its rows.
struct AlphaTable {
    width: usize,
    height: usize,
    /// Per row, `width + 1` sums of alpha from the left; one texel counts at most `full`.
    sums: Vec<u32>,
    full: f64,
}

impl AlphaTable {
    fn new(raster: &Raster, material: &Material) -> Option<Self> {
        let (width, height) = (raster.width as usize, raster.height as usize);
        if width == 0 || height == 0 || raster.rgba.len() != width * height * 4 {
            return None;
        }
        // The largest whole number up to 65535 of which a row cannot overflow.
        let full = (u32::MAX / raster.width).min(65535);
        let factor = material.base_color[3];
        let count = |texel: &[u8]| {
            let alpha = f32::from(texel[3]) / 255.0 * factor;
            match material.alpha_mode {
                AlphaMode::Opaque => full,
                AlphaMode::Mask(cutoff) => {
                    if alpha >= cutoff {
                        full
                    } else {
                        0
                    }
                }
                AlphaMode::Blend => (alpha.clamp(0.0, 1.0) * full as f32) as u32,
            }
        };
        let mut sums = Vec::with_capacity((width + 1) * height);
        for row in raster.rgba.chunks_exact(4 * width) {
            let mut sum = 0;
            sums.push(sum);
            for texel in row.chunks_exact(4) {
                sum += count(texel);
                sums.push(sum);
            }
        }
        Some(AlphaTable { width, height, sums, full: f64::from(full) })
    }

    fn row(&self, y: f64) -> &[u32] {
        let row = (y.floor().rem_euclid(self.height as f64) as usize).min(self.height - 1);
        &self.sums[row * (self.width + 1)..][..self.width + 1]
    }

    /// Integral of alpha along a row from 0 to `x` texels, repeated without end.
    fn integral(&self, row: &[u32], x: f64) -> f64 {
        let width = self.width as f64;
        let tiles = (x / width).floor();
        let inside = (x - tiles * width).clamp(0.0, width);
        let texel = (inside as usize).min(self.width - 1);
        let part = inside - texel as f64;
        let (before, after) = (f64::from(row[texel]), f64::from(row[texel + 1]));
        tiles * f64::from(row[self.width]) + before + part * (after - before)
    }

    fn mean(&self) -> f64 {
        let rows = self.sums.chunks_exact(self.width + 1);
        let sum: f64 = rows.map(|row| f64::from(row[self.width])).sum();
        sum / (self.full * self.width as f64 * self.height as f64)
    }

    fn at(&self, point: DVec2) -> f64 {
        let row = self.row(point.y);
        let texel = (point.x.floor().rem_euclid(self.width as f64) as usize).min(self.width - 1);
        f64::from(row[texel + 1] - row[texel]) / self.full
    }

    /// Mean alpha over a triangle of texture coordinates. Texels are squares of one alpha each. Along a
    /// row the integral is exact; across rows it is the midpoint rule with two lines per row (at least
    /// 16, at most 1024 lines), weighted by their lengths: the error is at most the share of the
    /// triangle's area within half a line's distance of an edge of the cut-out that is not upright.
    fn mean_over(&self, uvs: [DVec2; 3]) -> f64 {
        if uvs.iter().any(|uv| !uv.is_finite() || uv.abs().max_element() > FARTHEST) {
            return self.mean();
        }
        let size = DVec2::new(self.width as f64, self.height as f64);
        let mut corners = uvs.map(|uv| uv * size);
        corners.sort_by(|a, b| a.y.total_cmp(&b.y));
        let [low, middle, high] = corners;
        let rows = high.y - low.y;
        let lines = (rows * LINES_PER_ROW).ceil().clamp(LINES.0, LINES.1);
        let (mut alpha, mut length) = (0.0, 0.0);
        for line in 0..lines as usize {
            let y = low.y + rows * (line as f64 + 0.5) / lines;
            let (from, to) = if y < middle.y { (low, middle) } else { (middle, high) };
            let (x, end) = (cross(low, high, y), cross(from, to, y));
            let row = self.row(y);
            length += (end - x).abs();
            alpha += (self.integral(row, end) - self.integral(row, x)).abs();
        }
        // Without extent there is nothing to average: the texel at the middle answers.
        if length > 0.0 { (alpha / (length * self.full)).min(1.0) } else { self.at((low + middle + high) / 3.0) }
    }
}

/// Where the line from `a` to `b` has height `y`.
fn cross(a: DVec2, b: DVec2, y: f64) -> f64 {
    let rise = b.y - a.y;
    if rise > 0.0 { a.x + (b.x - a.x) * ((y - a.y) / rise).clamp(0.0, 1.0) } else { a.x }
}

/// Coverage tables of a base, each made when first asked for.
pub(crate) struct CoverageTables<'a> {
    base: &'a Base,
    tables: BTreeMap<u32, Option<Rc<AlphaTable>>>,
}

impl<'a> CoverageTables<'a> {
    pub fn new(base: &'a Base) -> Self {
        CoverageTables { base, tables: BTreeMap::new() }
    }

    /// Coverage of each triangle of a part, 0 to 1.
    pub fn of_part(&mut self, part: &Part) -> Vec<f64> {
        let count = part.triangles.len();
        let Some((index, material)) = part.material.and_then(|m| Some((m, self.base.materials.get(m as usize)?)))
        else {
            return vec![1.0; count];
        };
        if material.alpha_mode == AlphaMode::Opaque {
            return vec![1.0; count];
        }
        let raster = material.base_color_raster.and_then(|r| self.base.rasters.get(r as usize));
        let make = || raster.and_then(|r| AlphaTable::new(r, material)).map(Rc::new);
        match self.tables.entry(index).or_insert_with(make) {
            Some(table) if !part.uvs.is_empty() => over_triangles(table, part),
            _ => vec![plain_alpha(material); count],
        }
    }
}

fn plain_alpha(material: &Material) -> f64 {
    let alpha = material.base_color[3];
    match material.alpha_mode {
        AlphaMode::Opaque => 1.0,
        AlphaMode::Mask(cutoff) => f64::from(u8::from(alpha >= cutoff)),
        AlphaMode::Blend => f64::from(alpha.clamp(0.0, 1.0)),
    }
}

/// Thousands of cards show the same cut of the texture: each cut is integrated once.
fn over_triangles(table: &AlphaTable, part: &Part) -> Vec<f64> {
    #[expect(clippy::disallowed_types, reason = "looked up, never iterated")]
    let mut known: std::collections::HashMap<[u32; 6], f64> = std::collections::HashMap::new();
    part.triangles
        .iter()
        .map(|triangle| {
            let uvs = triangle.map(|v| part.uvs[v as usize]);
            let key = [0, 1, 2, 3, 4, 5].map(|i: usize| uvs[i / 2][i % 2].to_bits());
            *known.entry(key).or_insert_with(|| table.mean_over(uvs.map(|uv| uv.as_dvec2())))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn material(alpha_mode: AlphaMode) -> Material {
        Material { base_color: [1.0; 4], base_color_raster: Some(0), alpha_mode, ..Material::default() }
    }

    fn raster(size: u32, alpha: impl Fn(u32, u32) -> u8) -> Raster {
        let rgba = (0..size * size).flat_map(|i| [0, 0, 0, alpha(i % size, i / size)]).collect();
        Raster { width: size, height: size, rgba, has_alpha: true, ..Raster::default() }
    }

    /// Coverage of the quad from `low` to `high` in texture coordinates.
    fn quad(raster: Raster, mode: AlphaMode, low: Vec2, high: Vec2) -> f64 {
        let uvs = vec![low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
        let part = Part { material: Some(0), uvs, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Part::default() };
        let base = Base { materials: vec![material(mode)], rasters: vec![raster], ..Base::default() };
        CoverageTables::new(&base).of_part(&part).iter().sum::<f64>() / 2.0
    }

    #[test]
    fn a_checker_covers_half_of_itself_and_of_its_repeats() {
        let checker = || raster(8, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        for high in [Vec2::ONE, Vec2::splat(3.0), Vec2::new(-2.0, 1.0)] {
            let found = quad(checker(), AlphaMode::Mask(0.5), Vec2::ZERO, high);
            // Lines lie a quarter of a row off its edges; a triangle's slant crosses whole squares.
            assert!((found - 0.5).abs() < 0.01, "{found} at {high}");
        }
    }

    #[test]
    fn a_disc_covers_pi_quarters_of_its_square() {
        let disc = raster(256, |x, y| {
            let (dx, dy) = (f64::from(x) + 0.5 - 128.0, f64::from(y) + 0.5 - 128.0);
            if dx * dx + dy * dy < 128.0 * 128.0 { 255 } else { 0 }
        });
        let found = quad(disc, AlphaMode::Mask(0.5), Vec2::ZERO, Vec2::ONE);
        // Texels at the rim: about one part in a thousand of the disc, and they even out.
        assert!((found - std::f64::consts::FRAC_PI_4).abs() < 1e-3, "{found}");
    }

    #[test]
    fn blending_counts_alpha_and_masking_counts_all_or_nothing() {
        let grey = || raster(4, |_, _| 102);
        let blended = quad(grey(), AlphaMode::Blend, Vec2::ZERO, Vec2::ONE);
        // One step of 65535.
        assert!((blended - 0.4).abs() < 2e-5, "{blended}");
        let masked = |cutoff| quad(grey(), AlphaMode::Mask(cutoff), Vec2::ZERO, Vec2::ONE);
        assert!((masked(0.4) - 1.0).abs() < 1e-12 && masked(0.41).abs() < 1e-12);
        assert!((quad(grey(), AlphaMode::Opaque, Vec2::ZERO, Vec2::ONE) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_half_of_the_picture_is_taken_from_where_the_coordinates_say() {
        let left = || raster(16, |x, _| if x < 8 { 255 } else { 0 });
        let top = || raster(16, |_, y| if y < 8 { 255 } else { 0 });
        let found = |raster, low, high| quad(raster, AlphaMode::Mask(0.5), low, high);
        assert!((found(left(), Vec2::ZERO, Vec2::new(0.5, 1.0)) - 1.0).abs() < 1e-12);
        assert!((found(top(), Vec2::ZERO, Vec2::new(1.0, 0.5)) - 1.0).abs() < 1e-12);
        assert!(found(top(), Vec2::new(0.0, 0.5), Vec2::ONE).abs() < 1e-12);
    }

    #[test]
    fn coordinates_without_extent_or_sense_have_an_answer() {
        let left = || raster(16, |x, _| if x < 8 { 255 } else { 0 });
        let at = |low, high| quad(left(), AlphaMode::Mask(0.5), low, high);
        assert!((at(Vec2::splat(0.25), Vec2::splat(0.25)) - 1.0).abs() < 1e-12);
        assert!(at(Vec2::splat(-0.25), Vec2::splat(-0.25)).abs() < 1e-12);
        for wild in [f32::NAN, f32::INFINITY, 1e30] {
            assert!((at(Vec2::ZERO, Vec2::splat(wild)) - 0.5).abs() < 1e-12);
        }
    }
}
