//! The baker of scans: a closed leaf mesh, or heights of its two sides, in; maps out. It reads no tree.

use super::{Frame, Scan, Solid, between_heights, in_texture, project};
use crate::map::LeafMap;
use foliar_bake::{
    BakeError, Baked, Baker, Facts, FloatRaster, Idle, Inputs, Maps, Needs, Progress, Requirement, Rung,
};
use foliar_numerics::find_first;
use foliar_plant::Plant;
use foliar_schema::{CodeInfo, Finding, Scene, code, names};
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

const ROOM: &str = names::ROOM_LEAFSCAN;
const MM_PER_M: f64 = 1000.0;
/// A ray finds the surface to f32 of the mesh's size: some thousandths of a step of a thousandth of a millimeter.
const EXACT_STEPS: f64 = 0.1;
/// Mean slope of a leaf's middle beyond which its thickness along one axis says 2 % too much.
const BENT: f64 = 0.2;

/// Where maps of a mesh lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Unwrap {
    /// On the plane that the leaf keeps nearest to.
    #[default]
    Plane,
    /// In the mesh's own texture coordinates.
    Uv,
}

/// Which side of a leaf is its front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Face {
    /// The one that looks up; of a leaf that stands, the one that looks along +Z.
    #[default]
    Up,
    /// The other.
    Down,
}

/// Parameters of a scan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ScanParams {
    /// Heights of the front, outward, in place of a mesh: PNG of 16 bits, TIFF or EXR.
    #[schemars(extend("x-map" = names::MAP_HEIGHT_FRONT))]
    pub height_front: Vec<String>,
    /// Heights of the back, outward, texel by texel behind those of the front.
    #[schemars(extend("x-map" = names::MAP_HEIGHT_BACK))]
    pub height_back: Vec<String>,
    /// Texels along the longer side of the maps.
    #[schemars(range(min = 8, max = 8192))]
    pub resolution: u32,
    /// Where the maps lie.
    pub unwrap: Unwrap,
    /// Which side is the front, where maps lie on a plane.
    pub face: Face,
    /// Over how many millimeters the leaf's own plane is averaged, in texture coordinates: veins stand out of it, the leaf's
    /// bend is part of it.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub smooth_mm: f64,
    /// Edge of a texel of two height maps, mm; a mesh says that itself.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub texel_mm: Option<f64>,
    /// Relief of a height map from black to white, mm; nothing said: 1 for maps of floats. Whole numbers need it.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub height_scale_mm: Option<f64>,
    /// Height where a height map is 0 (black), mm: what a scan says beside its own pictures.
    pub height_offset_mm: f64,
    /// Thickness of the leaf where both height maps are 0, mm.
    #[schemars(range(min = 0.0))]
    pub gap_mm: f64,
}

impl Default for ScanParams {
    fn default() -> Self {
        ScanParams {
            height_front: Vec::new(),
            height_back: Vec::new(),
            resolution: 1024,
            unwrap: Unwrap::default(),
            face: Face::default(),
            smooth_mm: 2.0,
            texel_mm: None,
            height_scale_mm: None,
            height_offset_mm: 0.0,
            gap_mm: 0.0,
        }
    }
}

/// The baker of scans.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leafscan;

