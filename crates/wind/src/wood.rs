//! Faces of wood, branch by branch along each.

use foliar_plant::{Branches, NO_BRANCH, Plant};
use foliar_schema::Role;
use glam::DVec3;

/// A vertex of wood: part and index.
pub(crate) type Vertex = (u32, u32);

/// A face whose corners are on one branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    part: u32,
    corners: [u32; 3],
    /// Lowest and highest arc length of its corners.
    pub low: f32,
    pub high: f32,
}

impl Face {
    pub fn vertices(&self) -> [Vertex; 3] {
        self.corners.map(|v| (self.part, v))
    }
}

/// All faces of wood.
pub(crate) struct Wood<'a> {
    plant: &'a Plant,
    branches: &'a Branches,
    starts: Vec<u32>,
    faces: Vec<Face>,
    /// Per branch: the longest that a face is along it.
    longest: Vec<f32>,
}

impl<'a> Wood<'a> {
    pub fn new(plant: &'a Plant, branches: &'a Branches) -> Wood<'a> {
        let mut starts = vec![0u32; branches.count() + 1];
        each(plant, branches, |branch, _| starts[branch as usize + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut next = starts.clone();
        let none = Face { part: 0, corners: [0; 3], low: 0.0, high: 0.0 };
        let mut faces = vec![none; starts.last().copied().unwrap_or(0) as usize];
        each(plant, branches, |branch, face| {
            faces[next[branch as usize] as usize] = face;
            next[branch as usize] += 1;
        });
        let mut longest = vec![0.0f32; branches.count()];
        for branch in 0..branches.count() {
            let own = &mut faces[starts[branch] as usize..starts[branch + 1] as usize];
            own.sort_by(|a, b| a.low.total_cmp(&b.low));
            longest[branch] = own.iter().map(|face| face.high - face.low).fold(0.0, f32::max);
        }
        Wood { plant, branches, starts, faces, longest }
    }

    /// Faces of a branch that lie between two arc lengths or reach in, by their lowest.
    pub fn between(&self, branch: u32, from: f64, to: f64) -> impl Iterator<Item = &Face> + Clone {
        let own = &self.faces[self.starts[branch as usize] as usize..self.starts[branch as usize + 1] as usize];
        let first = own.partition_point(|face| f64::from(face.low) < from - f64::from(self.longest[branch as usize]));
        let last = own.partition_point(|face| f64::from(face.low) <= to);
        own[first.min(last)..last].iter().filter(move |face| f64::from(face.high) >= from)
    }

    /// Where a vertex is at rest, from the plant's center.
    pub fn place(&self, (part, vertex): Vertex) -> DVec3 {
        self.plant.parts()[part as usize].rest_position(vertex as usize) - self.plant.center()
    }

    /// Arc length of a vertex.
    pub fn arc(&self, (part, vertex): Vertex) -> f32 {
        self.branches.vertices[part as usize][vertex as usize].arc
    }

    /// What copies of one vertex along a texture seam share: part, bits of the place in its mesh, arc length.
    pub fn key(&self, vertex: Vertex) -> Key {
        let place = self.plant.parts()[vertex.0 as usize].positions[vertex.1 as usize];
        (vertex.0, place.to_array().map(f32::to_bits), self.arc(vertex).to_bits())
    }
}

/// See [`Wood::key`].
pub(crate) type Key = (u32, [u32; 3], u32);

fn each(plant: &Plant, branches: &Branches, mut visit: impl FnMut(u32, Face)) {
    for (part, places) in branches.vertices.iter().enumerate() {
        if plant.role(part) != Role::Wood || places.is_empty() {
            continue;
        }
        for &corners in &plant.parts()[part].triangles {
            let [a, b, c] = corners.map(|v| places[v as usize]);
            if a.branch != NO_BRANCH && a.branch == b.branch && b.branch == c.branch {
                let (low, high) = (a.arc.min(b.arc).min(c.arc), a.arc.max(b.arc).max(c.arc));
                visit(a.branch, Face { part: part as u32, corners, low, high });
            }
        }
    }
}
