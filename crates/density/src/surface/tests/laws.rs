//! Laws of density.md sections 4 and 7.

use super::*;
use proptest::prelude::*;

fn total(surface: &Surface) -> Piece {
    let list = pieces(surface);
    assert_eq!(list.len(), 1, "{list:?}");
    list[0]
}

#[test]
fn one_ball_is_a_sphere_of_the_closed_form() {
    let generators = [ball(DVec3::new(0.01, 0.02, 0.03), 1.0)];
    let balls = Balls { generators: &generators, radius_m: 1.0, threshold: 0.25 };
    let surface = exact_surface(balls, &cell(0.125));
    assert_sound(&surface);
    assert_eq!(total(&surface).euler(), 2);
    let radius = 0.5f64.sqrt();
    for (position, normal) in surface.positions.iter().zip(&surface.normals) {
        let arm = position.as_dvec3() + surface.origin - generators[0].position;
        // |S / tau - 1| <= 1e-4 at S' = -4 r (1 - r^2) = -1.414: 1.8e-5 of length.
        assert!((arm.length() - radius).abs() < 2e-5, "{}", arm.length());
        assert!(normal.as_dvec3().dot(arm.normalize()) > 1.0 - 1e-6);
    }
}

#[test]
fn linear_vertices_converge_at_second_order_and_newton_reaches_the_surface() {
    let generators = [ball(DVec3::new(0.013, 0.027, 0.031), 1.0)];
    let balls = Balls { generators: &generators, radius_m: 1.0, threshold: 0.25 };
    let miss = |cell_m: f64| {
        let params = SurfaceParams { refinement: Refinement::Linear, ..cell(cell_m) };
        let surface = exact_surface(balls, &params);
        let arms = surface.positions.iter().map(|p| (p.as_dvec3() + surface.origin - generators[0].position).length());
        let errors: Vec<f64> = arms.map(|arm| arm - 0.5f64.sqrt()).collect();
        foliar_numerics::ErrorStats::of(errors).rms
    };
    let order = libm::log2(miss(0.25) / miss(0.03125)) / 3.0;
    // The leading term is h^2; what follows is h^3 and 1/8 smaller at the finest.
    assert!((1.8..2.2).contains(&order), "{order}");
    assert!(exact_surface(balls, &cell(0.25)).residual <= TOLERANCE);
}

#[test]
fn corners_are_inside_the_mesh_where_the_density_is_above_the_threshold() {
    let generators = cluster(60);
    for (radius_m, threshold) in [(0.45, 0.7), (0.3, 0.5), (0.8, 6.0)] {
        let balls = Balls { generators: &generators, radius_m, threshold };
        for cells in [1.0, 2.0, 4.0] {
            let surface = exact_surface(balls, &cell(radius_m / cells));
            assert_sound(&surface);
            for k in 0..200 {
                let place = DVec3::from((r2_point(k), radical_inverse(k, 5))) * 3.0 - 1.5;
                let corner = ((place - surface.origin) / surface.cell_m).round() * surface.cell_m + surface.origin;
                let margin = Exact(balls).at(corner).density - threshold;
                // On the surface itself a solid angle says nothing, and f32 positions blur it.
                if margin.abs() > 1e-4 * threshold {
                    let expected = if margin > 0.0 { 1.0 } else { 0.0 };
                    let found = winding(&surface, corner);
                    assert!((found - expected).abs() < 1e-3, "{found} about {corner}, margin {margin}");
                }
            }
        }
    }
}

#[test]
fn vertices_are_on_the_threshold_with_the_fields_own_normal() {
    let generators = cluster(80);
    let balls = Balls { generators: &generators, radius_m: 0.4, threshold: 0.8 };
    for cells in [4.0, 8.0] {
        let surface = exact_surface(balls, &cell(0.4 / cells));
        assert!(surface.residual <= TOLERANCE);
        for (position, normal) in surface.positions.iter().zip(&surface.normals) {
            let probe = Exact(balls).at(position.as_dvec3() + surface.origin);
            assert!((probe.density / balls.threshold - 1.0).abs() <= TOLERANCE);
            assert!(normal.as_dvec3().dot(-probe.gradient.normalize()) > 1.0 - 1e-6);
        }
    }
}

#[test]
fn the_fast_field_gives_the_exact_fields_surface() {
    let generators = cluster(80);
    let balls = Balls { generators: &generators, radius_m: 0.4, threshold: 0.8 };
    let (fast, exact) = (extract_fast(&balls, &cell(0.05)).unwrap(), exact_surface(balls, &cell(0.05)));
    assert_eq!(fast.triangles, exact.triangles);
    assert!(fast.residual <= TOLERANCE);
    // Both are within 1e-4 of tau, of a field whose slope along an edge may be small but not
    // smaller than the residual over a cell.
    assert!(fast.positions.iter().zip(&exact.positions).all(|(f, e)| f.distance(*e) < 0.05));
}

