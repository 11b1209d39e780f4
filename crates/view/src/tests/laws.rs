//! Laws: sizes, threads, odd plants, what is refused.

use super::*;
use crate::{Normals, Panel, Shading, Standing, ViewError, bake_sheet, contact_sheet, png_bytes, render, render_among};
use foliar_plant::sample::{Recipe, odd_plants};

fn small() -> ViewParams {
    ViewParams { width_px: 120, height_px: 90, samples: 4, scale: Scale::None, ..ViewParams::default() }
}

/// A tree of `scale` times its size, moved by `offset` meters.
fn sized(scale: f64, offset: glam::DVec3) -> Plant {
    let tree = Recipe::small().grow();
    let mut base = tree.base().clone();
    for part in &mut base.parts {
        part.transform =
            DAffine3::from_translation(offset) * DAffine3::from_scale(glam::DVec3::splat(scale)) * part.transform;
    }
    // Leaves do not enter a plain picture.
    let leaf_ids = vec![Vec::new(); base.parts.len()];
    Plant::new(base, Structure { roles: tree.structure().roles.clone(), leaves: Vec::new(), leaf_ids }).unwrap()
}

#[test]
fn plants_of_any_size_and_place_look_alike() {
    let picture = |scale, offset| render(&sized(scale, offset), &[], &Shading::Plain, &small()).unwrap();
    let own = picture(1.0, glam::DVec3::ZERO);
    assert_eq!(own, picture(1.0 / 1_048_576.0, glam::DVec3::ZERO), "a power of two changes no digit");
    let cases = [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1e-3, -7.7)];
    for (scale, offset) in cases {
        let other = picture(scale, glam::DVec3::new(offset, offset, -offset));
        let step = |a: &Rgba<u8>, b: &Rgba<u8>| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max() > Some(2);
        let different = own.pixels().zip(other.pixels()).filter(|(a, b)| step(a, b)).count();
        // Rounding moves edges by a millionth of a pixel: a sample in a million flips, and one sample
        // of four is seen. One pixel in a thousand allows for the alpha test's own edges.
        assert!(different <= 11, "{different} of 10800 pixels differ at scale {scale:e}, offset {offset}");
    }
}

#[test]
fn any_number_of_threads_draws_the_same_bytes() {
    let tree = Recipe::small().grow();
    let params = ViewParams { scale: Scale::Person, ..small() };
    let bytes = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| png_bytes(&render(&tree, &[], &Shading::Baked, &params).unwrap()).unwrap())
    };
    let one = bytes(1);
    assert_eq!(one, bytes(2));
    assert_eq!(one, bytes(5));
    let decoded = image::load_from_memory(&one).unwrap().into_rgba8();
    assert_eq!(decoded, render(&tree, &[], &Shading::Baked, &params).unwrap(), "PNG keeps every pixel");
}

#[test]
fn odd_plants_get_a_picture() {
    for sample in odd_plants() {
        for shading in [Shading::Plain, Shading::Baked, Shading::Stock, Shading::Lines(Normals::Baked)] {
            let params = ViewParams { scale: Scale::Person, ..small() };
            let picture = render(&sample.plant, &[], &shading, &params).map_err(|e| format!("{}: {e}", sample.name));
            assert_eq!(picture.unwrap().dimensions(), (120, 90), "{}", sample.name);
        }
    }
}

#[test]
fn an_empty_plant_gives_the_background() {
    let params = ViewParams { background: Background::White, ..small() };
    let picture = render(&Plant::default(), &[], &Shading::Baked, &params).unwrap();
    assert!(picture.pixels().all(|p| p.0 == [255; 4]));
}

