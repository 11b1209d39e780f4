//! What the model must do whatever the leaf: closed forms, energy, symmetry.

use crate::harmonics;
use crate::model::{
    Leaf, Light, Optics, Sides, Sky, Slant, Sun, Tree, boulanger08, harmonic_transmittance, light, light_sh,
    octant_cosines,
};
use crate::octants::direction;
use crate::testing::{depths, directions};
use foliar_numerics::gauss_legendre;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Some sums of a dozen terms of about 1.
const ROUNDING: f64 = 1e-14;

fn leaf_optics() -> Optics {
    Optics::new(Sides { front: 0.3, back: 0.35 }, Sides::both(0.3)).unwrap()
}

#[test]
fn cosines_of_all_octants_are_those_of_a_half_space() {
    for normal in directions(2000).chain([DVec3::X, DVec3::NEG_Y, DVec3::new(1.0, 0.0, 1.0).normalize()]) {
        let front = octant_cosines(normal);
        let back = octant_cosines(-normal);
        assert!((front.iter().sum::<f64>() - PI).abs() < ROUNDING, "{normal}");
        for j in 0..8 {
            // Signed: an octant's own vector irradiance is pi/4 along each axis.
            let signed = PI / 4.0 * normal.dot(direction(j)) * 3f64.sqrt();
            assert!((front[j] - back[j] - signed).abs() < ROUNDING && front[j] >= 0.0, "{normal} {j}");
        }
    }
}

#[test]
fn cosines_are_what_quadrature_finds() {
    // Over z and the angle about it, with the horizon's crossing as a node's border in neither: 1e-5 is what a
    // kinked integrand leaves of 200 x 200 nodes.
    let (heights, turns) = (gauss_legendre(200, 0.0, 1.0), gauss_legendre(200, 0.0, FRAC_PI_2));
    for normal in directions(17) {
        for j in 0..8 {
            let n = normal * direction(j).signum();
            let at = |z: f64, turn: f64| {
                let ring = (1.0 - z * z).sqrt();
                n.dot(DVec3::new(ring * libm::cos(turn), ring * libm::sin(turn), z)).max(0.0)
            };
            let sum: f64 =
                heights.iter().map(|(z, w)| w * turns.iter().map(|(t, v)| v * at(*z, *t)).sum::<f64>()).sum();
            assert!((octant_cosines(normal)[j] - sum).abs() < 2e-5, "{normal} {j}: {sum}");
        }
    }
}

#[test]
fn slivers_of_an_octant_keep_their_digits() {
    // A normal nearly along -z sees of the octant above no more than pi/4 (x^2 + y^2) + x y.
    let small = 1e-9;
    let n = DVec3::new(small, 2.0 * small, -1.0);
    let exact = (PI / 4.0 * 5.0 + 2.0) * small * small / 2.0;
    assert!((octant_cosines(n.normalize())[7] / exact - 1.0).abs() < 1e-6);
    // A normal that all but turns its back on an octant: 50 digits of the same formula.
    let n = DVec3::new(0.0004976574862234018, -0.8179168865057561, -0.5753361792080839);
    assert!((octant_cosines(n)[7] / 4.365252980234068e-11 - 1.0).abs() < 1e-6);
}

#[test]
fn slants_stay_in_their_ranges() {
    for toward in directions(5000) {
        let slant = Slant::new(toward);
        assert!((1.632..2.3095).contains(&slant.sum), "{}", slant.sum);
        assert!((slant.weights.iter().sum::<f64>() - 1.0).abs() < ROUNDING);
        assert!(slant.fading.iter().all(|f| (1.0 / 3.0 - ROUNDING..5.0 / 3.0 + ROUNDING).contains(f)));
        // G1 is a phase function taken at eight middles: exact over the sphere, within 5 % here.
        let sum = (0..8).map(|j| slant.phase(&leaf_optics(), j)).sum::<f64>();
        assert!((sum / leaf_optics().albedo() - 1.0).abs() < 0.05, "{sum}");
    }
}

#[test]
fn the_phase_function_sends_on_what_leaves_scatter() {
    // Over all angles a between sun and neighbor, 8 phase(a) averages the albedo.
    let optics = leaf_optics();
    let at = |a: f64| {
        let (rho_tau, tau) = (1.25, 0.6);
        (rho_tau * (libm::sin(a) - a * libm::cos(a)) + PI * tau * libm::cos(a)) * 4.0 / (3.0 * PI)
    };
    let sum: f64 = gauss_legendre(40, 0.0, PI).iter().map(|(a, w)| w * at(*a) * libm::sin(*a) / 2.0).sum();
    assert!((sum / optics.albedo() - 1.0).abs() < 1e-12, "{sum}");
    let toward = DVec3::new(0.3, 0.9, -0.2).normalize();
    for j in 0..8 {
        let angle = libm::acos(toward.dot(direction(j)));
        assert!((8.0 * Slant::new(toward).phase(&optics, j) - at(angle)).abs() < ROUNDING * 10.0);
    }
}

#[test]
fn a_white_crown_under_an_even_sky_is_as_bright_as_the_sky() {
    // The furnace: leaves that lose nothing, the same sky everywhere. What one octant hides the others' bounces return.
    let white = Optics::new(Sides::both(0.4), Sides::both(0.6)).unwrap();
    let sky = Sky::even(1.0, 1.0).unwrap();
    for depth in [0.0, 0.1, 2.0, 16.0, f64::INFINITY] {
        for normal in directions(20) {
            let leaf = Leaf::new([depth; 8], normal).unwrap();
            let found = light(&leaf, &white, &Sun::new(DVec3::Y, 0.0).unwrap(), &sky).total();
            assert!((found.front / PI - 1.0).abs() < 1e-8 && (found.back / PI - 1.0).abs() < 1e-8, "{depth} {found:?}");
        }
    }
}

