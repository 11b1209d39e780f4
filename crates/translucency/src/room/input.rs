//! Maps as they came, made into a leaf: thickness in millimeters, unit normals of each side.

use super::params::{NormalFrame, NormalY, Params, Side, ThicknessFrom, refuse};
use super::{ROOM, finding};
use crate::map::{LEAST_THICKNESS_MM, LeafMap, normals_from_heights};
use crate::photo::{ColorEstimate, Look, thickness_from_photo};
use crate::presets::Preset;
use foliar_bake::{BakeError, MapRaster, Maps};
use foliar_numerics::{find_first, linear_of_srgb};
use foliar_schema::{Finding, code, names};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

/// A texel belongs to the leaf where its alpha reaches this.
const COVERED: f32 = 0.5;
/// Share of the light beyond which a step of a map is worth a warning.
const COARSE: f64 = 0.005;

/// A leaf as its maps tell it.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Texels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    thickness_mm: Vec<f32>,
    normals: [Vec<[f32; 3]>; 2],
    /// Edges of a texel, right and down, mm.
    pub texel_mm: [f64; 2],
    /// Least and greatest thickness.
    pub range_mm: (f64, f64),
    /// Median thickness.
    pub median_mm: f64,
    /// Bits of a map of whole numbers, and what one step of it is, mm.
    step: Option<(u32, f64)>,
    /// Mean color that the leaf shows by day, linear, where anything says so.
    albedo: Option<[f32; 3]>,
    /// What a person should know.
    pub findings: Vec<Finding>,
}

/// A map that cannot be used, and what would be right.
pub(super) fn bad(map: &str, problem: impl Into<String>, remedy: impl Into<String>) -> BakeError {
    BakeError::Map { room: ROOM.into(), map: map.into(), problem: problem.into(), remedy: remedy.into() }
}

impl Sheet {
    /// Reads the maps.
    ///
    /// # Errors
    /// [`BakeError`] for maps that are missing, of different size, not numbers, or hold no leaf.
    pub fn read(maps: &Maps, params: &Params) -> Result<Sheet, BakeError> {
        let name = names::MAP_THICKNESS;
        let Some(thickness) = maps.get(name) else { return Err(bad(name, "is missing", "give it")) };
        let (width, height) = (thickness.raster.width as usize, thickness.raster.height as usize);
        if width == 0 || height == 0 {
            return Err(bad(name, format!("has {width} x {height} texels"), "give a map of one texel or more"));
        }
        for (other, map) in maps {
            let size = if other == names::MAP_ALBEDO { (1, 1) } else { (width, height) };
            super::size::check(other, map, size)?;
        }
        let albedo = maps.get(names::MAP_ALBEDO).and_then(|map| map.raster.data.first_chunk().copied());
        let mut sheet = Sheet { width, height, albedo, texel_mm: params.texel_mm(width), ..Sheet::default() };
        sheet.read_thickness(maps, thickness, params)?;
        let heights = params.height_scale_mm;
        let lit = |side: usize| params.sides.list().iter().any(|(shown, _)| shown.lit() == side);
        for (side, normal, relief) in
            [(0, names::MAP_NORMAL_FRONT, names::MAP_HEIGHT_FRONT), (1, names::MAP_NORMAL_BACK, names::MAP_HEIGHT_BACK)]
        {
            // A side that no light falls on needs no normals.
            sheet.normals[side] = if !lit(side) {
                Vec::new()
            } else {
                match (maps.get(normal), maps.get(relief)) {
                    (Some(_), Some(_)) => {
                        return Err(bad(relief, format!("and {normal} say the same"), "give one of them"));
                    }
                    (Some(map), None) => sheet.normals(normal, map, params),
                    (None, Some(map)) => {
                        let scale = scale_of(relief, "height_scale_mm", map, heights)?;
                        sheet.warn_of_relief(relief, map, scale);
                        let values: Vec<f32> = channel(map).map(|h| h * scale as f32).collect();
                        normals_from_heights(&values, width, sheet.texel_mm)
                    }
                    (None, None) => Vec::new(),
                }
            };
        }
        Ok(sheet)
    }

