//! Sizes that no leaf has: refused where nothing can be made of them, else said.

use super::input::bad;
use super::{ROOM, finding};
use foliar_bake::{BakeError, MapRaster};
use foliar_numerics::find_first;
use foliar_schema::{Finding, code, names};

/// Texels that a leaf may be thick: beyond, its light spreads over more texels than a map has.
const MOST_TEXELS: f64 = 1e4;
/// Median thickness of leaves, mm: from the thinnest moss to a succulent.
const THICKNESS_MM: std::ops::Range<f64> = 0.01..20.0;
/// Widths of maps of leaves, mm: from a needle to an atlas of palms.
const WIDTH_MM: std::ops::Range<f64> = 0.5..5000.0;

/// What is said of the size of a leaf and of its map.
///
/// # Errors
/// [`BakeError`] where the leaf is thicker than its light could be followed.
pub(super) fn judge(
    greatest_mm: f64,
    median_mm: f64,
    texel_mm: [f64; 2],
    width: usize,
) -> Result<Vec<Finding>, BakeError> {
    let name = names::MAP_THICKNESS;
    let texels = greatest_mm / texel_mm[0].min(texel_mm[1]);
    if texels.is_nan() || texels >= MOST_TEXELS {
        let problem = format!("is {greatest_mm:.3e} mm thick at most, {texels:.1e} texels");
        return Err(bad(name, problem, "give its scale and its width in millimeters"));
    }
    let mut findings = Vec::new();
    if !THICKNESS_MM.contains(&median_mm) {
        let message = format!(
            "half of the leaf is thicker than {median_mm:.3e} mm, and no leaf is so: is the map in millimeters?"
        );
        findings.push(finding(&code::MAP_UNIT, name, message));
    }
    let wide = texel_mm[0] * width as f64;
    if !WIDTH_MM.contains(&wide) {
        let message =
            format!("the map is {wide:.3e} mm wide on the leaf: are leaf_width_mm and texel_mm in millimeters?");
        findings.push(finding(&code::MAP_UNIT, name, message));
    }
    Ok(findings)
}

/// Refuses numbers that no map may hold: over a mean that is nearly nothing a thin rim is many times too bright.
///
/// # Errors
/// [`BakeError::Map`].
pub(super) fn within_range(texels: &[f32], mean: f64) -> Result<(), BakeError> {
    let most = foliar_schema::raster(names::RASTER_TRANSLUCENCY_FRONT).map_or(f32::MAX, |raster| raster.max);
    let greatest = texels.iter().fold(0.0f32, |most, v| most.max(v.abs()));
    if greatest <= most {
        return Ok(());
    }
    let problem =
        format!("lets {mean:.1e} of the light through on the mean, and {greatest:.0} times that where it is thin");
    let reason = "normalize = mean would write more than a map may hold: say none or diffuse, or look at thickness and absorption";
    Err(BakeError::Map { room: ROOM.into(), map: names::MAP_THICKNESS.into(), problem, remedy: reason.into() })
}

/// Size, wholeness, numbers.
pub(super) fn check(name: &str, map: &MapRaster, (width, height): (usize, usize)) -> Result<(), BakeError> {
    let raster = &map.raster;
    if (raster.width as usize, raster.height as usize) != (width, height) {
        let problem =
            format!("is {} x {} and {} is {width} x {height}", raster.width, raster.height, names::MAP_THICKNESS);
        return Err(bad(name, problem, "give maps of one size"));
    }
    let colors = matches!(name, names::MAP_NORMAL_FRONT | names::MAP_NORMAL_BACK | names::MAP_ALBEDO);
    if !raster.is_whole() || raster.channels == 0 || (colors && raster.channels < 3) {
        let problem = format!("has {} channels and {} numbers", raster.channels, raster.data.len());
        return Err(bad(name, problem, "a normal map has three channels, any other at least one"));
    }
    match find_first(&raster.data, |v| !v.is_finite()) {
        None => Ok(()),
        Some(at) => {
            let texel = at / raster.channels as usize;
            let problem = format!("is {} at column {}, row {}", raster.data[at], texel % width, texel / width);
            Err(bad(name, problem, "every texel must be a finite number: write it again"))
        }
    }
}
