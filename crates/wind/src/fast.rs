//! The room's values: weights of every vertex.

use crate::bark::{Hidden, coming_out};
use crate::leaves;
use crate::sway::{Rule, Sway, Weights};
use foliar_plant::{Branches, LEVELS, NO_BRANCH, OnBranch, Plant};
use foliar_schema::Role;
use rayon::prelude::*;

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
    let coming = coming_out(plant, branches, rule.exit);
    let sway = Sway::new(branches, rule, coming.iter().map(|c| c.start).collect());
    let hidden = Hidden::solve(plant, &sway, &coming);
    let of_leaf: Vec<[f32; LEVELS]> = branches.leaves.par_iter().map(|place| of_leaf(&sway, place)).collect();
    let weights = (0..plant.parts().len())
        .map(|part| match plant.role(part) {
            _ if branches.count() == 0 => Vec::new(),
            Role::Wood => of_wood(plant, &sway, &hidden, part),
            Role::Leaf => {
                let weights = |vertex| plant.leaf_of(part, vertex).map_or([0.0; LEVELS], |leaf| of_leaf[leaf as usize]);
                (0..plant.parts()[part].positions.len()).map(weights).collect()
            }
            Role::Other => Vec::new(),
        })
        .collect();
    Values { weights, leaf_weights: leaves::own_weights(plant), longest_m: sway.longest_m }
}

fn of_wood(plant: &Plant, sway: &Sway, hidden: &Hidden, part: usize) -> Vec<[f32; LEVELS]> {
    let places = &sway.branches.vertices[part];
    let of = |vertex: usize| match (hidden.get(part, vertex), places.get(vertex)) {
        (Some(weights), _) => weights.map(|w| w as f32),
        (None, Some(place)) if place.branch != NO_BRANCH => {
            sway.of_ring(place.branch, f64::from(place.arc)).map(|w| w as f32)
        }
        _ => [0.0; LEVELS],
    };
    (0..plant.parts()[part].positions.len()).into_par_iter().map(of).collect()
}

/// A leaf moves as the bark does where it hangs.
pub(crate) fn of_leaf(sway: &Sway, place: &OnBranch) -> [f32; LEVELS] {
    match place.branch {
        NO_BRANCH => [0.0; LEVELS],
        branch => sway.on_bark(branch, f64::from(place.arc)).map(|w| w as f32),
    }
}