    fn read_thickness(&mut self, maps: &Maps, map: &MapRaster, params: &Params) -> Result<(), BakeError> {
        let name = names::MAP_THICKNESS;
        match params.thickness_from {
            ThicknessFrom::Map => self.measured(maps, map, params)?,
            ThicknessFrom::Photo => self.estimated(maps, map, params)?,
        }
        let leaf = LeafMap { width: self.width, height: self.height, ..LeafMap::default() };
        let leaf = LeafMap { thickness_mm: std::mem::take(&mut self.thickness_mm), ..leaf };
        let (range, median) = (leaf.range_mm(), leaf.median_mm());
        self.thickness_mm = leaf.thickness_mm;
        let (Some(range), Some(median)) = (range, median) else {
            return Err(match maps.contains_key(names::MAP_ALPHA) {
                true => bad(names::MAP_ALPHA, "covers no texel: there is no leaf in it", "give the alpha of the leaf"),
                false => bad(name, "is 0 everywhere: there is no leaf in it", "give a map above 0, or an alpha map"),
            });
        };
        (self.range_mm, self.median_mm) = (range, median);
        self.findings.extend(super::size::judge(range.1, median, self.texel_mm, self.width)?);
        if params.thickness_from == ThicknessFrom::Map {
            let scale = scale_of(name, "thickness_scale_mm", map, params.thickness_scale_mm)?;
            self.step = (map.bits < 32).then(|| (map.bits, scale / steps(map.bits)));
            self.warn_of_walls();
        }
        Ok(())
    }

    /// Thickness as the map says it.
    fn measured(&mut self, maps: &Maps, map: &MapRaster, params: &Params) -> Result<(), BakeError> {
        let name = names::MAP_THICKNESS;
        let scale = scale_of(name, "thickness_scale_mm", map, params.thickness_scale_mm)?;
        let alpha: Option<Vec<f32>> = maps.get(names::MAP_ALPHA).map(|map| channel(map).collect());
        let covered = |at: usize, value: f32| alpha.as_ref().map_or(value > 0.0, |alpha| alpha[at] >= COVERED);
        let stored = |value: f32| params.thickness_offset_mm + scale * f64::from(value);
        let (width, channels) = (self.width, map.raster.channels.max(1) as usize);
        let row = |(y, (row, texels)): (usize, (&mut [f32], &[f32]))| {
            let mut counts = [0usize; 2];
            for (x, (thickness, texel)) in row.iter_mut().zip(texels.chunks_exact(channels)).enumerate() {
                let (value, is_leaf) = (stored(texel[0]), covered(y * width + x, texel[0]));
                *thickness = if is_leaf { value.max(LEAST_THICKNESS_MM) as f32 } else { 0.0 };
                counts[0] += usize::from(is_leaf && value < LEAST_THICKNESS_MM);
                counts[1] += usize::from(alpha.is_none() && texel[0] < 0.0);
            }
            counts
        };
        self.thickness_mm = vec![0.0; width * self.height];
        let rows = self.thickness_mm.par_chunks_mut(width).zip(map.raster.data.par_chunks(width * channels));
        let [thin, below] = rows.enumerate().map(row).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        if below > 0 {
            let message = format!("{below} texels hold a thickness below 0: taken for no leaf");
            self.findings.push(finding(&code::MAP_THIN, name, message));
        }
        if thin > 0 {
            let all = self.thickness_mm.iter().filter(|thickness| **thickness > 0.0).count();
            if thin == all {
                return Err(bad(name, "is 0 everywhere on the leaf that the alpha shows", "give the map of this leaf"));
            }
            let other = if 10 * thin > all { "; is this the map of another leaf than the alpha?" } else { "" };
            let message =
                format!("{thin} texels of the leaf are thinner than {LEAST_THICKNESS_MM} mm: taken for that{other}");
            self.findings.push(finding(&code::MAP_THIN, name, message));
        }
        Ok(())
    }

