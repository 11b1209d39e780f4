//! The fast sums against the reference, on every path.

use super::oracle;
use crate::crown::{Crown, EXACT};
use crate::leaves::{NO_GROUP, Query, Source};
use crate::octants::{OCTANTS, direction};
use crate::profile::{MOST_DEPTH, Profile};
use crate::reference::{self, transmittance};
use crate::ways;
use foliar_numerics::Isa;
use foliar_numerics::{fibonacci_sphere, radical_inverse};
use glam::DVec3;

pub(super) const PROFILES: [Profile; 2] = [Profile::Cap, Profile::Paper];

/// Leaves in a ball of radius 1, so large that the ball's optical depth along its diameter is `thickness`.
pub(super) fn ball(count: usize, thickness: f64) -> Vec<Source> {
    let area = thickness * 4.0 / 3.0 * std::f64::consts::PI / count as f64;
    let source = |i: usize| Source {
        center: fibonacci_sphere(i * 7 % count, count) * libm::cbrt(radical_inverse(i as u64 + 1, 3)),
        normal: fibonacci_sphere(i, count),
        area: area * (0.5 + radical_inverse(i as u64 + 1, 5)),
        group: i as u32,
    };
    (0..count).map(source).collect()
}

pub(super) fn queries(sources: &[Source]) -> Vec<Query> {
    sources.iter().map(|source| Query { position: source.center, skip: source.group }).collect()
}

/// The oracle's tolerance for f32, on transmittance.
fn assert_near(name: &str, fast: &[[f32; OCTANTS]], exact: &[reference::Sum]) {
    for (index, (fast, exact)) in fast.iter().zip(exact).enumerate() {
        for (j, (&depth, &found)) in exact.depth.iter().zip(fast).enumerate() {
            let found = f64::from(found);
            let off = (transmittance(found) - transmittance(depth)).abs();
            assert!(off <= 1e-5 + 1e-4 * depth.min(MOST_DEPTH), "{name}: {index}, {j}: {found}, must be {depth}");
        }
    }
}

#[test]
fn exact_sums_meet_the_reference_on_every_path_with_the_same_bits() {
    let wood = (0..300).map(|i| Query { position: fibonacci_sphere(i, 300) * 0.8, skip: NO_GROUP });
    for (profile, thickness) in PROFILES.into_iter().flat_map(|p| [(p, 0.1), (p, 2.0), (p, 30.0)]) {
        let sources = ball(700, thickness);
        let queries: Vec<Query> = queries(&sources).into_iter().chain(wood.clone()).collect();
        let exact = reference::sums(&sources, &queries, profile);
        let crown = Crown::new(&sources, profile);
        let plain = crown.depths(&queries, EXACT, Isa::Plain);
        assert_near(&format!("{profile:?} {thickness}"), &plain, &exact);
        for isa in Isa::available() {
            for opening in [EXACT, 0.5] {
                let [a, b] = [isa, Isa::Plain].map(|isa| crown.depths(&queries, opening, isa));
                assert!(a == b, "{isa:?} rounds otherwise than the plain path");
            }
        }
    }
}

#[test]
fn the_oracles_sets_come_out_of_the_fast_sums_too() {
    let Some(oracle) = oracle::oracle() else { return };
    for value in ["bake_small", "bake_degenerate"].iter().flat_map(|key| oracle[key].as_array().unwrap()) {
        let set = oracle::set(value).normalized();
        let queries = queries(&set.sources);
        for (profile, mode) in [(Profile::Paper, "iso_hard"), (Profile::Cap, "cap_soft")] {
            let fast = Crown::new(&set.sources, profile).depths(&queries, EXACT, Isa::best());
            for (index, depths) in fast.iter().enumerate() {
                for (j, depth) in oracle::numbers(&value["modes"][mode]["D"][index]).into_iter().enumerate() {
                    let off = (transmittance(f64::from(depths[j])) - transmittance(depth)).abs();
                    assert!(off <= 1e-5 + 1e-4 * depth, "{} {mode} {index} {j}: {depth}, {}", set.name, depths[j]);
                }
            }
        }
    }
}

