//! A leaf by itself: lit from behind from several sides (Kusternig07 figure 5), its coefficients, and what differs from
//! another bake of it.

use crate::key::{Key, Legend};
use crate::sheet::{Panel, contact_sheet};
use crate::{ViewError, colors, difference, legend};
use foliar_bake::{FloatRaster, Layer};
use foliar_schema::names;
use foliar_translucency::light::Curve;
use foliar_translucency::runtime::transmitted;
use glam::{DVec3, Vec3};
use image::RgbaImage;

/// Widest picture of a leaf on a sheet, pixels.
const WIDEST: usize = 420;
/// Narrower ones are magnified to this or more: a legend fits below.
const LEAST: u32 = 320;
/// Light through a typical leaf of .2 mm at 610, 550 and 450 nm over that at 550 nm (PROSPECT-D): tints a map of one band.
const TINT: Vec3 = Vec3::new(0.42, 1.0, 0.009);
/// Share of the leaf that may be brighter than what is drawn as full light.
const BRIGHTEST: f64 = 0.98;
/// Pictures in a row of a sheet: two rows are a side.
const COLUMNS: usize = 5;
/// Behind the leaf: a dark room.
const ROOM: f32 = 0.012;

/// Lights of a sheet: name, degrees from straight behind, and where in the picture the light stands (degrees from its right,
/// counter-clockwise).
const LIGHTS: [(&str, f64, f64); 6] = [
    ("straight behind", 0.0, 0.0),
    ("45 deg right", 45.0, 0.0),
    ("45 deg left", 45.0, 180.0),
    ("45 deg up", 45.0, 90.0),
    ("75 deg right", 75.0, 0.0),
    ("75 deg left", 75.0, 180.0),
];

/// Maps of one side: red, green, blue, or one for all.
struct Side<'a> {
    bands: Vec<(&'a FloatRaster, Curve)>,
}

impl<'a> Side<'a> {
    /// The maps of each side that there is, of one leaf of a layer; "" is a layer that holds one leaf by itself.
    fn all(layer: &'a Layer, leaf: &str) -> Result<Vec<(&'static str, Side<'a>)>, ViewError> {
        let facts = match leaf {
            "" => layer.record.facts.get("maps"),
            _ => layer.record.facts.get(names::FACT_SHEETS).and_then(|sheets| sheets.get(leaf)?.get("maps")),
        };
        let curve = |name: &str| {
            let at = |i: usize| facts.and_then(|maps| maps.get(name)?.get("curve")?.get(i)?.as_f64());
            at(0).zip(at(1)).map_or(Curve::STRAIGHT, |(offset, slope)| Curve { offset, slope })
        };
        let within = if leaf.is_empty() { String::new() } else { format!("{leaf}/") };
        let found = |name: String| {
            let raster = layer.rasters.get(&format!("{within}{name}")).filter(|raster| raster.channels == 4);
            raster.map(|raster| (raster, curve(&name)))
        };
        let side = |(shown, raster): (&'static str, &str)| {
            let bands = [names::BAND_RED, "", names::BAND_BLUE].map(|band| found(format!("{raster}{band}")));
            match bands {
                [Some(red), Some(green), Some(blue)] => Some((shown, Side { bands: vec![red, green, blue] })),
                [_, Some(one), _] => Some((shown, Side { bands: vec![one] })),
                _ => None,
            }
        };
        let both = [("front", names::RASTER_TRANSLUCENCY_FRONT), ("back", names::RASTER_TRANSLUCENCY_BACK)];
        let sides: Vec<_> = both.into_iter().filter_map(side).collect();
        if sides.is_empty() { Err(ViewError::NoLeaf(layer.record.room.clone())) } else { Ok(sides) }
    }

