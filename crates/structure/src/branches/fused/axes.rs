//! Axes of the branches of a fused piece, and which nodes around a fork belong to which of its arms.

use super::reeb::Forks;
use super::{Limb, ring};
use crate::branches::tube::{Graph, Tube};
use foliar_plant::Axis;
use foliar_space::Aabb;
use glam::DVec3;
use rayon::prelude::*;

/// Rounds of bringing nodes to the nearest axis and cutting rings anew.
const ROUNDS: usize = 3;
/// From its root so many radii of its bearer on a branch is clear of the fork's web.
const CLEAR: f64 = 1.5;

/// So many radii of the bearer around a root nodes may go to either arm.
const AROUND: f64 = 4.0;

/// Where an arm comes out its ring is open on that side, and its center lies off the axis: so often each is averaged
/// with those beside it.
const SMOOTHINGS: usize = 2;

/// The limbs of a piece.
pub(super) fn limbs(graph: &Graph, forks: &Forks, band: f64, whole: &Tube) -> Vec<Limb> {
    let axis =
        |rings: &Vec<(DVec3, f64)>| Axis::new(rings.iter().map(|r| r.0).collect(), rings.iter().map(|r| r.1).collect());
    let mut axes: Vec<Axis> = forks.rings.iter().map(|rings| axis(&apart(rings))).collect();
    let mut of_node = forks.of_node.clone();
    for _ in 0..ROUNDS {
        for branch in 0..axes.len() {
            if let Some(parent) = forks.parent[branch] {
                axes[branch] = rooted(&axes[branch], &axes[parent as usize]);
            }
        }
        relabel(graph, forks, &axes, &mut of_node);
        let lists = lists(&of_node, axes.len());
        for (axis, list) in axes.iter_mut().zip(&lists) {
            *axis = recut(graph.points, list, axis, band);
        }
    }
    for branch in 0..axes.len() {
        if let Some(parent) = forks.parent[branch] {
            axes[branch] = rooted(&axes[branch], &axes[parent as usize]);
        }
    }
    let lists = lists(&of_node, axes.len());
    let limbs = axes.into_iter().zip(lists).zip(&forks.parent);
    limbs.map(|((axis, nodes), parent)| limb(graph.points, axis, nodes, *parent, whole)).collect()
}

/// Rings at least a radius apart, the first and the last among them: nearer ones zigzag by the chance of their nodes.
fn apart(rings: &[(DVec3, f64)]) -> Vec<(DVec3, f64)> {
    let mut kept: Vec<(DVec3, f64)> = Vec::new();
    for (index, ring) in rings.iter().enumerate() {
        let is_last = index + 1 == rings.len();
        if kept.last().is_none_or(|last| is_last || last.0.distance(ring.0) >= ring.1.max(last.1)) {
            kept.push(*ring);
        }
    }
    kept
}

fn lists(of_node: &[u32], branches: usize) -> Vec<Vec<u32>> {
    let mut lists = vec![Vec::new(); branches];
    of_node.iter().enumerate().for_each(|(node, &branch)| lists[branch as usize].push(node as u32));
    lists
}

fn limb(points: &[DVec3], axis: Axis, nodes: Vec<u32>, parent: Option<u32>, whole: &Tube) -> Limb {
    let spots: Vec<_> = nodes.par_iter().map(|&n| axis.nearest(points[n as usize])).collect();
    let (off, radius) = spots.iter().fold((0.0, 0.0), |(o, r), s| (o + (s.distance - s.radius).abs(), r + s.radius));
    let tube = Tube {
        arcs: spots.iter().map(|s| s.arc).collect(),
        roughness: if radius > 0.0 { off / radius } else { 0.0 },
        // The piece forks where its first branch does.
        split: if parent.is_none() { whole.split } else { 0.0 },
        around: Aabb::around(nodes.iter().map(|&n| points[n as usize])),
        axis,
    };
    Limb { tube, nodes, parent }
}

