//! What light sees of a plant: its leaves as samples, and the places that ask.

use foliar_plant::{Leaf, Plant};
use glam::DVec3;

/// The group of a place that belongs to no leaf: nothing is left out there.
pub const NO_GROUP: u32 = u32::MAX;

/// One leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Center, relative to the middle of the leaves and in units of the longest edge of the box around them: all
    /// arithmetic after this is free of place and unit.
    pub center: DVec3,
    /// Unit normal of the front.
    pub normal: DVec3,
    /// One-sided area times alpha coverage, in squares of the same unit; 0 or above.
    pub area: f64,
    /// Leaves of one object share it; an object does not shade itself.
    pub group: u32,
}

/// A place that asks how much stands in each octant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Where, in the frame of the [`Source`]s.
    pub position: DVec3,
    /// Group that is left out; [`NO_GROUP`] for none.
    pub skip: u32,
}

/// All leaves of a plant, in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Foliage {
    /// One per leaf, row = leaf id.
    pub sources: Vec<Source>,
    /// Middle of the box around the centers of leaves, meters, rest frame.
    pub origin: DVec3,
    /// Longest edge of that box, meters; what a length of 1 stands for. 1 where all centers are at one place.
    pub unit_m: f64,
}

impl Foliage {
    /// The leaves of a plant.
    pub fn new(plant: &Plant) -> Foliage {
        let source = |(center, leaf): (DVec3, &Leaf)| Source {
            center,
            normal: leaf.normal.as_dvec3(),
            area: f64::from(leaf.area),
            group: leaf.group,
        };
        Foliage::of(centers(plant).into_iter().zip(plant.leaves()).map(source).collect())
    }

    /// Leaves in meters of the rest frame, brought into the frame of the foliage.
    pub fn of(mut sources: Vec<Source>) -> Foliage {
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = sources.iter().fold(none, |(l, h), s| (l.min(s.center), h.max(s.center)));
        let origin = if sources.is_empty() { DVec3::ZERO } else { low.midpoint(high) };
        let edge = (high - low).max_element();
        let unit_m = if edge > 0.0 { edge } else { lone_unit(&sources) };
        for source in &mut sources {
            source.center = (source.center - origin) / unit_m;
            source.area /= unit_m * unit_m;
        }
        Foliage { sources, origin, unit_m }
    }

    /// A place of the rest frame, meters, in the frame of the sources.
    pub fn place(&self, position: DVec3) -> DVec3 {
        (position - self.origin) / self.unit_m
    }

    /// Each leaf at its own center, asking for all but its own group.
    pub fn queries(&self) -> Vec<Query> {
        self.sources.iter().map(|source| Query { position: source.center, skip: source.group }).collect()
    }
}

/// Where all leaves have one center, the edge of the largest is the only length there is.
fn lone_unit(sources: &[Source]) -> f64 {
    let largest = sources.iter().map(|source| source.area).fold(0.0, f64::max).sqrt();
    if largest > 0.0 { largest } else { 1.0 }
}

/// Area-weighted centers, rest frame, meters: from the triangles themselves where a leaf has any, since the table's
/// are f32 in the scene's frame and lose what a tree far from the origin needs.
pub fn centers(plant: &Plant) -> Vec<DVec3> {
    let leaves = plant.leaves();
    let mut sums = vec![(DVec3::ZERO, 0.0f64); leaves.len()];
    for (index, part) in plant.parts().iter().enumerate() {
        for triangle in &part.triangles {
            let Some(leaf) = plant.leaf_of(index, triangle[0] as usize).map(|leaf| leaf as usize) else { continue };
            if leaves[leaf].crown_volume {
                continue;
            }
            // Relative to the leaf: far from the origin products of coordinates would lose digits.
            let near = leaves[leaf].center.as_dvec3();
            let [a, b, c] = triangle.map(|v| part.rest_position(v as usize) - near);
            let area = (b - a).cross(c - a).length();
            sums[leaf].0 += area * (a + b + c) / 3.0;
            sums[leaf].1 += area;
        }
    }
    let center = |(leaf, (sum, area)): (&Leaf, (DVec3, f64))| {
        leaf.center.as_dvec3() + if area > 0.0 { sum / area } else { DVec3::ZERO }
    };
    leaves.iter().zip(sums).map(center).collect()
}