impl Baker for Leafscan {
    fn room(&self) -> &'static str {
        ROOM
    }

    fn version(&self) -> u32 {
        1
    }

    fn about(&self) -> &'static str {
        "thickness, relief and normals of a leaf from a closed mesh of it, or from heights of its two sides"
    }

    fn schema(&self) -> Value {
        schemars::schema_for!(ScanParams).to_value()
    }

    fn needs(&self) -> Needs {
        Needs { scan: true, ..Needs::default() }
    }

    fn require(&self, _: &Scene, _: &Facts) -> Requirement {
        Requirement::NotRequired { because: "once for a leaf, no part of a tree: foliar-leafscan".into() }
    }

    fn ladder(&self) -> Vec<Rung> {
        let rung = |name, params: Value| Rung {
            name,
            params: params.as_object().cloned().unwrap_or_default(),
            promise_steps: EXACT_STEPS,
        };
        vec![rung("plane", json!({"resolution": 64})), rung("uv", json!({"resolution": 64, "unwrap": "uv"}))]
    }

    fn idle(&self, inputs: &Inputs, params: &Map<String, Value>) -> Vec<Idle> {
        let of_heights = &["texel_mm", "height_scale_mm", "height_offset_mm", "gap_mm"];
        let of_a_mesh = &["resolution", "unwrap", "face", "smooth_mm"];
        if inputs.plant.is_none() {
            return Idle::where_holds(true, of_a_mesh, "it is for a mesh, and height maps are given");
        }
        let in_texture = params.get("unwrap").is_some_and(|unwrap| unwrap == "uv");
        let mut idle = Idle::where_holds(true, of_heights, "it is for height maps, and a mesh is given");
        idle.extend(Idle::where_holds(in_texture, &["face"], "unwrap = uv has the front where the texture has it"));
        idle.extend(Idle::where_holds(!in_texture, &["smooth_mm"], "it is for unwrap = uv"));
        idle
    }

    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        progress.step(ROOM, 0, 1);
        let baked = walk(inputs, params, false)?;
        progress.step(ROOM, 1, 1);
        Ok(baked)
    }

    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        walk(inputs, params, true)
    }
}

/// `direct`: every ray asks every triangle, in f64.
fn walk(inputs: &Inputs, params: &Map<String, Value>, direct: bool) -> Result<Baked, BakeError> {
    let value = Value::Object(params.clone());
    foliar_schema::check_ranges(&schemars::schema_for!(ScanParams).to_value(), &value)
        .map_err(|source| BakeError::Range { room: ROOM.into(), source })?;
    let params: ScanParams = serde_json::from_value(value).map_err(|error| refuse("params", error.to_string()))?;
    let (scan, findings) = match inputs.plant {
        Some(plant) if inputs.maps.is_empty() => of_mesh(plant, &params, direct)?,
        Some(_) => return Err(needs("a mesh or height maps, and not both", "leave one of them out")),
        None => (of_heights(inputs.maps, &params)?, about_bits(inputs.maps, &params)),
    };
    if scan.covered() == 0 {
        let found: Vec<String> = findings.iter().map(|finding: &Finding| finding.message.clone()).collect();
        let why = if found.is_empty() {
            "look at the unit".into()
        } else {
            format!("{}; look at the unit too", found.join("; "))
        };
        return Err(needs_text("a leaf: no texel of the maps holds any", why));
    }
    if let Some(what) = too_large(&scan) {
        return Err(needs_text("a leaf within a meter", format!("{what}: say --unit, or the scale of the heights")));
    }
    let resolved = serde_json::to_value(&params).unwrap_or_default();
    let findings = findings.into_iter().chain(about(&scan)).collect();
    Ok(Baked { resolved: resolved.as_object().cloned().unwrap_or_default(), findings, ..baked(scan) })
}

/// What the steps of 8 bits cost: they are steps of thickness, and turn normals.
fn about_bits(maps: &Maps, params: &ScanParams) -> Vec<Finding> {
    let Some((scale, texel)) = params.height_scale_mm.zip(params.texel_mm) else { return Vec::new() };
    let coarse = maps.iter().filter(|(_, map)| map.bits == 8);
    let say = |(name, _): (&String, &foliar_bake::MapRaster)| {
        let step = scale / 255.0;
        let turned = libm::atan(step / (2.0 * texel)).to_degrees();
        let message = format!(
            "8 bits make steps of {step:.5} mm, which turn normals by {turned:.2} degrees: 16 bits or floats cost nothing"
        );
        Finding::new(&code::MAP_BITS, message).at(format!("map {name}"))
    };
    coarse.map(say).collect()
}

/// What is no leaf: a texel thicker, or farther from the middle, than a map of a leaf may say.
fn too_large(scan: &Scan) -> Option<String> {
    let [front, back] = &scan.heights_mm;
    let maps =
        [(names::MAP_THICKNESS, &scan.thickness_mm), (names::MAP_HEIGHT_FRONT, front), (names::MAP_HEIGHT_BACK, back)];
    maps.into_iter().find_map(|(name, values)| {
        let info = foliar_schema::raster(name)?;
        let at = find_first(values, |value| !(info.min..=info.max).contains(value))?;
        let (column, row) = (at % scan.width, at / scan.width);
        Some(format!("its {name} is {} mm at column {column}, row {row}", values[at]))
    })
}

