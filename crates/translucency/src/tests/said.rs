//! What the room says of maps that cost something, and that it says the truth.

use super::room::{bake, maps, raster};
use foliar_bake::{Baker, MapRaster, Maps};
use foliar_schema::{Finding, names};
use serde_json::{Value, json};

/// A leaf whose front alone is shown: no normals of the front, which no light falls on.
fn seen_from_the_front(size: usize) -> Maps {
    let mut maps = maps(size);
    maps.remove(names::MAP_NORMAL_FRONT);
    maps
}

fn said(maps: &Maps, given: Value) -> Vec<Finding> {
    bake(maps, given).unwrap().1
}

/// The number before " %" in a message.
fn percent(finding: &Finding) -> f64 {
    let before = finding.message.split(" %").next().unwrap_or_default();
    before.rsplit(' ').next().unwrap_or_default().parse().unwrap()
}

/// The cost of a step is what a leaf one step thicker lets through less.
#[test]
fn the_cost_of_a_step_is_that_of_the_tissue() {
    let leaf = |mm: f64| Maps::from([(names::MAP_THICKNESS.into(), raster(8, 1, vec![mm as f32; 64]))]);
    let white = 0.4;
    let step = white / 255.0;
    let eight_bits = MapRaster { bits: 8, ..raster(8, 1, vec![0.5; 64]) };
    let coarse = Maps::from([(names::MAP_THICKNESS.into(), eight_bits)]);
    for given in [json!({}), json!({"preset": "dark"}), json!({"wavelength_nm": 550.0}), json!({"preset": "young"})] {
        let with = |more: Value| {
            let mut given = given.clone();
            more.as_object().unwrap().iter().for_each(|(key, value)| given[key] = value.clone());
            given
        };
        let mean = |mm: f64| {
            let layer = bake(&leaf(mm), with(json!({"texel_mm": 0.5}))).unwrap().0;
            layer.record.facts["maps"][names::RASTER_TRANSLUCENCY_FRONT]["meanTransmission"].as_f64().unwrap()
        };
        let truth = 100.0 * (1.0 - mean(0.5 * white + step) / mean(0.5 * white));
        let found = said(&coarse, with(json!({"texel_mm": 0.5, "thickness_scale_mm": white})));
        assert_eq!(found[0].code, "MAP-BITS", "{found:?}");
        // What the docs say of a green leaf.
        assert!(given != json!({}) || found[0].message.contains("2.3 %"), "{}", found[0].message);
        // One digit behind the point is printed; the mean over directions differs from straight ahead by less than a tenth.
        assert!((percent(&found[0]) - truth).abs() < 0.05 + 0.1 * truth, "{truth}: {}", found[0].message);
    }
}

/// Steps of normals and of heights: what they turn a normal by, and from which size on it is said.
#[test]
fn the_bits_of_normals_and_heights_are_warned_of() {
    let mut there = seen_from_the_front(16);
    there.get_mut(names::MAP_NORMAL_BACK).unwrap().raster.data.iter_mut().for_each(|v| *v = 0.5 * (*v + 1.0));
    there.get_mut(names::MAP_NORMAL_BACK).unwrap().bits = 8;
    let given = |more: Value| {
        let mut given = json!({"texel_mm": 0.5, "sides": "front"});
        more.as_object().unwrap().iter().for_each(|(key, value)| given[key] = value.clone());
        given
    };
    let found = said(&there, given(json!({})));
    assert_eq!((found.len(), found[0].code.as_str()), (1, "MAP-BITS"), "{found:?}");
    assert!(
        found[0].message.contains("0.45 degrees")
            && found[0].place.as_ref().is_some_and(|p| p.contains(names::MAP_NORMAL_BACK)),
        "{found:?}"
    );
    there.get_mut(names::MAP_NORMAL_BACK).unwrap().bits = 16;
    assert!(said(&there, given(json!({}))).is_empty());
    let relief = |bits| {
        let mut maps = maps(16);
        maps.remove(names::MAP_NORMAL_BACK);
        maps.insert(names::MAP_HEIGHT_BACK.into(), MapRaster { bits, ..raster(16, 1, vec![0.5; 256]) });
        maps
    };
    // .5 mm in 255 steps over two texels of .05 mm.
    let found = said(&relief(8), given(json!({"texel_mm": 0.05, "height_scale_mm": 0.5})));
    let bits = |found: &[Finding]| found.iter().find(|f| f.code == "MAP-BITS").map(percent);
    let cost = bits(&found).unwrap();
    assert!((cost - 100.0 * 0.5 / 255.0 / 0.1).abs() < 0.05, "{found:?}");
    assert_eq!(bits(&said(&relief(16), given(json!({"texel_mm": 0.05, "height_scale_mm": 0.5})))), None);
    assert_eq!(bits(&said(&relief(8), given(json!({"texel_mm": 5.0, "height_scale_mm": 0.05})))), None);
}

