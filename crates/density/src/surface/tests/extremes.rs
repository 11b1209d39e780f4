//! Bad input and extremes (density.md section 6).

use super::*;

const LONE: [Generator; 1] = [Generator { position: DVec3::ZERO, weight: 1.0, group: 0 }];

fn lone(radius_m: f64, threshold: f64) -> Balls<'static> {
    Balls { generators: &LONE, radius_m, threshold }
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    for (balls, params, name) in [
        (lone(1.0, 0.0), cell(0.25), "threshold"),
        (lone(1.0, -1.0), cell(0.25), "threshold"),
        (lone(1.0, f64::NAN), cell(0.25), "threshold"),
        (lone(0.0, 0.1), cell(0.25), "radius_m"),
        (lone(f64::INFINITY, 0.1), cell(0.25), "radius_m"),
        (lone(1.0, 0.1), cell(0.0), "cell_m"),
        (lone(1.0, 0.1), cell(1.5), "cell_m"),
        (lone(1.0, 0.1), SurfaceParams { memory_mb: 0.0, ..cell(0.25) }, "memory_mb"),
    ] {
        let error = extract_fast(&balls, &params).unwrap_err();
        assert!(matches!(error, SurfaceError::Parameter { name: found, .. } if found == name), "{error}");
        assert!(error.to_string().starts_with(name) && error.to_string().contains("must be"));
    }
    let generators = [ball(DVec3::ZERO, 1.0), ball(DVec3::NAN, 1.0)];
    let balls = Balls { generators: &generators, ..lone(1.0, 0.1) };
    assert!(matches!(extract_fast(&balls, &cell(0.25)), Err(SurfaceError::Ball { index: 1, .. })));
}

#[test]
fn too_fine_a_cell_is_refused_with_one_that_fits() {
    let generators = cluster(500);
    let balls = Balls { generators: &generators, radius_m: 0.3, threshold: 0.8 };
    let params = |cell_m| SurfaceParams { memory_mb: 8.0, ..cell(cell_m) };
    for cell_m in [1e-3, 1e-9, 1e-300] {
        let error = extract_fast(&balls, &params(cell_m)).unwrap_err();
        let SurfaceError::Memory { fits: Some(fits), .. } = error else { panic!("{error}") };
        assert!(fits > cell_m && fits <= 0.3 && error.to_string().contains("would"));
        assert_sound(&extract_fast(&balls, &params(fits)).unwrap());
    }
}

#[test]
fn balls_too_far_apart_for_any_cell_are_refused() {
    let generators = [ball(DVec3::ZERO, 1.0), ball(DVec3::splat(1e9), 1.0)];
    let balls = Balls { generators: &generators, radius_m: 0.1, threshold: 0.5 };
    let error = extract_fast(&balls, &SurfaceParams::default()).unwrap_err();
    assert!(matches!(error, SurfaceError::Memory { fits: None, .. }) && error.to_string().contains("radius_m"));
}

#[test]
fn nothing_has_no_surface() {
    let none = Balls { generators: &[], ..lone(1.0, 0.5) };
    let weightless = [ball(DVec3::ZERO, 0.0)];
    for balls in [none, Balls { generators: &weightless, ..none }, lone(1.0, 1.5)] {
        let surface = extract_fast(&balls, &cell(0.25)).unwrap();
        assert!(surface.positions.is_empty() && surface.triangles.is_empty() && pieces(&surface).is_empty());
        assert!(nearest(&surface, &Exact(balls), &[DVec3::ZERO]).is_none());
    }
}

#[test]
fn lines_planes_and_coincident_balls() {
    let line = |i: usize| DVec3::new(i as f64 * 0.2, 0.0, 0.0);
    let plane = |i: usize| DVec3::new((i % 6) as f64 * 0.25, 0.0, (i / 6) as f64 * 0.25);
    let same = |_: usize| DVec3::splat(0.1);
    for place in [&line as &dyn Fn(usize) -> DVec3, &plane, &same] {
        let generators: Vec<Generator> = (0..36).map(|i| ball(place(i), 1.0)).collect();
        let balls = Balls { generators: &generators, radius_m: 0.4, threshold: 0.6 };
        // On-lattice and off-lattice symmetry: corners exactly on the threshold are inside.
        for cell_m in [0.1, 0.05, 0.07] {
            let surface = extract_fast(&balls, &cell(cell_m)).unwrap();
            assert_sound(&surface);
            let list = pieces(&surface);
            assert!(list.len() == 1 && list[0].volume > 0.0, "{list:?}");
        }
    }
}

#[test]
fn a_radius_below_every_spacing_gives_one_piece_per_ball_and_a_large_one_a_single_piece() {
    let generators = cluster(50);
    let least = |g: &Generator| {
        let others = generators.iter().filter(|o| !std::ptr::eq(*o, g));
        others.map(|o| o.position.distance(g.position)).fold(f64::INFINITY, f64::min)
    };
    let spacing = generators.iter().map(least).fold(f64::INFINITY, f64::min);
    let small = Balls { generators: &generators, radius_m: 0.45 * spacing, threshold: 0.1 };
    let surface = extract_fast(&small, &SurfaceParams::default()).unwrap();
    assert_sound(&surface);
    assert_eq!(pieces(&surface).len(), 50);
    let large = Balls { generators: &generators, radius_m: 1e3, threshold: 5.0 };
    let surface = extract_fast(&large, &SurfaceParams::default()).unwrap();
    assert_sound(&surface);
    assert_eq!(pieces(&surface).len(), 1);
}

#[test]
fn size_does_not_matter() {
    let plain = cluster(40);
    let mesh = |scale: f64| {
        let generators: Vec<Generator> =
            plain.iter().map(|g| Generator { position: g.position * scale, ..*g }).collect();
        let balls = Balls { generators: &generators, radius_m: 0.4 * scale, threshold: 0.8 };
        let surface = extract_fast(&balls, &cell(0.1 * scale)).unwrap();
        assert_sound(&surface);
        surface
    };
    let one = mesh(1.0);
    // Powers of two change no digit; others may tip a corner that lies on the threshold.
    assert_eq!(mesh((2.0f64).powi(20)).triangles, one.triangles);
    assert_eq!(mesh((2.0f64).powi(-20)).triangles, one.triangles);
    for scale in [1e-6, 1e6] {
        let volume = pieces(&mesh(scale)).iter().map(|p| p.volume).sum::<f64>() / scale.powi(3);
        let expected: f64 = pieces(&one).iter().map(|p| p.volume).sum();
        assert!((volume / expected - 1.0).abs() < 1e-4, "{scale}: {volume}, not {expected}");
    }
}
