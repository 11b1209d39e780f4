//! The room's values: weights of every vertex.

use crate::bark::Fitted;
use crate::joint::{self, Joint};
use crate::leaves;
use crate::sway::{Exit, Rule, Weights};
use crate::wood::Wood;
use foliar_plant::{Branches, LEVELS, NO_BRANCH, Plant};
use foliar_schema::Role;
use rayon::prelude::*;

/// Faces of a branch lie no farther along it than so many radii from the bark that they are nearest to.
const LEAF_WINDOW: f64 = 2.0;

/// What the room gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    /// Per part, per vertex: weights of the four levels; empty where a part sways with no branch.
    pub weights: Vec<Vec<[f32; LEVELS]>>,
    /// Per part, per vertex: a leaf's own weight; empty where a part is no leaf.
    pub leaf_weights: Vec<Vec<f32>>,
    /// Longest way from bark to tip at each level, meters.
    pub longest_m: Weights,
}

/// Values of a plant with branches.
pub fn values(plant: &Plant, branches: &Branches, rule: Rule) -> Values {
    let wood = Wood::new(plant, branches);
    let joints = match rule.exit {
        Exit::Bark => joint::joints(&wood, branches),
        Exit::Root => vec![Joint::default(); branches.count()],
    };
    let fitted = Fitted::new(&wood, branches, rule, &joints);
    let of_leaf: Vec<[f32; LEVELS]> = (0..branches.leaves.len())
        .into_par_iter()
        .map(|leaf| leaves::on_branch(plant, &wood, &fitted, leaf, Some(LEAF_WINDOW)))
        .collect();
    let weights = (0..plant.parts().len())
        .map(|part| match plant.role(part) {
            _ if branches.count() == 0 => Vec::new(),
            Role::Wood => of_wood(plant, &fitted, part),
            Role::Leaf => {
                let weights = |vertex| plant.leaf_of(part, vertex).map_or([0.0; LEVELS], |leaf| of_leaf[leaf as usize]);
                (0..plant.parts()[part].positions.len()).map(weights).collect()
            }
            Role::Other => Vec::new(),
        })
        .collect();
    Values { weights, leaf_weights: leaves::own_weights(plant), longest_m: fitted.sway.longest_m }
}

fn of_wood(plant: &Plant, fitted: &Fitted, part: usize) -> Vec<[f32; LEVELS]> {
    let places = &fitted.sway.branches.vertices[part];
    let of = |vertex: usize| match places.get(vertex) {
        Some(place) if place.branch != NO_BRANCH => {
            fitted.of((part as u32, vertex as u32), place.branch, place.arc.into()).map(|w| w as f32)
        }
        _ => [0.0; LEVELS],
    };
    (0..plant.parts()[part].positions.len()).into_par_iter().map(of).collect()
}
