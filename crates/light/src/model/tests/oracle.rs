//! Every run-time value of the oracle, in f64.

use crate::model::{Leaf, Light, Optics, Sides, Sky, Slant, Sun, Tree, boulanger08, light, octant_cosines};
use crate::testing::{list, number, numbers, optics, oracle, vector};
use serde_json::Value;

/// The oracle's own tolerance, relative (light.md section 9), and rounding of numbers near 0.
const CLOSE: f64 = 1e-10;
const ROUNDING: f64 = 3e-15;
/// What the oracle's octant integrals are good to: one of 4.4e-11 is 3e-14 off what 50 digits give.
const OCTANT: f64 = 5e-14;

fn near(what: &str, found: f64, expected: f64) {
    let off = (found - expected).abs();
    assert!(off <= CLOSE * expected.abs() + ROUNDING, "{what}: {found} is not {expected}, off by {off:e}");
}

fn both(what: &str, found: Sides, expected: &Value, leaf: usize) {
    near(what, found.front, number(&expected[leaf][0]));
    near(what, found.back, number(&expected[leaf][1]));
}

struct Case<'a> {
    value: &'a Value,
    optics: Optics,
    sky: Sky,
    leaves: Vec<Leaf>,
}

impl Case<'_> {
    fn new(value: &Value) -> Case<'_> {
        let leaf = |(d, n): (&Value, &Value)| Leaf::new(numbers(d), vector(n)).unwrap();
        let leaves = list(&value["D"]).iter().zip(list(&value["N"])).map(leaf).collect();
        let sky = Sky::new(numbers(&value["Lsky"])).unwrap();
        Case { value, optics: optics(&value["mat_rf_rb_tf_tb"]), sky, leaves }
    }

    fn field(&self, name: &str) -> f64 {
        number(&self.value[name])
    }
}

#[test]
fn the_papers_model_is_the_oracles() {
    let Some(oracle) = oracle() else { return };
    let mut compared = 0;
    for value in list(&oracle["runtime"]) {
        let case = Case::new(value);
        let tree = Tree::new(case.field("tau"), case.field("rho"), case.field("A")).unwrap();
        for sun in list(&value["suns"]) {
            let sun_given = Sun::new(vector(&sun["wl"]), 1.0).unwrap();
            for (i, leaf) in case.leaves.iter().enumerate() {
                let found = boulanger08(leaf, &case.optics, &tree, &sun_given, &case.sky);
                near("E_sun_front", found.sun.front, number(&sun["E_sun_front"][i]));
                near("E_sun_back", found.sun.back, number(&sun["E_sun_back"][i]));
                near("E_ind_front", found.sun_indirect.front, number(&sun["E_ind_front"][i]));
                near("E_ind_back", found.sun_indirect.back, number(&sun["E_ind_back"][i]));
                near("E_sky_front", found.sky.front, number(&value["E_sky_front"][i]));
                near("E_sky_back", found.sky.back, number(&value["E_sky_back"][i]));
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 2 * 9 * 16);
}

#[test]
fn the_papers_terms_are_the_oracles() {
    let Some(oracle) = oracle() else { return };
    for value in list(&oracle["runtime"]) {
        let case = Case::new(value);
        let (tau, rho) = (case.field("tau"), case.field("rho"));
        for sun in list(&value["suns"]) {
            let slant = Slant::new(vector(&sun["wl"]).normalize());
            near("G2", tau / slant.sum, number(&sun["G2"]));
            for j in 0..8 {
                near("G1", rho / 2.0 * slant.phase(&case.optics, j), number(&sun["G1"][j]));
                near("G3", tau * slant.fading[j], number(&sun["G3"][j]));
            }
            for (i, leaf) in case.leaves.iter().enumerate() {
                near("smax_wl", slant.mean(&leaf.depths()) / tau, number(&sun["smax_wl"][i]));
            }
        }
        for (i, leaf) in case.leaves.iter().enumerate() {
            let cosines = octant_cosines(leaf.normal());
            for j in 0..8 {
                let exact = number(&value["K_oct"][i][j]);
                assert!((cosines[j] - exact).abs() <= CLOSE * exact + OCTANT, "{} is not {exact}", cosines[j]);
            }
        }
    }
}

#[test]
fn the_default_model_is_the_oracles() {
    let Some(oracle) = oracle() else { return };
    for value in list(&oracle["runtime"]) {
        let case = Case::new(value);
        for sun in list(&value["suns"]) {
            let sun_given = Sun::new(vector(&sun["wl"]), 1.0).unwrap();
            for (i, leaf) in case.leaves.iter().enumerate() {
                let found: Light = light(leaf, &case.optics, &sun_given, &case.sky);
                both("sky", found.sky, &sun["plus"]["sky"], i);
                both("sun", found.sun, &sun["plus"]["sun"], i);
                both("ind", found.sun_indirect, &sun["plus"]["ind"], i);
                both("skyind", found.sky_indirect, &sun["plus"]["skyind"], i);
                let radiance = case.optics.radiance(found.total());
                near("Lo_plus_front", radiance.front, number(&sun["Lo_plus_front"][i]));
            }
        }
    }
}
