//! Against oracles/density.json: volumes, necks, nearest points.

use super::*;
use serde_json::Value;

/// The reference values; `None`, said so, where there are none.
fn oracles() -> Option<Value> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var("FOLIAR_SHARED").unwrap_or_else(|_| beside.into());
    let text = std::fs::read_to_string(format!("{folder}/oracles/density.json")).ok();
    if text.is_none() {
        eprintln!("skipped: oracles/density.json, no shared data");
    }
    text.map(|text| serde_json::from_str(&text).unwrap())
}

fn vector(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|k| value[k].as_f64().unwrap()))
}

#[test]
fn volumes_and_areas_of_single_balls() {
    let Some(oracles) = oracles() else { return };
    for row in oracles["single_ball"].as_array().unwrap() {
        let number = |name: &str| row[name].as_f64();
        let (weight, rho, tau) = (number("w").unwrap(), number("rho").unwrap(), number("tau").unwrap());
        let generators = [ball(DVec3::ZERO, weight)];
        let balls = Balls { generators: &generators, radius_m: rho, threshold: tau };
        if tau <= 0.0 {
            assert!(matches!(extract_fast(&balls, &cell(rho / 8.0)), Err(SurfaceError::Parameter { .. })));
            continue;
        }
        let Some(radius) = number("r").filter(|&r| r > 0.0) else {
            // A point, which may be missed or be one corner's, or nothing.
            let cells = exact_surface(balls, &cell(rho / 8.0));
            assert!(pieces(&cells).iter().all(|p| p.volume < 1e-9 * rho.powi(3)), "w {weight}, tau {tau}");
            continue;
        };
        // A polyhedron with corners on a sphere and edges up to h sqrt(3) long lies within h^2 3 / (8 r) of it.
        let step = radius / 6.0;
        let surface = exact_surface(balls, &cell(step.min(rho)));
        assert_sound(&surface);
        let list = pieces(&surface);
        assert_eq!((list.len(), list[0].euler()), (1, 2));
        let sagitta = 3.0 * step * step / (8.0 * radius * radius);
        let (volume, area) = (number("volume").unwrap(), number("area").unwrap());
        assert!((list[0].volume / volume - 1.0).abs() < 3.0 * sagitta, "w {weight}, tau {tau}: {:?}", list[0]);
        assert!((list[0].area / area - 1.0).abs() < 2.0 * sagitta, "w {weight}, tau {tau}: {:?}", list[0]);
    }
}

#[test]
fn two_balls_part_at_the_neck() {
    let Some(oracles) = oracles() else { return };
    for row in oracles["two_balls"].as_array().unwrap() {
        let number = |name: &str| row[name].as_f64();
        let (rho, distance, most) = (number("rho").unwrap(), number("s").unwrap(), number("S_max").unwrap());
        let generators = [-0.5, 0.5].map(|k| ball(DVec3::new(k * distance, 0.0, 0.0), 1.0));
        let count = |threshold: f64| {
            let balls = Balls { generators: &generators, radius_m: rho, threshold };
            let surface = exact_surface(balls, &cell(rho / 48.0));
            assert_sound(&surface);
            pieces(&surface).len()
        };
        match number("tau_neck") {
            None => assert_eq!(count(0.9 * most), 1, "{row}"),
            Some(neck) if neck > 0.0 => {
                assert_eq!(count(0.99 * neck), 1, "{row}");
                let middle = number("S_mid").unwrap().min(1.0);
                // A third piece floats in the middle up to S_mid; one of less than .005 may fall between cells.
                let (above, expected) = if middle > neck + 0.01 { (middle, 3) } else { (1.0, 2) };
                assert_eq!(count(neck.midpoint(above)), expected, "{row}");
            }
            Some(_) => assert_eq!(count(0.1), 2, "{row}"),
        }
        assert_eq!(count(1.01 * most), 0, "{row}");
    }
}

#[test]
fn nearest_points_and_normals() {
    let Some(oracles) = oracles() else { return };
    for set in oracles["nearest"].as_array().unwrap() {
        let weight = |i: usize| set["weights"][i].as_f64().unwrap_or(1.0);
        let places = set["generators"].as_array().unwrap();
        let generators: Vec<Generator> = places.iter().enumerate().map(|(i, p)| ball(vector(p), weight(i))).collect();
        let (radius_m, threshold) = (set["rho"].as_f64().unwrap(), set["tau"].as_f64().unwrap());
        let balls = Balls { generators: &generators, radius_m, threshold };
        let step = radius_m / 32.0;
        let surface = exact_surface(balls, &cell(step));
        let queries = set["queries"].as_array().unwrap();
        let asked: Vec<DVec3> = queries.iter().map(|q| vector(&q["q"])).collect();
        let feet = nearest(&surface, &Exact(balls), &asked).unwrap();
        let mut compared = 0;
        for (query, foot) in queries.iter().zip(&feet) {
            if query["gap"].as_f64().is_some_and(|gap| gap < 0.02 * radius_m) {
                continue;
            }
            compared += 1;
            let point = foot.point.as_dvec3() + surface.origin;
            // The mesh is off by h^2 / 8 of curvature, the foot then slides by about a cell where
            // the surface bends as the query's distance does.
            let off = point.distance(vector(&query["p"]));
            assert!(off < 2.0 * step, "{} {query}: off by {off}", set["name"]);
            let distance = point.distance(vector(&query["q"]));
            assert!((distance - query["distance"].as_f64().unwrap()).abs() < 0.1 * step, "{query}: {distance}");
            let cosine = foot.normal.as_dvec3().dot(vector(&query["normal"]));
            assert!(cosine > 0.98, "{} {query}: cosine {cosine}", set["name"]);
        }
        assert!(2 * compared > queries.len());
    }
}
