//! A whole plant in motion: the layer's values and the tables, vertex by vertex as a shader would move them.

use crate::motion::{Branch, Gust, Vertex, travel};
use crate::noise::Field;
use foliar_bake::Layer;
use foliar_plant::{LEVELS, NO_BRANCH, Part, Plant};
use foliar_schema::{Role, names};
use glam::{DQuat, DVec2, DVec3};
use rayon::prelude::*;

/// A plant that can move.
#[derive(Clone, Debug)]
pub struct Player<'a> {
    plant: &'a Plant,
    /// Per part, per vertex; empty where nothing sways.
    pub weights: Vec<Vec<[f32; LEVELS]>>,
    /// Per part, per vertex: a leaf's own weight; empty where a part is no leaf.
    pub leaf_weights: Vec<Vec<f32>>,
    branches: Vec<Branch>,
    /// Per leaf: from petiole to tip.
    axes: Vec<DVec3>,
    still: Gust,
}

/// Tiles of the noise that each level passes a second: with 32 waves in a tile, the stem's fastest sway is at 1.6 Hz.
pub const TILES_PER_SECOND: [f64; LEVELS] = [0.05, 0.08, 0.12, 0.2];

impl<'a> Player<'a> {
    /// A plant with the layer that the wind room made of it; none where they do not belong together.
    pub fn new(plant: &'a Plant, layer: &Layer) -> Option<Player<'a>> {
        let list = |name: &str| layer.record.facts.get(name).and_then(four);
        let floats = |part: usize, name: &str, width: usize| {
            let array = layer.attribute(plant.parts()[part].place, name).filter(|array| array.width() == width);
            array.and_then(|array| array.as_f32()).unwrap_or(&[])
        };
        let parts = 0..plant.parts().len();
        let weights: Vec<Vec<[f32; LEVELS]>> =
            parts.clone().map(|part| floats(part, names::WIND_WEIGHTS, LEVELS).as_chunks().0.to_vec()).collect();
        let leaf_weights: Vec<Vec<f32>> = parts.map(|part| floats(part, names::LEAF_WEIGHT, 1).to_vec()).collect();
        let counts = plant.parts().iter().map(|part| part.positions.len());
        let fits = |length: usize, count: usize| length == 0 || length == count;
        let whole = counts.zip(weights.iter().zip(&leaf_weights));
        if !whole.into_iter().all(|(count, (w, l))| fits(w.len(), count) && fits(l.len(), count)) {
            return None;
        }
        let still = Gust::still(list("exponents")?, list("longestM")?);
        Some(Player {
            plant,
            axes: axes(plant, &leaf_weights),
            branches: tables(plant, layer)?,
            weights,
            leaf_weights,
            still,
        })
    }

    /// Still air.
    pub fn still(&self) -> &Gust {
        &self.still
    }

    /// The branches' tables.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Wind along a horizontal direction, `seconds` after its start, that moves the tip of each level's longest branch
    /// by `share` of its length where the noise peaks. `push` is the mean offset, in the same.
    pub fn gust(&self, share: f64, seconds: f64, toward: DVec2, push: f64) -> Gust {
        let toward = toward.normalize_or_zero();
        let size = self.mean_leaf_m();
        let still = self.still.clone();
        Gust {
            amplitude_m: still.longest_m.map(|longest| share * longest),
            travel: TILES_PER_SECOND.map(|speed| travel(seconds, speed, DVec2::new(1.0, 0.618))),
            wind: DVec3::new(toward.x, 0.0, toward.y) * push,
            leaf: crate::LeafGust {
                amplitude_m: 2.0 * share * size,
                scale_per_m: 0.05,
                roll: travel(seconds, 0.3, toward),
                yaw_rad: 4.0 * share,
            },
            ..still
        }
    }

    /// Per leaf: from petiole to tip.
    pub fn axes(&self) -> &[DVec3] {
        &self.axes
    }

    fn mean_leaf_m(&self) -> f64 {
        self.axes.iter().map(|axis| axis.length()).sum::<f64>() / self.axes.len().max(1) as f64
    }

    /// Displacement of each branch.
    pub fn displacements(&self, gust: &Gust, noise: &Field) -> Vec<DVec3> {
        let of = |branch: &Branch| gust.displacement(branch, noise.at(gust.noise_place(branch)));
        self.branches.iter().map(of).collect()
    }

    /// Every vertex of every part at rest. Tangents are any that lie in the surface.
    pub fn rest(&self) -> Vec<Vec<Vertex>> {
        let parts = self.plant.parts().iter();
        parts.map(|part| (0..part.positions.len()).into_par_iter().map(|v| at_rest(part, v)).collect()).collect()
    }

    /// Every vertex of every part, moved. Rest frame.
    pub fn moved(&self, gust: &Gust, noise: &Field) -> Vec<Vec<Vertex>> {
        self.moved_from(&self.rest(), gust, noise)
    }

    /// The same from places and normals at rest.
    pub fn moved_from(&self, rest: &[Vec<Vertex>], gust: &Gust, noise: &Field) -> Vec<Vec<Vertex>> {
        let displacements = self.displacements(gust, noise);
        let leaves: Vec<DVec2> =
            self.plant.leaves().iter().map(|leaf| noise.at(gust.leaf_noise_place(leaf.petiole.as_dvec3()))).collect();
        let of_part = |(part, rest): (usize, &Vec<Vertex>)| {
            let one =
                |(vertex, rest): (usize, &Vertex)| self.vertex(rest, (part, vertex), gust, &displacements, &leaves);
            rest.par_iter().enumerate().map(one).collect()
        };
        rest.iter().enumerate().map(of_part).collect()
    }

    /// The plant as it stands in this wind; none where it would leave the world, or its parts are flat.
    pub fn moved_plant(&self, gust: &Gust, noise: &Field) -> Option<Plant> {
        let mut base = self.plant.base().clone();
        for (part, moved) in base.parts.iter_mut().zip(self.moved(gust, noise)) {
            let to_mesh = part.transform.inverse();
            part.normals = match part.normals.is_empty() {
                true => Vec::new(),
                false => moved.iter().map(|v| part.normal_to_mesh(v.normal).as_vec3()).collect(),
            };
            part.positions = moved.iter().map(|v| to_mesh.transform_point3(v.position).as_vec3()).collect();
        }
        let moved = Plant::new(base, self.plant.structure().clone()).ok()?;
        moved.with_branches(self.plant.branches()?.clone()).ok()
    }

    fn vertex(
        &self,
        rest: &Vertex,
        (part, vertex): (usize, usize),
        gust: &Gust,
        displacements: &[DVec3],
        noise: &[DVec2],
    ) -> Vertex {
        let rest = *rest;
        let Some(branches) = self.plant.branches() else { return rest };
        let weights = self.weights[part].get(vertex).map_or([0.0; LEVELS], |w| w.map(f64::from));
        let (rest, branch, own) = match self.plant.leaf_of(part, vertex).map(|leaf| leaf as usize) {
            Some(leaf) => {
                let weight = self.leaf_weights[part].get(vertex).map_or(0.0, |w| f64::from(*w));
                let petiole = self.plant.leaves()[leaf].petiole.as_dvec3();
                let rest = match self.plant.leaves()[leaf].crown_volume {
                    true => rest,
                    false => gust.flutter(&rest, weight, petiole, self.axes[leaf], noise[leaf]),
                };
                (rest, branches.leaves[leaf].branch, false)
            }
            None => (rest, branches.vertices[part].get(vertex).map_or(NO_BRANCH, |place| place.branch), true),
        };
        let Some(row) = branches.rows.get(branch as usize) else { return rest };
        let chain = row.chain.map(|id| displacements.get(id as usize).copied().unwrap_or_default());
        let own = self.branches.get(branch as usize).filter(|_| own && self.plant.role(part) == Role::Wood);
        gust.bend(&rest, weights, chain, own)
    }
}

/// A vertex at rest, rest frame.
fn at_rest(part: &Part, vertex: usize) -> Vertex {
    let normal = part.normals.get(vertex).map_or(DVec3::Y, |n| part.normal_to_rest(n.as_dvec3()));
    Vertex { position: part.rest_position(vertex), normal, tangent: normal.any_orthonormal_vector() }
}

fn four(value: &serde_json::Value) -> Option<[f64; LEVELS]> {
    let list: Option<Vec<f64>> = value.as_array()?.iter().map(serde_json::Value::as_f64).collect();
    list?.try_into().ok()
}

fn tables(plant: &Plant, layer: &Layer) -> Option<Vec<Branch>> {
    let rows = &plant.branches()?.rows;
    let column = |name: &str| layer.column(names::CLASS_WIND, name).and_then(|array| array.as_f32()).unwrap_or(&[]);
    let (phases, frames) = (column("phase").as_chunks::<2>().0, column("frame").as_chunks::<4>().0);
    let whole = phases.len() == rows.len() && frames.len() == rows.len();
    let levels = layer.record.facts.get("levels").and_then(serde_json::Value::as_u64)? as usize;
    let branch = |((row, phase), frame): ((&foliar_plant::Branch, &[f32; 2]), &[f32; 4])| Branch {
        // Deeper than the levels that sway: past every list.
        level: if (row.level as usize) < levels { row.level as usize } else { LEVELS },
        frame: DQuat::from_array(frame.map(f64::from)),
        phase: DVec2::from_array(phase.map(f64::from)),
        pivot: row.pivot.as_dvec3(),
    };
    whole.then(|| rows.iter().zip(phases).zip(frames).map(branch).collect())
}

/// From petiole to tip of each leaf: the line through its center, as long as its vertex of weight 1 is far.
fn axes(plant: &Plant, weights: &[Vec<f32>]) -> Vec<DVec3> {
    let mut axes = vec![DVec3::ZERO; plant.leaves().len()];
    for (part, list) in weights.iter().enumerate() {
        for (vertex, _) in list.iter().enumerate().filter(|(_, weight)| **weight >= 1.0) {
            if let Some(leaf) = plant.leaf_of(part, vertex) {
                let row = &plant.leaves()[leaf as usize];
                let (petiole, center) = (row.petiole.as_dvec3(), row.center.as_dvec3());
                let way = plant.parts()[part].rest_position(vertex) - petiole;
                let axis = (center - petiole).normalize_or(way.normalize_or_zero());
                axes[leaf as usize] = axis * way.dot(axis).max(0.0);
            }
        }
    }
    axes
}
