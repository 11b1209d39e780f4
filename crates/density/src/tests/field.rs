//! Laws of the density itself: derivative, integral, monotony, order of instructions, tessellation, rotation.

use super::plants::{Quad, crown, halton, in_ball, plant};
use crate::{BALL_INTEGRAL, Field, Foliage, Generator, Isa, NO_GROUP, Params, Query, ambient_coefficient, reference};
use foliar_plant::sample::Recipe;
use foliar_plant::{Plant, Structure};
use glam::{DAffine3, DQuat, DVec3};

fn balls(count: usize) -> Vec<Generator> {
    let weight = |i: usize| 0.25 + (i % 7) as f32 / 4.0;
    in_ball(count).enumerate().map(|(i, position)| Generator { position, weight: weight(i), group: i as u32 }).collect()
}

fn queries(count: u64) -> Vec<Query> {
    (0..count).map(|i| Query { position: halton(i * 7 + 1) * 1.3, skip: i as u32 % 500 }).collect()
}

#[test]
fn the_fast_field_is_within_its_bound_at_every_vertex_of_a_tree() {
    const BOUND: f64 = 1e-6;
    let plant = Recipe::small().grow();
    let foliage = Foliage::new(&plant, &[], &Params::default());
    let places = crate::fast::Places::new(&plant, &Params::default());
    let samples = Field::new(&foliage.generators, foliage.radius).samples(&places.queries);
    for (sample, query) in samples.iter().zip(&places.queries) {
        let exact = reference::field(&foliage.generators, foliage.radius, query);
        // Skipped balls stand in no sum; a place with none in reach is exactly 0.
        let bound = BOUND * exact.weight;
        assert!((f64::from(sample.density) - exact.density).abs() <= bound, "{sample:?} {exact:?}");
        let slope = (sample.gradient.as_dvec3() - exact.gradient).abs().max_element();
        assert!(slope <= bound * 4.0 / foliage.radius, "{sample:?} {exact:?}");
    }
}

/// Nobody may be able to tell by the numbers which places all balls reach: half of these, or all.
#[test]
fn moments_of_all_balls_meet_the_reference() {
    let balls: Vec<Generator> =
        balls(3000).into_iter().map(|ball| Generator { group: ball.group / 3, ..ball }).collect();
    for radius in [1.9, 2.3, 4.0, 1e4] {
        let field = Field::new(&balls, radius);
        let queries: Vec<Query> = queries(400);
        for (sample, query) in field.samples(&queries).iter().zip(&queries) {
            let exact = reference::field(&balls, radius, query);
            let bound = 1e-6 * exact.weight;
            assert!((f64::from(sample.density) - exact.density).abs() <= bound, "{radius}: {sample:?} {exact:?}");
            let slope = (sample.gradient.as_dvec3() - exact.gradient).abs().max_element();
            assert!(slope <= bound * 4.0 / radius, "{radius}: {sample:?} {exact:?}");
            assert!((field.exact(query).0 - exact.density).abs() <= 1e-12 * exact.weight, "{radius} in f64");
        }
        let looked_at: usize = queries.iter().map(|query| field.exact(query).1).sum();
        assert_eq!(looked_at == 0, radius > 3.0, "{radius}: {looked_at} balls one by one");
    }
    let one_group: Vec<Generator> = balls.iter().map(|ball| Generator { group: 7, ..*ball }).collect();
    let own = Query { position: DVec3::ZERO, skip: 7 };
    assert_eq!(Field::new(&one_group, 4.0).samples(&[own])[0], crate::Sample::default(), "exactly nothing");
}

#[test]
fn all_instructions_give_the_same_bits() {
    let (balls, queries) = (balls(3000), queries(3000));
    let plain = Field::new(&balls, 0.3).on(Isa::Plain).samples(&queries);
    for isa in Isa::available() {
        assert!(plain == Field::new(&balls, 0.3).on(isa).samples(&queries), "{isa:?}");
        let densities = Field::new(&balls, 0.3).on(isa).densities(&queries);
        assert!(
            plain.iter().zip(densities).all(|(s, d)| s.density.to_bits() == d.to_bits()),
            "{isa:?} without gradient"
        );
    }
}

#[test]
fn a_query_does_not_depend_on_its_company() {
    let (balls, queries) = (balls(1000), queries(400));
    let field = Field::new(&balls, 0.3);
    let together = field.samples(&queries);
    for (query, sample) in queries.iter().zip(together) {
        assert_eq!(field.samples(&[*query])[0], sample);
    }
}

#[test]
fn the_gradient_is_the_derivative() {
    const STEP: f64 = 1e-5;
    let (balls, radius) = (balls(300), 0.5);
    for query in queries(50) {
        let sample = reference::field(&balls, radius, &query);
        for axis in 0..3 {
            let along = |h: f64| {
                let position = query.position + DVec3::AXES[axis] * h;
                reference::field(&balls, radius, &Query { position, ..query }).density
            };
            let slope = (along(STEP) - along(-STEP)) / (2.0 * STEP);
            // Relative to the largest slope that the weights in reach could make; the central difference itself
            // is off by STEP^2 / 6 times third derivatives of some 50 / radius^3.
            let scale = 4.0 / radius * (sample.weight + 1.0);
            assert!((slope - sample.gradient[axis]).abs() <= 1e-6 * scale, "{query:?}");
        }
    }
}