fn of_mesh(plant: &Plant, params: &ScanParams, direct: bool) -> Result<(Scan, Vec<Finding>), BakeError> {
    let bad = |error: super::ScanError| needs_text("a closed mesh of a leaf", format!("the mesh {error}"));
    let (mut corners, mut texture) = (Vec::new(), Vec::new());
    for part in plant.parts() {
        for triangle in &part.triangles {
            corners.push(triangle.map(|i| part.rest_position(i as usize) * MM_PER_M));
            let place = |i: u32| part.uvs.get(i as usize).map_or(DVec2::ZERO, |uv| uv.as_dvec2());
            texture.push(triangle.map(place));
        }
    }
    let mut solid = Solid::new(&corners, texture).map_err(bad)?;
    solid.direct = direct;
    // Up decides; of a leaf that stands, +Z.
    let up = DVec3::new(0.0, 1.0, 1e-3) * if params.face == Face::Up { 1.0 } else { -1.0 };
    let scan = match params.unwrap {
        Unwrap::Plane => project(&solid, &Frame::of(&solid, up), params.resolution as usize),
        Unwrap::Uv => in_texture(&solid, params.resolution as usize, params.smooth_mm).map_err(bad)?,
    };
    Ok((scan, about_mesh(&solid)))
}

fn of_heights(maps: &Maps, params: &ScanParams) -> Result<Scan, BakeError> {
    let [front, back] = [names::MAP_HEIGHT_FRONT, names::MAP_HEIGHT_BACK].map(|name| maps.get(name));
    let (Some(front), Some(back)) = (front, back) else {
        return Err(needs("a closed mesh of a leaf, or height maps of both its sides", "give one of them"));
    };
    let (a, b) = (&front.raster, &back.raster);
    if (a.width, a.height) != (b.width, b.height) {
        let problem = format!("is {} x {} and that of the front {} x {}", b.width, b.height, a.width, a.height);
        return Err(bad_map(names::MAP_HEIGHT_BACK, problem, "give maps of one size"));
    }
    let Some(texel_mm) = params.texel_mm else {
        return Err(refuse("texel_mm", "must be given for height maps: normals depend on the size of a texel".into()));
    };
    let heights = |name: &str, map: &foliar_bake::MapRaster| {
        let scale = match params.height_scale_mm {
            Some(scale) => scale,
            None if map.bits == 32 => 1.0,
            None => {
                let reason = format!("must be given: map {name} holds whole numbers");
                return Err(refuse("height_scale_mm", reason));
            }
        };
        let channels = map.raster.channels.max(1) as usize;
        let values: Vec<f32> = map.raster.data.iter().step_by(channels).map(|v| v * scale as f32).collect();
        match values.iter().position(|v| !v.is_finite()) {
            Some(at) => {
                let (column, row) = (at % map.raster.width.max(1) as usize, at / map.raster.width.max(1) as usize);
                let problem = format!("is {} at column {column}, row {row}", values[at]);
                Err(bad_map(name, problem, "every texel must be a finite number: write it again"))
            }
            None => Ok(values),
        }
    };
    let half = (params.gap_mm / 2.0 + params.height_offset_mm) as f32;
    let [front, back] = [heights(names::MAP_HEIGHT_FRONT, front)?, heights(names::MAP_HEIGHT_BACK, back)?]
        .map(|list| list.into_iter().map(|h| h + half).collect::<Vec<f32>>());
    Ok(between_heights(&front, &back, a.width as usize, [texel_mm; 2]))
}

