//! Plants made by rule know their hierarchy: what is found is held against it.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::sample::Recipe;
use foliar_structure::branches::{Accuracy, BranchParams, Truth, find};

fn accuracy(plant: &foliar_plant::Plant, params: &BranchParams) -> Accuracy {
    let found = find(plant.base(), plant.structure(), params).unwrap();
    plant.clone().with_branches(found.branches.clone()).unwrap();
    Truth::of_sample(plant.branches().unwrap()).compare(&found.branches)
}

#[test]
fn grown_trees() {
    for recipe in [Recipe::small(), Recipe { texture_px: 0, ..Recipe::linden() }] {
        println!("{:?}", accuracy(&recipe.grow(), &BranchParams::default()));
    }
}
