//! Leaves: the weights of the place on the branch where each hangs, and its own weight from petiole to tip.

use crate::bark::Fitted;
use crate::wood::Wood;
use foliar_plant::{LEVELS, Leaf, NO_BRANCH, Plant};
use foliar_schema::Role;
use foliar_space::closest_on_triangle;
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

/// A leaf moves as the bark does where it hangs: at the place of its branch's faces that is nearest to the bark between the
/// axis and the petiole. Faces are sought `window` radii up and down, or everywhere.
pub(crate) fn on_branch(
    plant: &Plant,
    wood: &Wood,
    fitted: &Fitted,
    leaf: usize,
    window: Option<f64>,
) -> [f32; LEVELS] {
    let (place, branches) = (fitted.sway.branches.leaves[leaf], fitted.sway.branches);
    if place.branch == NO_BRANCH {
        return [0.0; LEVELS];
    }
    let spot = branches.axes[place.branch as usize].at(place.arc.into());
    let toward = (plant.leaves()[leaf].petiole.as_dvec3() - spot.point).normalize_or(DVec3::Y);
    let bark = spot.point + toward * spot.radius - plant.center();
    let window = window.map_or(f64::INFINITY, |radii| radii * spot.radius);
    let mut best = (f64::INFINITY, None);
    for face in wood.between(place.branch, spot.arc - window, spot.arc + window) {
        let corners = face.vertices().map(|v| wood.place(v));
        // Relative to the bark, so that f32 is as fine as the face is small.
        let near = closest_on_triangle(glam::Vec3::ZERO, corners.map(|c| (c - bark).as_vec3())).as_dvec3();
        if near.length_squared() < best.0 {
            best = (near.length_squared(), Some((face.vertices(), corners.map(|c| c - bark), near)));
        }
    }
    let weights = match best.1 {
        Some((vertices, corners, near)) => {
            let powers = fitted.powers(wood, place.branch, vertices, shares(near, corners));
            fitted.sway.roots(powers)
        }
        None => fitted.sway.on_bark(place.branch, place.arc.into()),
    };
    weights.map(|w| w as f32)
}

/// Shares of a triangle's corners at a place in it.
fn shares(place: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).length();
    let (of_a, of_b, of_c) = (area(place, b, c), area(place, c, a), area(place, a, b));
    let all = (of_a + of_b + of_c).max(f64::MIN_POSITIVE);
    [of_a / all, of_b / all, of_c / all]
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