#[test]
fn slices_add_up_to_the_closed_form() {
    // The integral that eq. 23 to 25 solve, summed: light that reaches a slice at depth x along an octant falls as the
    // sun's way changes and as the slices between hide it.
    let slant = Slant::new(DVec3::new(0.5, 0.7, 0.5).normalize());
    let leaf = Leaf::new(depths(3), DVec3::Y).unwrap();
    let closed = crate::model::single_bounce(&leaf, &slant, &leaf_optics(), 0.7);
    for (j, closed) in closed.iter().enumerate() {
        let nodes = gauss_legendre(60, 0.0, leaf.depths()[j]);
        let sum: f64 = nodes.iter().map(|(x, w)| w * libm::exp(-slant.fading[j] * x)).sum();
        assert!((slant.phase(&leaf_optics(), j) * 0.7 * sum - closed).abs() < 1e-12, "{j}");
    }
}

/// The 48 rotations and mirrorings of the cube.
fn turns() -> impl Iterator<Item = impl Fn(DVec3) -> DVec3> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    (0..48).map(move |k| {
        let (order, signs) = (orders[k / 8], direction(k % 8).signum());
        move |v: DVec3| DVec3::new(v[order[0]], v[order[1]], v[order[2]]) * signs
    })
}

fn octant_of(d: DVec3) -> usize {
    (0..8).max_by(|a, b| direction(*a).dot(d).total_cmp(&direction(*b).dot(d))).unwrap()
}

#[test]
fn a_turned_crown_is_lit_as_it_was() {
    let (normal, toward) = (DVec3::new(0.3, -0.5, 0.81), DVec3::new(-0.2, 0.7, 0.4));
    let (depths, radiance) = (depths(5), [0.2, 1.0, 0.4, 0.3, 0.9, 0.1, 2.0, 0.7]);
    let lit = |turn: &dyn Fn(DVec3) -> DVec3| {
        let moved = |values: [f64; 8]| {
            let mut out = [0.0; 8];
            (0..8).for_each(|j| out[octant_of(turn(direction(j)))] = values[j]);
            out
        };
        let leaf = Leaf::new(moved(depths), turn(normal)).unwrap();
        let (sun, sky) = (Sun::new(turn(toward), 2.0).unwrap(), Sky::new(moved(radiance)).unwrap());
        [light(&leaf, &leaf_optics(), &sun, &sky), boulanger08(&leaf, &leaf_optics(), &Tree::CONSISTENT, &sun, &sky)]
    };
    let still = lit(&|v| v);
    for turn in turns() {
        for (a, b) in lit(&turn).iter().zip(&still) {
            for (a, b) in parts(a).zip(parts(b)) {
                assert!((a - b).abs() < ROUNDING * 100.0, "{a} {b}");
            }
        }
    }
}

fn parts(light: &Light) -> impl Iterator<Item = f64> + use<> {
    [light.sun, light.sun_indirect, light.sky, light.sky_indirect].into_iter().flat_map(|s| [s.front, s.back])
}

#[test]
fn more_foliage_takes_direct_light_away() {
    let (sun, sky) = (Sun::new(DVec3::new(1.0, 2.0, 0.5), 1.0).unwrap(), Sky::even(1.0, 0.2).unwrap());
    for index in 0..200 {
        let (thin, normal) = (depths(index), directions(200).nth(index as usize).unwrap());
        let [a, b] =
            [1.0, 1.3].map(|f| light(&Leaf::new(thin.map(|d| d * f), normal).unwrap(), &leaf_optics(), &sun, &sky));
        assert!(b.sun.front <= a.sun.front && b.sky.front <= a.sky.front && b.sky.back <= a.sky.back);
    }
}

#[test]
fn nine_numbers_of_a_function_are_its_own() {
    let given = [0.9, 0.1, -0.2, 0.15, 0.05, -0.1, 0.08, 0.02, -0.04];
    let mut sums = [0.0; 9];
    for d in directions(20_000) {
        let value = harmonic_transmittance(&given, d) * 4.0 * PI / 20_000.0;
        harmonics(d).iter().zip(&mut sums).for_each(|(b, sum)| *sum += b * value);
    }
    // Orthonormal: projections of what they say give them back; none of its values is cut off.
    assert!(sums.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-3), "{sums:?}");
}

#[test]
fn nine_numbers_only_change_the_suns_share() {
    let (sun, sky) = (Sun::new(DVec3::new(1.0, 2.0, 0.5), 1.0).unwrap(), Sky::even(1.0, 0.2).unwrap());
    let leaf = Leaf::new([0.5; 8], DVec3::new(0.1, 0.9, 0.3)).unwrap();
    // Even foliage: eight depths and nine numbers say the same.
    let mut even = [0.0; 9];
    even[0] = libm::exp(-0.5) * (4.0 * PI).sqrt();
    let (a, b) = (light(&leaf, &leaf_optics(), &sun, &sky), light_sh(&leaf, &even, &leaf_optics(), &sun, &sky));
    assert!(parts(&a).zip(parts(&b)).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
    let dark = light_sh(&leaf, &[0.0; 9], &leaf_optics(), &sun, &sky);
    assert!(dark.sun.front == 0.0 && dark.sun_indirect.front == 0.0 && dark.sky == a.sky);
}
