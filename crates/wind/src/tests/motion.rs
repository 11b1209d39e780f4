//! The evaluator against closed forms, and its promises: still air moves nothing, nothing is ever no number, boxes hold.

use super::bark::{bake, noise};
use super::laws::plants;
use crate::motion::{Branch, LeafGust, Vertex, travel};
use crate::{Gust, Player};
use foliar_plant::sample::Recipe;
use glam::{DQuat, DVec2, DVec3};

const UP: Branch = Branch { level: 0, frame: DQuat::IDENTITY, phase: DVec2::ZERO, pivot: DVec3::ZERO };

fn gust() -> Gust {
    Gust { amplitude_m: [2.0, 1.0, 0.0, 0.0], ..Gust::still([2.0, 1.5, 1.5, 1.0], [10.0, 5.0, 1.0, 1.0]) }
}

fn close(a: DVec3, b: DVec3) -> bool {
    // A few roundings of numbers up to ten.
    a.distance(b) < 1e-14 * 10.0
}

#[test]
fn a_branch_swings_across_itself() {
    let wind = Gust { wind: DVec3::new(1.0, 2.0, 5.0), ..gust() };
    // The frame is the world's: right X, up Y, along Z. Wind along the branch does nothing.
    let moved = wind.displacement(&UP, DVec2::new(0.5, -1.0));
    assert!(close(moved, 2.0 * DVec3::new(1.5, 1.0, 0.0)), "{moved}");
    assert_eq!(wind.displacement(&Branch { level: 4, ..UP }, DVec2::ONE), DVec3::ZERO);
}

#[test]
fn weights_bend_by_their_exponents_and_normals_follow() {
    let rest = Vertex { position: DVec3::new(0.0, 0.1, 5.0), normal: DVec3::Y, tangent: DVec3::Z };
    let chain = [DVec3::X * 4.0, DVec3::Y * 2.0, DVec3::ZERO, DVec3::ZERO];
    let moved = gust().bend(&rest, [0.5, 0.25, 0.0, 0.0], chain, Some(&Branch { level: 1, ..UP }));
    // 4 x .5^2 along X, 2 x .25^1.5 along Y.
    assert!(close(moved.position, rest.position + DVec3::new(1.0, 0.25, 0.0)), "{moved:?}");
    // Slope of level 1: 1.5 x .25^.5 / 5 m x 2 m along Y per meter along Z: .3.
    assert!(close(moved.normal, DVec3::new(0.0, 1.0, -0.3).normalize()), "{moved:?}");
    assert!(close(moved.tangent, DVec3::new(0.0, 0.3, 1.0).normalize()), "{moved:?}");
    let deep = gust().bend(&rest, [0.5, 0.25, 0.0, 0.0], chain, Some(&Branch { level: 4, ..UP }));
    assert_eq!((deep.normal, deep.position), (rest.normal, moved.position));
}

#[test]
fn a_kept_length_stays_and_what_is_inherited_is_added() {
    let rest = Vertex { position: DVec3::new(0.0, 3.0, 4.0), normal: DVec3::X, tangent: DVec3::Z };
    let chain = [DVec3::X * 2.0, DVec3::Y * 3.0, DVec3::ZERO, DVec3::ZERO];
    let strong = Gust { keep_length: true, ..gust() };
    let moved = strong.bend(&rest, [1.0, 1.0, 0.0, 0.0], chain, Some(&Branch { level: 1, ..UP }));
    assert!(((moved.position - DVec3::X * 2.0).length() - 5.0).abs() < 1e-13, "{moved:?}");
    let at_pivot = Vertex { position: DVec3::ZERO, ..rest };
    assert!(strong.bend(&at_pivot, [0.0; 4], chain, Some(&UP)).position.is_finite());
}

