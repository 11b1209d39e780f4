//! The laws of the house over odd plants, one test each; the plants that are hard to take apart join where they are
//! small enough.

use crate::Wind;
use foliar_bake::laws;
use foliar_plant::sample::{Sample, hard_tree, odd_plants};
use foliar_plant::{Branches, Plant};

/// The plant with branches, where it has none yet.
pub fn branched(plant: Plant) -> Plant {
    if plant.branches().is_some() {
        return plant;
    }
    let vertices = vec![Vec::new(); plant.parts().len()];
    let leaves = vec![foliar_plant::OnBranch::NONE; plant.leaves().len()];
    plant.with_branches(Branches { vertices, leaves, ..Branches::default() }).unwrap()
}

pub fn plants() -> Vec<Sample> {
    let odd = odd_plants().into_iter().map(|sample| Sample { plant: branched(sample.plant), ..sample });
    let hard = ["palm", "forks-equal", "seam-doubled"].map(|name| {
        let tree = hard_tree(name, 1).unwrap();
        Sample { name: tree.name, plant: tree.plant }
    });
    odd.chain(hard).collect()
}

fn holds(law: laws::Law) {
    let breaches: Vec<String> =
        plants().iter().filter_map(|sample| law(&Wind, sample).err()).map(|breach| breach.to_string()).collect();
    assert!(breaches.is_empty(), "{}", breaches.join("\n"));
}

#[test]
fn law_2_own_room() {
    holds(laws::own_room);
}

#[test]
fn law_4_repeatable() {
    holds(laws::repeatable);
}

#[test]
fn law_5_meets_its_reference() {
    holds(laws::meets_reference);
}

#[test]
fn law_6_in_range() {
    holds(laws::in_range);
}

#[test]
fn law_7_defaults_agree() {
    holds(laws::defaults_agree);
}

#[test]
fn law_8_order_free() {
    holds(laws::order_free);
}

#[test]
fn law_8_translation_free() {
    holds(laws::translation_free);
}

#[test]
fn law_8_unit_free() {
    holds(laws::unit_free);
}
