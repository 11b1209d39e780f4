//! Where a leaf is fixed: its point nearest to wood.

use crate::geometry::{Geometry, PartGeometry};
use foliar_schema::Role;
use foliar_space::TriangleTree;
use glam::{DVec3, Vec3};

/// Edge of a box that the plant is brought to for the search: f32 keeps 7 digits of it, whatever the unit.
const SEARCH_SIZE: f64 = 100.0;
/// How much of a leaf's size a place at the top of its texture may be nearer to wood than one at
/// the bottom and still lose: leaves that cross their twig are at distance 0 in many places.
const LOW_V: f64 = 0.1;
/// The same for distance from the leaf's center, far weaker: of an edge the middle is taken.
const MIDDLE: f64 = 0.0004;
/// Pieces of at most so many triangles offer the middles of their edges too: cards need a place between
/// their corners, leaves of many triangles have vertices enough.
const FEW_TRIANGLES: usize = 16;

/// Wood to measure distances from.
pub(crate) struct Wood {
    tree: TriangleTree,
    scale: f64,
}

/// A place on a leaf that may be its petiole.
struct Candidate {
    place: DVec3,
    /// 0 at the low v edge, 1 at the top; by height where there are no texture coordinates. Then, how
    /// much nearer to the wood it must be than a place without handicap, meters.
    handicap: f64,
}

impl Wood {
    pub fn new(geometry: &Geometry, roles: &[Role]) -> Self {
        let scale = if geometry.diagonal > 0.0 { SEARCH_SIZE / geometry.diagonal } else { 1.0 };
        let wood = geometry.parts.iter().zip(roles).filter(|(_, role)| **role == Role::Wood);
        let triangles: Vec<[Vec3; 3]> = wood
            .flat_map(|(part, _)| (0..part.part.triangles.len() as u32).map(|t| part.corners(t)))
            .map(|corners| corners.map(|p| (p * scale).as_vec3()))
            .collect();
        Wood { tree: TriangleTree::new(&triangles), scale }
    }

    /// The place among a piece's vertices (and middles of its margin, where it has few) that is nearest to
    /// the wood's surface; low v, then nearness to the center break ties. Without wood: the low v edge's middle.
    pub fn petiole(&self, part: &PartGeometry, piece: usize, center: DVec3, size: f64) -> DVec3 {
        let mut candidates = candidates(part, part.pieces.triangles(piece));
        for candidate in &mut candidates {
            candidate.handicap = LOW_V * size * candidate.handicap + MIDDLE * candidate.place.distance(center);
        }
        // The likeliest first: what it finds spares the search around most of the others.
        candidates.sort_unstable_by(|a, b| a.handicap.total_cmp(&b.handicap));
        let (mut best, mut least) = (center, f64::INFINITY);
        for candidate in candidates {
            if candidate.handicap >= least {
                break;
            }
            if let Some(distance) = self.distance(candidate.place, least - candidate.handicap) {
                (best, least) = (candidate.place, distance + candidate.handicap);
            }
        }
        best
    }

    /// Distance to the wood if it is below `limit`; 0 where there is no wood.
    fn distance(&self, place: DVec3, limit: f64) -> Option<f64> {
        if self.tree.is_empty() {
            return Some(0.0);
        }
        let limit = (limit * self.scale) as f32;
        let found = self.tree.closest_within((place * self.scale).as_vec3(), limit * limit)?;
        Some(f64::from(found.distance_squared).sqrt() / self.scale)
    }
}

/// Places on the margin of a piece of few triangles (edges that no other triangle uses); else, and where
/// there is no margin, all vertices.
fn candidates(part: &PartGeometry, triangles: &[u32]) -> Vec<Candidate> {
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * triangles.len());
    for &triangle in triangles {
        let [a, b, c] = part.part.triangles[triangle as usize];
        edges.extend([[a, b], [b, c], [c, a]]);
    }
    let few = triangles.len() <= FEW_TRIANGLES;
    let margin = || edges.iter().filter(|[from, to]| !edges.contains(&[*to, *from]));
    let mut candidates: Vec<Candidate> = if few && margin().next().is_some() {
        margin().flat_map(|&[from, to]| [0.0, 0.5].map(|share| place_on(part, from, to, share))).collect()
    } else {
        edges.iter().map(|&[from, _]| place_on(part, from, from, 0.0)).collect()
    };
    normalize(&mut candidates);
    candidates
}

/// A place on an edge, with height over the picture's bottom (glTF: v points down) or the ground.
fn place_on(part: &PartGeometry, from: u32, to: u32, share: f64) -> Candidate {
    let (from, to) = (from as usize, to as usize);
    let place = part.positions[from].lerp(part.positions[to], share);
    let low = match (part.part.uvs.get(from), part.part.uvs.get(to)) {
        (Some(a), Some(b)) => -(f64::from(a.y) + (f64::from(b.y) - f64::from(a.y)) * share),
        _ => place.y,
    };
    Candidate { place, handicap: low }
}

/// Brings the handicap to 0 to 1; to 0 where it says nothing.
fn normalize(candidates: &mut [Candidate]) {
    let (least, most) =
        candidates.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), c| (l.min(c.handicap), m.max(c.handicap)));
    let range = most - least;
    for candidate in candidates {
        let share = (candidate.handicap - least) / range;
        candidate.handicap = if share.is_finite() { share } else { 0.0 };
    }
}
