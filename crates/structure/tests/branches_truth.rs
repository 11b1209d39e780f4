//! Plants made by rule know their hierarchy: what is found is held against it.
#![expect(clippy::unwrap_used, reason = "a test that fails here says where")]

use foliar_plant::sample::{HARD_TREES, Recipe, hard_tree};
use foliar_structure::branches::{Accuracy, BranchParams, Method, Truth, find};

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

#[test]
fn hard_trees() {
    for name in HARD_TREES {
        for seed in [1, 2] {
            let tree = hard_tree(name, seed).unwrap();
            let robust = accuracy(&tree.plant, &BranchParams::default());
            let literal =
                accuracy(&tree.plant, &BranchParams { method: Method::Kusternig07, ..BranchParams::default() });
            println!(
                "{name:24} n {:4} literal {:.3} {:.3} robust parent {:.4} level {:.4} chain {:.4} purity {:.4} leaf {:.4}",
                robust.branches,
                literal.parent,
                literal.level,
                robust.parent,
                robust.level,
                robust.chain,
                robust.purity,
                robust.leaf
            );
        }
    }
}
