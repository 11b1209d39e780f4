//! Closed forms: coverage, alpha, Lambert, textures, shadows, baked channels, legends.

use super::*;
use crate::camera::{self, Camera};
use crate::frame::Frame;
use crate::{Shading, colors, legend, render, shade};

const FULL: Vec3 = Vec3::ONE;

fn facing(material: Material, rasters: Vec<Raster>) -> Plant {
    plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Leaf, material)], rasters)
}

fn plain(plant: &Plant, params: &ViewParams) -> RgbaImage {
    render(plant, &[], &Shading::Plain, params).unwrap()
}

/// The quad fills the height less a margin of 4 % at each border.
const EDGE: f64 = 0.92 * 180.0;
/// Pixels along the quad's border: each may be wrong by one sample of 16 at most on average.
const BORDER_ERROR: f64 = 4.0 * EDGE / 16.0;

#[test]
fn a_quad_covers_the_pixels_that_it_should() {
    let found = covered(&plain(&facing(gray(0.2), vec![]), &frontal()));
    assert!((found - EDGE * EDGE).abs() < BORDER_ERROR, "{found} of {}", EDGE * EDGE);
}

#[test]
fn half_transparent_quads_let_half_through() {
    let checker = || vec![raster(2, &[[255; 4], [255, 255, 255, 0], [255, 255, 255, 0], [255; 4]])];
    let veil = || vec![raster(1, &[[255, 255, 255, 128]])];
    let half = EDGE * EDGE / 2.0;
    let cases = [
        (AlphaMode::Mask(0.5), checker(), 0.5),
        (AlphaMode::Blend, checker(), 0.5),
        (AlphaMode::Blend, veil(), 128.0 / 255.0),
    ];
    for (mode, rasters, share) in cases {
        let found = covered(&plain(&facing(textured(mode), rasters), &frontal()));
        // The checker's own edges are as long as two sides of the quad or more.
        assert!((found - 2.0 * half * share).abs() < 2.0 * BORDER_ERROR, "{mode:?}: {found} of {half}");
    }
    let opaque = covered(&plain(&facing(textured(AlphaMode::Opaque), checker()), &frontal()));
    assert!((opaque - 2.0 * half).abs() < BORDER_ERROR, "alpha of an opaque material counts for nothing: {opaque}");
}

#[test]
fn what_lies_behind_a_hole_is_seen() {
    let hole = vec![raster(1, &[[255, 255, 255, 0]])];
    let front = (quad(Vec3::Z, Vec3::X, Vec3::Y), Role::Leaf, textured(AlphaMode::Mask(0.5)));
    let back = (quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Wood, gray(0.1));
    let alone = plain(&facing(gray(0.1), vec![]), &frontal());
    let through = plain(&plant(vec![front, back], hole), &frontal());
    assert!(close(middle(&through).0, middle(&alone).0), "the hole casts no shadow and hides nothing");
}

#[test]
fn a_tilted_quad_follows_lamberts_law() {
    let albedo = 0.15;
    for tilt_deg in [0.0f32, 20.0, 40.0, 60.0] {
        // The sun stands level behind the camera; the quad leans back about X.
        let up = Vec3::new(0.0, libm::cosf(tilt_deg.to_radians()), -libm::sinf(tilt_deg.to_radians()));
        let wood = plant(vec![(quad(Vec3::ZERO, Vec3::X, up), Role::Wood, gray(albedo))], vec![]);
        let params = ViewParams { sun_azimuth_deg: 0.0, sun_elevation_deg: 1.0, ..frontal() };
        let cosine = Vec3::X.cross(up).dot(camera::direction(0.0, 1.0).as_vec3());
        let expected = colors::to_bytes(albedo * FULL * (shade::SUN * cosine + shade::SKY), 1.0);
        let found = middle(&plain(&wood, &params)).0;
        assert!(close(found, expected), "{tilt_deg} degrees: {found:?}, not {expected:?}");
    }
}

#[test]
fn both_sides_of_a_leaf_are_lit_and_wood_is_dark_behind() {
    let behind = ViewParams { sun_azimuth_deg: 180.0, sun_elevation_deg: 1.0, ..frontal() };
    let at =
        |role| middle(&plain(&plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), role, gray(0.15))], vec![]), &behind)).0;
    let sun = camera::direction(180.0, 1.0).as_vec3().dot(Vec3::NEG_Z);
    let through = colors::to_bytes(0.15 * (shade::SUN * 0.5 * sun + shade::SKY), 1.0);
    assert!(close(at(Role::Leaf), through), "{:?} {through:?}", at(Role::Leaf));
    assert!(close(at(Role::Wood), colors::to_bytes(0.15 * shade::SKY, 1.0)));
    // Seen from behind, the file's normal is turned: the same as from the front.
    let from_behind = ViewParams { azimuth_deg: 180.0, sun_azimuth_deg: 180.0, sun_elevation_deg: 1.0, ..frontal() };
    let front = ViewParams { sun_azimuth_deg: 0.0, sun_elevation_deg: 1.0, ..frontal() };
    let leaf = facing(gray(0.15), vec![]);
    assert!(close(middle(&plain(&leaf, &from_behind)).0, middle(&plain(&leaf, &front)).0));
}