#[test]
fn threads_instructions_and_order_do_not_change_a_byte() {
    fn balls(generators: &[Generator]) -> Balls<'_> {
        Balls { generators, radius_m: 0.3, threshold: 0.8 }
    }
    let mut generators = cluster(300);
    let first = extract_fast(&balls(&generators), &cell(0.05)).unwrap();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| extract_fast(&balls(&generators), &cell(0.05)).unwrap()) == first, "{threads} threads");
    }
    for isa in crate::Isa::available() {
        let made = extract_on(&balls(&generators), &cell(0.05), isa).unwrap();
        assert!(made == first, "{isa:?}");
    }
    generators.reverse();
    generators.rotate_left(7);
    assert!(extract_fast(&balls(&generators), &cell(0.05)).unwrap() == first);
}

#[test]
fn a_translated_set_gives_a_translated_mesh() {
    let generators = cluster(40);
    // Multiples of 1/8 and an exact shift: the same bits relative to the middle.
    let snapped: Vec<Generator> =
        generators.iter().map(|g| ball((g.position * 8.0).round() / 8.0, f64::from(g.weight))).collect();
    let shifted: Vec<Generator> =
        snapped.iter().map(|g| Generator { position: g.position + DVec3::new(1e6, -1e6, 4096.0), ..*g }).collect();
    let balls = |generators| Balls { generators, radius_m: 0.5, threshold: 0.8 };
    let (here, there) = (exact_surface(balls(&snapped), &cell(0.125)), exact_surface(balls(&shifted), &cell(0.125)));
    assert_sound(&there);
    assert_eq!(here.triangles, there.triangles);
    assert_eq!(there.origin - here.origin, DVec3::new(1e6, -1e6, 4096.0));
    // Places are summed in f64 at 1e6: 1.2e-10 of rounding.
    assert!(here.positions.iter().zip(&there.positions).all(|(a, b)| a.distance(*b) < 1e-6));
}

#[test]
fn a_hollow_crown_has_an_inner_sheet_that_can_be_dropped() {
    let generators: Vec<Generator> = (0..200).map(|i| ball(foliar_numerics::fibonacci_sphere(i, 200), 1.0)).collect();
    let balls = Balls { generators: &generators, radius_m: 0.4, threshold: 0.5 };
    let surface = exact_surface(balls, &cell(0.1));
    assert_sound(&surface);
    let list = pieces(&surface);
    assert_eq!(list.len(), 2);
    assert!(list.iter().all(|p| p.euler() == 2));
    assert!(list.iter().filter(|p| p.volume < 0.0).count() == 1, "{list:?}");
    let outer = surface.without_cavities();
    assert_sound(&outer);
    assert!(total(&outer).volume > 4.0);
    let feet = nearest(&outer, &Exact(balls), &[DVec3::new(0.3, 0.1, 0.2)]).unwrap();
    // All round the middle the outer sheet is outside the balls' centers, and its normals point out.
    assert!(feet[0].point.length() > 1.0 && feet[0].normal.dot(feet[0].point) > 0.0);
}

#[test]
fn feet_do_not_depend_on_what_else_is_asked() {
    let generators = cluster(80);
    let balls = Balls { generators: &generators, radius_m: 0.4, threshold: 0.8 };
    let surface = exact_surface(balls, &cell(0.1));
    let places: Vec<DVec3> = (0..600).map(|i| DVec3::from((r2_point(i), radical_inverse(i, 5))) * 4.0 - 2.0).collect();
    let together = nearest(&surface, &Exact(balls), &places).unwrap();
    for (place, foot) in places.iter().zip(&together) {
        let alone = nearest(&surface, &Exact(balls), std::slice::from_ref(place)).unwrap()[0];
        let distance = |foot: &Foot| (foot.point.as_dvec3() + surface.origin).distance(*place);
        // The same distance to f32; where two triangles tie, either foot will do.
        assert!((distance(&alone) - distance(foot)).abs() < 1e-6, "{place}: {alone:?}, {foot:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn random_balls_give_closed_manifold_outward_meshes(
        places in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64, 0.0..2.0f64), 1..40),
        radius_m in 0.1..1.2f64,
        cells in 1.0..6.0f64,
        threshold in 0.01..2.0f64,
    ) {
        let generators: Vec<Generator> = places.iter().map(|&(x, y, z, w)| ball(DVec3::new(x, y, z), w)).collect();
        let balls = Balls { generators: &generators, radius_m, threshold };
        let surface = extract_fast(&balls, &cell(radius_m / cells)).unwrap();
        assert_sound(&surface);
        let list = pieces(&surface);
        prop_assert!(list.iter().all(|p| p.triangles % 2 == 0 && p.euler() % 2 == 0));
        if !list.is_empty() {
            prop_assert!(list.iter().map(|p| p.volume).sum::<f64>() > 0.0);
        }
    }
}