    /// The first of them.
    fn first(layer: &'a Layer, leaf: &str) -> Result<Side<'a>, ViewError> {
        Side::all(layer, leaf).map(|mut sides| sides.swap_remove(0).1)
    }

    /// Texels that make one pixel, each way.
    fn step(&self) -> usize {
        let raster = self.bands[0].0;
        (raster.width.max(raster.height) as usize).div_ceil(WIDEST).max(1)
    }

    /// Mean of `value` over the texels of each pixel, with the share of them that is leaf.
    fn pixels(&self, band: usize, value: impl Fn(&[f32]) -> f64) -> (usize, Vec<(f64, f32)>) {
        let (raster, step) = (self.bands[band].0, self.step());
        let (width, height) = (raster.width as usize, raster.height as usize);
        let (columns, rows) = (width.div_ceil(step), height.div_ceil(step));
        let pixel = |at: usize| {
            let (left, top) = (at % columns * step, at / columns * step);
            let (mut sum, mut leaf, mut all) = (0.0, 0, 0);
            for y in top..(top + step).min(height) {
                for x in left..(left + step).min(width) {
                    let texel = &raster.data[4 * (y * width + x)..4 * (y * width + x) + 4];
                    all += 1;
                    // Coefficients go on beyond the rim; the mean says where the leaf is.
                    if texel[3] > 0.0 {
                        leaf += 1;
                        sum += value(texel);
                    }
                }
            }
            (sum / f64::from(leaf.max(1)), leaf as f32 / all.max(1) as f32)
        };
        (columns, (0..columns * rows).map(pixel).collect())
    }

    /// The leaf under one light, over `exposure`.
    fn lit(&self, light: DVec3, exposure: f64) -> RgbaImage {
        let band = |at: usize| {
            let curve = self.bands[at].1;
            self.pixels(at, |c| {
                transmitted(DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2])), light, curve)
            })
        };
        let all: Vec<(usize, Vec<(f64, f32)>)> = (0..self.bands.len()).map(band).collect();
        let color = |at: usize| {
            let value = |band: usize| (all[band].1[at].0 / exposure) as f32;
            let lit = if all.len() == 3 { Vec3::new(value(0), value(1), value(2)) } else { TINT * value(0) };
            let cover = all[0].1[at].1;
            colors::to_bytes(colors::tone(lit) * cover + Vec3::splat(ROOM) * (1.0 - cover), 1.0)
        };
        picture(all[0].0, (0..all[0].1.len()).flat_map(color).collect())
    }

    /// What is drawn as full light: nearly the brightest of the leaf with the light straight behind.
    fn exposure(&self) -> f64 {
        let green = self.bands.len() / 2;
        let (raster, curve) = self.bands[green];
        let mut all: Vec<f64> = raster
            .data
            .chunks_exact(4)
            .filter(|c| c[3] > 0.0)
            .map(|c| transmitted(DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2])), DVec3::Z, curve))
            .collect();
        all.sort_unstable_by(f64::total_cmp);
        let at = (all.len() as f64 * BRIGHTEST) as usize;
        all.get(at).or(all.last()).copied().unwrap_or(1.0).max(1e-9)
    }

    /// A number of each texel in false colors.
    fn channel(&self, name: &str, doc: &str, value: impl Fn(&[f32]) -> f64, signed: bool) -> RgbaImage {
        let (columns, pixels) = self.pixels(self.bands.len() / 2, value);
        let most = pixels.iter().map(|p| p.0.abs()).fold(1e-9, f64::max);
        let color = |(value, cover): &(f64, f32)| {
            let share = (value / most) as f32;
            let color = if signed { colors::diverging(share) } else { colors::ramp(share) };
            colors::to_bytes(color * *cover + Vec3::splat(ROOM) * (1.0 - cover), 1.0)
        };
        let kind = if signed { Key::Diverging(most as f32) } else { Key::Ramp(0.0, most as f32) };
        let words = Legend { name: name.into(), doc: doc.into(), unit: "1".into(), kind };
        legend::below(picture(columns, pixels.iter().flat_map(color).collect()), &words)
    }
}

