//! The laws of the house over odd plants, one test each; the plants that are hard to take apart join where they are
//! small enough.

use crate::Wind;
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

foliar_bake::law_tests!(Wind, plants());
