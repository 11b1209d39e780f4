//! Contact sheets: pictures side by side with captions.

use crate::render::render_like;
use crate::text::{self, LARGE, SMALL};
use crate::{Shading, Standing, ViewError, ViewParams, difference, render_among, values};
use foliar_bake::Layer;
use foliar_numerics::CompensatedSum;
use foliar_plant::Plant;
use foliar_schema::names;
use image::{Rgba, RgbaImage};

/// Pixels between pictures and around them.
const GAP: u32 = 12;
/// A path is a noisy sample: so many more of them than of the model's.
const PATHS_PER_SAMPLE: u32 = 8;
/// Behind the pictures.
const PAPER: Rgba<u8> = Rgba([28, 28, 30, 255]);

/// Width of the pictures of a sheet of everything, pixels: a legend fits below.
const LEAST_SMALL: u32 = 320;

/// One picture of a sheet.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Line under the picture.
    pub caption: String,
    /// The picture.
    pub picture: RgbaImage,
}

impl Panel {
    /// A picture and the line under it.
    pub fn new(caption: impl Into<String>, picture: RgbaImage) -> Self {
        Panel { caption: caption.into(), picture }
    }
}

/// Panels in rows of `columns` (at least one) under title lines. Columns are as wide as the widest picture, a row
/// as high as its highest; lower ones stand at its top, so that pictures with and without a legend align;
/// captions that do not fit are cut.
pub fn contact_sheet(panels: &[Panel], titles: &[String], columns: usize) -> RgbaImage {
    let columns = columns.clamp(1, panels.len().max(1));
    let cell_width = panels.iter().map(|p| p.picture.width()).max().unwrap_or(0);
    let heights = panels.chunks(columns).map(|row| row.iter().map(|p| p.picture.height()).max().unwrap_or(0));
    let heights: Vec<u32> = heights.collect();
    let caption = text::height(SMALL) + 4;
    let head = GAP + titles.len() as u32 * (text::height(LARGE) + 4);
    let width = (GAP + columns as u32 * (cell_width + GAP)).max(4 * GAP);
    let height = head + heights.iter().map(|h| h + caption + GAP).sum::<u32>() + GAP;
    let mut sheet = RgbaImage::from_pixel(width, height, PAPER);
    for (line, title) in titles.iter().enumerate() {
        let y = GAP + line as u32 * (text::height(LARGE) + 4);
        let words = text::fitted(LARGE, title, width - 2 * GAP);
        text::write(&mut sheet, LARGE, i64::from(GAP), i64::from(y), &words, if line == 0 { 255 } else { 190 });
    }
    let mut y = head;
    for (row, height) in panels.chunks(columns).zip(heights) {
        for (x, panel) in (GAP..).step_by((cell_width + GAP) as usize).zip(row) {
            let aside = (cell_width - panel.picture.width()) / 2;
            image::imageops::overlay(&mut sheet, &panel.picture, i64::from(x + aside), i64::from(y));
            let words = text::fitted(SMALL, &panel.caption, cell_width);
            text::write(&mut sheet, SMALL, i64::from(x), i64::from(y + height + 4), &words, 220);
        }
        y += height + caption + GAP;
    }
    sheet
}

/// Plain, baked, their difference and the ambient coefficient of one tree, with figures. `params.look`
/// and `params.channel` do not count; without a baked ambient coefficient its panel is left out.
///
/// # Errors
/// As [`crate::render()`].
pub fn bake_sheet(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    title: &str,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let plain = render_among(plant, layers, around, &Shading::Plain, params)?;
    let baked = render_among(plant, layers, around, &Shading::Baked, params)?;
    let changed = difference(&plain, &baked)?;
    let caption = changed.to_string();
    let mut panels = vec![
        Panel::new("plain: normals of the file, the same ambient light everywhere", plain),
        Panel::new("baked: realigned normals, ambient coefficient", baked),
        Panel::new(caption, changed.picture),
    ];
    if let Some(caption) = ambient_figures(plant, layers)? {
        let shown = render_among(plant, layers, around, &Shading::Channel(names::AMBIENT.into()), params)?;
        panels.push(Panel::new(caption, shown));
    }
    Ok(contact_sheet(&panels, &[title.into(), facts(plant)], 2))
}

fn facts(plant: &Plant) -> String {
    let triangles: usize = plant.parts().iter().map(|p| p.triangles.len()).sum();
    let size = plant.size();
    format!(
        "{} leaves, {triangles} triangles, {} x {} x {} m",
        plant.leaves().len(),
        text::number(size.x as f32),
        text::number(size.y as f32),
        text::number(size.z as f32)
    )
}