/// Small maps are magnified by a whole number: every texel stays a sharp square, and words fit below.
fn picture(columns: usize, bytes: Vec<u8>) -> RgbaImage {
    let (width, height) = (columns as u32, (bytes.len() / 4 / columns.max(1)) as u32);
    let small = RgbaImage::from_raw(width, height, bytes).unwrap_or_default();
    let times = LEAST.div_ceil(width.max(height).max(1));
    image::imageops::resize(&small, width * times, height * times, image::imageops::FilterType::Nearest)
}

/// Toward a light behind the leaf, in the frame of its map.
fn toward(from_behind_deg: f64, around_deg: f64) -> DVec3 {
    let (tilt, around) = (from_behind_deg.to_radians(), around_deg.to_radians());
    DVec3::new(libm::sin(tilt) * libm::cos(around), libm::sin(tilt) * libm::sin(around), libm::cos(tilt))
}

/// Leaves that a layer holds maps of, by name; "" where it holds one by itself.
pub fn leaf_names(layer: &Layer) -> Vec<String> {
    let set = |name: &String| name.rsplit_once('/').map_or_else(String::new, |(set, _)| set.to_owned());
    let mut names: Vec<String> = layer.rasters.keys().map(set).collect();
    names.dedup();
    names
}

/// Each side of a leaf lit from behind at several angles, its three coefficients and its answer to even light.
///
/// # Errors
/// [`ViewError::NoLeaf`] for a layer without maps of light through this leaf.
pub fn leaf_sheet(layer: &Layer, leaf: &str, title: &str) -> Result<RgbaImage, ViewError> {
    let sides = Side::all(layer, leaf)?;
    // One exposure for both: which side passes more is to be seen.
    let exposure = sides[0].1.exposure();
    let mut panels = Vec::new();
    for (shown, side) in &sides {
        for (name, tilt, around) in LIGHTS {
            panels.push(Panel::new(format!("{shown}, light {name}"), side.lit(toward(tilt, around), exposure)));
        }
        for (i, along) in ["right", "up and left", "down and left"].into_iter().enumerate() {
            let name = format!("coefficient {}", i + 1);
            let picture = side.channel(&name, &format!("light from behind, {along}"), |c| f64::from(c[i]), true);
            panels.push(Panel::new(format!("{shown}, {name}"), picture));
        }
        let doc = "share of the light that falls in from everywhere behind";
        let picture = side.channel("mean transmission", doc, |c| f64::from(c[3]), false);
        panels.push(Panel::new(format!("{shown}, mean transmission"), picture));
    }
    let (raster, _) = sides[0].1.bands[0];
    let facts = format!(
        "{} x {} texels, {} of light; full light is {exposure:.3} of what falls in",
        raster.width,
        raster.height,
        if sides[0].1.bands.len() == 3 { "three bands" } else { "one band" }
    );
    Ok(contact_sheet(&panels, &[title.into(), facts], COLUMNS))
}

/// Two bakes of one leaf, each with the leaf's name in its layer and its own: straight and slanting light, and what differs.
///
/// # Errors
/// As [`leaf_sheet`]; [`ViewError::Sizes`] for maps of different size.
pub fn leaf_comparison(leaves: [(&Layer, &str, &str); 2]) -> Result<RgbaImage, ViewError> {
    let [(a, a_leaf, a_name), (b, b_leaf, b_name)] = leaves;
    let [before, after] = [Side::first(a, a_leaf)?, Side::first(b, b_leaf)?];
    let exposure = before.exposure();
    let mut panels = Vec::new();
    for (name, tilt, around) in [LIGHTS[0], LIGHTS[1]] {
        let light = toward(tilt, around);
        let [one, two] = [&before, &after].map(|side| side.lit(light, exposure));
        let changed = difference(&one, &two)?;
        let caption = changed.to_string();
        panels.push(Panel::new(format!("{a_name}: light {name}"), one));
        panels.push(Panel::new(format!("{b_name}: light {name}"), two));
        panels.push(Panel::new(caption, changed.picture));
    }
    Ok(contact_sheet(&panels, &[format!("{a_name} | {b_name} | difference")], 3))
}
