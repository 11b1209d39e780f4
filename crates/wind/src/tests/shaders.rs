//! The shader includes, run by `foliar-shader-test`, against the evaluator on vertices of a real bake.

use super::bark::{bake, noise};
use crate::motion::{Branch, Vertex};
use crate::{Gust, Player};
use foliar_plant::sample::{Recipe, hard_tree};
use foliar_plant::{NO_BRANCH, Plant};
use foliar_shader_test::{Shader, Value};
use glam::{DQuat, DVec2, DVec3};

fn shaders() -> [Shader; 2] {
    [
        Shader::wgsl(include_str!("../../shaders/foliar_wind.wgsl")).unwrap(),
        Shader::glsl(include_str!("../../shaders/foliar_wind.glsl")).unwrap(),
    ]
}

fn vec2(v: DVec2) -> Value {
    v.as_vec2().to_array().into()
}

fn vec3(v: DVec3) -> Value {
    v.as_vec3().to_array().into()
}

fn four(v: [f64; 4]) -> Value {
    v.map(|x| x as f32).into()
}

fn frame(q: DQuat) -> Value {
    four(q.to_array())
}

fn vertex(v: &Vertex) -> Value {
    Value::list([vec3(v.position), vec3(v.normal), vec3(v.tangent)])
}

/// What the f64 evaluator is given: the same numbers, rounded as the shader gets them.
fn rounded(v: &Vertex) -> Vertex {
    let round = |v: DVec3| v.as_vec3().as_dvec3();
    Vertex { position: round(v.position), normal: round(v.normal), tangent: round(v.tangent) }
}

fn branch(branch: Option<&Branch>, longest: [f64; 4]) -> Value {
    match branch {
        Some(b) if b.level < 4 => {
            Value::list([(b.level as i32).into(), (longest[b.level] as f32).into(), frame(b.frame), vec3(b.pivot)])
        }
        _ => Value::list([(-1).into(), 0.0f32.into(), frame(DQuat::IDENTITY), vec3(DVec3::ZERO)]),
    }
}

/// Largest difference of place over the plant's size and of directions; rounding some twenty times at 6e-8 of the size
/// or of a power of a weight, whose logarithm is off by 2e-7 at most.
const CLOSE: f64 = 4e-6;

fn compare(what: &str, size: f64, shader: &Value, exact: &Vertex) {
    let all = shader.floats().unwrap();
    let at = |k: usize| DVec3::new(f64::from(all[k]), f64::from(all[k + 1]), f64::from(all[k + 2]));
    let found = Vertex { position: at(0), normal: at(3), tangent: at(6) };
    assert!(found.position.distance(exact.position) <= CLOSE * size, "{what}: {found:?} {exact:?}");
    let off = found.normal.distance(exact.normal).max(found.tangent.distance(exact.tangent));
    assert!(off <= CLOSE * 10.0, "{what}: {found:?} {exact:?}");
}

fn plants() -> [Plant; 2] {
    [hard_tree("crooked", 1).unwrap().plant, Recipe::small().grow()]
}

fn gusts(player: &Player) -> Vec<Gust> {
    let strong = player.gust(0.15, 3.3, DVec2::new(0.6, -0.8), 0.4);
    vec![
        player.gust(0.02, 11.0, DVec2::X, 0.0),
        Gust { keep_length: true, ..strong.clone() },
        Gust { exponents: [1.0, 3.3, 2.0, 1.5], ..strong.clone() },
        strong,
    ]
}

#[test]
fn branches_bend_as_the_evaluator_says() {
    let (shaders, noise) = (shaders(), noise());
    for plant in plants() {
        let layer = bake(&plant);
        let player = Player::new(&plant, &layer).unwrap();
        let (rest, size) = (player.rest(), plant.size().max_element());
        let places = &plant.branches().unwrap().vertices[0];
        for gust in gusts(&player) {
            let displacements = player.displacements(&gust, &noise);
            for v in (0..places.len()).step_by(1 + places.len() / 200).filter(|v| places[*v].branch != NO_BRANCH) {
                let row = &plant.branches().unwrap().rows[places[v].branch as usize];
                let chain =
                    row.chain.map(|id| displacements.get(id as usize).map_or(DVec3::ZERO, |d| d.as_vec3().as_dvec3()));
                let (rest, own) = (rounded(&rest[0][v]), &player.branches()[places[v].branch as usize]);
                let weights = player.weights[0][v].map(f64::from);
                let exact = gust.bend(&rest, weights, chain, Some(own));
                let arguments = [
                    vertex(&rest),
                    four(weights),
                    four(gust.exponents),
                    Value::list(chain.map(vec3)),
                    branch(Some(own), gust.longest_m),
                    gust.keep_length.into(),
                ];
                for shader in &shaders {
                    compare("bend", size, &shader.call("foliar_bend", &arguments).unwrap(), &exact);
                }
            }
        }
    }
}