    /// Thickness estimated from a photograph; said to be that.
    fn estimated(&mut self, maps: &Maps, map: &MapRaster, params: &Params) -> Result<(), BakeError> {
        let name = names::MAP_THICKNESS;
        let channels = map.raster.channels as usize;
        if channels < 3 {
            return Err(bad(name, format!("has {channels} channels"), "a photograph has red, green and blue"));
        }
        let alpha = maps.get(names::MAP_ALPHA).map(|map| channel(map).collect::<Vec<f32>>());
        // Whole numbers of a photograph are bent as sRGB is; floats are linear.
        let linear = |v: f32| if map.bits == 32 { v } else { linear_of_srgb(v) };
        let texel = |(at, texel): (usize, &[f32])| {
            let own = if channels > 3 { texel[3] } else { 1.0 };
            let alpha = alpha.as_ref().map_or(own, |alpha| alpha[at]);
            [linear(texel[0]), linear(texel[1]), linear(texel[2]), alpha]
        };
        let rgba: Vec<[f32; 4]> = map.raster.data.par_chunks_exact(channels).enumerate().map(texel).collect();
        self.albedo = mean_color(&rgba);
        let usual = Preset::named(params.preset.name()).map_or(0.2, |preset| preset.thickness_mm);
        let look = Look { mean_mm: params.thickness_mean_mm.unwrap_or(usual), veins: params.veins };
        self.thickness_mm = thickness_from_photo(rgba.as_flattened(), self.width, &look);
        let message = format!(
            "thickness was estimated from a photograph, veins thick and rim thin, {} mm on the mean: nothing of it was \
             measured",
            look.mean_mm
        );
        self.findings.push(finding(&code::MAP_ESTIMATED, name, message));
        Ok(())
    }

    /// Where thickness rises so steeply that light leaves through the wall, which no kernel of a flat leaf knows.
    fn warn_of_walls(&mut self) {
        let at = |x: usize, y: usize| self.thickness_mm[y * self.width + x];
        let rises = |a: f32, b: f32, edge: f64| a > 0.0 && b > 0.0 && f64::from((a - b).abs()) > edge;
        let [right, down] = self.texel_mm;
        let wall = |x: usize, y: usize| {
            (x + 1 < self.width && rises(at(x, y), at(x + 1, y), right))
                || (y + 1 < self.height && rises(at(x, y), at(x, y + 1), down))
        };
        let rows = (0..self.height).into_par_iter();
        let walls: usize = rows.map(|y| (0..self.width).filter(|x| wall(*x, y)).count()).sum();
        if walls > 0 {
            let message = format!(
                "at {walls} texels thickness rises steeper than 1:1: light leaves through such a wall, which this room does not \
                 know; smooth the map there where that shows"
            );
            self.findings.push(finding(&code::MAP_STEEP, names::MAP_THICKNESS, message));
        }
    }

    /// What a step of the thickness map costs, as a share of the light at its median; `through` is the transmittance of a
    /// thickness, mm. `None` for floats.
    pub fn cost_of_step(&self, through: impl Fn(f64) -> f64) -> Option<f64> {
        const APART: f64 = 0.05;
        let (_, step) = self.step?;
        let at = |share: f64| libm::log(through(share * self.median_mm));
        Some((at(1.0 - APART) - at(1.0 + APART)) / (2.0 * APART * self.median_mm) * step)
    }

    /// The same in words, where it is worth saying.
    pub fn warning_of_steps(&self, cost: f64) -> Option<Finding> {
        let (bits, step) = self.step.filter(|_| cost > COARSE)?;
        let message = format!(
            "{bits} bits make steps of {step:.5} mm, {:.1} % of the light that passes at {:.3} mm: 16 bits or floats cost \
             nothing",
            100.0 * cost,
            self.median_mm
        );
        Some(finding(&code::MAP_BITS, names::MAP_THICKNESS, message))
    }