#[test]
fn a_tree_stands_whole_in_the_picture() {
    let tree = Recipe::small().grow();
    for (azimuth_deg, elevation_deg, fov_deg) in [(0.0, 0.0, 30.0), (120.0, 60.0, 90.0), (-45.0, -30.0, 10.0)] {
        let params = ViewParams { azimuth_deg, elevation_deg, fov_deg, ..small() };
        let params = ViewParams { ground: Ground::None, background: Background::Clear, ..params };
        let picture = render(&tree, &[], &Shading::Plain, &params).unwrap();
        let is_border = |x: u32, y: u32| x < 2 || y < 2 || x >= 118 || y >= 88;
        assert!(picture.enumerate_pixels().all(|(x, y, p)| !is_border(x, y) || p.0[3] == 0));
        // It reaches to the margins one way, but for the transparent corners of the outermost cards.
        let rows = picture.enumerate_pixels().filter(|(_, _, p)| p.0[3] > 0).map(|(_, y, _)| y);
        let columns = picture.enumerate_pixels().filter(|(_, _, p)| p.0[3] > 0).map(|(x, _, _)| x);
        let span = |mut values: Vec<u32>| {
            values.sort_unstable();
            values.last().unwrap() - values[0]
        };
        let (high, wide) = (span(rows.collect()), span(columns.collect()));
        assert!(f64::from(high) > 0.75 * 90.0 || f64::from(wide) > 0.75 * 120.0, "{wide} x {high}");
    }
}

#[test]
fn a_person_and_a_bar_are_as_long_as_they_say() {
    // A post of 2 m, seen level and from afar, so that near things are hardly larger: a person of 1.7 m is .85 of it.
    let post = plant(vec![(quad(Vec3::Y, Vec3::X * 0.1, Vec3::Y), Role::Wood, gray(0.2))], vec![]);
    let params = ViewParams { fov_deg: 1.0, samples: 16, scale: Scale::Person, ..frontal() };
    let picture = render(&post, &[], &Shading::Plain, &params).unwrap();
    let span = |keep: &dyn Fn(u32, u32, &Rgba<u8>) -> bool| {
        let rows = picture.enumerate_pixels().filter(|(x, y, p)| keep(*x, *y, p)).map(|(_, y, _)| y);
        let rows: Vec<u32> = rows.collect();
        f64::from(rows.iter().max().unwrap() - rows.iter().min().unwrap() + 1)
    };
    // What is written above the person is dark with a light rim, and no part of it.
    let solid = |p: &Rgba<u8>| p.0[3] > 128 && ![[20, 20, 20], [245, 245, 245]].contains(&[p.0[0], p.0[1], p.0[2]]);
    // The bar stands in the lower left corner, the post left of the middle, the person right of it.
    let post = span(&|x, _, p| (60..110).contains(&x) && solid(p));
    let person = span(&|x, _, p| x > 110 && solid(p));
    // Either end of either height may be a pixel off, and the person stands 2 % nearer or farther at most.
    assert!((person / post - 0.85).abs() < 0.02 + 4.0 / post, "{person} of {post} pixels");
    let ink = picture.enumerate_pixels().filter(|(_, y, p)| *y == 180 - 14 && p.0 == [20, 20, 20, 255]).count();
    assert!((ink as f64 - post / 4.0).abs() <= 1.0, "0.5 m is a quarter of the post: {ink} of {post} pixels");
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let refused =
        |params: ViewParams| render(&Plant::default(), &[], &Shading::Plain, &params).unwrap_err().to_string();
    assert!(refused(ViewParams { samples: 0, ..small() }).contains("samples"));
    assert!(refused(ViewParams { exposure: 0.0, ..small() }).contains("exposure"));
    assert!(refused(ViewParams { elevation_deg: 90.0, ..small() }).contains("elevation_deg"));
    assert!(refused(ViewParams { fov_deg: f64::NAN, ..small() }).contains("finite"));
    assert!(refused(ViewParams { width_px: 1 << 20, ..small() }).contains("width_px"));
}