#[test]
fn displacements_and_places_are_the_evaluators() {
    let (shaders, noise) = (shaders(), noise());
    let plant = &plants()[0];
    let layer = bake(plant);
    let player = Player::new(plant, &layer).unwrap();
    for (gust, b) in gusts(&player).iter().flat_map(|g| player.branches().iter().step_by(7).map(move |b| (g, b))) {
        let amplitude = gust.amplitude_m.get(b.level).copied().unwrap_or(0.0);
        let place = gust.noise_place(b);
        let exact = gust.displacement(b, noise.at(place));
        for shader in &shaders {
            let arguments = [frame(b.frame), (amplitude as f32).into(), vec2(noise.at(place)), vec3(gust.wind)];
            let found = shader.call("foliar_displacement", &arguments).unwrap().floats().unwrap();
            let off = (0..3).map(|k| (f64::from(found[k]) - exact[k]).abs()).fold(0.0, f64::max);
            assert!(off <= CLOSE * amplitude, "{found:?} {exact:?}");
            let travel = gust.travel[b.level.min(3)];
            let found = shader.call("foliar_noise_place", &[vec2(b.phase), vec2(travel)]).unwrap().floats().unwrap();
            // Around the edge of the tile 0 and 1 are one place.
            let off = |k: usize| (f64::from(found[k]) - place[k] + 0.5).rem_euclid(1.0) - 0.5;
            assert!(off(0).abs().max(off(1).abs()) < CLOSE, "{found:?} {place}");
        }
    }
}

#[test]
fn leaves_flutter_as_the_evaluator_says() {
    let (shaders, noise) = (shaders(), noise());
    let plant = &plants()[1];
    let layer = bake(plant);
    let player = Player::new(plant, &layer).unwrap();
    let (part, rest) = (1, player.rest());
    for gust in gusts(&player) {
        for v in (0..rest[part].len()).step_by(1 + rest[part].len() / 200) {
            let Some(leaf) = plant.leaf_of(part, v) else { continue };
            let rest = rounded(&rest[part][v]);
            let petiole = plant.leaves()[leaf as usize].petiole.as_dvec3();
            let axis = player.axes()[leaf as usize].as_vec3().as_dvec3();
            let weight = f64::from(player.leaf_weights[part][v]);
            let noise = noise.at(gust.leaf_noise_place(petiole)).as_vec2().as_dvec2();
            let exact = gust.flutter(&rest, weight, petiole, axis, noise);
            let arguments = [
                vertex(&rest),
                (weight as f32).into(),
                vec3(petiole),
                vec3(axis),
                vec2(noise),
                vec3(gust.wind),
                (gust.leaf.amplitude_m as f32).into(),
                (gust.leaf.yaw_rad as f32).into(),
            ];
            for shader in &shaders {
                let found = shader.call("foliar_flutter", &arguments).unwrap();
                compare("flutter", plant.size().max_element(), &found, &exact);
            }
        }
    }
}

#[test]
fn four_bilinear_taps_are_the_spline() {
    let (shaders, noise) = (shaders(), noise());
    let size = noise.size() as f64;
    let bilinear = |place: DVec2| {
        let texels = place * size - 0.5;
        let (cell, part) = (texels.floor(), texels - texels.floor());
        let at = |dx: i64, dy: i64| noise.texel(cell.x as i64 + dx, cell.y as i64 + dy);
        at(0, 0).lerp(at(1, 0), part.x).lerp(at(0, 1).lerp(at(1, 1), part.x), part.y)
    };
    for k in 0..300 {
        let place = foliar_numerics::r2_point(k);
        for shader in &shaders {
            let taps = shader.call("foliar_taps", &[vec2(place), (size as f32).into()]).unwrap().floats().unwrap();
            let [lx, ly, hx, hy, sx, sy] = [0, 1, 2, 3, 4, 5].map(|i| f64::from(taps[i]));
            let row = |y: f64| bilinear(DVec2::new(lx, y)).lerp(bilinear(DVec2::new(hx, y)), sx);
            let found = row(ly).lerp(row(hy), sy);
            // Places of taps are f32 of a tile: 6e-8 of 64 texels, each with a slope of about 1.
            assert!(found.distance(noise.at(place)) < 2e-5, "{place}: {found} {}", noise.at(place));
        }
    }
}

#[test]
fn still_air_keeps_every_bit_in_shaders_too() {
    let rest = Vertex { position: DVec3::new(-0.0, 1.1, 3e7), normal: DVec3::Y, tangent: DVec3::X };
    let own = branch(Some(&Branch { level: 1, frame: DQuat::IDENTITY, phase: DVec2::ZERO, pivot: DVec3::Z }), [1.0; 4]);
    for shader in &shaders() {
        for keep in [false, true] {
            let none = Value::list([DVec3::ZERO; 4].map(vec3));
            let arguments =
                [vertex(&rest), four([0.5, 0.0, 1.0, 0.3]), four([2.0, 1.5, 1.5, 1.0]), none, own.clone(), keep.into()];
            let bits = |v: &Value| v.floats().unwrap().into_iter().map(f32::to_bits).collect::<Vec<_>>();
            assert_eq!(bits(&shader.call("foliar_bend", &arguments).unwrap()), bits(&vertex(&rest)));
        }
        let arguments = [
            vertex(&rest),
            1.0f32.into(),
            vec3(DVec3::X),
            vec3(DVec3::Y),
            vec2(DVec2::ONE),
            vec3(DVec3::ZERO),
            0.0f32.into(),
            2.0f32.into(),
        ];
        assert_eq!(shader.call("foliar_flutter", &arguments).unwrap(), vertex(&rest));
    }
}
