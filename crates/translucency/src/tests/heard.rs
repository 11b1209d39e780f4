//! Nobody is ignored in silence: what is given changes what is baked, or is said to have no say, or is refused.

use super::room::{maps, raster};
use super::scans::plant;
use crate::map::by_rule::leaf_mesh;
use crate::room::Translucency;
use crate::scan::Leafscan;
use foliar_bake::{Baker, Inputs, Maps, Quiet, Request, run};
use foliar_plant::Plant;
use foliar_schema::names;
use serde_json::{Map, Value, json};

/// What the shell reads of this section, not the room.
const OF_THE_SHELL: [&str; 4] = ["material", "for_material", "exr", "embed_all"];

/// Another value than the default for each parameter, and for what nobody can make up.
fn others(baker: &dyn Baker) -> Vec<(String, Vec<Value>)> {
    let schema = baker.schema();
    let words = |property: &Value| {
        let name = property["$ref"].as_str().and_then(|path| path.rsplit('/').next()).unwrap_or_default().to_owned();
        let variants = schema["$defs"][&name]["oneOf"].as_array().cloned().unwrap_or_default();
        let mut words: Vec<Value> = variants.iter().map(|variant| variant["const"].clone()).collect();
        words.retain(|word| *word != property["default"]);
        words
    };
    let values = |name: &str, property: &Value| match name {
        "fit_rt" => vec![json!("0.1,0.06")],
        "layer" => vec![json!(["1,8,0.8,1"])],
        "filters" => vec![json!(3)],
        "resolution" => vec![json!(24)],
        "wavelength_nm" => vec![json!(600)],
        "coarsest_mm" => vec![json!(0.3)],
        "smooth_mm" => vec![json!(20.0)],
        _ if property.get("x-map").is_some() || OF_THE_SHELL.contains(&name) => Vec::new(),
        _ if property.get("$ref").is_some() => words(property),
        _ => vec![json!(property["default"].as_f64().map_or(1.5, |v| 0.9 * v + 0.05))],
    };
    let given = |(name, property): (&String, &Value)| (name.clone(), values(name, property));
    schema["properties"].as_object().into_iter().flatten().map(given).filter(|(_, values)| !values.is_empty()).collect()
}

/// What was baked, as text and numbers, and of which parameters it was said that they are idle; what is refused is heard.
fn baked(baker: &dyn Baker, inputs: &Inputs, given: &Map<String, Value>) -> Option<(String, Vec<String>)> {
    let request = Request { given: given.clone(), ..Request::default() };
    let (layer, findings) = run(baker, inputs, &request, &Quiet).ok()?;
    let idle = findings.iter().filter(|finding| finding.code == "PARAM-IDLE");
    let idle = idle.map(|finding| finding.message.split(' ').next().unwrap_or_default().to_owned()).collect();
    Some((format!("{:?} {:?}", layer.record.facts, layer.rasters), idle))
}

/// Every parameter over every base, except where a base says it already.
fn all_are_heard(baker: &dyn Baker, plant: Option<&Plant>, maps: &Maps, bases: &[Value]) {
    let inputs = Inputs { plant, maps, neighbors: &[] };
    for base in bases {
        let base = base.as_object().unwrap();
        let (plain, _) = baked(baker, &inputs, base).unwrap_or_else(|| panic!("{base:?}"));
        for (name, values) in others(baker).into_iter().filter(|(name, _)| !base.contains_key(name)) {
            let with = |value: &Value| {
                let mut given = base.clone();
                given.insert(name.clone(), value.clone());
                baked(baker, &inputs, &given)
            };
            // A word may be what is chosen where nothing is said; not all of them.
            let all: Vec<_> = values.iter().map(with).collect();
            let is_said = |idle: &[String]| idle.contains(&name);
            let heard = all.iter().any(|one| one.as_ref().is_none_or(|(with, idle)| *with != plain && !is_said(idle)));
            let idle = all.iter().all(|one| one.as_ref().is_some_and(|(with, idle)| *with == plain && is_said(idle)));
            assert!(heard != idle, "{name} of {values:?} beside {base:?}: heard {heard}, said to be idle {idle}");
        }
    }
}

#[test]
fn every_parameter_of_a_leaf_is_heard() {
    let plain = maps(12);
    let thickness = || (names::MAP_THICKNESS.to_owned(), plain[names::MAP_THICKNESS].clone());
    let wedge = |k: usize| raster(12, 1, (0..144).map(|i| 0.01 * ((i * k) % 12) as f32).collect());
    let relief = Maps::from([
        thickness(),
        (names::MAP_HEIGHT_FRONT.into(), wedge(1)),
        (names::MAP_HEIGHT_BACK.into(), wedge(5)),
    ]);
    let flat = Maps::from([thickness()]);
    for (there, base) in [
        (&plain, json!({"leaf_width_mm": 0.6, "bands": "rgb", "sides": "front"})),
        (&plain, json!({"texel_mm": 0.05, "layer": ["1,8,0.8,0.3", "4,10,0.8,0.7"]})),
        (&relief, json!({"texel_mm": 0.05, "spread": "none", "sides": "back", "normalize": "diffuse"})),
        (&flat, json!({"texel_mm": 0.05, "fit_rt": "0.12,0.1", "sides": "front"})),
    ] {
        all_are_heard(&Translucency, None, there, &[base]);
    }
    let photo = raster(12, 3, (0..432).map(|i| 0.1 + 0.002 * ((i * 7) % 97) as f32).collect());
    let photo = Maps::from([(names::MAP_THICKNESS.into(), photo)]);
    all_are_heard(
        &Translucency,
        None,
        &photo,
        &[json!({"texel_mm": 0.05, "thickness_from": "photo", "sides": "front"})],
    );
}

#[test]
fn every_parameter_of_a_scan_is_heard() {
    let plant = plant(&leaf_mesh(12));
    let bases = [json!({"resolution": 16}), json!({"resolution": 16, "unwrap": "uv"})];
    all_are_heard(&Leafscan, Some(&plant), &Maps::new(), &bases);
    let heights = |k: usize| raster(12, 1, (0..144).map(|i| 0.2 + 0.01 * ((i * k) % 12) as f32).collect());
    let heights =
        Maps::from([(names::MAP_HEIGHT_FRONT.into(), heights(1)), (names::MAP_HEIGHT_BACK.into(), heights(5))]);
    all_are_heard(&Leafscan, None, &heights, &[json!({"texel_mm": 0.05})]);
}
