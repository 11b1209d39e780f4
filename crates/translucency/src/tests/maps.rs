//! Maps against golden.json, radial.json and relief.json, and the fast way against the direct gather.

use super::oracle;
use crate::light::{Curve, Entry, Fit, Projection};
use crate::map::{LeafMap, Model, Recipe, Spreading, Tables, coefficient_map, coefficient_map_on, reference};
use crate::oracle::{Golden, bumps_error, spread_error};
use crate::transport::Medium;
use foliar_numerics::Isa;
use glam::DVec3;
use serde_json::Value;

fn fast(map: &LeafMap, recipe: &Recipe) -> Vec<DVec3> {
    let tables = Tables::new(recipe, map.range_mm().unwrap(), map.median_mm().unwrap());
    let coefficients = coefficient_map(map, &tables);
    coefficients.chunks(3).map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]))).collect()
}

/// Gates of translucency.md section 9.
#[test]
fn golden_maps_are_met() {
    let Some(file) = oracle("golden.json") else { return };
    for case in file["cases"].as_array().unwrap() {
        let golden = Golden::of(case);
        let (direct, [inside, anywhere]) = (golden.direct_error(), golden.bank_errors());
        println!("{}: {direct} {inside} {anywhere}", case["name"]);
        assert!(direct <= 2e-3 && inside <= 5e-3 && anywhere <= 4e-2, "{}: {direct} {inside} {anywhere}", case["name"]);
    }
}

/// The gate of the issue: .3 % rms of the mean, for the chosen number of filters, and for more.
#[test]
fn the_bank_meets_the_direct_gather() {
    const PROMISED: f64 = 3e-3;
    let Some(file) = oracle("golden.json") else { return };
    for case in file["cases"].as_array().unwrap().iter().take(2) {
        let Golden { map, recipe, .. } = Golden::of(case);
        let direct = reference::coefficient_map(&map, &recipe);
        for filters in [None, Some(6), Some(9)] {
            let bank = fast(&map, &Recipe { filters, ..recipe.clone() });
            let mean = direct.iter().map(|c| c.length()).sum::<f64>() / direct.len() as f64;
            let squares = direct.iter().zip(&bank).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>();
            let rms = (squares / direct.len() as f64).sqrt() / mean;
            assert!(rms <= PROMISED, "{} with {filters:?} filters: {rms}", case["name"]);
        }
    }
}

/// A flat leaf far from its rim: every coefficient is T v_z / sqrt 3, however light spreads.
#[test]
fn an_even_leaf_has_even_coefficients() {
    let medium = Medium { absorption: 2.341, scattering: 41.75, anisotropy: 0.8, index: 1.474 };
    for texel in [[0.08, 0.08], [0.02, 0.05]] {
        let recipe = Recipe::new(medium, texel);
        let (width, height) = (161, 120);
        let map = LeafMap { width, height, thickness_mm: vec![0.2; width * height], normals: Vec::new() };
        let entrance = recipe.entrance(0.2);
        let projection =
            Projection::new(1.0, Entry::Transport, Fit::Uniform, Curve::STRAIGHT, entrance.knots(), medium.index);
        let exact = entrance.transmittance * projection.vector(&entrance, Entry::Transport)[1] / 3.0f64.sqrt();
        // Weights sum to one, taps to one: what is left is f32, and the light that left through the rim.
        let middle = fast(&map, &recipe)[60 * width + 80];
        assert!((middle / exact - 1.0).abs().max_element() < 2e-5, "{middle} {exact}");
    }
}

/// Encircled energy of a pencil of light against counted photons, at every radius.
#[test]
fn the_spread_meets_counted_photons() {
    // Gate of translucency.md section 9.
    const GATE: f64 = 0.08;
    let Some(file) = oracle("radial.json") else { return };
    let records = file["records"].as_array().unwrap();
    assert_eq!(records.len(), 6);
    for record in records {
        let error = spread_error(record);
        assert!(error <= GATE, "{error} {record}");
    }
}

/// Five directions of light on bumps against counted photons: linear within 21 %, with the curve within 11 %, as measured on
/// a prototype, and 2 % for the photons.
#[test]
fn bumps_meet_counted_photons() {
    let Some(file) = oracle("relief.json") else { return };
    for (group, records) in groups(&file, "relief face") {
        assert_eq!(records.len(), 5, "{group}");
        for (curve, gate) in [(false, 0.23), (true, 0.13)] {
            let error = bumps_error(&records, |recipe| Recipe { curve, ..recipe });
            println!("{group}, curve {curve}: {error}");
            assert!(error <= gate, "{group}, curve {curve}: {error}");
        }
    }
}

