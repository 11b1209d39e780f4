//! Pen drawings in closed form: outlines, creases, smooth surfaces.

use super::*;
use crate::{Normals, Shading, png_bytes, render};

/// Ink of each pixel, 0 to 1.
fn ink(plant: &Plant, layers: &[&Layer], normals: Normals, params: &ViewParams) -> Vec<Vec<f64>> {
    let picture = render(plant, layers, &Shading::Lines(normals), params).unwrap();
    let share = |p: &Rgba<u8>| f64::from(255 - p.0[0]) / 231.0;
    let width = picture.width() as usize;
    picture.pixels().map(share).collect::<Vec<_>>().chunks(width).map(<[f64]>::to_vec).collect()
}

fn paper(line_angle_deg: f64) -> ViewParams {
    ViewParams { background: Background::White, line_angle_deg, line_width_px: 2.0, ..frontal() }
}

/// Ink within `reach` pixels of the middle, across and down.
fn inner(ink: &[Vec<f64>], reach: [usize; 2]) -> f64 {
    let (y, x) = (ink.len() / 2, ink[0].len() / 2);
    ink[y - reach[1]..y + reach[1]].iter().flat_map(|row| &row[x - reach[0]..x + reach[0]]).sum()
}

fn total(ink: &[Vec<f64>]) -> f64 {
    ink.iter().flatten().sum()
}

#[test]
fn a_quad_is_its_outline() {
    let leaf = plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Leaf, gray(0.2))], vec![]);
    let found = ink(&leaf, &[], Normals::Plain, &paper(10.0));
    // The quad fills the height less 4 % at each border; its outline is twice as wide as a pixel.
    let outline = 4.0 * 0.92 * 180.0 * 2.0;
    // A disc of 4 samples covers lattice points for a width of 9 of them: a ninth more; and corners.
    assert!((total(&found) / outline - 1.0).abs() < 0.15, "{} of {outline}", total(&found));
    assert!(inner(&found, [75, 75]).abs() < f64::EPSILON, "nothing inside");
}

#[test]
fn a_ball_is_its_outline() {
    let (rings, sides) = (64u32, 128u32);
    let at = |ring: u32, side: u32| {
        let (polar, around) =
            (std::f32::consts::PI * ring as f32 / rings as f32, std::f32::consts::TAU * side as f32 / sides as f32);
        let (sine, cosine) = libm::sincosf(polar);
        Vec3::new(sine * libm::cosf(around), cosine, sine * libm::sinf(around))
    };
    let positions: Vec<Vec3> = (0..=rings).flat_map(|r| (0..=sides).map(move |s| at(r, s))).collect();
    let cell = |r: u32, s: u32| {
        let (a, b) = (r * (sides + 1) + s, (r + 1) * (sides + 1) + s);
        [[a, a + 1, b], [b, a + 1, b + 1]]
    };
    let triangles = (0..rings).flat_map(|r| (0..sides).flat_map(move |s| cell(r, s))).collect();
    let part = Part {
        normals: positions.clone(),
        uvs: vec![],
        triangles,
        position_ids: vec![0; positions.len()],
        positions,
        ..Part::default()
    };
    let ball = plant(vec![(part, Role::Leaf, gray(0.2))], vec![]);
    let found = ink(&ball, &[], Normals::Plain, &paper(20.0));
    // Seen in perspective the outline fills the height less the margins.
    let outline = std::f64::consts::PI * 0.92 * 180.0 * 2.0;
    assert!((total(&found) / outline - 1.0).abs() < 0.15, "{} of {outline}", total(&found));
    assert!(inner(&found, [50, 50]).abs() < f64::EPSILON, "smooth normals make no lines");
}

#[test]
fn a_crease_shows_from_its_angle_on() {
    for crease_deg in [20.0f32, 50.0, 80.0] {
        // Two walls that meet in the middle, each turned back by half the angle.
        let (sine, cosine) = libm::sincosf((crease_deg / 2.0).to_radians());
        let wall =
            |side: f32| quad(Vec3::new(side * cosine, 0.0, -sine), Vec3::new(cosine, 0.0, -side * sine), Vec3::Y);
        let parts = [1.0, -1.0].map(|side| (wall(side), Role::Wood, gray(0.2)));
        let folded = plant(parts.into(), vec![]);
        let middle = |threshold: f64| inner(&ink(&folded, &[], Normals::Plain, &paper(threshold)), [20, 20]);
        let angle = f64::from(crease_deg);
        // Rounding of f32 moves the angle by less than a hundredth of a degree.
        assert!(middle(angle + 0.1).abs() < f64::EPSILON, "{crease_deg} below the threshold");
        let (drawn, line) = (middle(angle - 0.1), 40.0 * 2.0);
        assert!((drawn / line - 1.0).abs() < 0.15, "{crease_deg}: {drawn} of {line}");
    }
}

