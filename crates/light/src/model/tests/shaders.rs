//! The shader includes, run by `foliar-shader-test`, against the evaluator: depths of the oracle and depths without pattern.

use crate::model::{Leaf, Optics, Sides, Sky, Slant, Sun, harmonic_transmittance, light, light_sh, octant_cosines};
use crate::octants::OCTANTS;
use crate::testing::{depths, directions, list, numbers, oracle};
use foliar_shader_test::{Shader, Value};
use glam::DVec3;

/// What f32 is to keep of f64 (light.md section 9).
const CLOSE: f64 = 1e-5;

fn shaders() -> [Shader; 2] {
    [
        Shader::wgsl(include_str!("../../../shaders/foliar_light.wgsl")).unwrap(),
        Shader::glsl(include_str!("../../../shaders/foliar_light.glsl")).unwrap(),
    ]
}

fn vec3(v: DVec3) -> Value {
    v.as_vec3().to_array().into()
}

fn octants(values: [f64; OCTANTS]) -> Value {
    let four = |first: usize| -> Value { std::array::from_fn::<f32, 4, _>(|k| values[first + k] as f32).into() };
    Value::list([four(0), four(4)])
}

/// Red, green and blue of a leaf, of the sun and of the sky.
struct Given {
    optics: [Optics; 3],
    sun_light: DVec3,
    sky: [[f64; OCTANTS]; 3],
}

impl Given {
    fn new() -> Given {
        let optics =
            |rf, rb, tf, tb| Optics::new(Sides { front: rf, back: rb }, Sides { front: tf, back: tb }).unwrap();
        Given {
            optics: [optics(0.09, 0.12, 0.05, 0.04), optics(0.3, 0.35, 0.3, 0.28), optics(0.0, 0.0, 0.0, 0.0)],
            sun_light: DVec3::new(3.0, 2.8, 2.5),
            sky: [
                [0.1, 0.2, 0.15, 0.1, 0.9, 1.0, 1.1, 0.8],
                [0.2, 0.2, 0.2, 0.2, 1.0, 1.0, 1.0, 1.0],
                [0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 2.0, 0.1],
            ],
        }
    }

    fn values(&self) -> [Value; 3] {
        let each = |of: &dyn Fn(&Optics) -> f64| vec3(DVec3::from_array([0, 1, 2].map(|c| of(&self.optics[c]))));
        let optics = Value::list([
            each(&|o| o.reflectance().front),
            each(&|o| o.reflectance().back),
            each(&|o| o.transmittance().front),
            each(&|o| o.transmittance().back),
        ]);
        let sky = (0..OCTANTS).map(|j| vec3(DVec3::from_array([0, 1, 2].map(|c| self.sky[c][j]))));
        [optics, vec3(self.sun_light), Value::list([Value::list(sky)])]
    }
}

/// Depths as a file holds them.
fn cases() -> Vec<[f64; OCTANTS]> {
    let mut all: Vec<[f64; OCTANTS]> = (0..40).map(depths).collect();
    all.extend([[0.0; OCTANTS], [1e-4; OCTANTS], [16.0; OCTANTS], [100.0; OCTANTS]]);
    if let Some(oracle) = oracle() {
        for scene in list(&oracle["monte_carlo"]) {
            all.extend(list(&scene["model_vs_truth"]["cap_soft"]["D_first8"]).iter().map(numbers::<OCTANTS>));
        }
    }
    all.into_iter().map(|row| row.map(|d| f64::from(d as f32))).collect()
}

fn close(what: &str, found: f32, exact: f64, scale: f64) {
    let off = (f64::from(found) - exact).abs();
    assert!(off <= CLOSE * exact.abs() + 1e-7 * scale, "{what}: {found} is not {exact}");
}

#[test]
fn shaders_light_leaves_as_the_evaluator_does() {
    let (shaders, given) = (shaders(), Given::new());
    let [optics, sun_light, sky] = given.values();
    for (index, (row, toward)) in cases().into_iter().zip(directions(60)).enumerate() {
        let round = |v: DVec3| v.as_vec3().as_dvec3();
        let (toward, normal) = (round(toward), round(directions(60).nth((7 * index + 3) % 60).unwrap()));
        let leaf = Leaf::new(row, normal).unwrap();
        let slant = Slant::new(toward);
        for shader in &shaders {
            let call = |name: &str, given: &[Value]| shader.call(name, given).unwrap();
            let sun = call("foliar_light_sun", &[vec3(toward)]);
            let part = call("foliar_sun_transmittance", &[octants(row), sun.clone()]);
            let transmittance = part.floats().unwrap()[0];
            close("transmittance", transmittance, slant.mean(&leaf.transmittances()), 0.0);
            let arguments =
                [octants(row), vec3(normal), optics.clone(), sun, transmittance.into(), sun_light.clone(), sky.clone()];
            let lit = call("foliar_light", &arguments);
            let found = lit.floats().unwrap();
            let radiance = call("foliar_radiance", &[lit, optics.clone()]).floats().unwrap();
            for c in 0..3 {
                let (sun, sky) = (Sun::new(toward, given.sun_light[c]).unwrap(), Sky::new(given.sky[c]).unwrap());
                let exact = light(&leaf, &given.optics[c], &sun, &sky).total();
                // What no leaf hides is the scale of the rounding: octants that the horizon all but hides.
                let scale = leaf.transmittances().iter().fold(0.0, |a: f64, b| a.max(*b)) * 10.0;
                close("front", found[c], exact.front, scale);
                close("back", found[3 + c], exact.back, scale);
                let exact = given.optics[c].radiance(exact);
                close("radiance of the front", radiance[c], exact.front, scale);
                close("radiance of the back", radiance[3 + c], exact.back, scale);
            }
        }
    }
}

#[test]
fn shaders_know_the_cosines_and_the_nine_numbers() {
    let given = [0.5, 0.1, -0.2, 0.15, 0.05, -0.1, 0.08, 0.02, -0.04];
    let leaf = Leaf::new([1.0; OCTANTS], DVec3::Y).unwrap();
    let dark = Optics::new(Sides::both(0.0), Sides::both(0.0)).unwrap();
    let sky = Sky::even(0.0, 0.0).unwrap();
    for shader in &shaders() {
        for d in directions(100).chain([DVec3::X, DVec3::NEG_Z, DVec3::new(0.6, 0.0, -0.8)]) {
            let d = d.as_vec3().as_dvec3();
            let found = shader.call("foliar_octant_cosines", &[vec3(d)]).unwrap().floats().unwrap();
            octant_cosines(d).iter().zip(found).for_each(|(exact, found)| close("cosine", found, *exact, 3.0));
            let arguments = [given.map(|c| c as f32).into(), vec3(d)];
            let found = shader.call("foliar_sun_transmittance_sh", &arguments).unwrap().floats().unwrap()[0];
            close("nine numbers", found, harmonic_transmittance(&given, d), 5.0);
            let up = light_sh(&leaf, &given, &dark, &Sun::new(DVec3::new(d.x, d.y.abs(), d.z), 1.0).unwrap(), &sky);
            assert!(up.sun.front <= 1.0);
        }
    }
}