#[test]
fn walls_and_what_is_below_nothing_are_said() {
    let step: Vec<f32> = (0..64).map(|at| if at % 8 < 4 { 0.1 } else { 0.3 }).collect();
    let leaf = |data: Vec<f32>| Maps::from([(names::MAP_THICKNESS.into(), raster(8, 1, data))]);
    let found = said(&leaf(step.clone()), json!({"texel_mm": 0.1}));
    assert_eq!(found[0].code, "MAP-STEEP");
    assert!(found[0].message.contains("at 8 texels"), "{found:?}");
    assert!(said(&leaf(step), json!({"texel_mm": 0.5})).is_empty());
    let mut below = vec![0.2; 64];
    below[..3].fill(-0.1);
    let found = said(&leaf(below), json!({"texel_mm": 0.5}));
    assert!(found[0].code == "MAP-THIN" && found[0].message.contains("3 texels"), "{found:?}");
}

#[test]
fn a_fitted_tissue_is_told() {
    let found = said(&maps(8), json!({"texel_mm": 0.5, "fit_rt": "0.1,0.06"}));
    let layer = bake(&maps(8), json!({"texel_mm": 0.5, "fit_rt": "0.1,0.06"})).unwrap().0;
    let tissue = &layer.record.facts["maps"][names::RASTER_TRANSLUCENCY_FRONT]["tissues"][0];
    let absorption = format!("absorption {:.4}", tissue["absorption"].as_f64().unwrap());
    assert!(found[0].code == "MAP-FITTED" && found[0].message.contains(&absorption), "{found:?}");
}

/// Three bands as measured: each has its own tissue, that of its band alone.
#[test]
fn three_bands_are_fitted_each_by_its_own_measurement() {
    let pairs = ["0.08,0.03", "0.12,0.08", "0.05,0.01"];
    let with = |bands: &str, pairs: &str, nm: f64| json!({"texel_mm": 0.5, "sides": "front", "bands": bands, "fit_rt": pairs, "wavelength_nm": nm});
    let (layer, found) = bake(&seen_from_the_front(8), with("rgb", &pairs.join(";"), 510.0)).unwrap();
    assert!(found[0].code == "MAP-FITTED" && found[0].message.matches(" nm").count() == 3, "{found:?}");
    let front = names::RASTER_TRANSLUCENCY_FRONT;
    let bands = [names::BAND_RED, "", names::BAND_BLUE].map(|band| format!("{front}{band}"));
    for ((name, pair), nm) in bands.iter().zip(pairs).zip([610.0, 550.0, 450.0]) {
        let alone = bake(&seen_from_the_front(8), with("one", pair, nm)).unwrap().0;
        let tissues = |layer: &foliar_bake::Layer, name: &str| layer.record.facts["maps"][name]["tissues"].clone();
        assert_eq!(tissues(&layer, name), tissues(&alone, front), "{name}");
    }
    for (bands, pairs) in [("rgb", "0.1,0.06"), ("rgb", "0.1,0.06;0.1,0.06"), ("one", "0.1,0.06;0.1,0.06")] {
        let error = bake(&seen_from_the_front(8), with(bands, pairs, 510.0)).unwrap_err().to_string();
        assert!(error.contains("fit_rt") && error.contains("must be R,T"), "{error}");
    }
}

/// A scene's pixel is the finest texel that is kept: each is the mean of what was baked there.
#[test]
fn no_texel_is_finer_than_a_pixel_of_the_scene() {
    let near = foliar_schema::Scene::default();
    let foliar_bake::Requirement::Required { params, because, .. } =
        crate::Translucency.require(&near, &foliar_bake::Facts::default())
    else {
        panic!("the default scene is backlit");
    };
    // 3 m, 60 degrees, 1080 rows.
    let pixel = params["coarsest_mm"].as_f64().unwrap();
    assert!((pixel - 2000.0 * 3.0 * 0.577_350_27 / 1080.0).abs() < 1e-6 && because.contains("3.21 mm"), "{because}");
    let name = names::RASTER_TRANSLUCENCY_FRONT;
    let with = |more: Value| bake(&maps(32), more).unwrap().0;
    let fine = with(json!({"texel_mm": 0.5, "sides": "front"}));
    let coarse = with(json!({"texel_mm": 0.5, "sides": "front", "coarsest_mm": pixel}));
    let (fine_map, coarse_map) = (&fine.rasters[name], &coarse.rasters[name]);
    assert_eq!((fine_map.width, coarse_map.width, coarse_map.height), (32, 8, 8));
    assert_eq!((&fine.record.facts["texelMm"], &coarse.record.facts["texelMm"]), (&json!(0.5), &json!(2.0)));
    let texel = |x: usize, y: usize| &fine_map.data[4 * (32 * y + x)..][..4];
    for (at, found) in coarse_map.data.chunks(4).enumerate() {
        let own = (0..16).map(|i| texel(at % 8 * 4 + i % 4, at / 8 * 4 + i / 4)).filter(|texel| texel[3] > 0.0);
        let own: Vec<&[f32]> = own.collect();
        for (c, found) in found.iter().enumerate() {
            let mean = own.iter().map(|texel| texel[c]).sum::<f32>() / own.len().max(1) as f32;
            assert!((mean - found).abs() < 1e-6, "texel {at}: {mean} {found}");
        }
    }
}

