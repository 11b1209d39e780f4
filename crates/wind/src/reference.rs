//! The shortest program for the same values: every edge of a branch against every face of its parent, every leaf against every
//! face of its branch, nothing gathered before. What tests compare the fast one with; it shares with it the weights along a
//! branch (`sway`) and what follows from the crossings (`bark`).

use crate::bark::Fitted;
use crate::fast::Values;
use crate::joint::{self, Crossing, Joint};
use crate::leaves::{self, Blade};
use crate::sway::Rule;
use crate::wood::{Face, Vertex, Wood};
use foliar_plant::{Branches, LEVELS, NO_BRANCH, OnBranch, Plant};
use foliar_schema::Role;
use glam::DVec3;

/// Values of a plant with branches.
pub fn values(plant: &Plant, branches: &Branches, rule: Rule) -> Values {
    let wood = Wood::new(plant, branches);
    let joints: Vec<Joint> = (0..branches.count() as u32).map(|branch| joint(&wood, branches, branch)).collect();
    let fitted = Fitted::new(&wood, branches, rule, &joints);
    let weight = |part: usize, vertex: usize| -> [f32; LEVELS] {
        let place = branches.vertices[part].get(vertex).copied().unwrap_or(OnBranch::NONE);
        match plant.leaf_of(part, vertex) {
            Some(leaf) => leaves::on_branch(plant, &wood, &fitted, leaf as usize, None),
            None if place.branch == NO_BRANCH => [0.0; LEVELS],
            None => fitted.of((part as u32, vertex as u32), place.branch, place.arc.into()).map(|w| w as f32),
        }
    };
    let all = |part: usize| 0..plant.parts()[part].positions.len();
    let sways = |part: &usize| branches.count() > 0 && plant.role(*part) != Role::Other;
    let parts = 0..plant.parts().len();
    let weights = parts.clone().map(|part| all(part).filter(|_| sways(&part)).map(|v| weight(part, v)).collect());
    let leaf =
        |part: usize| all(part).filter(move |_| plant.role(part) == Role::Leaf).map(move |v| own(plant, part, v));
    let leaf_weights = parts.clone().map(|part| leaf(part).collect());
    Values { weights: weights.collect(), leaf_weights: leaf_weights.collect(), longest_m: fitted.sway.longest_m }
}

/// Every edge of a branch near its root against every face of its parent.
fn joint(wood: &Wood, branches: &Branches, branch: u32) -> Joint {
    let row = &branches.rows[branch as usize];
    if row.parent == NO_BRANCH {
        return Joint::default();
    }
    let own: Vec<Face> = wood.between(branch, 0.0, f64::INFINITY).copied().collect();
    let reach = joint::reach(branches, branch);
    let mut edges: Vec<[Vertex; 2]> = own
        .iter()
        .map(Face::vertices)
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| if (wood.arc(a), wood.key(a)) <= (wood.arc(b), wood.key(b)) { [a, b] } else { [b, a] })
        .filter(|[low, _]| f64::from(wood.arc(*low)) <= reach)
        .collect();
    edges.sort_by_key(|ends| ends.map(|v| wood.key(v)));
    edges.dedup_by_key(|ends| ends.map(|v| wood.key(v)));
    let mut crossings = Vec::new();
    for ends in edges {
        for face in wood.between(row.parent, 0.0, f64::INFINITY) {
            if let Some((share, shares)) = pierce(ends.map(|v| wood.place(v)), face.vertices().map(|v| wood.place(v))) {
                crossings
                    .push((ends.map(|v| wood.key(v)), Crossing { ends: [0; 2], share, face: face.vertices(), shares }));
            }
        }
    }
    joint::gathered(wood, crossings, branches, branch)
}

/// By volumes: the ends lie on both sides of the triangle, and the line goes round all its sides the same way.
fn pierce([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    let (above, below) = (volume(a, b, c, p), -volume(a, b, c, q));
    let around = [volume(p, q, b, c), volume(p, q, c, a), volume(p, q, a, b)];
    let (through, all) = (above + below, around.iter().sum::<f64>());
    let shares = around.map(|x| x / all);
    let inside = above * below >= 0.0 && shares.iter().all(|x| *x >= 0.0);
    inside.then_some((above / through, shares)).filter(|(share, _)| share.is_finite())
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
