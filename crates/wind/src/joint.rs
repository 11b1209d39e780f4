//! Where a branch and its parent meet: the edges of the one that pierce faces of the other, on the meshes themselves.

use crate::wood::{Face, Key, Vertex, Wood};
use foliar_plant::{Branches, NO_BRANCH};
use foliar_space::Aabb;
use glam::DVec3;
use rayon::prelude::*;

/// How far along a branch its edges may pierce its parent, in radii of both beyond where its axis does: a branch that
/// comes back to its parent elsewhere is not attached there.
const NEAR_ROOT: f64 = 2.0;
/// How much an edge and a face may miss each other by, as a share of the edge and of the face's sides: rounding, so that
/// no edge slips between two faces.
const SLACK: f64 = 1e-9;

/// An edge that pierces a face of the parent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// Its ends among the joint's places, the lower first.
    pub ends: [u32; 2],
    /// Share of the second end.
    pub share: f64,
    /// Corners of the parent's face, and their shares.
    pub face: [Vertex; 3],
    pub shares: [f64; 3],
}

/// Where a branch and its parent meet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joint {
    /// Ends of edges that pierce, copies along a seam once.
    pub places: Vec<Key>,
    pub crossings: Vec<Crossing>,
    /// Arc length of the first ring that no piercing edge reaches beyond; 0 where nothing pierces.
    pub start: f64,
    /// Vertices at the places, and the place of each.
    pub vertices: Vec<(Vertex, u32)>,
}

/// The joint of every branch; empty for roots.
pub(crate) fn joints(wood: &Wood, branches: &Branches) -> Vec<Joint> {
    let one = |branch: usize| match branches.rows[branch].parent {
        NO_BRANCH => Joint::default(),
        _ => joint(wood, branches, branch as u32),
    };
    (0..branches.count()).into_par_iter().map(one).collect()
}

/// Up to which arc length a branch's edges may pierce its parent.
pub(crate) fn reach(branches: &Branches, branch: u32) -> f64 {
    let (row, attachment) = (&branches.rows[branch as usize], &branches.attachments[branch as usize]);
    attachment.bark_arc + NEAR_ROOT * f64::from(row.radius + branches.rows[row.parent as usize].radius)
}

fn joint(wood: &Wood, branches: &Branches, branch: u32) -> Joint {
    let (row, reach) = (&branches.rows[branch as usize], reach(branches, branch));
    let own: Vec<Face> = wood.between(branch, 0.0, reach).copied().collect();
    let own_around = own.iter().map(|face| around(wood, face)).fold(Aabb::EMPTY, Aabb::union);
    let far = own.iter().map(|face| face.high).fold(0.0, f32::max);
    let near = branches.attachments[branch as usize].bark_parent_arc;
    let window = 2.0 * f64::from(far) + 4.0 * branches.axes[row.parent as usize].at(near).radius;
    let parent: Vec<(Aabb, Face)> = wood
        .between(row.parent, near - window, near + window)
        .map(|face| (around(wood, face), *face))
        .filter(|(around, _)| around.touches(&own_around))
        .collect();
    let parent_around = parent.iter().map(|(around, _)| *around).fold(Aabb::EMPTY, Aabb::union);
    let mut edges = edges(wood, &own, &parent_around, reach);
    edges.sort_by_key(|edge| edge.0);
    edges.dedup_by_key(|edge| edge.0);
    let mut crossings: Vec<([Key; 2], Crossing)> = Vec::new();
    for (keys, [a, b]) in &edges {
        let ends = [*a, *b].map(|v| wood.place(v));
        let around = Aabb::around(ends);
        for (_, face) in parent.iter().filter(|(other, _)| other.touches(&around)) {
            if let Some((share, shares)) = pierce(ends, face.vertices().map(|v| wood.place(v))) {
                crossings.push((*keys, Crossing { ends: [0; 2], share, face: face.vertices(), shares }));
            }
        }
    }
    gathered(wood, crossings, branches, branch)
}

/// What belongs to the root: pierced without a gap from where the axis comes out.
pub(crate) fn gathered(
    wood: &Wood,
    mut crossings: Vec<([Key; 2], Crossing)>,
    branches: &Branches,
    branch: u32,
) -> Joint {
    let (bark_arc, radius) =
        (branches.attachments[branch as usize].bark_arc, f64::from(branches.rows[branch as usize].radius));
    let arcs = |keys: &[Key; 2]| keys.map(|key| f64::from(f32::from_bits(key.2)));
    crossings.sort_by(|a, b| arcs(&a.0)[0].total_cmp(&arcs(&b.0)[0]));
    let (mut start, mut count) = (0.0f64, 0);
    for (keys, _) in &crossings {
        let [low, high] = arcs(keys);
        if low > start.max(bark_arc) + radius {
            break;
        }
        (start, count) = (start.max(high), count + 1);
    }
    if count == 0 {
        return Joint::default();
    }
    crossings.truncate(count);
    let mut places: Vec<Key> = crossings.iter().flat_map(|(keys, _)| *keys).collect();
    places.sort_unstable();
    places.dedup();
    let index = |key: &Key| places.binary_search(key).map_or(u32::MAX, |index| index as u32);
    let crossings = crossings
        .iter()
        .map(|(keys, crossing)| Crossing { ends: [index(&keys[0]), index(&keys[1])], ..*crossing })
        .collect();
    // Of all faces that touch them: in soup each has copies of its own.
    let mut vertices: Vec<(Vertex, u32)> = wood
        .between(branch, 0.0, start)
        .flat_map(Face::vertices)
        .map(|v| (v, index(&wood.key(v))))
        .filter(|(_, place)| *place != u32::MAX)
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    Joint { places, crossings, start, vertices }
}

/// Edges of faces near the parent, lower end first.
fn edges(wood: &Wood, own: &[Face], around: &Aabb, reach: f64) -> Vec<([Key; 2], [Vertex; 2])> {
    let mut edges = Vec::new();
    for face in own.iter().filter(|face| self::around(wood, face).touches(around)) {
        let [a, b, c] = face.vertices();
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let (low, high) = if (wood.arc(a), wood.key(a)) <= (wood.arc(b), wood.key(b)) { (a, b) } else { (b, a) };
            if f64::from(wood.arc(low)) <= reach {
                edges.push(([wood.key(low), wood.key(high)], [low, high]));
            }
        }
    }
    edges
}

fn around(wood: &Wood, face: &Face) -> Aabb {
    Aabb::around(face.vertices().map(|v| wood.place(v)))
}

/// Share of the edge's second end where it pierces the triangle, and shares of the triangle's corners (Moller and Trumbore).
fn pierce([start, end]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let (way, ab, ac, from) = (end - start, b - a, c - a, start - a);
    let across = way.cross(ac);
    let volume = ab.dot(across);
    let scale = way.length() * ab.length() * ac.length();
    if volume.abs() <= SLACK * scale {
        return None;
    }
    let of_b = from.dot(across) / volume;
    let turned = from.cross(ab);
    let of_c = way.dot(turned) / volume;
    let share = ac.dot(turned) / volume;
    let shares = [1.0 - of_b - of_c, of_b, of_c];
    let inside = shares.iter().chain([&share, &(1.0 - share)]).all(|x| *x >= -SLACK);
    inside.then_some((share.clamp(0.0, 1.0), shares))
}
