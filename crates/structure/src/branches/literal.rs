//! The paper's own words (Kusternig07 section 5): order by diameter, the largest is the stem, its children are
//! the pieces that intersect it, theirs those that intersect them, and so on.

use super::hang::Hanging;
use super::mesh::Mesh;
use super::tube::Tube;
use foliar_space::{Aabb, BoxTree};
use glam::DVec3;
use rayon::prelude::*;

/// Hangs every tube on the first that reached it.
pub(super) fn hang(mesh: &Mesh, tubes: &[Tube]) -> Vec<Hanging> {
    let touching = touching(mesh);
    let diameter = |t: u32| {
        let radii = &tubes[t as usize].axis.radii;
        radii.iter().sum::<f64>() / radii.len() as f64
    };
    let mut order: Vec<u32> = (0..tubes.len() as u32).collect();
    order.sort_by(|&a, &b| diameter(b).total_cmp(&diameter(a)).then(a.cmp(&b)));
    let root = Hanging { parent: None, from_tip: false, cost: 0.0, margin: f64::INFINITY, gap: 0.0 };
    let mut hangings = vec![root; tubes.len()];
    let mut seen = vec![false; tubes.len()];
    for &start in &order {
        // The largest is the stem; what nothing reaches starts anew.
        let mut front = vec![start];
        if std::mem::replace(&mut seen[start as usize], true) {
            continue;
        }
        hangings[start as usize].from_tip = lower_is_tip(&tubes[start as usize]);
        while !front.is_empty() {
            front.sort_by(|&a, &b| diameter(b).total_cmp(&diameter(a)).then(a.cmp(&b)));
            let mut next = Vec::new();
            for &parent in &front {
                for &child in &touching[parent as usize] {
                    if !std::mem::replace(&mut seen[child as usize], true) {
                        let tube = &tubes[child as usize];
                        let distance = |tip: bool| tubes[parent as usize].axis.nearest(tube.end(tip)).distance;
                        let from_tip = distance(true) < distance(false);
                        hangings[child as usize] = Hanging { parent: Some(parent), from_tip, ..root };
                        next.push(child);
                    }
                }
            }
            front = next;
        }
    }
    hangings
}

fn lower_is_tip(tube: &Tube) -> bool {
    tube.end(true).y < tube.end(false).y
}

/// For each piece those whose faces cross its own.
fn touching(mesh: &Mesh) -> Vec<Vec<u32>> {
    let corners = |face: u32| mesh.faces[face as usize].map(|n| mesh.points[n as usize]);
    let boxes: Vec<Aabb> = (0..mesh.faces.len() as u32).map(|f| Aabb::around(corners(f))).collect();
    let tree = BoxTree::new(&boxes);
    let mut piece_of = vec![0u32; mesh.faces.len()];
    for piece in 0..mesh.count() {
        piece_of[mesh.starts[piece].1 as usize..mesh.starts[piece + 1].1 as usize].fill(piece as u32);
    }
    let of = |piece: usize| {
        let mut found: Vec<u32> = Vec::new();
        for face in mesh.starts[piece].1..mesh.starts[piece + 1].1 {
            let around = boxes[face as usize];
            tree.near(&around, |other| {
                let owner = piece_of[other as usize];
                let apart = owner == piece as u32 || found.contains(&owner) || !boxes[other as usize].touches(&around);
                if !apart && cross(corners(face), corners(other)) {
                    found.push(owner);
                }
            });
        }
        found
    };
    let one_way: Vec<Vec<u32>> = (0..mesh.count()).into_par_iter().map(of).collect();
    let mut both = one_way.clone();
    one_way.iter().enumerate().for_each(|(a, list)| list.iter().for_each(|&b| both[b as usize].push(a as u32)));
    for list in &mut both {
        list.sort_unstable();
        list.dedup();
    }
    both
}

/// Whether two triangles cross: an edge of one goes through the other.
fn cross(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let through = |t: &[DVec3; 3], o: &[DVec3; 3]| (0..3).any(|k| pierces(t[k], t[(k + 1) % 3], o));
    through(&a, &b) || through(&b, &a)
}

/// Whether a segment goes through a triangle, by signed volumes; touching counts.
fn pierces(from: DVec3, to: DVec3, [a, b, c]: &[DVec3; 3]) -> bool {
    let volume = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| (q - p).cross(r - p).dot(s - p);
    let (low, high) = (volume(*a, *b, *c, from), volume(*a, *b, *c, to));
    if low * high > 0.0 || (low.abs() <= 0.0 && high.abs() <= 0.0) {
        return false;
    }
    let sides = [volume(from, to, *a, *b), volume(from, to, *b, *c), volume(from, to, *c, *a)];
    sides.iter().all(|v| *v >= 0.0) || sides.iter().all(|v| *v <= 0.0)
}
