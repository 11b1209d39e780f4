//! The layer `branches` holds what the plant says, belongs to the room that the contract names, and gives back what a room
//! may ask of branches.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_bake::{Array, ColumnKey, Layer};
use foliar_plant::sample::{hard_tree, odd_plants};
use foliar_plant::{Branches, Plant};
use foliar_schema::{COLUMNS, Element, names};
use foliar_structure::branches::{BranchReport, Found, from_layer, to_layer};

#[test]
fn layers_of_odd_plants_say_what_their_branches_are() {
    for sample in odd_plants() {
        let plant = &sample.plant;
        let Some(branches) = plant.branches() else { continue };
        let layer = layer_of(plant);
        let integers = |class, name| layer.column(class, name).and_then(|a| a.as_i32());
        for key in layer.columns.keys() {
            let column = COLUMNS.iter().find(|c| c.class == key.class && c.name == key.property).unwrap();
            assert_eq!(column.room, names::ROOM_BRANCHES, "{}", sample.name);
            let array = layer.column(&key.class, &key.property).unwrap();
            let float = column.element == Element::F32;
            assert_eq!((array.width(), array.as_f32().is_some()), (column.width, float), "{}", sample.name);
        }
        let Some(parents) = integers(names::CLASS_BRANCH, "parent") else {
            assert_eq!(branches.count(), 0, "{}", sample.name);
            continue;
        };
        let right = branches.rows.iter().map(|row| if row.parent == u32::MAX { -1 } else { row.parent as i32 });
        assert!(parents.iter().copied().eq(right), "{}", sample.name);
        if let Some(of_leaves) = integers(names::CLASS_LEAF, "branch") {
            assert!(of_leaves.iter().zip(&branches.leaves).all(|(id, place)| *id == place.branch as i32));
        }
        for (part, list) in plant.parts().iter().zip(&branches.vertices) {
            let ids = layer.attribute(part.place, names::BRANCH_ID).and_then(|a| a.as_f32()).unwrap_or(&[]);
            assert!(ids.iter().zip(list).all(|(id, place)| *id as u32 == place.branch), "{}", sample.name);
        }
    }
}

fn layer_of(plant: &Plant) -> Layer {
    let branches = plant.branches().unwrap().clone();
    let reports = vec![BranchReport { margin: 100.0, gap: 0.5, tubes: 2, ..BranchReport::default() }; branches.count()];
    to_layer(&Found { branches, reports }, plant.base(), plant.structure(), "hash")
}

fn back(layer: &Layer, plant: &Plant) -> Branches {
    let found = from_layer(layer, plant.base(), plant.leaves().len()).unwrap();
    let margins = found.branches.rows.iter().map(|row| f64::from(row.margin));
    assert!(found.reports.iter().zip(margins).all(|(r, margin)| (r.gap, r.tubes, r.margin) == (0.5, 2, margin)));
    found.branches
}

#[test]
fn what_a_layer_gives_back_is_what_was_put_in_as_floats_hold_it() {
    let hard = ["clean", "shrub-7-stems", "islands"].map(|name| hard_tree(name, 1).unwrap().plant);
    for plant in odd_plants().into_iter().map(|sample| sample.plant).chain(hard) {
        let Some(branches) = plant.branches() else { continue };
        let again = back(&layer_of(&plant), &plant);
        assert_eq!(again.rows, branches.rows);
        assert_eq!(again.leaves, branches.leaves);
        for (axis, right) in again.axes.iter().zip(&branches.axes) {
            // A float of an offset, and an arc that is a sum of distances between such.
            let tolerance = f64::from(f32::EPSILON) * right.length().max(right.radii[0]) * right.points.len() as f64;
            let far = |(a, b): (&glam::DVec3, &glam::DVec3)| a.distance(*b) > tolerance;
            assert!(!axis.points.iter().zip(&right.points).any(far) && axis.points.len() == right.points.len());
            assert!((axis.length() - right.length()).abs() <= tolerance);
        }
        for (list, right) in again.vertices.iter().zip(&branches.vertices) {
            let same = |(a, b): (&_, &foliar_plant::OnBranch)| a == b;
            assert!(right.iter().all(|place| place.branch == u32::MAX) || list.iter().zip(right).all(same));
        }
        // The plant takes them, and another reading changes nothing more.
        let plant = plant.clone().with_branches(again.clone()).unwrap();
        assert_eq!(back(&layer_of(&plant), &plant), again);
    }
}

#[test]
fn a_layer_that_does_not_fit_is_refused_by_name() {
    let plant = hard_tree("palm", 1).unwrap().plant;
    let whole = layer_of(&plant);
    let spoiled = |class: &str, property: &str, array: Option<Array>| {
        let (mut layer, key) = (whole.clone(), ColumnKey { class: class.into(), property: property.into() });
        match array {
            Some(array) => layer.columns.insert(key, array),
            None => layer.columns.remove(&key),
        };
        from_layer(&layer, plant.base(), plant.leaves().len()).unwrap_err().to_string()
    };
    let rings = whole.column(names::CLASS_AXIS, "branch").unwrap().rows();
    for (class, property, array) in [
        (names::CLASS_BRANCH, "chain", None),
        (names::CLASS_BRANCH, "margin", Some(Array::scalars(vec![0.0]))),
        (names::CLASS_AXIS, "branch", Some(Array::integers(vec![-1; rings]))),
        (names::CLASS_AXIS, "branch", Some(Array::integers(vec![0; rings]))),
        (names::CLASS_AXIS, "radius", None),
        (names::CLASS_LEAF, "branchArc", None),
        (names::CLASS_BRANCH, "kind", None),
    ] {
        let said = spoiled(class, property, array);
        assert!(said.contains("layer branches") && said.contains(class), "{property}: {said}");
    }
    let mut layer = whole.clone();
    layer.attributes.retain(|key, _| key.name != names::BRANCH_ARC);
    let said = from_layer(&layer, plant.base(), plant.leaves().len()).unwrap_err().to_string();
    assert!(said.contains("mesh 0, primitive 0"), "{said}");
}