#[test]
fn the_tree_is_the_nearer_the_more_it_opens() {
    for profile in PROFILES {
        let sources = ball(5000, 3.0);
        let queries = queries(&sources);
        let crown = Crown::new(&sources, profile);
        let exact = crown.depths(&queries, EXACT, Isa::best());
        let error = |opening: f64| {
            let fast = crown.depths(&queries, opening, Isa::best());
            let pairs = fast.as_flattened().iter().zip(exact.as_flattened());
            let (off, all) =
                pairs.fold((0.0, 0.0), |(off, all), (a, b)| (off + f64::from((a - b).abs()), all + f64::from(*b)));
            off / all
        };
        let errors = [0.7, 0.5, 0.3, 0.2].map(error);
        eprintln!("{profile:?}: {errors:?}");
        assert!(errors.is_sorted_by(|a, b| a > b) && errors[0] < 0.02 && errors[3] < 0.002, "{errors:?}");
    }
}

#[test]
fn the_whole_group_is_left_out_however_far_its_leaves() {
    let mut sources = ball(400, 2.0);
    for leaf in &mut sources[300..] {
        leaf.group = 300;
    }
    let queries = queries(&sources);
    for profile in PROFILES {
        let exact = reference::sums(&sources, &queries, profile);
        let crown = Crown::new(&sources, profile);
        assert_near("groups", &crown.depths(&queries, EXACT, Isa::best()), &exact);
        let own = sources[350].center;
        let alone = [Query { position: own, skip: 300 }];
        let only: Vec<Source> = sources[300..].to_vec();
        assert_eq!(Crown::new(&only, profile).depths(&alone, 0.7, Isa::best()), [[0.0; OCTANTS]]);
    }
}

#[test]
fn ways_and_extinction_are_those_of_the_reference() {
    for (profile, thickness) in PROFILES.into_iter().flat_map(|p| [(p, 0.1), (p, 30.0)]) {
        let sources = ball(700, thickness);
        let queries = queries(&sources);
        let exact = reference::sums(&sources, &queries, profile);
        let crown = Crown::new(&sources, profile);
        for (query, sum) in queries.iter().zip(&exact) {
            for (j, way) in crown.ways(query).into_iter().enumerate() {
                // Widths of slabs are f32 in the tree: a leaf that touches a plane may fall on either side of it.
                assert!(
                    (way.max(0.0) - sum.far[j]).abs() < 1e-6 && (way >= 0.0) == (sum.count[j] > 0),
                    "{way} {sum:?}"
                );
            }
        }
        let area = reference::mean_area(&sources);
        let depths = crown.depths(&queries, EXACT, Isa::best());
        let (fast, slow) = (ways::extinction(&crown, &queries, &depths, area), reference::extinction(&exact, area));
        assert!((fast / slow - 1.0).abs() < 1e-5, "{fast} {slow}");
    }
}

#[test]
fn the_48_turns_and_mirrors_of_a_cube_permute_the_octants() {
    // A flat canopy with leaves exactly on each other's planes, and a ball.
    let lattice = (0..49).map(|i| DVec3::new(f64::from(i % 7), 0.0, f64::from(i / 7)) / 6.0);
    let leaf = |(i, center): (usize, DVec3)| Source { center, normal: DVec3::Y, area: 0.01, group: i as u32 };
    let flat: Vec<Source> = lattice.enumerate().map(leaf).collect();
    for (profile, sources) in PROFILES.into_iter().flat_map(|p| [(p, flat.clone()), (p, ball(300, 2.0))]) {
        let home = Crown::new(&sources, profile).depths(&queries(&sources), EXACT, Isa::best());
        for (axes, signs) in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]]
            .into_iter()
            .flat_map(|axes| (0..8usize).map(move |signs| (axes, signs)))
        {
            let sign = |axis: usize| if signs & (1 << axis) == 0 { 1.0 } else { -1.0 };
            let turn = |v: DVec3| DVec3::from_array([0, 1, 2].map(|axis| sign(axis) * v[axes[axis]]));
            let turned: Vec<Source> = sources.iter().map(|s| Source { center: turn(s.center), ..*s }).collect();
            let found = Crown::new(&turned, profile).depths(&queries(&turned), EXACT, Isa::best());
            for (a, b) in home.iter().zip(&found) {
                for (j, depth) in a.iter().enumerate() {
                    let there = turn(direction(j));
                    let k = (0..OCTANTS).find(|k| direction(*k).dot(there) > 0.99).unwrap();
                    let off = (depth - b[k]).abs();
                    assert!(off <= 1e-4 * (1.0 + depth), "{profile:?} {axes:?} {signs}: {depth} became {}", b[k]);
                }
            }
        }
    }
}