#[test]
fn defaults_agree() {
    assert_eq!(serde_json::from_str::<ViewParams>("{}").unwrap(), ViewParams::default());
    assert!(serde_json::from_str::<ViewParams>(r#"{"azimut_deg": 3}"#).is_err(), "unknown keys are refused");
    let schema = ViewParams::schema();
    let properties = schema["properties"].as_object().unwrap();
    assert!(properties.values().all(|p| p["description"].is_string() && p.get("default").is_some()), "{schema:#}");
}

#[test]
fn a_layer_that_does_not_fit_is_refused() {
    let leaf = plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Leaf, gray(0.2))], vec![]);
    let short = layer(0, &[("_AMBIENT", Array::scalars(vec![0.5; 3]))]);
    let error = render(&leaf, &[&short], &Shading::Baked, &small()).unwrap_err();
    assert!(matches!(&error, ViewError::Shape { found: 3, .. }), "{error}");
    let error = render(&leaf, &[&short], &Shading::Channel("wind".into()), &small()).unwrap_err().to_string();
    assert!(error.contains("wind") && error.contains("_AMBIENT"), "{error}");
}

#[test]
fn sheets_hold_every_panel_in_its_place() {
    let colors = [[9, 0, 0, 255], [0, 9, 0, 255], [0, 0, 9, 255]];
    let panels = colors.map(|c| {
        Panel::new("a caption that is much too long for forty pixels", RgbaImage::from_pixel(40, 30, Rgba(c)))
    });
    let sheet = contact_sheet(&panels, &["title".into()], 2);
    for color in colors {
        assert_eq!(sheet.pixels().filter(|p| p.0 == color).count(), 1200, "{color:?}");
    }
    assert!(contact_sheet(&[], &[], 0).width() > 0);
}

#[test]
fn a_bake_sheet_says_what_changed() {
    let tree = Recipe::small().grow();
    let dark: Vec<Array> = tree.parts().iter().map(|p| Array::scalars(vec![0.0; p.positions.len()])).collect();
    let mut baked = layer(0, &[]);
    for (part, array) in tree.parts().iter().zip(dark) {
        baked.attributes.insert(AttributeKey { place: part.place, name: "_AMBIENT".into() }, array);
    }
    let without = bake_sheet(&tree, &[], &[], "tree", &small()).unwrap();
    let with = bake_sheet(&tree, &[&baked], &[], "tree", &small()).unwrap();
    assert_eq!(without.width(), with.width());
    assert_eq!(without.height(), with.height());
    assert_ne!(without, with);
}

#[test]
fn a_neighbor_stands_where_it_would_as_a_part_of_the_plant() {
    let leaf = |center| (quad(center, Vec3::X * 0.5, Vec3::Y * 0.5), Role::Leaf, gray(0.15));
    let (own, beside) = (Vec3::ZERO, Vec3::new(2.0, 1.0, -0.5));
    let together = plant(vec![leaf(own), leaf(beside)], vec![]);
    // A quarter turn takes +X, where it stands in its own file, to -Z; twice as large, it stood half as far.
    let turned = quad(Vec3::new(0.25, 0.5, 1.0), Vec3::Z * 0.25, Vec3::Y * 0.25);
    let other = plant(vec![(turned, Role::Leaf, gray(0.15))], vec![]);
    let transform = foliar_bake::Placement { offset_m: glam::DVec3::ZERO, yaw_deg: 90.0, scale: 2.0 }.transform();
    let around = [Standing { plant: other, layers: Vec::new(), transform }];
    for shading in [Shading::Plain, Shading::Stock, Shading::Lines(Normals::Plain)] {
        let one = render(&together, &[], &shading, &small()).unwrap();
        let two = render_among(&plant(vec![leaf(own)], vec![]), &[], &around, &shading, &small()).unwrap();
        let step = |a: &Rgba<u8>, b: &Rgba<u8>| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max() > Some(2);
        let different = one.pixels().zip(two.pixels()).filter(|(a, b)| step(a, b)).count();
        // As where a plant is moved: rounding flips a sample at an edge here and there.
        assert!(different <= 11, "{different} of 10800 pixels differ: {shading:?}");
    }
}
