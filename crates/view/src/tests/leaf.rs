//! A leaf by itself: light from the side that its bumps lean to shows them, two equal bakes do not differ.

use crate::{ViewError, leaf_comparison, leaf_names, leaf_sheet};
use foliar_bake::{FloatRaster, Layer};
use foliar_schema::{Record, names};
use foliar_translucency::light::coefficients;
use glam::DVec3;
use image::RgbaImage;

/// 320 x 320 texels whose left half leans left and whose right half leans right, with an empty rim.
fn layer() -> Layer {
    const SIDE: usize = 320;
    let texel = |at: usize| {
        let (x, y) = (at % SIDE, at / SIDE);
        if x.min(y) < 4 || x.max(y) >= SIDE - 4 {
            return [0.0; 4];
        }
        let lean = if x < SIDE / 2 { -0.1 } else { 0.1 };
        let c = coefficients(DVec3::new(lean, 0.0, 0.1)).as_vec3();
        [c.x, c.y, c.z, 0.1]
    };
    let data = (0..SIDE * SIDE).flat_map(texel).collect();
    let raster = FloatRaster { width: SIDE as u32, height: SIDE as u32, channels: 4, data };
    let mut layer =
        Layer { record: Record { room: names::ROOM_TRANSLUCENCY.into(), ..Record::default() }, ..Layer::default() };
    layer.rasters.insert(names::RASTER_TRANSLUCENCY_BACK.into(), raster);
    layer
}

/// Mean green of a place, 12 pixels and the title above the first picture.
fn green(sheet: &RgbaImage, [column, row]: [u32; 2], x: u32) -> f64 {
    let cell = (sheet.width() - 12) / 5;
    let height = 320 + 15 + 4 + 12;
    let top = 12 + 2 * 24;
    let (left, top) = (12 + column * cell + x, top + row * height + 100);
    let all = (0..20).flat_map(|y| (0..20).map(move |x| (left + x, top + y)));
    all.map(|(x, y)| f64::from(sheet.get_pixel(x, y).0[1])).sum::<f64>() / 400.0
}

#[test]
fn a_leaf_answers_to_the_side_that_the_light_is_on() {
    let sheet = leaf_sheet(&layer(), "", "leaf").unwrap();
    // Second and third picture: light from the right, from the left.
    let [right, left] = [1, 2].map(|column| [green(&sheet, [column, 0], 60), green(&sheet, [column, 0], 240)]);
    assert!(right[1] > 2.0 * right[0] && left[0] > 2.0 * left[1], "{right:?} {left:?}");
    let straight = [green(&sheet, [0, 0], 60), green(&sheet, [0, 0], 240)];
    assert!((straight[0] - straight[1]).abs() < 1.0, "{straight:?}");
}

#[test]
fn equal_bakes_do_not_differ() {
    let layer = layer();
    let sheet = leaf_comparison([(&layer, "", "a"), (&layer, "", "b")]).unwrap();
    assert!(sheet.width() > 900);
    let other = Layer::default();
    assert!(matches!(leaf_sheet(&other, "", "x"), Err(ViewError::NoLeaf(_))));
}

/// A leaf among others of a master, both sides: names, rows, and the curve of its own record.
#[test]
fn both_sides_of_a_leaf_of_a_master_are_drawn() {
    let alone = layer();
    let raster = alone.rasters[names::RASTER_TRANSLUCENCY_BACK].clone();
    let mut master = Layer { record: alone.record.clone(), ..Layer::default() };
    for side in [names::RASTER_TRANSLUCENCY_FRONT, names::RASTER_TRANSLUCENCY_BACK] {
        master.rasters.insert(format!("oak/{side}"), raster.clone());
    }
    assert_eq!((leaf_names(&alone), leaf_names(&master)), (vec![String::new()], vec!["oak".to_owned()]));
    let [one, two] = [leaf_sheet(&alone, "", "x").unwrap(), leaf_sheet(&master, "oak", "x").unwrap()];
    assert!(two.width() == one.width() && two.height() > one.height() + 2 * 320);
    assert!(matches!(leaf_sheet(&master, "", "x"), Err(ViewError::NoLeaf(_))));
    // Twice the slope of the curve: brighter by as much; exposure divides it out, so two leaves are held together.
    let slope = |slope: f64| {
        let mut layer = master.clone();
        let curve = serde_json::json!({"oak": {"maps": {names::RASTER_TRANSLUCENCY_FRONT: {"curve": [0.0, slope]}}}});
        layer.record.facts.insert(names::FACT_SHEETS.into(), curve);
        layer
    };
    let [plain, bent] = [slope(1.0), slope(0.5)];
    let held = leaf_comparison([(&plain, "oak", "a"), (&bent, "oak", "b")]).unwrap();
    let cell = (held.width() - 12) / 3;
    let [a, b] = [0, 1].map(|column| held.get_pixel(12 + column * cell + 60, 12 + 24 + 100).0[1]);
    assert!(a > b, "{a} {b}");
}

/// Coefficients go on beyond the rim, for mips: where the mean is 0 there is no leaf.
#[test]
fn nothing_is_drawn_where_there_is_no_leaf() {
    let bare = layer();
    let mut filled = bare.clone();
    let raster = filled.rasters.get_mut(names::RASTER_TRANSLUCENCY_BACK).unwrap();
    for texel in raster.data.chunks_exact_mut(4).filter(|texel| texel[3] <= 0.0) {
        texel[..3].copy_from_slice(&[0.9; 3]);
    }
    assert!(leaf_sheet(&bare, "", "x").unwrap() == leaf_sheet(&filled, "", "x").unwrap());
}
