//! Maps against golden.json, radial.json and relief.json, and the fast way against the direct gather.

use super::{number, oracle};
use crate::kernel::Spread;
use crate::light::{Curve, Entry, Fit, Projection, vector};
use crate::map::{LeafMap, Model, Recipe, Spreading, Tables, coefficient_map, reference};
use crate::transport::{Boundary, Medium};
use foliar_numerics::gauss_legendre;
use glam::DVec3;
use serde_json::Value;

fn medium(record: &Value) -> Medium {
    Medium {
        absorption: number(record, "sigma_a"),
        scattering: number(record, "sigma_s"),
        anisotropy: number(record, "g"),
        index: number(record, "eta"),
    }
}

fn floats(rows: &Value) -> Vec<f64> {
    rows.as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap()).map(|v| v.as_f64().unwrap()).collect()
}

fn golden(case: &Value) -> (LeafMap, Recipe, Vec<DVec3>) {
    let triples = |rows: &Value| floats(rows).chunks(3).map(|v| DVec3::new(v[0], v[1], v[2])).collect::<Vec<_>>();
    let mask = floats(&case["mask"]);
    let map = LeafMap {
        width: number(case, "width") as usize,
        height: number(case, "height") as usize,
        thickness_mm: floats(&case["thickness_mm"]).iter().zip(&mask).map(|(d, m)| (d * m) as f32).collect(),
        normals: triples(&case["normal_xyz"]).iter().map(|n| n.as_vec3().to_array()).collect(),
    };
    let texel = &case["texel_mm"];
    let recipe = Recipe {
        entry: if case["angular"] == "lambert" { Entry::Lambert } else { Entry::Transport },
        curve: case["curve"].as_bool().unwrap(),
        ..Recipe::new(medium(case), [texel[0].as_f64().unwrap(), texel[1].as_f64().unwrap()])
    };
    (map, recipe, triples(&case["hl2"]))
}

fn fast(map: &LeafMap, recipe: &Recipe) -> Vec<DVec3> {
    let tables = Tables::new(recipe, map.range_mm().unwrap(), map.median_mm().unwrap());
    let coefficients = coefficient_map(map, &tables);
    coefficients.chunks(3).map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]))).collect()
}

/// Largest difference of a coefficient over the largest coefficient, among the texels that count.
fn worst(ours: &[DVec3], theirs: &[DVec3], counts: impl Fn(usize) -> bool) -> f64 {
    let top = theirs.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
    let off = |i: usize| (ours[i] - theirs[i]).abs().max_element();
    (0..ours.len()).filter(|i| counts(*i)).map(off).fold(0.0, f64::max) / top
}

/// Gates of translucency.md section 9.
#[test]
fn golden_maps_are_met() {
    let Some(file) = oracle("golden.json") else { return };
    for case in file["cases"].as_array().unwrap() {
        let (map, recipe, theirs) = golden(case);
        let (width, height) = (map.width, map.height);
        let leaf = |i: usize| map.thickness_mm[i] > 0.0;
        let direct = reference::coefficient_map(&map, &recipe);
        let inside = |i: usize| {
            let (x, y) = ((i % width) as i64, (i / width) as i64);
            (-6..=6).all(|dy| {
                (-6..=6).all(|dx| {
                    let (x, y) = (x + dx, y + dy);
                    x >= 0 && y >= 0 && x < width as i64 && y < height as i64 && leaf(y as usize * width + x as usize)
                })
            })
        };
        let bank = fast(&map, &recipe);
        let errors = [worst(&direct, &theirs, leaf), worst(&bank, &theirs, inside), worst(&bank, &theirs, leaf)];
        println!("{}: {errors:?}", case["name"]);
        assert!(errors[0] <= 2e-3 && errors[1] <= 5e-3 && errors[2] <= 4e-2, "{}: {errors:?}", case["name"]);
    }
}