    /// What the steps of a height map cost.
    fn warn_of_relief(&mut self, name: &str, map: &MapRaster, scale: f64) {
        if map.bits < 32 {
            // A slope is a difference over two texels.
            let [right, down] = self.texel_mm;
            self.warn_of_slopes(name, map.bits, scale / steps(map.bits) / (2.0 * right.min(down)));
        }
    }

    /// What steps of a normal's slope cost: of light that falls in at 45 degrees, a slope adds its own share.
    fn warn_of_slopes(&mut self, name: &str, bits: u32, slope: f64) {
        if slope > COARSE {
            let message = format!(
                "{bits} bits turn normals in steps of {:.2} degrees, {:.1} % of the light that falls in at 45 degrees: 16 bits \
                 or floats cost nothing",
                libm::atan(slope).to_degrees(),
                100.0 * slope
            );
            self.findings.push(finding(&code::MAP_BITS, name, message));
        }
    }

    fn normals(&mut self, name: &str, map: &MapRaster, params: &Params) -> Vec<[f32; 3]> {
        let channels = map.raster.channels as usize;
        // Whole numbers store half of n + 1.
        let signed = map.bits == 32 && are_signed(&map.raster.data, channels);
        let decode = |v: f32| if signed { v } else { 2.0 * v - 1.0 };
        let turn = [
            if name == names::MAP_NORMAL_BACK && params.normal_frame == NormalFrame::RightHanded { -1.0 } else { 1.0 },
            if params.normal_y == NormalY::Down { -1.0 } else { 1.0 },
        ];
        // Black is no normal, however it is written.
        let is_black = |values: &[f32]| values[..3].iter().all(|v| *v == 0.0);
        let decoded = |values: &[f32]| [decode(values[0]) * turn[0], decode(values[1]) * turn[1], decode(values[2])];
        let length = |n: [f32; 3]| n.iter().map(|v| v * v).sum::<f32>().sqrt();
        if map.bits < 32 {
            self.warn_of_slopes(name, map.bits, 2.0 / steps(map.bits));
        }
        let row = |row: &mut [[f32; 3]], texels: &[f32], thickness: &[f32]| {
            let mut counts = [0usize; 2];
            for ((normal, values), d) in row.iter_mut().zip(texels.chunks_exact(channels)).zip(thickness) {
                let n = decoded(values);
                let length = length(n);
                let is = length > f32::EPSILON && !is_black(values);
                *normal = if is { n.map(|v| v / length) } else { [0.0, 0.0, 1.0] };
                counts[0] += usize::from(!is && *d > 0.0);
                counts[1] += usize::from(is && n[2] <= 0.0 && *d > 0.0);
            }
            counts
        };
        let mut normals = vec![[0.0; 3]; self.thickness_mm.len()];
        let rows = normals.par_chunks_mut(self.width).zip(map.raster.data.par_chunks(self.width * channels));
        let rows = rows.zip(self.thickness_mm.par_chunks(self.width)).map(|((to, from), d)| row(to, from, d));
        let counts = rows.reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let say = [
            "have no length: taken for straight ones",
            "point into the leaf, where no light falls in: is the map of this side?",
        ];
        for (count, what) in counts.into_iter().zip(say).filter(|(count, _)| *count > 0) {
            self.findings.push(finding(&code::MAP_NORMALS, name, format!("{count} normals of the leaf {what}")));
        }
        normals
    }

    /// The leaf as light meets it whose map is shown on `side`: the other side is lit. Its normals are handed over, which
    /// at 4096 x 4096 texels are 200 MB: once a side.
    pub fn lit_side(&mut self, side: Side) -> LeafMap {
        let (width, height) = (self.width, self.height);
        let normals = std::mem::take(&mut self.normals[side.lit()]);
        LeafMap { width, height, thickness_mm: self.thickness_mm.clone(), normals }
    }

