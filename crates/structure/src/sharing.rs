//! Parts that lie on another part by its vertices: bark marks, decals.

use crate::geometry::Geometry;
use std::collections::BTreeMap;

/// A part lies on another where at least this share of its positions are the other's ...
const MOST: f64 = 0.9;
/// ... and at most this share of the other's are its own: else neither lies on the other.
const SMALL: f64 = 0.5;

/// For each part the larger part that it shares most of its positions with, if there is one.
pub(crate) fn larger_partner(geometry: &Geometry) -> Vec<Option<usize>> {
    let (used, shared) = count_shared(geometry);
    (0..used.len())
        .map(|part| {
            let of = |count: u32, whole: u32| f64::from(count) / f64::from(whole.max(1));
            let lies_on = |other: &usize, count: u32| of(count, used[part]) >= MOST && of(count, used[*other]) <= SMALL;
            let pairs = shared.range((part, 0)..(part + 1, 0));
            pairs
                .filter(|(pair, count)| lies_on(&pair.1, **count))
                .max_by_key(|(_, count)| **count)
                .map(|(pair, _)| pair.1)
        })
        .collect()
}

/// Positions that each part uses, and how many each ordered pair of parts has in common.
fn count_shared(geometry: &Geometry) -> (Vec<u32>, BTreeMap<(usize, usize), u32>) {
    const NOBODY: u32 = u32::MAX;
    let positions = geometry.base.position_count as usize;
    let (mut first_owner, mut last_owner) = (vec![NOBODY; positions], vec![NOBODY; positions]);
    let mut used = vec![0u32; geometry.parts.len()];
    // Few positions have more than one owner: they alone are listed.
    let mut more: Vec<(u32, u32)> = Vec::new();
    for (index, part) in geometry.parts.iter().enumerate() {
        for (&id, _) in part.part.position_ids.iter().zip(&part.pieces.of_vertex).filter(|(_, piece)| **piece != NOBODY)
        {
            let slot = id as usize;
            if last_owner[slot] == index as u32 {
                continue;
            }
            last_owner[slot] = index as u32;
            used[index] += 1;
            if first_owner[slot] == NOBODY {
                first_owner[slot] = index as u32;
            } else {
                more.push((id, index as u32));
            }
        }
    }
    more.sort_unstable();
    let mut shared = BTreeMap::new();
    for same in more.chunk_by(|a, b| a.0 == b.0) {
        let owners: Vec<usize> = std::iter::once(first_owner[same[0].0 as usize])
            .chain(same.iter().map(|m| m.1))
            .map(|o| o as usize)
            .collect();
        for &a in &owners {
            for &b in owners.iter().filter(|&&b| b != a) {
                *shared.entry((a, b)).or_insert(0) += 1;
            }
        }
    }
    (used, shared)
}
