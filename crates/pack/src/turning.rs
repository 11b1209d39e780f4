//! Which triangles show their other side as their front. A viewer turns the normals of back faces of a
//! two-sided material (glTF 2.0 section 3.9.6), which is right for a surface's own normal and wrong for a
//! realigned one: half of all leaves would be lit as if they faced into the crown. So each leaf's
//! triangles are wound such that their front is where its realigned normal points.

use crate::master::Piece;
use glam::DVec3;
use std::collections::BTreeMap;

/// Per triangle of a piece, whether it is to be wound the other way; a leaf's triangles all alike.
pub(crate) fn turned(piece: &Piece) -> Vec<bool> {
    let part = piece.part;
    let toward = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| part.rest_position(v as usize));
        let normals = corners.map(|v| part.normal_to_rest(piece.normal_of(v as usize)));
        (b - a).cross(c - a).dot(normals.into_iter().sum::<DVec3>())
    };
    let leaf = |corners: &[u32; 3]| piece.leaf_of(corners[0] as usize);
    let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
    for corners in &part.triangles {
        if let Some(leaf) = leaf(corners) {
            *sums.entry(leaf).or_default() += toward(corners);
        }
    }
    let sum = |corners: &[u32; 3]| leaf(corners).and_then(|leaf| sums.get(&leaf).copied());
    part.triangles.iter().map(|corners| sum(corners).unwrap_or_else(|| toward(corners)) < 0.0).collect()
}
