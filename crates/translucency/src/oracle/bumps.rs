//! Bumps of one dimension under five directions of light, against counted photons (relief.json).

use super::{golden::fast, medium, number, numbers};
use crate::light::Curve;
use crate::map::{LeafMap, Recipe};
use crate::runtime::transmitted;
use glam::DVec3;
use serde_json::Value;

/// Rows and periods of the map: enough that its rims do not tell in the middle.
const ROWS: usize = 96;
const PERIODS: usize = 3;

/// One relief as a map.
#[derive(Clone, Debug)]
pub struct Bumps {
    /// Three periods across.
    pub map: LeafMap,
    /// Edge of a texel, mm.
    pub texel_mm: f64,
    bins: usize,
}

impl Bumps {
    /// Reads the relief of a record; a texel is the mean of its two segments.
    pub fn of(record: &Value) -> Bumps {
        let knots = numbers(&record["h_knots_mm"]);
        let bins = (knots.len().saturating_sub(1) / 2).max(1);
        let texel_mm = number(record, "period_mm") / bins as f64;
        let h = |bin: usize| (knots[2 * bin] + 2.0 * knots[2 * bin + 1] + knots[2 * bin + 2]) / 4.0;
        let slope = |bin: usize| (knots[2 * bin + 2] - knots[2 * bin]) / texel_mm;
        let flat = record["lit"] == "flat face";
        let normal = |bin: usize| if flat { DVec3::Z } else { DVec3::new(-slope(bin), 0.0, 1.0).normalize() };
        let texels = || (0..PERIODS * bins * ROWS).map(|at| at % bins);
        let map = LeafMap {
            width: PERIODS * bins,
            height: ROWS,
            thickness_mm: texels().map(|bin| h(bin) as f32).collect(),
            normals: texels().map(|bin| normal(bin).as_vec3().to_array()).collect(),
        };
        Bumps { map, texel_mm, bins }
    }

    /// Coefficients of the middle period.
    fn middle(&self, recipe: &Recipe) -> Vec<DVec3> {
        let start = ROWS / 2 * self.map.width + self.bins;
        fast(&self.map, recipe)[start..start + self.bins].to_vec()
    }
}

/// Rms miss over all bins and directions of records of one relief, over the rms of what was counted. One map serves all
/// directions; `recipe` makes it of what the record's tissue and texel make by default.
pub fn bumps_error(records: &[&Value], recipe: impl Fn(Recipe) -> Recipe) -> f64 {
    let Some(first) = records.first() else { return f64::NAN };
    let bumps = Bumps::of(first);
    let recipe = recipe(Recipe::new(medium(first), [bumps.texel_mm; 2]));
    let median = bumps.map.median_mm().unwrap_or(f64::NAN);
    let curve = if recipe.curve { Curve::fit(&recipe.entrance(median), recipe.index()) } else { Curve::STRAIGHT };
    let found = bumps.middle(&recipe);
    let (mut squares, mut total) = (0.0, 0.0);
    for record in records {
        let light = DVec3::from_slice(&numbers(&record["light"]));
        for (c, seen) in found.iter().zip(numbers(&record["M_over_E"])) {
            squares += (transmitted(*c, light, curve) - seen).powi(2);
            total += seen * seen;
        }
    }
    (squares / total).sqrt()
}