#[test]
fn equal_normals_leave_the_silhouette_alone() {
    // Shingles that overlap, tilted this way and that, none far before another.
    let shingle = |i: i32| {
        let tilt = Vec3::new(0.0, 0.0, if i % 2 == 0 { 0.6 } else { -0.6 });
        (quad(Vec3::new(i as f32 * 0.4, 0.0, 0.0), Vec3::X * 0.3 + tilt * 0.3, Vec3::Y), Role::Leaf, gray(0.2))
    };
    let leaves = plant((-3..=3).map(shingle).collect(), vec![]);
    let attributes: Vec<Layer> =
        (0..7).map(|mesh| layer(mesh, &[("_SOFT_NORMAL", Array::vectors(&[Vec3::Y; 4]))])).collect();
    let layers: Vec<&Layer> = attributes.iter().collect();
    let inside = |normals| inner(&ink(&leaves, &layers, normals, &paper(30.0)), [60, 30]);
    assert!(inside(Normals::Baked).abs() < f64::EPSILON);
    assert!(inside(Normals::Plain) > 100.0, "the file's own normals show every shingle");
}

#[test]
fn what_stands_far_before_something_has_an_edge() {
    let front = (quad(Vec3::Z * 0.5, Vec3::X * 0.3, Vec3::Y * 0.3), Role::Leaf, gray(0.2));
    let back = (quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Leaf, gray(0.2));
    let found = ink(&plant(vec![front, back], vec![]), &[], Normals::Plain, &paper(90.0));
    assert!(inner(&found, [60, 60]) > 200.0);
    assert!(inner(&found, [15, 15]).abs() < f64::EPSILON);
}

#[test]
fn any_number_of_threads_and_any_background_draw_the_same_lines() {
    let tree = foliar_plant::sample::Recipe::small().grow();
    let params = ViewParams { width_px: 150, height_px: 100, samples: 4, scale: Scale::None, ..ViewParams::default() };
    let draw = |threads, params: &ViewParams| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&tree, &[], &Shading::Lines(Normals::Baked), params).unwrap())
    };
    let one = draw(1, &params);
    assert_eq!(png_bytes(&one).unwrap(), png_bytes(&draw(5, &params)).unwrap());
    let clear = draw(2, &ViewParams { background: Background::Clear, ..params });
    let agree =
        |(a, b): (&Rgba<u8>, &Rgba<u8>)| (f32::from(255 - a.0[0]) / 231.0 - f32::from(b.0[3]) / 255.0).abs() < 0.01;
    assert!(one.pixels().zip(clear.pixels()).all(agree), "ink on paper is ink on nothing");
}

#[test]
fn small_gaps_close_and_large_ones_stay() {
    // A frame of four bars around a square hole, in the middle of the picture.
    let frame = |half: f32| {
        let (bar, at) = ((1.0 - half) / 2.0, f32::midpoint(1.0, half));
        let bars = [(at, 0.0, bar, 1.0), (-at, 0.0, bar, 1.0), (0.0, at, half, bar), (0.0, -at, half, bar)];
        let quads =
            bars.map(|(x, y, w, h)| (quad(Vec3::new(x, y, 0.0), Vec3::X * w, Vec3::Y * h), Role::Leaf, gray(0.2)));
        plant(quads.into(), vec![])
    };
    let drawn = |half: f32, line_detail_px: f64| {
        inner(&ink(&frame(half), &[], Normals::Plain, &ViewParams { line_detail_px, ..paper(30.0) }), [40, 40])
    };
    // The half edge of 1 is 83 pixels: holes of 3 and of 50 pixels.
    assert!(drawn(0.018, 0.0) > 5.0);
    assert!(drawn(0.018, 10.0).abs() < f64::EPSILON, "{}", drawn(0.018, 10.0));
    let outline = 4.0 * 50.0 * 2.0;
    assert!((drawn(0.3, 10.0) / outline - 1.0).abs() < 0.2, "{} of {outline}", drawn(0.3, 10.0));
}
