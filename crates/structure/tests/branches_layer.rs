//! The layer `branches` holds what the plant says, and belongs to the room that the contract names.

use foliar_plant::sample::odd_plants;
use foliar_schema::{COLUMNS, Element, names};
use foliar_structure::branches::to_layer;

#[test]
fn layers_of_odd_plants_say_what_their_branches_are() {
    for sample in odd_plants() {
        let plant = &sample.plant;
        let Some(branches) = plant.branches() else { continue };
        let layer = to_layer(branches, plant.base(), plant.structure(), "hash");
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
