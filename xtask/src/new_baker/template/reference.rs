//! The shortest correct program: f64, every vertex against every leaf. Tests compare the fast one with it.

use foliar_plant::Plant;
use foliar_schema::Role;
use glam::DVec3;

/// Weight of a leaf at an offset, 1 at its center, 0 from the radius on. Where all of a plant is one point the radius
/// is 0, and that point counts.
pub fn weight(offset: DVec3, radius: f64) -> f64 {
    let square = if radius > 0.0 { offset.length_squared() / (radius * radius) } else { 0.0 };
    (1.0 - square).max(0.0).powi(2)
}

/// Per part, per vertex: the share; empty where a part is no part of the plant.
pub fn shares(plant: &Plant, radius: f64) -> Vec<Vec<f32>> {
    let total: f64 = plant.leaves().iter().map(|leaf| f64::from(leaf.area)).sum();
    let share = |place: DVec3| {
        let near = |leaf: &foliar_plant::Leaf| f64::from(leaf.area) * weight(place - leaf.center.as_dvec3(), radius);
        let sum: f64 = plant.leaves().iter().map(near).sum();
        if total > 0.0 { (sum / total) as f32 } else { 0.0 }
    };
    let shares = |(index, part): (usize, &foliar_plant::Part)| match plant.role(index) {
        Role::Other => Vec::new(),
        _ => (0..part.positions.len()).map(|vertex| share(part.rest_position(vertex))).collect(),
    };
    plant.parts().iter().enumerate().map(shares).collect()
}