#[test]
fn the_integral_of_one_ball_is_32_pi_over_105_radii_cubed() {
    const CELLS: i32 = 60;
    let (radius, ball) = (0.7, [Generator { position: DVec3::ZERO, weight: 1.0, group: 0 }]);
    let step = 2.0 * radius / f64::from(CELLS);
    let middle = |i: i32| (f64::from(i) + 0.5) * step - radius;
    let mut sum = 0.0;
    for (x, y) in (0..CELLS).flat_map(|x| (0..CELLS).map(move |y| (x, y))) {
        for z in 0..CELLS {
            let position = DVec3::new(middle(x), middle(y), middle(z));
            sum += reference::field(&ball, radius, &Query { position, skip: NO_GROUP }).density * step * step * step;
        }
    }
    // The midpoint rule of a function with a continuous slope: better than (step / radius)^2.
    let tolerance = (step / radius).powi(2);
    assert!((sum / radius.powi(3) / BALL_INTEGRAL - 1.0).abs() < tolerance, "{sum}");
}

#[test]
fn one_more_ball_never_lowers_the_density() {
    let (mut balls, queries) = (balls(400), queries(400));
    let before = Field::new(&balls, 0.4).densities(&queries);
    balls.push(Generator { position: DVec3::new(0.1, -0.2, 0.3), weight: 0.7, group: 9999 });
    let after = Field::new(&balls, 0.4).densities(&queries);
    assert!(before.iter().zip(&after).all(|(b, a)| *b >= 0.0 && a >= b));
    assert!(before.iter().zip(&after).any(|(b, a)| a > b));
}

#[test]
fn k_a_falls_with_density() {
    let values: Vec<f64> = (-10..60).map(|i| ambient_coefficient(f64::from(i) * 0.05, 2.0, 0.1, 3.0)).collect();
    assert!(values.windows(2).all(|w| w[1] <= w[0]));
    assert!(values.first().is_some_and(|v| *v >= 1.0) && values.last().is_some_and(|v| *v <= 0.1));
}

/// The same square as `parts` by `parts` quads.
fn square(parts: u32) -> Plant {
    let whole = plant(&[Quad { center: DVec3::ZERO, edge: 2.0, normal: DVec3::Z }], 3, DAffine3::IDENTITY);
    let (mut base, structure) = (whole.base().clone(), whole.structure().clone());
    let corners = base.parts[0].positions.clone();
    let place = |i: u32| {
        corners[0]
            + (corners[1] - corners[0]) * (i % (parts + 1)) as f32 / parts as f32
            + (corners[3] - corners[0]) * (i / (parts + 1)) as f32 / parts as f32
    };
    let count = (parts + 1) * (parts + 1);
    let part = &mut base.parts[0];
    part.positions = (0..count).map(place).collect();
    part.normals = vec![part.normals[0]; count as usize];
    part.position_ids = (0..count).collect();
    part.triangles = (0..parts * parts)
        .map(|q| q / parts * (parts + 1) + q % parts)
        .flat_map(|q| [[q, q + 1, q + parts + 2], [q, q + parts + 2, q + parts + 1]])
        .collect();
    base.parts[1].position_ids = (count..count + 3).collect();
    base.position_count = count + 3;
    let leaf_ids = vec![vec![0; count as usize], structure.leaf_ids[1].clone()];
    Plant::new(base, Structure { leaf_ids, ..structure }).unwrap()
}

#[test]
fn how_a_leaf_is_cut_into_triangles_does_not_matter() {
    let densities = |parts: u32, radius: f64| {
        let foliage = Foliage::new(&square(parts), &[], &Params { radius_m: Some(radius), ..Params::default() });
        let total: f64 = foliage.generators.iter().map(|g| f64::from(g.weight)).sum();
        assert!((total - 1.0).abs() < 1e-6, "weights sum to {total}");
        let queries: Vec<Query> = queries(200).iter().map(|q| Query { skip: NO_GROUP, ..*q }).collect();
        Field::new(&foliage.generators, radius).densities(&queries)
    };
    // One ball for the leaf: the table's center, whatever the triangles.
    assert_eq!(densities(1, 3.0), densities(5, 3.0));
    // Many balls: pieces are a ninth of the radius wide at most, which moves area by half of that at the edge of
    // a voxel; the peak of the density is the share of the leaf within reach, pi r^2 / 3 of 4.
    let (few, many) = (densities(1, 0.5), densities(5, 0.5));
    let peak = few.iter().copied().fold(0.0, f32::max);
    let worst = few.iter().zip(&many).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(peak > 0.05 && worst < 0.03 * peak, "{worst} of {peak}");
}

#[test]
fn k_a_is_the_same_under_rotation() {
    // A quality that only the exact field keeps.
    let params = Params { ambient: crate::AmbientTerm::Luft, quality: Some(1e-3), ..Params::default() };
    let ambient = |plant: &Plant| {
        let foliage = Foliage::new(plant, &[], &params);
        crate::fast::values(plant, &foliage, &crate::fast::Places::new(plant, &params), &params).unwrap().ambient
    };
    let upright = crown(500, 2.0, 0.08, 30);
    let turn = DAffine3::from_quat(DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 0.5).normalize(), 0.8));
    let (mut base, mut structure) = (upright.base().clone(), upright.structure().clone());
    base.parts.iter_mut().for_each(|part| part.transform = turn * part.transform);
    structure.leaves.iter_mut().for_each(|l| l.center = turn.transform_point3(l.center.as_dvec3()).as_vec3());
    let turned = Plant::new(base, structure).unwrap();
    let worst = ambient(&upright).iter().zip(ambient(&turned)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    // Centers are rounded to f32 after the turn: 1e-7 of 2 m in a radius of .4 m, through slopes of order 10.
    assert!(worst < 1e-4, "{worst}");
}
