//! The room: laws of the house, sides, frames, bad maps.

use crate::map::{by_rule::leaf_by_rule, normals_from_heights};
use crate::room::Translucency;
use foliar_bake::{
    BakeError, Baked, Baker, FloatRaster, Inputs, Layer, MapRaster, Maps, Needs, Progress, Quiet, Request, laws, run,
};
use foliar_plant::Plant;
use foliar_plant::sample::Sample;
use foliar_schema::names;
use serde_json::{Map, Value, json};

pub(super) fn raster(width: usize, channels: u32, data: Vec<f32>) -> MapRaster {
    let height = (data.len() / width / channels as usize) as u32;
    MapRaster { raster: FloatRaster { width: width as u32, height, channels, data }, bits: 32 }
}

/// A leaf of `size` texels a side with normals of both sides.
pub(super) fn maps(size: usize) -> Maps {
    let leaf = leaf_by_rule(size);
    let normals = |n: &[[f32; 3]]| raster(size, 3, n.as_flattened().to_vec());
    Maps::from([
        (names::MAP_THICKNESS.into(), raster(size, 1, leaf.front.thickness_mm.clone())),
        (names::MAP_NORMAL_FRONT.into(), normals(&leaf.front.normals)),
        (names::MAP_NORMAL_BACK.into(), normals(&leaf.back.normals)),
    ])
}

pub(super) fn bake(maps: &Maps, given: Value) -> Result<(Layer, Vec<foliar_schema::Finding>), BakeError> {
    let inputs = Inputs { plant: None, maps, neighbors: &[] };
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    run(&Translucency, &inputs, &request, &Quiet)
}

/// The room with maps at hand, so that the laws of the house can walk it; no plant tells it anything.
struct WithMaps(Maps);

impl WithMaps {
    fn said(params: &Map<String, Value>) -> Map<String, Value> {
        let mut params = params.clone();
        if params["texel_mm"].is_null() {
            params.insert("texel_mm".into(), json!(0.5));
        }
        params
    }
}

