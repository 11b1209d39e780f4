//! Leaves: the weights of the place on the branch where each hangs, and its own weight from petiole to tip.

use foliar_plant::{Leaf, Plant};
use foliar_schema::Role;
use glam::DVec3;

/// Centers nearer to the petiole than this share of the leaf's reach give no axis.
const NO_AXIS: f64 = 1e-3;

/// How far a place of a leaf is along it from its petiole, meters: along the line from petiole to center, or in
/// any direction where there is no such line.
pub(crate) struct Blade {
    petiole: DVec3,
    axis: Option<DVec3>,
}

impl Blade {
    /// The blade of a leaf whose farthest place is `reach` from its petiole.
    pub fn new(leaf: &Leaf, reach: f64) -> Blade {
        let petiole = leaf.petiole.as_dvec3();
        let way = leaf.center.as_dvec3() - petiole;
        Blade { petiole, axis: (way.length() > NO_AXIS * reach).then(|| way.normalize()) }
    }

    pub fn along(&self, place: DVec3) -> f64 {
        match self.axis {
            Some(axis) => (place - self.petiole).dot(axis).max(0.0),
            None => place.distance(self.petiole),
        }
    }
}

/// Own weight of every vertex of leaves, by part; empty for other parts. Rows of a crown volume are no leaves
/// that could flutter: 0.
pub(crate) fn own_weights(plant: &Plant) -> Vec<Vec<f32>> {
    let mut reach = vec![0.0f64; plant.leaves().len()];
    over(plant, |leaf, place| {
        reach[leaf] = reach[leaf].max(place.distance(plant.leaves()[leaf].petiole.as_dvec3()));
    });
    let blades: Vec<Blade> = plant.leaves().iter().zip(&reach).map(|(leaf, reach)| Blade::new(leaf, *reach)).collect();
    let mut longest = vec![0.0f64; plant.leaves().len()];
    over(plant, |leaf, place| longest[leaf] = longest[leaf].max(blades[leaf].along(place)));
    let weight = |part: usize, vertex: usize| {
        let leaf = plant.leaf_of(part, vertex).map(|leaf| leaf as usize);
        let leaf = leaf.filter(|&leaf| longest[leaf] > 0.0 && !plant.leaves()[leaf].crown_volume);
        leaf.map_or(0.0, |leaf| (blades[leaf].along(plant.parts()[part].rest_position(vertex)) / longest[leaf]) as f32)
    };
    let parts = plant.parts().iter().enumerate();
    parts
        .map(|(part, data)| match plant.role(part) {
            Role::Leaf => (0..data.positions.len()).map(|vertex| weight(part, vertex)).collect(),
            _ => Vec::new(),
        })
        .collect()
}

/// Every vertex of every leaf.
fn over(plant: &Plant, mut visit: impl FnMut(usize, DVec3)) {
    for (index, part) in plant.parts().iter().enumerate() {
        if plant.role(index) == Role::Leaf {
            let leaves = (0..part.positions.len()).filter_map(|v| plant.leaf_of(index, v).map(|leaf| (v, leaf)));
            leaves.for_each(|(vertex, leaf)| visit(leaf as usize, part.rest_position(vertex)));
        }
    }
}
