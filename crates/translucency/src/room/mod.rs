//! The room: maps of a leaf in, a map of coefficients for each side out.

mod idle;
mod input;
mod normalize;
mod params;
mod sheet;
mod size;
mod texels;

pub use params::{
    AngularCurve, Bands, Exr, LeafKind, Mirror, NormalFrame, NormalY, Normalize, Params, Side, Sides, ThicknessFrom,
};

use crate::map::{LeafMap, Tables, coefficient_map, reference};
use foliar_bake::{BakeError, Baked, Baker, Facts, Idle, Inputs, Needs, Progress, Requirement, Rung, pixel_m};
use foliar_schema::{Finding, Scene, names};
use input::Sheet;
use serde_json::{Map, Value, json};

pub(crate) const ROOM: &str = names::ROOM_TRANSLUCENCY;

/// The bank against the direct gather: .3 % of the mean transmittance, which is .15 at most for green leaves, in steps of
/// 1 / 255.
const BANK_STEPS: f64 = 0.12;

/// The translucency room.
#[derive(Clone, Copy, Debug, Default)]
pub struct Translucency;

impl Baker for Translucency {
    fn room(&self) -> &'static str {
        ROOM
    }

    fn version(&self) -> u32 {
        5
    }

    fn about(&self) -> &'static str {
        "light through a leaf, as three coefficients per texel (Kusternig07 section 3.5)"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(Params).to_value()
    }

    fn needs(&self) -> Needs {
        Needs { maps: &[names::MAP_THICKNESS], ..Needs::default() }
    }

    fn require(&self, scene: &Scene, _: &Facts) -> Requirement {
        if scene.light.backlit {
            let pixel_mm = 1000.0 * pixel_m(&scene.camera);
            let because = format!(
                "backlit = true: leaves are seen against the sun; no texel finer than a pixel at {} m, {pixel_mm:.2} mm",
                scene.camera.nearest_m
            );
            let implied = json!({ "coarsest_mm": pixel_mm }).as_object().cloned();
            Requirement::Required { params: implied.unwrap_or_default(), because, bytes: 0 }
        } else {
            Requirement::NotRequired { because: "backlit = false: no leaf is seen against the sun".into() }
        }
    }

    fn ladder(&self) -> Vec<Rung> {
        let rung = |name, params: Value, promise_steps| Rung {
            name,
            params: params.as_object().cloned().unwrap_or_default(),
            promise_steps,
        };
        vec![
            rung("none", json!({"spread": "none", "texel_mm": 0.1}), BANK_STEPS),
            rung("bank-4", json!({"filters": 4, "texel_mm": 0.1}), 2.0 * BANK_STEPS),
            rung("bank", json!({"texel_mm": 0.1}), BANK_STEPS),
            rung("curve", json!({"texel_mm": 0.1, "curve": "fitted", "wavelength_nm": 550.0}), BANK_STEPS),
        ]
    }

    fn idle(&self, inputs: &Inputs, params: &Map<String, Value>) -> Vec<Idle> {
        Params::from_json(params).map(|params| idle::params(&params, inputs.maps)).unwrap_or_default()
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        walk(inputs, params, progress, |map, tables, _| coefficient_map(map, tables))
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        walk(inputs, params, &foliar_bake::Quiet, |map, _, recipe| {
            let exact = reference::coefficient_map(map, recipe);
            exact.iter().flat_map(|c| c.as_vec3().to_array()).collect()
        })
    }
}

/// Every side and band in turn; `solve` makes the coefficients of one.
fn walk(
    inputs: &Inputs,
    params: &Map<String, Value>,
    progress: &dyn Progress,
    solve: impl Fn(&LeafMap, &Tables, &crate::map::Recipe) -> Vec<f32>,
) -> Result<Baked, BakeError> {
    let params = Params::from_json(params)?;
    let mut sheet = Sheet::read(inputs.maps, &params)?;
    let mut baked = Baked { findings: std::mem::take(&mut sheet.findings), ..Baked::default() };
    let bands = sheet::recipes(&params, &sheet)?;
    let sides = params.sides.list();
    let size = [sheet.width, sheet.height];
    let by = texels::merged(sheet.texel_mm, size, params.coarsest_mm);
    let mut maps = Map::new();
    let (mut done, mut cost) = (0, 0.0f64);
    baked.findings.extend(idle::maps(&params, inputs.maps));
    baked.findings.extend(sheet.colorless());
    baked.findings.extend(sheet::fitted_tissue(&params, &bands));
    for (side, raster) in sides {
        let map = sheet.lit_side(*side);
        for band in &bands {
            progress.step(ROOM, done, (sides.len() * bands.len()) as u64);
            let recipe = band.seen_from(*side);
            let tables = Tables::new(&recipe, sheet.range_mm, sheet.median_mm);
            cost = sheet.cost_of_step(|d| recipe.entrance(d).transmittance).unwrap_or(0.0).max(cost);
            let mut coefficients = solve(&map, &tables, &recipe);
            let facts = normalize::finish(&map, &mut coefficients, &tables, &params);
            let name = format!("{raster}{}", band.suffix);
            maps.insert(name.clone(), band.facts(&tables, &recipe, facts.mean));
            let texels = normalize::with_mean(&map, &coefficients, &tables);
            size::within_range(&texels, facts.mean)?;
            baked.rasters.insert(name, texels::coarser(texels, size, by));
            done += 1;
        }
    }
    baked.findings.extend(sheet.warning_of_steps(cost));
    let resolved = serde_json::to_value(&params).unwrap_or_default();
    baked.resolved = resolved.as_object().cloned().unwrap_or_default();
    baked.facts = sheet.facts(&params, by, maps);
    Ok(baked)
}

/// A finding of this room about a map.
fn finding(code: &foliar_schema::CodeInfo, map: &str, message: String) -> Finding {
    Finding::new(code, message).at(format!("map {map}"))
}
