//! The evaluator by closed forms, and the shader includes, run by `foliar-shader-test`, against it on a real bake.

use crate::light::{Curve, coefficients};
use crate::map::{Recipe, Tables, by_rule::leaf_by_rule, coefficient_map};
use crate::presets::Preset;
use crate::runtime::{decoded, lit_direction, transmitted, transmitted_diffuse, weights};
use foliar_numerics::{gauss_legendre, r2_point};
use foliar_shader_test::{Shader, Value};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

fn shaders() -> [Shader; 2] {
    [
        Shader::wgsl(include_str!("../../shaders/foliar_translucency.wgsl")).unwrap(),
        Shader::glsl(include_str!("../../shaders/foliar_translucency.glsl")).unwrap(),
    ]
}

fn vec3(v: DVec3) -> Value {
    v.as_vec3().to_array().into()
}

fn vec2(curve: Curve) -> Value {
    [curve.offset as f32, curve.slope as f32].into()
}

/// The same numbers as the shader gets.
fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

/// Directions all around, in front and behind.
fn lights() -> impl Iterator<Item = DVec3> {
    (0..60).map(|k| {
        let place = r2_point(k);
        let (z, angle) = (2.0 * place.x - 1.0, TAU * place.y);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z)
    })
}

/// Some texels of a baked leaf with their curve.
fn baked() -> (Vec<DVec3>, Curve) {
    let leaf = leaf_by_rule(64);
    let medium = Preset::named("typical").unwrap().medium(550.0).unwrap();
    let recipe = Recipe { curve: true, ..Recipe::new(medium, [leaf.texel_mm; 2]) };
    let tables = Tables::new(&recipe, leaf.back.range_mm().unwrap(), leaf.back.median_mm().unwrap());
    let found = coefficient_map(&leaf.back, &tables);
    let texels = found.chunks(3).map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2])));
    (texels.filter(|c| c.length() > 0.0).step_by(37).collect(), tables.curve)
}

/// Rounding of four products and their sum, of a size that is at most 1.5 (f32: 6e-8 each).
const CLOSE: f64 = 1e-6;

fn compare(what: &str, shader: &Shader, arguments: &[Value], exact: &[f64]) {
    let found = shader.call(what, arguments).unwrap().floats().unwrap();
    assert_eq!(found.len(), exact.len());
    for (a, b) in found.iter().zip(exact) {
        assert!((f64::from(*a) - b).abs() <= CLOSE, "{what}: {found:?} {exact:?}");
    }
}

#[test]
fn shaders_do_as_the_evaluator() {
    let (texels, curve) = baked();
    let curve = Curve { offset: f64::from(curve.offset as f32), slope: f64::from(curve.slope as f32) };
    assert!(texels.len() > 10 && curve != Curve::STRAIGHT);
    for (c, light) in texels.iter().zip((0..).flat_map(|_| lights())) {
        let (c, light) = (rounded(*c), rounded(light));
        for shader in &shaders() {
            let exact = transmitted(c, light, curve);
            compare("foliar_transmitted", shader, &[vec3(c), vec3(light), vec2(curve)], &[exact]);
            compare("foliar_translucency_weights", shader, &[vec3(light)], &weights(light).to_array());
            let diffuse = transmitted_diffuse(c, curve);
            compare("foliar_transmitted_diffuse", shader, &[vec3(c), vec2(curve)], &[diffuse]);
            let curves = Value::list([vec2(Curve::STRAIGHT), vec2(curve), vec2(curve)]);
            let turned = DVec3::new(c.y, c.z, c.x);
            let bands = [transmitted(turned, light, Curve::STRAIGHT), exact, transmitted(-c, light, curve)];
            let arguments = [vec3(turned), vec3(c), vec3(-c), vec3(light), curves];
            compare("foliar_transmitted_rgb", shader, &arguments, &bands);
        }
    }
}

#[test]
fn shaders_decode_and_turn_light_as_the_evaluator() {
    for (i, light) in lights().enumerate() {
        let light = rounded(light);
        let [t, b, n] = [DVec3::new(0.8, 0.0, 0.6), DVec3::Y, DVec3::new(0.6, 0.0, -0.8)].map(rounded);
        let texel = rounded(DVec3::new(i as f64 / 255.0, 0.3, 1.0));
        let (scale, bias) = (rounded(DVec3::new(0.21, 0.5, 0.125)), rounded(DVec3::new(-0.04, 0.0, -0.1)));
        for shader in &shaders() {
            let exact = lit_direction(light, t, b, n).to_array();
            compare("foliar_lit_direction", shader, &[vec3(light), vec3(t), vec3(b), vec3(n)], &exact);
            let exact = decoded(texel, scale, bias).to_array();
            compare("foliar_translucency_decoded", shader, &[vec3(texel), vec3(scale), vec3(bias)], &exact);
        }
    }
}

/// Coefficients of a vector are a clamped cosine about it; light on the seen side gives nothing.
#[test]
fn the_evaluator_is_a_clamped_linear_function() {
    let v = DVec3::new(0.5, -0.2, 0.1);
    let curve = Curve { offset: 0.3, slope: 0.6 };
    for light in lights() {
        let exact = if light.z > 0.0 { v.dot(light).max(0.0) * (0.3 + 0.6 * light.z) } else { 0.0 };
        assert!((transmitted(coefficients(v), light, curve) - exact).abs() < 1e-15);
    }
}

/// Even light is the mean over directions, weighted by their cosines: where nothing is clamped, to rounding.
#[test]
fn even_light_is_the_mean_of_all() {
    let c = coefficients(DVec3::new(0.0, 0.0, 0.7));
    let curve = Curve { offset: 0.3, slope: 0.6 };
    let all = gauss_legendre(8, 0.0, 1.0);
    let sum: f64 =
        all.iter().map(|(z, w)| w * TAU * transmitted(c, DVec3::new(0.0, (1.0 - z * z).sqrt(), *z), curve)).sum();
    // t is over the irradiance of a plane that faces the light: even radiance 1/pi has irradiance 1 behind the leaf.
    assert!((sum / PI - transmitted_diffuse(c, curve)).abs() < 1e-14);
}

/// The frame of a map, on either side of a leaf that lies anyhow: a bump that leans right and up in the image is
/// brightest for light from there, whichever side is seen.
#[test]
fn either_side_sees_light_from_behind() {
    let (tangent, bitangent) = (DVec3::new(0.0, 0.0, -1.0), DVec3::X);
    let front = tangent.cross(bitangent);
    let bump = coefficients(DVec3::new(0.4, 0.2, 0.6));
    for seen in [front, -front] {
        let toward = |x: f64, y: f64, z: f64| (tangent * x + bitangent * y - seen * z).normalize();
        let answer = |light| transmitted(bump, lit_direction(light, tangent, bitangent, seen), Curve::STRAIGHT);
        assert!(answer(toward(0.4, 0.2, 0.6)) > answer(toward(-0.4, 0.2, 0.6)));
        assert!(answer(toward(0.4, 0.2, 0.6)) > answer(toward(0.4, -0.2, 0.6)));
        assert!(answer(toward(0.0, 0.0, -1.0)) <= 0.0);
    }
}