/// The axis without what lies in the web of its fork, drawn on backward to its bearer's axis.
fn rooted(axis: &Axis, bearer: &Axis) -> Axis {
    let foot = bearer.nearest(axis.points[0]);
    let clear = CLEAR * foot.radius;
    let outside = |p: &DVec3| bearer.nearest(*p).distance > clear;
    let last = axis.points.len() - 1;
    // A short branch keeps its tip at least.
    let first = axis.points.iter().position(outside).unwrap_or(last).min(last);
    let (mut points, mut radii) = (axis.points[first..].to_vec(), axis.radii[first..].to_vec());
    let ahead = axis.at(axis.arcs[first] + clear).point;
    let back = (axis.points[first] - ahead).normalize_or((foot.point - axis.points[first]).normalize_or_zero());
    let start = bearer.nearest(axis.points[first]);
    // Along the ray backward, the point that comes nearest to the bearer's axis.
    let steps = 16;
    let ray = |k: i32| axis.points[first] + back * (2.0 * start.distance * f64::from(k) / f64::from(steps));
    let nearest = (0..=steps).map(|k| bearer.nearest(ray(k))).min_by(|a, b| a.distance.total_cmp(&b.distance));
    points.insert(0, nearest.map_or(start.point, |spot| spot.point));
    radii.insert(0, radii[0]);
    Axis::new(points, radii)
}

/// Around each fork, every node goes to the arm whose bark it lies nearest to.
fn relabel(graph: &Graph, forks: &Forks, axes: &[Axis], of_node: &mut [u32]) {
    let own = lists(of_node, axes.len());
    for (branch, parent) in forks.parent.iter().enumerate().filter_map(|(b, p)| Some((b, (*p)?))) {
        let (child, bearer) = (&axes[branch], &axes[parent as usize]);
        let root = child.points[0];
        let foot = bearer.nearest(root);
        let near = AROUND * foot.radius + 2.0 * child.radii[0];
        let off = |axis: &Axis, middle: f64, place: DVec3| {
            let spot = axis.nearest_between(place, middle - 2.0 * near, middle + 2.0 * near);
            spot.distance - spot.radius
        };
        for &node in own[branch].iter().chain(&own[parent as usize]) {
            let place = graph.points[node as usize];
            let now = of_node[node as usize];
            if place.distance(root) <= near && (now == parent || now as usize == branch) {
                let is_child = off(child, 0.0, place) < off(bearer, foot.arc, place);
                of_node[node as usize] = if is_child { branch as u32 } else { parent };
            }
        }
    }
}

/// Rings cut anew by the places of nodes on the axis, each a radius wide at least.
fn recut(points: &[DVec3], nodes: &[u32], axis: &Axis, band: f64) -> Axis {
    let length = axis.length();
    let radius = axis.radii.iter().sum::<f64>() / axis.radii.len() as f64;
    let count = ((length / band.max(radius)).floor() as usize).max(1);
    let mut bins: Vec<Vec<u32>> = vec![Vec::new(); count];
    let arcs: Vec<f64> = nodes.par_iter().map(|&n| axis.nearest(points[n as usize]).arc).collect();
    for (&node, arc) in nodes.iter().zip(arcs) {
        bins[((arc / length * count as f64) as usize).min(count - 1)].push(node);
    }
    let rings: Vec<(DVec3, f64)> = bins.iter().filter(|bin| bin.len() >= 3).map(|bin| ring(points, bin)).collect();
    if rings.len() < 2 {
        return axis.clone();
    }
    let mut points: Vec<DVec3> = rings.iter().map(|r| r.0).collect();
    for _ in 0..SMOOTHINGS {
        let before = points.clone();
        for at in 1..points.len() - 1 {
            points[at] = 0.25 * (before[at - 1] + before[at + 1]) + 0.5 * before[at];
        }
    }
    Axis::new(points, rings.iter().map(|r| r.1).collect())
}