impl Baker for WithMaps {
    fn room(&self) -> &'static str {
        Translucency.room()
    }
    fn version(&self) -> u32 {
        Translucency.version()
    }
    fn about(&self) -> &'static str {
        Translucency.about()
    }
    fn schema(&self) -> Value {
        Translucency.schema()
    }
    fn needs(&self) -> Needs {
        Needs::default()
    }
    fn require(&self, scene: &foliar_schema::Scene, facts: &foliar_bake::Facts) -> foliar_bake::Requirement {
        Translucency.require(scene, facts)
    }
    fn ladder(&self) -> Vec<foliar_bake::Rung> {
        Translucency.ladder()
    }
    fn bake(&self, _: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError> {
        Translucency.bake(&Inputs { plant: None, maps: &self.0, neighbors: &[] }, &Self::said(params), progress)
    }
    fn reference(&self, _: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError> {
        Translucency.reference(&Inputs { plant: None, maps: &self.0, neighbors: &[] }, &Self::said(params))
    }
}

#[test]
fn the_laws_of_the_house_hold() {
    let nothing = Sample { name: "nothing", plant: Plant::default() };
    let breaches = laws::check_all(&WithMaps(maps(24)), &[nothing]);
    assert!(breaches.is_empty(), "{breaches:?}");
}

/// Exchanging the sides of a leaf exchanges its maps.
#[test]
fn sides_belong_to_the_light_behind_them() {
    let given = json!({"texel_mm": 0.5, "layer": ["1,8,0.8,0.3", "4,10,0.8,0.7"]});
    let turned = json!({"texel_mm": 0.5, "layer": ["4,10,0.8,0.7", "1,8,0.8,0.3"]});
    let there = maps(20);
    let mut exchanged = there.clone();
    exchanged.insert(names::MAP_NORMAL_FRONT.into(), there[names::MAP_NORMAL_BACK].clone());
    exchanged.insert(names::MAP_NORMAL_BACK.into(), there[names::MAP_NORMAL_FRONT].clone());
    let (a, b) = (bake(&there, given).unwrap().0, bake(&exchanged, turned).unwrap().0);
    let [front, back] = [names::RASTER_TRANSLUCENCY_FRONT, names::RASTER_TRANSLUCENCY_BACK];
    assert_eq!(a.rasters[front], b.rasters[back]);
    assert_eq!(a.rasters[back], b.rasters[front]);
    assert_ne!(a.rasters[front], a.rasters[back]);
}

/// A bump that falls to the right and down leans right and down.
#[test]
fn frames_of_normals_are_told_apart() {
    let heights: Vec<f32> = (0..12).map(|at| -0.2 * (at % 4) as f32 - 0.1 * (at / 4) as f32).collect();
    let [x, y, z] = normals_from_heights(&heights, 4, [1.0, 1.0])[5];
    assert!(x > 0.0 && y < 0.0 && z > 0.9, "{x} {y} {z}");
    // Green down is the same map upside down; a right-handed frame of the back is the same with red turned over.
    let there = maps(20);
    let turned = |channel: usize| {
        let mut maps = there.clone();
        let data = &mut maps.get_mut(names::MAP_NORMAL_BACK).unwrap().raster.data;
        data.chunks_exact_mut(3).for_each(|n| n[channel] = -n[channel]);
        maps
    };
    let front = |maps: &Maps, given| bake(maps, given).unwrap().0.rasters[names::RASTER_TRANSLUCENCY_FRONT].clone();
    let plain = front(&there, json!({"texel_mm": 0.5, "sides": "front"}));
    assert_eq!(plain, front(&turned(1), json!({"texel_mm": 0.5, "sides": "front", "normal_y": "down"})));
    assert_eq!(plain, front(&turned(0), json!({"texel_mm": 0.5, "sides": "front", "normal_frame": "right-handed"})));
}

#[test]
fn normalized_maps_keep_what_they_say() {
    let plain = bake(&maps(20), json!({"texel_mm": 0.5, "sides": "front"})).unwrap().0;
    let name = names::RASTER_TRANSLUCENCY_FRONT;
    let mean = plain.record.facts["maps"][name]["meanTransmission"].as_f64().unwrap();
    let divided = |how| bake(&maps(20), json!({"texel_mm": 0.5, "sides": "front", "normalize": how})).unwrap().0;
    let leaf = |texel: &&[f32]| texel[3] > 0.0;
    let means = divided("mean");
    for (a, b) in plain.rasters[name].data.chunks(4).zip(means.rasters[name].data.chunks(4)).filter(|(a, _)| leaf(a)) {
        assert!((f64::from(a[3]) / mean - f64::from(b[3])).abs() < 1e-5 * f64::from(b[3]) + 1e-6);
    }
    // Each texel answers diffuse light with one.
    let even = divided("diffuse");
    assert!(even.rasters[name].data.chunks(4).filter(leaf).all(|texel| (texel[3] - 1.0).abs() < 1e-5));
}

/// Three bands and both sides, in the order of the spectrum: green passes most.
#[test]
fn three_bands_make_six_maps() {
    let layer = bake(&maps(16), json!({"leaf_width_mm": 80.0, "bands": "rgb"})).unwrap().0;
    assert_eq!(layer.rasters.len(), 6);
    let mean = |suffix| {
        let name = format!("{}{suffix}", names::RASTER_TRANSLUCENCY_FRONT);
        layer.record.facts["maps"][name]["meanTransmission"].as_f64().unwrap()
    };
    assert!(mean("") > mean("Red") && mean("Red") > mean("Blue"));
}

/// Each kind of bad map and parameter: named, with what would be right.
#[test]
fn bad_input_is_refused_by_name() {
    let good = || maps(8);
    let with = |name: &str, map: MapRaster| {
        let mut maps = good();
        maps.insert(name.into(), map);
        maps
    };
    let texel = || json!({"texel_mm": 0.5});
    let says = |maps: &Maps, given: Value, words: &[&str]| {
        let error = bake(maps, given).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    };
    says(&Maps::new(), texel(), &["thickness"]);
    says(&good(), json!({}), &["leaf_width_mm", "texel_mm"]);
    says(&good(), json!({"texel_mm": 1.0, "leaf_width_mm": 80.0}), &["not both"]);
    says(&with("thickness", raster(8, 1, vec![0.0; 64])), texel(), &["thickness", "0 everywhere"]);
    says(&with("thickness", raster(4, 1, vec![0.1; 16])), texel(), &["8 x 8", "4 x 4"]);
    says(
        &with("thickness", raster(8, 1, [vec![0.1; 63], vec![f32::NAN]].concat())),
        texel(),
        &["NaN", "column 7, row 7"],
    );
    says(&with("normal-back", raster(8, 1, vec![0.1; 64])), texel(), &["normal-back", "three channels"]);
    says(&with("height-back", raster(8, 1, vec![0.1; 64])), texel(), &["height-back", "one of them"]);
    says(&with("thickness", MapRaster { bits: 8, ..raster(8, 1, vec![0.1; 64]) }), texel(), &["thickness_scale_mm"]);
    says(&good(), json!({"texel_mm": 0.5, "index": 0.9}), &["index"]);
    says(&good(), json!({"texel_mm": 0.5, "absorption": -1}), &["absorption"]);
    says(&good(), json!({"texel_mm": 0.5, "fit_rt": "0.8,0.4"}), &["R + T", "below 1"]);
    says(&good(), json!({"texel_mm": 0.5, "fit_rt": "0.8"}), &["R,T"]);
    says(&good(), json!({"texel_mm": 0.5, "layer": ["1,2"]}), &["ABSORPTION,REDUCED,ANISOTROPY,SHARE"]);
    says(&good(), json!({"texel_mm": 0.5, "curve": "fitted", "entry": "lambert"}), &["transport"]);
    says(&good(), json!({"texel_mm": 0.5, "wavelength_nm": 900}), &["wavelength_nm", "900"]);
}

#[test]
fn coarse_and_thin_maps_are_warned_of() {
    let mut there = maps(16);
    let map = there.get_mut(names::MAP_THICKNESS).unwrap();
    map.raster.data.iter_mut().for_each(|d| *d = (*d / 0.4 * 255.0).round() / 255.0);
    map.bits = 8;
    let codes = |maps: &Maps, given| bake(maps, given).unwrap().1.iter().map(|f| f.code.clone()).collect::<Vec<_>>();
    let given = json!({"texel_mm": 0.5, "thickness_scale_mm": 0.4, "thickness_offset_mm": -0.12});
    assert_eq!(codes(&there, given), ["MAP-THIN", "MAP-BITS"]);
    there.get_mut(names::MAP_THICKNESS).unwrap().bits = 16;
    assert!(codes(&there, json!({"texel_mm": 0.5, "thickness_scale_mm": 0.4})).is_empty());
    let mut none = maps(16);
    none.get_mut(names::MAP_NORMAL_BACK).unwrap().raster.data.fill(0.0);
    none.get_mut(names::MAP_NORMAL_BACK).unwrap().raster.data[0] = -1.0;
    assert_eq!(codes(&none, json!({"texel_mm": 0.5})), ["MAP-NORMALS"]);
    // Normals of the other side.
    let inward = none.get_mut(names::MAP_NORMAL_BACK).unwrap().raster.data.chunks_mut(3);
    inward.for_each(|normal| normal.copy_from_slice(&[0.0, 0.0, -1.0]));
    assert_eq!(codes(&none, json!({"texel_mm": 0.5})), ["MAP-NORMALS"]);
}

/// An artist with nothing but a leaf's texture gets a result, which says that it is a guess.
#[test]
fn a_photograph_stands_in_for_thickness() {
    let photo = |channels: u32, alpha: f32| {
        let texel = |at: usize| {
            let vein = if at % 16 == 8 { 0.9 } else { 0.5 };
            [0.3 * vein, vein, 0.2 * vein, alpha].into_iter().take(channels as usize)
        };
        MapRaster { bits: 8, ..raster(16, channels, (0..256).flat_map(texel).collect()) }
    };
    let baked = |map: MapRaster, more: Value| {
        let mut given = json!({"texel_mm": 0.5, "thickness_from": "photo"});
        more.as_object().unwrap().iter().for_each(|(key, value)| given[key] = value.clone());
        bake(&Maps::from([(names::MAP_THICKNESS.into(), map)]), given)
    };
    let (layer, findings) = baked(photo(4, 1.0), json!({"thickness_mean_mm": 0.25})).unwrap();
    assert!(findings.iter().all(|f| f.code == "MAP-ESTIMATED") && findings.len() == 1, "{findings:?}");
    assert_eq!(layer.record.facts["thicknessFrom"], "photo");
    let median = layer.record.facts["thicknessMm"]["median"].as_f64().unwrap();
    assert!((0.15..0.3).contains(&median), "{median}");
    // Without alpha all of it is leaf; without any leaf, or in gray, it is refused.
    assert!(baked(photo(3, 1.0), json!({})).is_ok());
    assert!(baked(photo(4, 0.0), json!({})).unwrap_err().to_string().contains("0 everywhere"));
    assert!(baked(photo(1, 1.0), json!({})).unwrap_err().to_string().contains("red, green and blue"));
}

/// One texel, one row: a map as any other.
#[test]
fn the_smallest_maps_are_baked() {
    for (width, height) in [(1, 1), (1, 7), (7, 1)] {
        let maps = Maps::from([(names::MAP_THICKNESS.into(), raster(width, 1, vec![0.2; width * height]))]);
        let layer = bake(&maps, json!({"texel_mm": 0.1})).unwrap().0;
        assert!(layer.rasters.values().all(|r| r.data.chunks(4).all(|texel| texel[3] > 0.0)));
    }
}

/// Statistics of a leaf that nobody means to change: a version that did not move with them would leave stale caches.
#[test]
fn golden_statistics_belong_to_the_version() {
    // Other machines round otherwise in nothing that reaches this far.
    const SAME: f64 = 1e-5;
    let layer = bake(&maps(64), json!({"leaf_width_mm": 80.0})).unwrap().0;
    let facts = &layer.record.facts["maps"];
    let mean = |name: &str| facts[name]["meanTransmission"].as_f64().unwrap();
    assert_eq!(layer.record.version, 5);
    for (name, golden) in
        [(names::RASTER_TRANSLUCENCY_FRONT, 0.064_452_6), (names::RASTER_TRANSLUCENCY_BACK, 0.064_416_5)]
    {
        assert!((mean(name) / golden - 1.0).abs() < SAME, "{name}: {}", mean(name));
    }
}