#[test]
fn textures_are_srgb() {
    let leaf = facing(textured(AlphaMode::Opaque), vec![raster(1, &[[90, 60, 120, 255]])]);
    let params = ViewParams { sun_azimuth_deg: 0.0, sun_elevation_deg: 90.0, ..frontal() };
    // IEC 61966-2-1 by hand: 90, 60 and 120 of 255.
    let linear = Vec3::new(0.102_242, 0.045_186, 0.187_821);
    // A sun in the zenith grazes the quad: only the sky counts.
    let expected = colors::to_bytes(linear * shade::SKY, 1.0);
    let found = middle(&plain(&leaf, &params)).0;
    assert!(close(found, expected), "{found:?}, not {expected:?}");
}

#[test]
fn a_shadow_falls_where_geometry_says() {
    let albedo = 0.15;
    let floor = || (quad(Vec3::ZERO, 2.0 * Vec3::Z, 2.0 * Vec3::X), Role::Wood, gray(albedo));
    let lid = (quad(Vec3::Y, 0.3 * Vec3::Z, 0.3 * Vec3::X), Role::Leaf, gray(albedo));
    // The sun stands over +X at 45 degrees: the shadow of what hangs at height 1 lies 1 toward -X.
    let params = ViewParams { elevation_deg: 30.0, sun_azimuth_deg: 90.0, sun_elevation_deg: 45.0, ..frontal() };
    let scene = plant(vec![floor(), lid], vec![]);
    let picture = plain(&scene, &params);
    let scale = (camera::PLANT_EDGE / scene.size().max_element()) as f32;
    let place = |p: Vec3| (p - scene.center().as_vec3()) * scale;
    let points = scene.parts().iter().flat_map(|part| part.positions.iter().map(|&p| place(p)));
    let camera = Camera::fit(points, &Frame::around(&scene, &[]), &params);
    let at = |p: Vec3| {
        let pixel = camera.project(place(p)).unwrap().as_uvec2();
        picture.get_pixel(pixel.x, pixel.y).0
    };
    let sine = camera::direction(90.0, 45.0).y as f32;
    let open = colors::to_bytes(albedo * (shade::SUN * sine + shade::SKY), 1.0);
    let shaded = colors::to_bytes(albedo * shade::SKY, 1.0);
    // Half a degree of sun blurs the edge by .02: places .1 away from it are clear.
    for (x, z, expected) in [
        (-1.0, 0.0, shaded),
        (-0.8, 0.2, shaded),
        (-1.2, -0.2, shaded),
        (-0.6, 0.0, open),
        (-1.4, 0.0, open),
        (-1.0, 0.4, open),
        (1.0, 0.0, open),
        (0.0, 0.5, open),
    ] {
        let found = at(Vec3::new(x, 0.0, z));
        assert!(close(found, expected), "({x}, {z}): {found:?}, not {expected:?}");
    }
}

#[test]
fn the_ground_shows_a_shadow_and_nothing_else() {
    let leaf = (quad(Vec3::Y, 0.5 * Vec3::X, 0.5 * Vec3::Z), Role::Leaf, gray(0.1));
    let stem = (quad(Vec3::Y * 0.5, 0.01 * Vec3::X, 0.5 * Vec3::Y), Role::Wood, gray(0.1));
    let tree = plant(vec![leaf, stem], vec![]);
    let params = ViewParams { elevation_deg: 20.0, ground: Ground::Shadow, ..frontal() };
    let with = plain(&tree, &params);
    let without = plain(&tree, &ViewParams { ground: Ground::None, ..params });
    let shadow = with.pixels().zip(without.pixels()).filter(|(a, b)| a.0[3] > b.0[3]);
    assert!(shadow.clone().count() > 300, "{}", shadow.count());
    assert!(shadow.clone().all(|(a, _)| f32::from(a.0[3]) <= 255.0 * shade::GROUND_SHADOW + 1.0 || a.0[..3] != [0; 3]));
}

#[test]
fn baked_light_takes_the_soft_normal_and_scales_the_sky() {
    let leaf = facing(gray(0.15), vec![]);
    let soft = Vec3::new(0.6, 0.8, 0.0);
    let baked = layer(0, &[("_AMBIENT", Array::scalars(vec![0.25; 4])), ("_SOFT_NORMAL", Array::vectors(&[soft; 4]))]);
    let params = ViewParams { sun_azimuth_deg: 45.0, sun_elevation_deg: 45.0, ..frontal() };
    let cosine = soft.dot(camera::direction(45.0, 45.0).as_vec3());
    let expected = colors::to_bytes(0.15 * (shade::SUN * cosine + 0.25 * shade::SKY), 1.0);
    let found = middle(&render(&leaf, &[&baked], &Shading::Baked, &params).unwrap()).0;
    assert!(close(found, expected), "{found:?}, not {expected:?}");
    assert_eq!(plain(&leaf, &params), render(&leaf, &[&baked], &Shading::Plain, &params).unwrap());
}

