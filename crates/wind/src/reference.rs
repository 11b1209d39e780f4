//! The shortest program for the same values: every vertex against every triangle, nothing gathered before. What tests
//! compare the fast one with; it shares the weights along a branch (`sway`) with it, not the bark rule nor leaves.

use crate::bark::TOUCH;
use crate::fast::{Values, of_leaf};
use crate::leaves::Blade;
use crate::sway::{Rule, Sway, Weights};
use foliar_plant::{Branches, LEVELS, NO_BRANCH, OnBranch, Plant};
use foliar_schema::Role;
use glam::DVec3;
use std::collections::BTreeSet;

/// Halvings that find where an edge pierces the bark.
const HALVINGS: usize = 50;

/// Values of a plant with branches.
pub fn values(plant: &Plant, branches: &Branches, rule: Rule) -> Values {
    let coming: Vec<(f64, BTreeSet<(usize, usize)>)> =
        (0..branches.count()).map(|branch| coming_out(plant, branches, branch)).collect();
    let sway = Sway::new(branches, rule, coming.iter().map(|c| c.0).collect());
    let weight = |part: usize, vertex: usize| -> [f32; LEVELS] {
        let place = branches.vertices[part].get(vertex).copied().unwrap_or(OnBranch::NONE);
        match plant.leaf_of(part, vertex) {
            Some(leaf) => of_leaf(&sway, &branches.leaves[leaf as usize]),
            None if place.branch == NO_BRANCH => [0.0; LEVELS],
            None => match coming[place.branch as usize].1.contains(&(part, vertex)) {
                true => hidden(plant, &sway, &coming[place.branch as usize].1, (part, vertex)).map(|w| w as f32),
                false => sway.of_ring(place.branch, f64::from(place.arc)).map(|w| w as f32),
            },
        }
    };
    let all = |part: usize| 0..plant.parts()[part].positions.len();
    let sways = |part: &usize| branches.count() > 0 && plant.role(*part) != Role::Other;
    let parts = 0..plant.parts().len();
    let weights = parts.clone().map(|part| all(part).filter(|_| sways(&part)).map(|v| weight(part, v)).collect());
    let leaf =
        |part: usize| all(part).filter(move |_| plant.role(part) == Role::Leaf).map(move |v| own(plant, part, v));
    let leaf_weights = parts.clone().map(|part| leaf(part).collect());
    Values { weights: weights.collect(), leaf_weights: leaf_weights.collect(), longest_m: sway.longest_m }
}

/// Distance to the bark of a branch, below 0 inside, and where.
fn outside(branches: &Branches, parent: u32, place: DVec3) -> (f64, f64) {
    let spot = branches.axes[parent as usize].nearest(place);
    (spot.distance - spot.radius * (1.0 - TOUCH), spot.arc)
}

/// Arc length of the first ring wholly outside, and the vertices inside before it.
fn coming_out(plant: &Plant, branches: &Branches, branch: usize) -> (f64, BTreeSet<(usize, usize)>) {
    let row = branches.rows[branch];
    let mut inside = BTreeSet::new();
    if row.parent == NO_BRANCH {
        return (0.0, inside);
    }
    let mut list = Vec::new();
    for (part, places) in branches.vertices.iter().enumerate() {
        let own = places.iter().enumerate().filter(|(_, place)| place.branch as usize == branch);
        list.extend(own.map(|(vertex, place)| (place.arc, part, vertex)));
    }
    let mut arcs: Vec<f32> = list.iter().map(|v| v.0).collect();
    arcs.sort_by(f32::total_cmp);
    for arc in arcs {
        let ring = list.iter().filter(|v| v.0.total_cmp(&arc).is_eq());
        let is_in =
            |v: &&(f32, usize, usize)| outside(branches, row.parent, plant.parts()[v.1].rest_position(v.2)).0 < 0.0;
        let below: Vec<_> = ring.filter(is_in).map(|v| (v.1, v.2)).collect();
        if below.is_empty() {
            return (f64::from(arc), inside);
        }
        inside.extend(below);
    }
    (branches.attachments[branch].bark_arc.min(branches.axes[branch].length()), BTreeSet::new())
}

/// Least squares over the edges that pierce the bark at a hidden place.
fn hidden(plant: &Plant, sway: &Sway, inside: &BTreeSet<(usize, usize)>, vertex: (usize, usize)) -> Weights {
    let (part, branches) = (&plant.parts()[vertex.0], sway.branches);
    let branch = branches.vertices[vertex.0][vertex.1].branch;
    let (position, parent) = (part.positions[vertex.1], branches.rows[branch as usize].parent);
    let (mut sum, mut total) = ([0.0; LEVELS], 0.0);
    for (from, to) in part.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]) {
        let far = branches.vertices[vertex.0][to as usize];
        if part.positions[from as usize] != position
            || branches.vertices[vertex.0][from as usize].branch != branch
            || far.branch != branch
            || inside.contains(&(vertex.0, to as usize))
        {
            continue;
        }
        let (start, end) = (part.rest_position(from as usize), part.rest_position(to as usize));
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *if outside(branches, parent, start.lerp(end, middle)).0 < 0.0 { &mut low } else { &mut high } = middle;
        }
        let of_parent = sway.powers_on_bark(parent, outside(branches, parent, start.lerp(end, high)).1);
        let of_end = sway.powers(sway.of_ring(branch, f64::from(far.arc)));
        total += (1.0 - high) * (1.0 - high);
        (0..LEVELS).for_each(|l| sum[l] += (1.0 - high) * (of_parent[l] - high * of_end[l]));
    }
    if total > 0.0 { sway.roots(sum.map(|s| s / total)) } else { sway.inherited[branch as usize] }
}

/// A leaf vertex's own weight.
fn own(plant: &Plant, part: usize, vertex: usize) -> f32 {
    let Some(id) = plant.leaf_of(part, vertex).filter(|&id| !plant.leaves()[id as usize].crown_volume) else {
        return 0.0;
    };
    let leaf = &plant.leaves()[id as usize];
    let mut places = Vec::new();
    for (index, data) in plant.parts().iter().enumerate() {
        let of_leaf = (0..data.positions.len()).filter(|&v| plant.leaf_of(index, v) == Some(id));
        places.extend(of_leaf.map(|v| data.rest_position(v)));
    }
    let reach = places.iter().map(|p| p.distance(leaf.petiole.as_dvec3())).fold(0.0, f64::max);
    let blade = Blade::new(leaf, reach);
    let longest = places.iter().map(|p| blade.along(*p)).fold(0.0, f64::max);
    let way = blade.along(plant.parts()[part].rest_position(vertex));
    if longest > 0.0 { (way / longest) as f32 } else { 0.0 }
}