/// Normals in floats are taken for what they are, whichever way they are written.
#[test]
fn floats_of_normals_are_signed_or_not() {
    let front = |texel: Option<[f32; 3]>| {
        let mut maps = Maps::from([(names::MAP_THICKNESS.into(), raster(8, 1, vec![0.2; 64]))]);
        let normals = texel.map(|texel| raster(8, 3, [[0.0; 3], texel].concat().repeat(32)));
        maps.extend(normals.map(|map| (names::MAP_NORMAL_BACK.to_owned(), map)));
        bake(&maps, json!({"texel_mm": 5.0, "sides": "front"})).unwrap().0.rasters[names::RASTER_TRANSLUCENCY_FRONT]
            .data[4..8]
            .to_vec()
    };
    let straight = front(None);
    assert_eq!(front(Some([0.0, 0.0, 1.0])), straight, "signed, and none below 0");
    assert_eq!(front(Some([0.5, 0.5, 1.0])), straight, "half of n + 1");
    let leans = [0.6, 0.0, 0.8f32];
    let apart = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(apart(&front(Some(leans)), &front(Some(leans.map(|v| 0.5 * (v + 1.0))))) < 1e-7);
    assert!(apart(&front(Some(leans)), &straight) > 1e-3);
}

/// Texels need not be square: a leaf laid over its diagonal, with its edges exchanged, is the same leaf.
#[test]
fn texels_have_two_edges() {
    let (width, height) = (12, 7);
    let at = |x: usize, y: usize| 0.1 + 0.2 * ((x * x + 3 * y) % 5) as f32 / 5.0;
    let lying: Vec<f32> = (0..width * height).map(|i| at(i % width, i / width)).collect();
    let standing: Vec<f32> = (0..width * height).map(|i| at(i / height, i % height)).collect();
    let bake = |width: usize, data: Vec<f32>, right: f64, down: f64| {
        let maps = Maps::from([
            (names::MAP_THICKNESS.into(), raster(width, 1, data.clone())),
            (names::MAP_HEIGHT_BACK.into(), raster(width, 1, data)),
        ]);
        let given = json!({"texel_mm": right, "texel_height_mm": down, "sides": "front"});
        bake(&maps, given).unwrap().0.rasters[names::RASTER_TRANSLUCENCY_FRONT].data.clone()
    };
    let (a, b) = (bake(width, lying.clone(), 0.3, 0.1), bake(height, standing, 0.1, 0.3));
    let square = bake(width, lying, 0.3, 0.3);
    let (mut worst, mut moved) = (0.0f32, 0.0f32);
    for i in 0..width * height {
        let (x, y) = (i % width, i / width);
        let [here, there] = [a[4 * i + 3], b[4 * (x * height + y) + 3]];
        worst = worst.max((here / there - 1.0).abs());
        moved = moved.max((here / square[4 * i + 3] - 1.0).abs());
    }
    // Sums of a few dozen f32 in another order.
    assert!(worst < 1e-5, "{worst}");
    assert!(moved > 1e-2, "{moved}");
}

/// Over a mean of nearly nothing a thin rim is brighter than a map may hold: refused in words.
#[test]
fn a_mean_of_nothing_divides_no_map() {
    let thickness = (0..64).map(|at| if at % 8 == 0 { 0.001 } else { 2.0 }).collect();
    let leaf = Maps::from([(names::MAP_THICKNESS.into(), raster(8, 1, thickness))]);
    let given = |by: &str| json!({"texel_mm": 5.0, "spread": "none", "absorption": 60.0, "normalize": by});
    assert!(bake(&leaf, given("none")).is_ok() && bake(&leaf, given("diffuse")).is_ok());
    let few = (0..64 * 64).map(|at| if at == 0 { 0.001 } else { 2.0 }).collect();
    let dark = Maps::from([(names::MAP_THICKNESS.into(), raster(64, 1, few))]);
    let error = bake(&dark, given("mean")).unwrap_err().to_string();
    assert!(error.contains("thickness") && error.contains("normalize = mean") && error.contains("diffuse"), "{error}");
}
