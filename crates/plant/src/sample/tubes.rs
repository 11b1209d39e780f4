//! Wood: one open, tapered tube per chain of the skeleton, with bark coordinates and root flare.

use super::build::Piece;
use super::skeleton::{Chain, Skeleton};
use super::tree::Recipe;
use crate::Axis;
use glam::{DVec3, Vec2};
use std::f64::consts::TAU;

/// The tube of a chain, the ring of each of its vertices, and its axis.
pub fn tube(skeleton: &Skeleton, chain: &Chain, recipe: &Recipe) -> (Piece, Vec<u32>, Axis) {
    let axis = axis(skeleton, chain);
    let piece = around(&axis, chain, recipe);
    let per_ring = piece.positions.len() as u32 / axis.len() as u32;
    let rings = (0..piece.positions.len() as u32).map(|vertex| vertex / per_ring).collect();
    let (points, radii) = axis.into_iter().unzip();
    (piece, rings, Axis::new(points, radii))
}

fn around(axis: &[(DVec3, f64)], chain: &Chain, recipe: &Recipe) -> Piece {
    let sides = sides(axis[0].1, recipe);
    let root = chain.nodes[0] == 0;
    let frames = frames(axis);
    let around = TAU * axis[0].1;
    let repeats = (around / BARK_M).round().max(1.0);
    let mut piece = Piece::default();
    let mut length = 0.0;
    for (ring, (&(center, radius), &(normal, binormal))) in axis.iter().zip(&frames).enumerate() {
        if ring > 0 {
            length += center.distance(axis[ring - 1].0);
        }
        let first = piece.positions.len() as u32;
        for side in 0..=sides {
            let turn = TAU * f64::from(side % sides) / f64::from(sides);
            let radius = if root { radius * flare(center.y, turn, recipe) } else { radius };
            let place = center + (normal * libm::cos(turn) + binormal * libm::sin(turn)) * radius;
            piece.positions.push(place.as_vec3());
            let u = repeats * f64::from(side) / f64::from(sides);
            // Bark keeps its proportions; on twigs it is stretched rather than repeated a hundred times.
            let v = -length * repeats / around.max(0.25 * BARK_M);
            piece.uvs.push(Vec2::new(u as f32, v as f32));
            piece.twin_of.push(first + side % sides);
        }
        if ring > 0 {
            let below = first - sides - 1;
            piece.triangles.extend((0..sides).flat_map(|k| {
                let (a, b) = (below + k, first + k);
                [[a, a + 1, b + 1], [a, b + 1, b]]
            }));
        }
    }
    piece
}

/// Width of one repeat of the bark, meters.
const BARK_M: f64 = 0.45;

/// Centers and radii. A branch starts inside its parent, with its own radius and a little collar.
fn axis(skeleton: &Skeleton, chain: &Chain) -> Vec<(DVec3, f64)> {
    let nodes = &skeleton.nodes;
    let own = |n: usize| (nodes[n].position, nodes[n].radius);
    let mut axis: Vec<(DVec3, f64)> = chain.nodes.iter().map(|&n| own(n)).collect();
    if chain.nodes[0] == 0 {
        refine_foot(&mut axis);
    } else {
        axis[0].1 = (axis[1].1 * 1.25).min(axis[0].1);
    }
    axis
}

/// Rings close to the ground, where the root flare bends.
fn refine_foot(axis: &mut Vec<(DVec3, f64)>) {
    let (foot, next) = (axis[0], axis[1]);
    let between = [0.12, 0.3, 0.6].map(|t: f64| (foot.0.lerp(next.0, t), foot.1 + (next.1 - foot.1) * t));
    axis.splice(1..1, between);
}

/// How much the roots widen the trunk at a height and bearing.
fn flare(height: f64, turn: f64, recipe: &Recipe) -> f64 {
    let scale = height / recipe.trunk_radius_m();
    let lobes = libm::cos(5.0 * turn + recipe.seed as f64) + 0.5 * libm::cos(3.0 * turn + 1.0);
    1.0 + 0.75 * libm::exp(-scale / 0.9) + 0.20 * lobes * libm::exp(-scale / 1.6) + 0.035 * lobes
}

fn sides(radius: f64, recipe: &Recipe) -> u32 {
    let share = (radius / recipe.trunk_radius_m()).min(1.0);
    (f64::from(recipe.trunk_sides) * share.sqrt()).round().max(3.0) as u32
}

/// Normal and binormal at every ring, carried along without twist; normal x binormal = tangent.
fn frames(axis: &[(DVec3, f64)]) -> Vec<(DVec3, DVec3)> {
    let tangent = |i: usize| {
        let (low, high) = (i.saturating_sub(1), (i + 1).min(axis.len() - 1));
        (axis[high].0 - axis[low].0).normalize_or(DVec3::Y)
    };
    let mut normal = tangent(0).any_orthonormal_vector();
    let mut frame = |i| {
        let t: DVec3 = tangent(i);
        normal = (normal - t * normal.dot(t)).normalize_or(t.any_orthonormal_vector());
        (normal, t.cross(normal))
    };
    (0..axis.len()).map(&mut frame).collect()
}
