//! The same plant, said otherwise: renumbered, moved, in another unit. What law 8 compares.

use crate::Array;
use foliar_plant::{Base, Branches, NO_LEAF, Part, Plant, PlantError, Structure};
use glam::{DAffine3, DVec3};

/// Row i of a renumbered list is row `(first + i * stride) mod count` of the original.
#[derive(Clone, Copy, Debug)]
pub struct Permutation {
    count: usize,
    stride: usize,
}

impl Permutation {
    /// Mixes `count` rows; the same each time.
    pub fn of(count: usize) -> Self {
        // A prime that does not divide the count visits every row once.
        let stride = [7919, 6007, 4999, 2, 1].into_iter().find(|prime| gcd(*prime, count) == 1).unwrap_or(1);
        Permutation { count, stride }
    }

    /// Original row of new row `index`.
    pub fn old(&self, index: usize) -> usize {
        (self.count / 2 + index * self.stride) % self.count.max(1)
    }

    /// New row of each original row.
    pub fn new_rows(&self) -> Vec<u32> {
        let mut rows = vec![0; self.count];
        (0..self.count).for_each(|index| rows[self.old(index)] = index as u32);
        rows
    }

    /// A list in the new order; an empty list stays empty.
    pub fn list<T: Clone>(&self, rows: &[T]) -> Vec<T> {
        if rows.is_empty() { Vec::new() } else { (0..self.count).map(|i| rows[self.old(i)].clone()).collect() }
    }

    /// An array in the new order.
    pub fn apply(&self, array: &Array) -> Array {
        let width = array.width();
        let pick = |index: usize| self.old(index / width) * width + index % width;
        match array {
            Array::F32 { data, .. } => Array::F32 { width, data: (0..data.len()).map(|i| data[pick(i)]).collect() },
            Array::I32 { data, .. } => Array::I32 { width, data: (0..data.len()).map(|i| data[pick(i)]).collect() },
        }
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Vertices of every part, and leaves, in another order.
///
/// # Errors
/// None for a plant that [`Plant::new`] accepted.
pub fn permuted(plant: &Plant) -> Result<Plant, PlantError> {
    let structure = plant.structure();
    let leaf_order = Permutation::of(structure.leaves.len());
    let new_leaf = leaf_order.new_rows();
    let (mut parts, mut leaf_ids) = (Vec::new(), Vec::new());
    for (part, ids) in plant.parts().iter().zip(&structure.leaf_ids) {
        let order = Permutation::of(part.positions.len());
        let new_vertex = order.new_rows();
        parts.push(Part {
            positions: order.list(&part.positions),
            normals: order.list(&part.normals),
            uvs: order.list(&part.uvs),
            colors: order.list(&part.colors),
            position_ids: order.list(&part.position_ids),
            triangles: part.triangles.iter().map(|t| t.map(|v| new_vertex[v as usize])).collect(),
            ..part.clone()
        });
        let renamed = |id: u32| if id == NO_LEAF { NO_LEAF } else { new_leaf[id as usize] };
        leaf_ids.push(order.list(ids).into_iter().map(renamed).collect());
    }
    let base = Base { parts, ..plant.base().clone() };
    let renumbered =
        Plant::new(base, Structure { leaves: leaf_order.list(&structure.leaves), leaf_ids, ..structure.clone() })?;
    let Some(branches) = plant.branches() else { return Ok(renumbered) };
    // Branches keep their ids: nothing says that those must follow the vertices.
    renumbered.with_branches(Branches {
        vertices: branches.vertices.iter().map(|list| Permutation::of(list.len()).list(list)).collect(),
        leaves: leaf_order.list(&branches.leaves),
        ..branches.clone()
    })
}

/// Moved by a few of its own sizes; a power of two, so that what f32 holds far from the origin stays exact.
///
/// # Errors
/// None for a plant that [`Plant::new`] accepted, unless the move takes it out of the world.
pub fn translated(plant: &Plant) -> Result<Plant, PlantError> {
    let size = plant.size().max_element().max(f64::MIN_POSITIVE);
    let step = libm::exp2(libm::ceil(libm::log2(size)));
    let offset = DVec3::new(2.0, -1.0, 1.0) * step;
    changed(plant, DAffine3::from_translation(offset))
}

/// In a unit 128 times as small: a power of two, so that what f32 holds far from the origin stays exact.
///
/// # Errors
/// None for a plant that [`Plant::new`] accepted, unless it grows out of the world.
pub fn scaled(plant: &Plant) -> Result<Plant, PlantError> {
    changed(plant, DAffine3::from_scale(DVec3::splat(128.0)))
}

/// After a uniform scale and a move.
fn changed(plant: &Plant, change: DAffine3) -> Result<Plant, PlantError> {
    let mut base = plant.base().clone();
    let mut structure = plant.structure().clone();
    base.parts.iter_mut().for_each(|part| part.transform = change * part.transform);
    let scale = change.matrix3.x_axis.length();
    for leaf in &mut structure.leaves {
        leaf.center = change.transform_point3(leaf.center.as_dvec3()).as_vec3();
        leaf.petiole = change.transform_point3(leaf.petiole.as_dvec3()).as_vec3();
        leaf.area = (f64::from(leaf.area) * scale * scale) as f32;
    }
    let changed = Plant::new(base, structure)?;
    match plant.branches() {
        Some(branches) => changed.with_branches(branches.transformed(change)),
        None => Ok(changed),
    }
}
