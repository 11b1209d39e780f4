//! Bad and extreme input: an error with name and remedy, or a finite number.

use crate::model::{Leaf, ModelError, Optics, Sides, Sky, Sun, Tree, boulanger08, light, light_sh};
use crate::testing::{depths, directions};
use glam::DVec3;

fn message<T: std::fmt::Debug>(result: Result<T, ModelError>, words: &[&str]) {
    let message = result.unwrap_err().to_string();
    assert!(words.iter().all(|word| message.contains(word)), "{message}");
}

#[test]
fn what_cannot_be_lit_is_refused_by_name_with_a_remedy() {
    message(Sun::new(DVec3::ZERO, 1.0), &["direction of the sun", "longer than 0", "irradiance of 0"]);
    message(Sun::new(DVec3::new(0.0, f64::NAN, 1.0), 1.0), &["direction of the sun"]);
    message(Sun::new(DVec3::new(f64::INFINITY, 0.0, 1.0), 1.0), &["direction of the sun"]);
    message(Sun::new(DVec3::Y, -1.0), &["irradiance of the sun = -1", "0 or above"]);
    message(Sun::new(DVec3::Y, f64::NAN), &["irradiance of the sun = NaN"]);
    let mut radiance = [1.0; 8];
    radiance[3] = f64::INFINITY;
    message(Sky::new(radiance), &["radiance of an octant = inf"]);
    message(Sky::even(-0.1, 0.0), &["radiance of an octant = -0.1"]);
    let mut bad = [0.0; 8];
    bad[6] = -1e-9;
    message(Leaf::new(bad, DVec3::Y), &["optical depth 6 = -0.000000001", "bake the light room again"]);
    bad[6] = f64::NAN;
    message(Leaf::new(bad, DVec3::Y), &["optical depth 6 = NaN"]);
    message(Leaf::new([0.0; 8], DVec3::ZERO), &["normal of the leaf", "triangle"]);
    message(Optics::new(Sides::both(0.6), Sides { front: 0.3, back: 0.5 }), &["back", "0.6", "0.5", "at most 1"]);
    message(Optics::new(Sides { front: -0.1, back: 0.0 }, Sides::both(0.0)), &["reflectance of the front = -0.1"]);
    message(Optics::new(Sides::both(0.0), Sides { front: 0.0, back: 1.5 }), &["transmittance of the back", "share"]);
    message(Optics::new(Sides::both(f64::NAN), Sides::both(0.0)), &["reflectance of the front = NaN"]);
    message(Tree::new(-1.0, 1.0, 1.0), &["tau = -1"]);
    message(Tree::new(1.0, f64::NAN, 1.0), &["leaf density = NaN"]);
    message(Tree::new(1.0, 1.0, f64::INFINITY), &["mean leaf area = inf"]);
    message(Tree::new(1e-300, 1e300, 1.0), &["leaf density x area / tau = inf"]);
}

/// Every sun and every normal that stands exactly on, or a hair off, a border of octants.
fn edges() -> Vec<DVec3> {
    let steps = [0.0, -0.0, 1.0, -1.0, 1e-9, -1e-9, 1e-160, -1e-300, 1e150];
    let all = steps.iter().flat_map(|&x| steps.iter().flat_map(move |&y| steps.map(|z| DVec3::new(x, y, z))));
    all.filter(|v| v.abs().max_element() > 0.0).collect()
}

#[test]
fn every_direction_gives_finite_light() {
    let optics = Optics::new(Sides::both(0.5), Sides::both(0.5)).unwrap();
    let sky = Sky::even(1.0, 0.2).unwrap();
    for (index, &v) in edges().iter().enumerate() {
        let sun = Sun::new(v, 1.0).unwrap();
        let leaf = Leaf::new(depths(index as u64), -v).unwrap();
        assert!((leaf.normal().length() - 1.0).abs() < 1e-15 && (sun.toward().length() - 1.0).abs() < 1e-15);
        for found in [light(&leaf, &optics, &sun, &sky), boulanger08(&leaf, &optics, &Tree::CONSISTENT, &sun, &sky)] {
            let total = found.total();
            assert!(
                total.front.is_finite() && total.back.is_finite() && total.front >= 0.0 && total.back >= 0.0,
                "{v}"
            );
        }
    }
}

#[test]
fn extremes_of_depth_and_optics_give_finite_light() {
    let sky = Sky::even(1.0, 0.2).unwrap();
    let shares = [0.0, 1e-300, 0.3, 0.5, 1.0];
    let mut all = Vec::new();
    for (r, t) in shares.iter().flat_map(|&r| shares.map(|t| (r, t))).filter(|(r, t)| r + t <= 1.0) {
        all.push(Optics::new(Sides::both(r), Sides::both(t)).unwrap());
    }
    for depth in [0.0, 5e-324, 1e-17, 1e-8, 1.0, 16.0, 1e6, f64::MAX, f64::INFINITY] {
        for (optics, normal) in all.iter().zip(directions(all.len() as u64)) {
            for (leaf, sun) in [[depth; 8], [depth, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]]
                .map(|depths| Leaf::new(depths, normal).unwrap())
                .into_iter()
                .zip([0.0, 1e-300].map(|e| Sun::new(normal, e + 1.0).unwrap()))
            {
                let found = light(&leaf, optics, &sun, &sky);
                let tree = Tree::new(0.0, 3.0, 1.0).unwrap();
                let paper = boulanger08(&leaf, optics, &tree, &sun, &sky);
                for sides in [found.total(), paper.total(), light_sh(&leaf, &[1e30; 9], optics, &sun, &sky).total()] {
                    // The darkest crown of the whitest leaves: 1 / (1 - p) = e^16.
                    assert!(sides.front.is_finite() && sides.front <= 2e8, "{depth} {optics:?} {sides:?}");
                    assert!(sides.back.is_finite() && sides.front >= 0.0 && sides.back >= 0.0);
                }
            }
        }
    }
}

#[test]
fn a_leaf_alone_gets_all_of_the_sun_and_no_bounce() {
    let leaf = Leaf::new([0.0; 8], DVec3::Y).unwrap();
    let optics = Optics::new(Sides::both(0.3), Sides::both(0.3)).unwrap();
    let sun = Sun::new(DVec3::new(0.0, 3.0, 0.0), 5.0).unwrap();
    let found = light(&leaf, &optics, &sun, &Sky::even(1.0, 0.0).unwrap());
    assert_eq!((found.sun.front, found.sun.back), (5.0, 0.0));
    assert_eq!((found.sun_indirect, found.sky_indirect), (Sides::default(), Sides::default()));
    assert!((found.sky.front - std::f64::consts::PI).abs() < 1e-14 && found.sky.back.abs() < 1e-14);
}
