//! The leaves of a plant, ready to answer places: batches of queries, sums on all threads.

use crate::kernel::{Batch, Depths, LANES, rounded_off, sum};
use crate::leaves::{NO_GROUP, Query, Source};
use crate::octants::OCTANTS;
use crate::profile::Profile;
use crate::tree::{Tree, sorted};
use foliar_numerics::Isa;
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;

/// Nothing is approximated.
pub const EXACT: f64 = 0.0;

/// The leaves of a plant in a tree.
#[derive(Clone, Debug)]
pub struct Crown {
    pub(crate) tree: Tree,
    /// Boxes of the groups that have several leaves, by group.
    groups: Vec<(u32, [DVec3; 2])>,
}

impl Crown {
    /// Sorts leaves.
    pub fn new(sources: &[Source], profile: Profile) -> Crown {
        Crown { tree: Tree::new(sources, profile), groups: boxes(sources) }
    }

    /// Number of leaves.
    pub fn leaves(&self) -> usize {
        self.tree.order.len()
    }

    /// Optical depths of the octants at each place, not capped. Of the tree's nodes those are opened that are wider
    /// than `opening` times their distance (below 1); [`EXACT`] opens all.
    pub fn depths(&self, queries: &[Query], opening: f64, isa: Isa) -> Vec<[f32; OCTANTS]> {
        let order = order_of(queries);
        let blocks: Vec<Depths> =
            order.par_chunks(LANES).map(|block| sum(isa, &self.tree, &self.batch(queries, block), opening)).collect();
        let mut depths = vec![[0.0; OCTANTS]; queries.len()];
        for (block, sums) in order.chunks(LANES).zip(&blocks) {
            for (lane, &query) in block.iter().enumerate() {
                depths[query as usize] = std::array::from_fn(|j| sums[j][lane] as f32);
            }
        }
        depths
    }

    fn batch(&self, queries: &[Query], block: &[u32]) -> Batch {
        let query = |lane: usize| queries[block[lane.min(block.len() - 1)] as usize];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut reach = [low, high];
        for at in (0..block.len()).map(query) {
            (low, high) = (low.min(at.position), high.max(at.position));
            if let Some([from, to]) = self.group(at.skip) {
                reach = [reach[0].min(from), reach[1].max(to)];
            }
        }
        let middle = low.midpoint(high);
        let exact = |axis: usize, lane: usize| (query(lane).position - middle)[axis];
        let axis = |axis: usize| std::array::from_fn(|lane| exact(axis, lane) as f32);
        let rest = |axis: usize| std::array::from_fn(|lane| rounded_off(exact(axis, lane)));
        Batch {
            middle,
            position: [axis(0), axis(1), axis(2)],
            rest: [rest(0), rest(1), rest(2)],
            skip: std::array::from_fn(|lane| query(lane).skip),
            low,
            high,
            reach: [reach[0].min(low), reach[1].max(high)],
        }
    }

    /// Box of a group that has several leaves.
    fn group(&self, group: u32) -> Option<[DVec3; 2]> {
        self.groups.binary_search_by_key(&group, |(group, _)| *group).ok().map(|at| self.groups[at].1)
    }
}

/// Indices of places in an order in which places that are near each other come near in the list.
pub fn order_of(queries: &[Query]) -> Vec<u32> {
    let places: Vec<DVec3> = queries.iter().map(|query| query.position).collect();
    sorted(&places, &|_, _| Ordering::Equal)
}

/// Boxes of the groups that have several leaves, by group.
fn boxes(sources: &[Source]) -> Vec<(u32, [DVec3; 2])> {
    let mut by_group: Vec<(u32, u32)> = (0..).zip(sources).map(|(i, source)| (source.group, i)).collect();
    by_group.par_sort_unstable();
    let several = by_group.chunk_by(|a, b| a.0 == b.0).filter(|leaves| leaves.len() > 1 && leaves[0].0 != NO_GROUP);
    let bounds = |leaves: &[(u32, u32)]| {
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let centers = leaves.iter().map(|(_, i)| sources[*i as usize].center);
        (leaves[0].0, centers.fold(none, |[low, high], c| [low.min(c), high.max(c)]))
    };
    several.map(bounds).collect()
}
