//! Laws of what is chosen: a camera's place, one number of several, what a sheet of everything holds.

use super::*;
use crate::key::Key;
use crate::values::{false_colors, shown_names};
use crate::{Shading, channel_sheet, colors, comparison, render};
use foliar_plant::sample::Recipe;

#[test]
fn a_chosen_camera_stands_where_it_is_put() {
    // Two squares of 2 m, 10 m apart; the camera looks at the right one from 5 m.
    let square = |x: f32| (quad(Vec3::new(x, 1.0, 0.0), Vec3::X, Vec3::Y), Role::Wood, gray(0.2));
    let pair = plant(vec![square(0.0), square(10.0)], vec![]);
    let params = ViewParams { target_m: Some([10.0, 1.0, 0.0]), distance_m: Some(5.0), ..frontal() };
    let seen = covered(&render(&pair, &[], &Shading::Plain, &params).unwrap());
    // 2 m at 5 m, where the picture's 180 rows are 2 * 5 tan(15 deg) = 2.679 m: 134.4 pixels a side.
    let side = 180.0 * 2.0 / (10.0 * libm::tan(15f64.to_radians()));
    // Either edge of either side is right to a sample's share of a pixel: a pixel of each is ample.
    assert!((seen.sqrt() - side).abs() < 1.0, "{} for {side}", seen.sqrt());
    let far = covered(&render(&pair, &[], &Shading::Plain, &ViewParams { distance_m: Some(10.0), ..params }).unwrap());
    assert!((far.sqrt() - side / 2.0).abs() < 1.0, "twice as far, half as large: {}", far.sqrt());
    // Without a place, the distance is from the plant's center, which is between the squares.
    let between = ViewParams { distance_m: Some(5.0), ..frontal() };
    assert!(covered(&render(&pair, &[], &Shading::Plain, &between).unwrap()) < 1.0, "nothing stands there");
    let beyond = ViewParams { target_m: Some([f64::NAN; 3]), ..frontal() };
    assert!(render(&pair, &[], &Shading::Plain, &beyond).unwrap_err().to_string().contains("finite"));
    let behind = ViewParams { distance_m: Some(-1.0), ..frontal() };
    assert!(render(&pair, &[], &Shading::Plain, &behind).unwrap_err().to_string().contains("distance_m"));
}

/// One leaf whose vertices have these four weights each.
fn weighted(rows: [[f32; 4]; 4]) -> (Plant, Layer) {
    let leaf = plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Leaf, gray(0.2))], vec![]);
    let layer = layer(0, &[("_WIND_WEIGHTS", Array::F32 { data: rows.concat(), width: 4 })]);
    (leaf, layer)
}

#[test]
fn one_number_of_several_is_shown_over_its_range() {
    let (leaf, layer) = weighted([[0.0, 0.0, 1.0, 0.5]; 4]);
    let shown = |name: &str| false_colors(&leaf, &[&layer], name, None);
    let ends = ["_WIND_WEIGHTS[0]", "wind_weights[2]", "_WIND_WEIGHTS[3]"].map(|name| shown(name).unwrap());
    for (found, share) in ends.iter().zip([0.0, 1.0, 0.5]) {
        assert_eq!(found.legend.kind, Key::Ramp(0.0, 1.0), "{:?}", found.legend);
        assert_eq!(found.colors[0], vec![colors::ramp(share); 4]);
    }
    for refused in ["_WIND_WEIGHTS[4]", "_WIND_WEIGHTS[x]", "_WIND_WEIGHTS[1", "role[0]"] {
        let error = shown(refused).err().unwrap().to_string();
        assert!(error.contains("_WIND_WEIGHTS[0] to [3]"), "{refused}: {error}");
    }
}

#[test]
fn a_channel_without_an_end_is_shown_over_what_it_is() {
    let wood = plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Wood, gray(0.2))], vec![]);
    let layer = layer(0, &[("_BRANCH_ARC", Array::scalars(vec![1.0, 2.0, 3.0, 5.0]))]);
    let shown = false_colors(&wood, &[&layer], "_BRANCH_ARC", None).unwrap();
    assert_eq!(shown.legend.kind, Key::Ramp(1.0, 5.0));
    assert_eq!(shown.colors[0][3], colors::ramp(1.0));
}

/// Beside each other the same color is the same value.
#[test]
fn two_pictures_have_one_key() {
    let wood = plant(vec![(quad(Vec3::ZERO, Vec3::X, Vec3::Y), Role::Wood, gray(0.2))], vec![]);
    let with = |data: [f32; 4]| layer(0, &[("_BRANCH_ARC", Array::scalars(data.to_vec()))]);
    let (low, high) = (with([1.0, 2.0, 3.0, 5.0]), with([2.0, 4.0, 6.0, 10.0]));
    let key = Key::Ramp(1.0, 10.0);
    let shown = |layer| false_colors(&wood, &[layer], "_BRANCH_ARC", Some(&key)).unwrap();
    assert_eq!((shown(&low).legend.kind, shown(&high).legend.kind), (key.clone(), key.clone()));
    assert_eq!(shown(&low).colors[0][1], shown(&high).colors[0][0], "2 is 2");
    assert_ne!(shown(&low).colors[0][3], shown(&high).colors[0][3], "5 is not 10, though each is its own greatest");
    let params = ViewParams { channel: Some("_BRANCH_ARC".into()), ..frontal() };
    let [a, b] = [[&low], [&high]];
    let apart = comparison([(&wood, &a, "a"), (&wood, &b, "b")], &[], &params).unwrap();
    let alike = comparison([(&wood, &a, "a"), (&wood, &a, "b")], &[], &params).unwrap();
    assert_ne!(apart, alike);
}

#[test]
fn petioles_are_as_long_as_they_are() {
    let tree = Recipe::small().grow();
    let shown = false_colors(&tree, &[], "petiole-length", None).unwrap();
    let lengths: Vec<f32> = tree.leaves().iter().map(|leaf| (leaf.center - leaf.petiole).length()).collect();
    let ends = [f32::min, f32::max].map(|pick| lengths.iter().copied().reduce(pick).unwrap());
    assert_eq!(shown.legend.kind, Key::Ramp(ends[0], ends[1]));
    assert!(shown.legend.unit == "m" && ends[1] > 0.0);
}

#[test]
fn a_sheet_of_everything_holds_each_name_once() {
    let (leaf, layer) = weighted([[0.5; 4]; 4]);
    assert_eq!(shown_names(&leaf, &[&layer, &layer], false), ["role", "_WIND_WEIGHTS"]);
    let params = ViewParams { width_px: 96, height_px: 96, samples: 1, ..frontal() };
    let sheet = channel_sheet(&leaf, &[&layer], &[], "leaf", &params).unwrap();
    assert!(sheet.width() > 2 * 320 && sheet.width() < 4 * 320, "three panels of the least width: {}", sheet.width());
}