/// Bumps on the side where light leaves, lit evenly from straight ahead: the kernel of the thickness where it leaves is
/// within 2 % (translucency.md 3.5), photons add 1.5 %. Anchored: what comes from straight ahead is exact there.
#[test]
fn the_thickness_that_counts_is_where_light_leaves() {
    let Some(file) = oracle("relief.json") else { return };
    for (group, records) in groups(&file, "flat face") {
        let error = bumps_error(&records, |recipe| Recipe { fit: Fit::Anchor, ..recipe });
        println!("{group}: {error}");
        assert!(error <= 0.035, "{group}: {error}");
    }
}

/// Records of relief.json with one side lit, by material and shape.
fn groups<'a>(file: &'a Value, lit: &str) -> Vec<(String, Vec<&'a Value>)> {
    let records = file["records"].as_array().unwrap();
    let name = |r: &Value| format!("{} {}", r["material"].as_str().unwrap(), r["relief"].as_str().unwrap());
    let of = |group: &str| records.iter().filter(|r| name(r) == group && r["lit"] == lit).collect::<Vec<_>>();
    ["typ550 sin", "typ550 vein", "white sin"].map(|group| (group.to_string(), of(group))).to_vec()
}

/// No thread count, and no place in a larger map, changes a bit.
#[test]
fn threads_change_nothing() {
    let (map, recipe) = bumps(70, 45);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| coefficient_map(&map, &Tables::new(&recipe, map.range_mm().unwrap(), map.median_mm().unwrap())))
    };
    let one: Vec<u32> = with(1).iter().map(|v| v.to_bits()).collect();
    for threads in [2, 5] {
        assert_eq!(one, with(threads).iter().map(|v| v.to_bits()).collect::<Vec<_>>());
    }
}

/// Nor do the vector instructions that there are.
#[test]
fn instructions_change_nothing() {
    let (map, recipe) = bumps(70, 45);
    let tables = Tables::new(&recipe, map.range_mm().unwrap(), map.median_mm().unwrap());
    assert!(tables.bank.filters.iter().any(|filter| filter.level > 0), "a halved image is filtered too");
    let bits = |isa| coefficient_map_on(&map, &tables, isa).iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for isa in Isa::available() {
        assert!(bits(isa) == bits(Isa::Plain), "{isa:?}");
    }
}

/// Waves of thickness and tilt with a hole.
fn bumps(width: usize, height: usize) -> (LeafMap, Recipe) {
    let wave = |at: usize, k: f64| libm::sin(k * (at % width) as f64) * libm::cos(k * (at / width) as f64);
    let thickness = |at: usize| if at.is_multiple_of(97) { 0.0 } else { (0.2 + 0.12 * wave(at, 0.3)) as f32 };
    let normal = |at: usize| DVec3::new(wave(at, 0.21), wave(at, 0.37), 1.0).normalize().as_vec3().to_array();
    let map = LeafMap {
        width,
        height,
        thickness_mm: (0..width * height).map(thickness).collect(),
        normals: (0..width * height).map(normal).collect(),
    };
    let medium = Medium { absorption: 6.56, scattering: 34.25, anisotropy: 0.8, index: 1.486 };
    (map, Recipe::new(medium, [0.05, 0.05]))
}

/// Every model, entry and fit, on maps of one texel, one row, one column, and on texels far larger and far smaller than
/// the leaf is thick.
#[test]
fn extremes_make_no_wild_numbers() {
    let cases = [
        ((1, 1), Model::Multipole, Entry::Lambert, Fit::Cosine, [0.001, 0.001]),
        ((1, 9), Model::Diffusion, Entry::Fresnel, Fit::Anchor, [0.05, 0.4]),
        ((9, 1), Model::AddingDoubling, Entry::Transport, Fit::Uniform, [0.001, 0.3]),
        ((33, 17), Model::Multipole, Entry::Transport, Fit::Anchor, [0.05, 0.4]),
        ((33, 17), Model::AddingDoubling, Entry::Transport, Fit::Uniform, [20.0, 20.0]),
    ];
    for ((width, height), model, entry, fit, texel_mm) in cases {
        let (mut map, recipe) = bumps(width, height);
        map.thickness_mm[0] = 0.3;
        let recipe = Recipe { model, entry, fit, texel_mm, curve: entry == Entry::Transport, ..recipe };
        let (range, median) = (map.range_mm().unwrap(), map.median_mm().unwrap());
        let found = coefficient_map(&map, &Tables::new(&recipe, range, median));
        assert!(found.iter().all(|c| c.abs() <= 1.5), "{width} x {height} {recipe:?}");
        // Texels far larger than the leaf is thick: nothing spreads.
        if texel_mm[0] > 1.0 {
            let local = Recipe { spreading: Spreading::None, ..recipe.clone() };
            let local = coefficient_map(&map, &Tables::new(&local, range, median));
            assert!(found.iter().zip(&local).all(|(a, b)| (a - b).abs() < 0.02), "{recipe:?}");
        }
    }
}
