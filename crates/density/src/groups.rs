//! Balls by group: what a query leaves out.

use crate::field::Query;
use crate::generators::Generator;
use rayon::prelude::*;

/// Balls sorted by group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups {
    balls: Vec<Generator>,
}

/// Queries that look for their groups one after another.
const RUN: usize = 1024;

impl Groups {
    /// Sorts balls that have weight.
    pub fn new(balls: &[Generator]) -> Groups {
        let mut balls: Vec<Generator> = balls.iter().filter(|ball| ball.weight > 0.0).copied().collect();
        // Stable, so that sums run in the order of the balls; they mostly are in order already.
        balls.sort_by_key(|ball| ball.group);
        Groups { balls }
    }

    /// Number of balls.
    pub fn len(&self) -> usize {
        self.balls.len()
    }

    /// Balls of a group.
    pub fn of(&self, group: u32) -> &[Generator] {
        let start = self.balls.partition_point(|ball| ball.group < group);
        let rest = &self.balls[start..];
        &rest[..rest.iter().position(|ball| ball.group != group).unwrap_or(rest.len())]
    }

    /// For each query the balls that it leaves out. Neighbors in the list mostly share a group.
    pub fn of_each(&self, queries: &[Query]) -> Vec<&[Generator]> {
        let run = |queries: &[Query]| {
            let mut last: (u32, &[Generator]) = (u32::MAX, &[]);
            let find = |query: &Query| {
                if query.skip != last.0 {
                    last = (query.skip, self.of(query.skip));
                }
                last.1
            };
            queries.iter().map(find).collect::<Vec<_>>()
        };
        queries.par_chunks(RUN).flat_map_iter(run).collect()
    }
}