#[test]
fn false_colors_are_those_of_the_legend() {
    let leaf = facing(gray(0.15), vec![]);
    let baked = layer(0, &[("_AMBIENT", Array::scalars(vec![0.25; 4]))]);
    let params = ViewParams { width_px: 480, height_px: 360, ..frontal() };
    let picture = render(&leaf, &[&baked], &Shading::Channel("ambient".into()), &params).unwrap();
    assert_eq!(middle(&picture).0, colors::to_bytes(colors::ramp(0.25), 1.0));
    let [x, y] = legend::bar_corner(picture.height());
    assert!(y > 360, "the legend hides nothing of the picture");
    let ends = [picture.get_pixel(x, y).0, picture.get_pixel(x + legend::BAR[0] - 1, y).0];
    assert_eq!(ends, [0.0, 1.0].map(|share| colors::to_bytes(colors::ramp(share), 1.0)));
}

#[test]
fn a_role_has_a_color_of_its_own_and_no_layer_is_asked() {
    let wood = quad(Vec3::ZERO, Vec3::X, Vec3::Y);
    let color = |role| {
        let plant = plant(vec![(wood.clone(), role, gray(0.2))], vec![]);
        middle(&render(&plant, &[], &Shading::Channel("role".into()), &frontal()).unwrap()).0
    };
    let [r, g, _, _] = color(Role::Leaf);
    assert!(g > r, "leaves are green");
    let [r, g, _, _] = color(Role::Wood);
    assert!(r > g, "wood is brown");
}

#[test]
fn a_material_that_says_nothing_is_drawn_as_bark_or_foliage() {
    let params = ViewParams { sun_azimuth_deg: 0.0, sun_elevation_deg: 90.0, ..frontal() };
    let of = |role, material| {
        middle(&plain(&plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), role, material)], vec![]), &params)).0
    };
    let [r, g, b, _] = of(Role::Leaf, gray(1.0));
    assert!(g > r && r > b, "foliage is green: {r} {g} {b}");
    let [r, g, b, _] = of(Role::Wood, gray(0.8));
    assert!(r > g && g > b, "bark is brown: {r} {g} {b}");
    let chosen = colors::to_bytes(0.3 * shade::SKY, 1.0);
    assert!(close(of(Role::Leaf, gray(0.3)), chosen), "a color that somebody chose stays");
}

#[test]
fn a_stock_viewer_takes_normal_and_color_0_of_the_file_and_no_shadow() {
    let color = Vec3::new(0.5, 0.25, 1.0);
    let own = Vec3::new(0.6, 0.0, 0.8);
    let leaf = |double_sided| {
        let part = quad(Vec3::ZERO, Vec3::X, Vec3::Y);
        let part = Part { normals: vec![own; 4], colors: vec![color; 4], ..part };
        // Something between it and the sun, out of the camera's way.
        let lid = quad(Vec3::new(3.0, 0.0, 4.0), Vec3::Y, Vec3::Z);
        let material = Material { double_sided, ..gray(0.15) };
        plant(vec![(part, Role::Leaf, material), (lid, Role::Other, gray(0.1))], vec![])
    };
    let seen = |azimuth_deg, sun_azimuth_deg, double_sided| {
        let params = ViewParams { azimuth_deg, sun_azimuth_deg, sun_elevation_deg: 1.0, ..frontal() };
        middle(&render(&leaf(double_sided), &[&layer(0, &[])], &Shading::Stock, &params).unwrap()).0
    };
    let lit = |normal: Vec3, sun_azimuth_deg| {
        let cosine = normal.dot(camera::direction(sun_azimuth_deg, 1.0).as_vec3()).max(0.0);
        colors::to_bytes(0.15 * color * (shade::SUN * cosine + shade::SKY), 1.0)
    };
    assert!(close(seen(0.0, 37.0, true), lit(own, 37.0)), "{:?}", seen(0.0, 37.0, true));
    // From behind the normal is turned, and no light shines through.
    assert!(close(seen(180.0, 200.0, true), lit(-own, 200.0)), "{:?}", seen(180.0, 200.0, true));
    assert!(close(seen(180.0, 37.0, true), lit(-own, 37.0)));
    assert_eq!(seen(180.0, 200.0, false)[3], 0, "the back of a one-sided material is not drawn");
    assert!(close(seen(0.0, 37.0, false), lit(own, 37.0)));
}