/// Everything that the file holds: the lit plant, then roles, channels and columns in false colors, each with its
/// legend; pictures are a third as large as `params` says.
///
/// # Errors
/// As [`crate::render()`].
pub fn channel_sheet(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    title: &str,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let small = ViewParams {
        width_px: (params.width_px / 3).max(LEAST_SMALL),
        height_px: (params.height_px / 3).max(LEAST_SMALL * 3 / 4),
        ..params.clone()
    };
    let mut panels = vec![Panel::new("baked", render_among(plant, layers, around, &Shading::Baked, &small)?)];
    for name in values::shown_names(plant, layers, false) {
        let shown = render_among(plant, layers, around, &Shading::Channel(name.clone()), &small)?;
        panels.push(Panel::new(name, shown));
    }
    Ok(contact_sheet(&panels, &[title.into(), facts(plant)], 4))
}

/// One tree in the light of two suns: by the model, by paths, and what differs. `params.look` does not count; the second
/// sun stands opposite to the first.
///
/// # Errors
/// As [`crate::render()`].
pub fn light_sheet(
    plant: &Plant,
    layers: &[&Layer],
    around: &[Standing],
    title: &str,
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let mut panels = Vec::new();
    for (turn, sun) in [(0.0, "the sun as given"), (180.0, "the sun opposite to that")] {
        // Azimuths of more than a turn are refused.
        let azimuth = params.sun_azimuth_deg + turn;
        let lit =
            ViewParams { sun_azimuth_deg: if azimuth > 360.0 { azimuth - 360.0 } else { azimuth }, ..params.clone() };
        let paths = ViewParams { samples: (params.samples * PATHS_PER_SAMPLE).min(1024), ..lit.clone() };
        let model = render_among(plant, layers, around, &Shading::Light, &lit)?;
        let traced = render_among(plant, layers, around, &Shading::Traced, &paths)?;
        let changed = difference(&traced, &model)?;
        let caption = format!("model less paths: {changed}");
        panels.push(Panel::new(format!("model, {sun}"), model));
        panels.push(Panel::new(format!("{} paths per pixel", paths.samples), traced));
        panels.push(Panel::new(caption, changed.picture));
    }
    Ok(contact_sheet(&panels, &[title.into()], 3))
}

/// Two plants side by side and what differs, under their names. In false colors one legend holds for both: the same color
/// is the same value.
///
/// # Errors
/// As [`crate::render()`].
pub fn comparison(
    plants: [(&Plant, &[&Layer], &str); 2],
    around: &[Standing],
    params: &ViewParams,
) -> Result<RgbaImage, ViewError> {
    let shading = params.shading();
    let like = match &shading {
        Shading::Channel(name) => {
            let [a, b] = plants.map(|(plant, layers, _)| values::false_colors(plant, layers, name, None));
            Some(a?.legend.kind.with(b?.legend.kind))
        }
        _ => None,
    };
    let draw = |(plant, layers, _): (&Plant, &[&Layer], &str)| {
        render_like(plant, layers, around, &shading, like.as_ref(), params)
    };
    let [before, after] = plants.map(draw);
    let (before, after) = (before?, after?);
    // Legends are the same for both: they are no part of what differs.
    let drawn = |picture: &RgbaImage| {
        let (width, height) = picture.dimensions();
        image::imageops::crop_imm(picture, 0, 0, width, height.min(params.height_px)).to_image()
    };
    let changed = difference(&drawn(&before), &drawn(&after))?;
    let caption = changed.to_string();
    let [a, b] = plants.map(|(_, _, name)| name);
    let panels = [Panel::new(a, before), Panel::new(b, after), Panel::new(caption, changed.picture)];
    Ok(contact_sheet(&panels, &[format!("{a} | {b} | difference")], 3))
}

/// Least, mean and greatest ambient coefficient over all vertices that have one.
fn ambient_figures(plant: &Plant, layers: &[&Layer]) -> Result<Option<String>, ViewError> {
    let arrays = values::ambient(plant, layers)?;
    let all: Vec<f64> = arrays.into_iter().flatten().flatten().map(|&v| f64::from(v)).collect();
    if all.is_empty() {
        return Ok(None);
    }
    let mean = all.iter().copied().collect::<CompensatedSum>().value() / all.len() as f64;
    let low = all.iter().copied().fold(f64::INFINITY, f64::min);
    let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Ok(Some(format!("ambient coefficient: {low:.3} to {high:.3}, mean {mean:.3}")))
}