/// The gate of the issue: .3 % rms of the mean, for any number of filters from the default on.
#[test]
fn the_bank_meets_the_direct_gather() {
    const PROMISED: f64 = 3e-3;
    let Some(file) = oracle("golden.json") else { return };
    for case in file["cases"].as_array().unwrap().iter().take(2) {
        let (map, recipe, _) = golden(case);
        let direct = reference::coefficient_map(&map, &recipe);
        for filters in [recipe.filters, recipe.filters + 3] {
            let bank = fast(&map, &Recipe { filters, ..recipe.clone() });
            let mean = direct.iter().map(|c| c.length()).sum::<f64>() / direct.len() as f64;
            let squares = direct.iter().zip(&bank).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>();
            let rms = (squares / direct.len() as f64).sqrt() / mean;
            assert!(rms <= PROMISED, "{} with {filters} filters: {rms}", case["name"]);
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

/// Encircled energy of a pencil of light against counted photons.
#[test]
fn the_spread_meets_counted_photons() {
    // Gate of translucency.md section 9.
    const GATE: f64 = 0.08;
    let Some(file) = oracle("radial.json") else { return };
    for record in file["records"].as_array().unwrap() {
        let medium = medium(record);
        let d = number(record, "d");
        let spread = Spread::diffusion(&medium, d, &Boundary::new(medium.index));
        // What no wave resolves lies at the entry itself.
        let point = spread.at(1e6);
        let radii: Vec<f64> = record["r"].as_array().unwrap().iter().map(|r| r.as_f64().unwrap()).collect();
        let seen: Vec<f64> = record["E"].as_array().unwrap().iter().map(|e| e.as_f64().unwrap()).collect();
        let waves: Vec<(f64, f64)> =
            gauss_legendre(600, 0.0, 60.0 / d).into_iter().map(|(q, w)| (q, w * (spread.at(q) - point))).collect();
        for (r, seen) in radii.iter().zip(seen).step_by(3) {
            let energy: f64 = waves.iter().map(|(q, part)| part * r * libm::j1(q * r)).sum();
            assert!((energy + point - seen).abs() <= GATE, "r {r}: {} {seen} {medium:?}", energy + point);
        }
    }
}

/// Three periods of a relief, wide enough across that the rim does not tell.
fn relief(record: &Value) -> (LeafMap, f64) {
    let period = number(record, "period_mm");
    let knots: Vec<f64> = record["h_knots_mm"].as_array().unwrap().iter().map(|h| h.as_f64().unwrap()).collect();
    let (bins, height) = (64, 96);
    let texel = period / bins as f64;
    // A bin is the mean of its two segments.
    let h = |bin: usize| (knots[2 * bin] + 2.0 * knots[2 * bin + 1] + knots[2 * bin + 2]) / 4.0;
    let slope = |bin: usize| (knots[2 * bin + 2] - knots[2 * bin]) / texel;
    let normal = |bin: usize| {
        if record["lit"] == "flat face" { DVec3::Z } else { DVec3::new(-slope(bin), 0.0, 1.0).normalize() }
    };
    let texels = || (0..3 * bins * height).map(|at| at % bins);
    let map = LeafMap {
        width: 3 * bins,
        height,
        thickness_mm: texels().map(|bin| h(bin) as f32).collect(),
        normals: texels().map(|bin| normal(bin).as_vec3().to_array()).collect(),
    };
    (map, texel)
}

/// Five directions of light on bumps against counted photons: linear within 21 %, with the curve within 11 %, as measured on
/// a prototype, and 2 % for the photons.
#[test]
fn bumps_meet_counted_photons() {
    let Some(file) = oracle("relief.json") else { return };
    let records = file["records"].as_array().unwrap();
    for curve in [false, true] {
        for group in ["typ550 sin", "typ550 vein", "white sin"] {
            let of =
                |r: &&Value| format!("{} {}", r["material"].as_str().unwrap(), r["relief"].as_str().unwrap()) == group;
            let lit = records.iter().filter(of).filter(|r| r["lit"] == "relief face");
            let (mut squares, mut total, mut baked) = (0.0, 0.0, None);
            for record in lit {
                let (map, texel) = relief(record);
                let recipe = Recipe { curve, ..Recipe::new(medium(record), [texel; 2]) };
                // One map serves all five directions.
                let (tables, found) = baked.get_or_insert_with(|| {
                    let tables = Tables::new(&recipe, map.range_mm().unwrap(), map.median_mm().unwrap());
                    let found = coefficient_map(&map, &tables);
                    (tables, found)
                });
                let light: Vec<f64> = record["light"].as_array().unwrap().iter().map(|l| l.as_f64().unwrap()).collect();
                let light = DVec3::new(light[0], light[1], light[2]);
                for (bin, seen) in record["M_over_E"].as_array().unwrap().iter().enumerate() {
                    let at = 3 * (48 * map.width + 64 + bin);
                    let c = DVec3::new(f64::from(found[at]), f64::from(found[at + 1]), f64::from(found[at + 2]));
                    let ours = (vector(c).dot(light) * tables.curve.at(light.z)).max(0.0);
                    let seen = seen.as_f64().unwrap();
                    (squares, total) = (squares + (ours - seen).powi(2), total + seen * seen);
                }
            }
            let (error, gate) = ((squares / total).sqrt(), if curve { 0.13 } else { 0.23 });
            println!("{group}, curve {curve}: {error}");
            assert!(error <= gate, "{group}, curve {curve}: {error}");
        }
    }
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