    /// What a record says of the whole leaf.
    /// `merged` texels an edge are one of the maps that are stored.
    pub fn facts(&self, params: &Params, merged: usize, maps: Map<String, Value>) -> Map<String, Value> {
        let facts = json!({
            "texelMm": self.texel_mm[0] * merged as f64,
            "texelHeightMm": self.texel_mm[1] * merged as f64,
            "thicknessMm": { "least": self.range_mm.0, "median": self.median_mm, "greatest": self.range_mm.1 },
            "thicknessFrom": params.thickness_from,
            "normalize": params.normalize,
            "frame": "x image right, y image up, z out of the lit side, which is not the side that shows the map",
            "decode": "t = max(0, R b1.l + G b2.l + B b3.l) (a0 + a1 l.z), 0 where l.z <= 0; A is the mean over directions",
            "maps": maps,
        });
        let mut facts = facts.as_object().cloned().unwrap_or_default();
        if let Some(color) = self.color_estimate(params) {
            facts.insert(names::FACT_COLOR_ESTIMATE.into(), json!(color));
        }
        facts
    }

    /// What is said where the light's color is a guess for want of the leaf's own.
    pub fn colorless(&self) -> Option<Finding> {
        let text =
            "the material is white, which no leaf is: the color of the light follows from the kind of leaf alone";
        self.albedo.filter(|albedo| is_white(*albedo)).map(|_| Finding::new(&code::MAP_ESTIMATED, text))
    }

    /// Color of light that comes through over its greatest part, by what the leaf shows by day and the tissue of its kind.
    fn color_estimate(&self, params: &Params) -> Option<[f64; 3]> {
        let estimate = ColorEstimate::new(Preset::named(params.preset.name())?, self.median_mm)?;
        let through = match self.albedo? {
            white if is_white(white) => estimate.of_its_kind(),
            albedo => estimate.of(albedo).map(f64::from),
        };
        let greatest = through.into_iter().fold(0.0, f64::max);
        (greatest > 0.0).then(|| through.map(|part| part / greatest))
    }
}

/// Whether floats are normals themselves, not half of n + 1: where any is negative, or where they are nearer to unit length
/// as they stand (a flat leaf is 0, 0, 1). Texels of nothing but 0 say nothing.
fn are_signed(data: &[f32], channels: usize) -> bool {
    if find_first(data, |v| *v < 0.0).is_some() {
        return true;
    }
    let off = |n: [f32; 3]| f64::from((n.iter().map(|v| v * v).sum::<f32>().sqrt() - 1.0).abs());
    let texels = data.chunks_exact(channels).map(|t| [t[0], t[1], t[2]]).filter(|n| n.iter().any(|v| *v != 0.0));
    let sums = texels.fold([0.0; 2], |[own, half], n| [own + off(n), half + off(n.map(|v| 2.0 * v - 1.0))]);
    sums[0] <= sums[1]
}

/// No leaf is white: its material has no color of its own.
fn is_white(albedo: [f32; 3]) -> bool {
    albedo.iter().all(|v| *v > 0.9)
}

/// Mean color of the texels that belong to the leaf.
fn mean_color(rgba: &[[f32; 4]]) -> Option<[f32; 3]> {
    let leaf = || rgba.iter().filter(|texel| texel[3] >= COVERED);
    let count = leaf().count() as f64;
    let mean = |c: usize| (leaf().map(|texel| f64::from(texel[c])).sum::<f64>() / count) as f32;
    (count > 0.0).then(|| [mean(0), mean(1), mean(2)])
}

/// Steps between black and white.
fn steps(bits: u32) -> f64 {
    libm::pow(2.0, f64::from(bits)) - 1.0
}

/// First channel of a map.
fn channel(map: &MapRaster) -> impl Iterator<Item = f32> + '_ {
    map.raster.data.iter().step_by(map.raster.channels.max(1) as usize).copied()
}

/// Millimeters of 1 in a map.
fn scale_of(map: &str, place: &str, raster: &MapRaster, given: Option<f64>) -> Result<f64, BakeError> {
    match given {
        Some(scale) => Ok(scale),
        None if raster.bits == 32 => Ok(1.0),
        None => Err(refuse(
            place,
            format!("must be given: map {map} holds whole numbers, and nothing says how many mm white is"),
        )),
    }
}