#[test]
fn a_leaf_turns_into_the_wind_and_its_tip_moves() {
    let rest = Vertex { position: DVec3::new(0.0, 1.0, 0.2), normal: DVec3::Y, tangent: DVec3::Z };
    let leaf = LeafGust { amplitude_m: 0.1, yaw_rad: 0.7, ..LeafGust::default() };
    let wind = Gust { wind: DVec3::X, leaf, ..gust() };
    let (petiole, axis) = (DVec3::Y, DVec3::Z * 0.2);
    let turned = wind.flutter(&rest, 1.0, petiole, axis, DVec2::ZERO).position - petiole;
    // Across the wind of 1: the whole .7 radians, toward X.
    assert!(close(turned, 0.2 * DVec3::new(libm::sin(0.7), 0.0, libm::cos(0.7))), "{turned}");
    let along = wind.flutter(&rest, 1.0, petiole, DVec3::X * 0.2, DVec2::ZERO);
    assert_eq!(along.position, rest.position, "it looks along the wind already");
    let tip = Gust { wind: DVec3::ZERO, ..wind }.flutter(&rest, 0.5, petiole, axis, DVec2::new(1.0, 0.5));
    assert!(close(tip.position - rest.position, DVec3::new(0.05, 0.025, 0.0)), "{tip:?}");
    // Slope .05 / .2 upward along Z: .25.
    assert!(close(tip.normal, DVec3::new(0.0, 1.0, -0.25).normalize()), "{tip:?}");
}

#[test]
fn time_is_folded_without_a_jump() {
    let direction = DVec2::new(1.0, 0.618);
    let (before, after) = (travel(1e6 - 5e-4, 0.05, direction), travel(1e6 + 5e-4, 0.05, direction));
    let step = (after - before + 0.5).fract_gl() - 0.5;
    // Half a millisecond before and after 50,000 tiles: 5e-5 tiles; f64 keeps 1e6 s to 1e-10.
    assert!((step - direction * 5e-5).length() < 1e-9, "{step}");
}

#[test]
fn still_air_keeps_every_bit() {
    let noise = noise();
    for sample in plants() {
        let layer = bake(&sample.plant);
        let player = Player::new(&sample.plant, &layer).unwrap();
        let rest = player.rest();
        // No amplitude; no wind vector; both kept at their length.
        let windy = player.gust(0.0, 3.0, DVec2::ZERO, 1.0);
        for gust in [player.still().clone(), windy.clone(), Gust { keep_length: true, ..windy }] {
            let bits = |list: &[Vec<Vertex>]| {
                let all = list.iter().flatten().flat_map(|v| [v.position, v.normal, v.tangent]);
                all.flat_map(|v| v.to_array().map(f64::to_bits)).collect::<Vec<_>>()
            };
            assert_eq!(bits(&player.moved(&gust, &noise)), bits(&rest), "{}", sample.name);
        }
    }
}

#[test]
fn nothing_is_ever_no_number() {
    let noise = noise();
    for sample in plants() {
        let layer = bake(&sample.plant);
        let player = Player::new(&sample.plant, &layer).unwrap();
        for share in [1e-12, 0.15, 1.0, 1e6] {
            for keep_length in [false, true] {
                let gust = Gust { keep_length, ..player.gust(share, 1e5, DVec2::new(-0.3, 0.2), 1.0) };
                let finite = |v: &Vertex| {
                    v.position.is_finite() && [v.normal, v.tangent].iter().all(|n| (n.length() - 1.0).abs() < 1e-9)
                };
                assert!(player.moved(&gust, &noise).iter().flatten().all(finite), "{} {share}", sample.name);
            }
        }
    }
}

#[test]
fn boxes_grown_by_the_bounds_hold_every_vertex() {
    let plant = Recipe::small().grow();
    let (layer, noise) = (bake(&plant), noise());
    let player = Player::new(&plant, &layer).unwrap();
    let bounds = layer.record.facts["boundsPerAmplitude"]["wood"].as_array().unwrap();
    let rest = player.rest();
    for time in 0..20 {
        let still = LeafGust::default();
        let gust = Gust { leaf: still, ..player.gust(0.15, f64::from(time), DVec2::X, 0.0) };
        let most: f64 = bounds.iter().zip(gust.amplitude_m).map(|(b, a)| b.as_f64().unwrap() * a).sum();
        // A kept length may go round instead of across: the chord of a right angle is sqrt 2 of its sine.
        for (keep_length, most) in [(false, most), (true, most * std::f64::consts::SQRT_2)] {
            let moved = player.moved(&Gust { keep_length, ..gust.clone() }, &noise);
            let ways = moved[0].iter().zip(&rest[0]).map(|(m, r)| m.position.distance(r.position));
            let widest = ways.fold(0.0, f64::max);
            assert!(widest <= most && widest > 0.02 * most, "{widest} of {most}");
        }
    }
}