/// Rasters with what a reader needs: size of a texel, and for pictures of whole numbers what black and white are.
fn baked(scan: Scan) -> Baked {
    let (width, height, texel_mm, covered) = (scan.width, scan.height, scan.texel_mm, scan.covered());
    let map = LeafMap { width, height, thickness_mm: scan.thickness_mm, normals: Vec::new() };
    let (range, median) = (map.range_mm().unwrap_or_default(), map.median_mm().unwrap_or_default());
    let mut baked = Baked::default();
    let mut ranges = Map::new();
    let mut add = |name: &str, channels: u32, data: Vec<f32>, range: [f64; 2]| {
        ranges.insert(name.into(), json!({"black": range[0], "white": range[1]}));
        baked.rasters.insert(name.into(), FloatRaster { width: width as u32, height: height as u32, channels, data });
    };
    add(names::MAP_THICKNESS, 1, map.thickness_mm, [0.0, range.1]);
    let [front, back] = scan.heights_mm;
    // One scale for both: whoever reads pictures of whole numbers gives one.
    let (low, high) = front.iter().chain(&back).fold((0.0f32, 0.0f32), |(a, b), h| (a.min(*h), b.max(*h)));
    for (name, heights) in [(names::MAP_HEIGHT_FRONT, front), (names::MAP_HEIGHT_BACK, back)] {
        add(name, 1, heights, [f64::from(low), f64::from(high)]);
    }
    let [front, back] = scan.normals;
    for (name, normals) in [(names::MAP_NORMAL_FRONT, front), (names::MAP_NORMAL_BACK, back)] {
        add(name, 3, normals.into_flattened(), [-1.0, 1.0]);
    }
    let facts = json!({
        "texelMm": texel_mm,
        "thicknessMm": { "least": range.0, "median": median, "greatest": range.1 },
        "coverage": covered as f64 / (width * height) as f64,
        "stored": ranges,
        "frame": "rows from the top, x right, y up on both sides (same-uv-mirrored), z outward of each side",
    });
    Baked { facts: facts.as_object().cloned().unwrap_or_default(), ..baked }
}

fn about_mesh(solid: &Solid) -> Vec<Finding> {
    let faults = &solid.faults;
    let mut findings = Vec::new();
    let mut say = |code: &CodeInfo, place: Option<DVec3>, message: String| {
        let place = place.map_or_else(|| "the mesh".into(), |p| format!("{:.3}, {:.3}, {:.3} mm", p.x, p.y, p.z));
        findings.push(Finding::new(code, message).at(place));
    };
    if faults.open_edges > 0 {
        let message = format!("{} edges have a triangle on one side only: the mesh has holes", faults.open_edges);
        say(&code::SCAN_OPEN, faults.first_hole, message);
    }
    if faults.turned_edges > 0 {
        let message = format!("across {} edges triangles face opposite ways: some are inverted", faults.turned_edges);
        say(&code::SCAN_TURNED, faults.first_turned, message);
    }
    if faults.crowded_edges > 0 {
        say(&code::SCAN_OPEN, None, format!("{} edges belong to more than two triangles", faults.crowded_edges));
    }
    if faults.inside_out {
        say(&code::SCAN_TURNED, None, "the whole mesh faces inward: it was taken turned over".into());
    }
    findings
}

fn about(scan: &Scan) -> Vec<Finding> {
    let mut findings = Vec::new();
    if let Some(first) = scan.broken.first() {
        let message = format!(
            "{} texels lie over holes or inverted faces, where no thickness is known: they are left empty",
            scan.broken.len()
        );
        let place = format!("column {}, row {}", first % scan.width, first / scan.width);
        findings.push(Finding::new(&code::SCAN_BROKEN, message).at(place));
    }
    if scan.folded > 0 {
        let message =
            format!("at {} texels the leaf lies over itself: the layer next to the front was taken", scan.folded);
        findings.push(Finding::new(&code::SCAN_FOLDED, message));
    }
    if scan.overlapping > 0 {
        let message =
            format!("{} texels are claimed by two places of the front: the first was taken", scan.overlapping);
        findings.push(Finding::new(&code::SCAN_FOLDED, message));
    }
    let bend = scan.bend();
    if bend > BENT {
        let message =
            format!("the leaf's middle slopes by {bend:.2} on the mean: thickness along one axis says too much");
        findings.push(Finding::new(&code::SCAN_BENT, message));
    }
    findings
}

fn refuse(place: &str, reason: String) -> BakeError {
    BakeError::Parameter { room: ROOM.into(), place: place.into(), reason }
}

fn bad_map(map: &str, problem: String, remedy: &str) -> BakeError {
    BakeError::Map { room: ROOM.into(), map: map.into(), problem, remedy: remedy.into() }
}

fn needs(what: &'static str, remedy: &str) -> BakeError {
    needs_text(what, remedy.into())
}

fn needs_text(what: &'static str, remedy: String) -> BakeError {
    BakeError::Needs { room: ROOM.into(), what, remedy }
}
