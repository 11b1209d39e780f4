//! The cheapest way to hang every branch on another or on the ground: minimum arborescence (Chu and Liu 1965,
//! Edmonds 1967), by rounds of contraction.

/// A possible parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub parent: u32,
    pub child: u32,
    /// Cost in whole steps, so that no order of sums decides a tie.
    pub cost: i64,
}

/// The edge that each of `nodes` nodes takes, as an index into `edges`; none for the root and for what cannot be
/// reached. Of equal costs the first edge of the list wins.
pub(super) fn solve(nodes: usize, root: u32, edges: &[Edge]) -> Vec<Option<usize>> {
    let best = cheapest(nodes, root, edges);
    let cycles = cycles(nodes, edges, &best);
    let Some((label, labels)) = cycles else { return best };
    let is_cycle = cycle_members(nodes, &label, labels);
    let (mut inner, mut back) = (Vec::new(), Vec::new());
    for (index, edge) in edges.iter().enumerate() {
        let (parent, child) = (label[edge.parent as usize], label[edge.child as usize]);
        if parent != child {
            let saved = best[edge.child as usize].filter(|_| is_cycle[child as usize]);
            inner.push(Edge { parent, child, cost: edge.cost - saved.map_or(0, |b| edges[b].cost) });
            back.push(index);
        }
    }
    let outer = solve(labels, label[root as usize], &inner);
    // Inside a cycle each keeps its cheapest edge, but for the one through which the cycle is entered.
    let mut chosen: Vec<Option<usize>> = (0..nodes).map(|n| best[n].filter(|_| is_cycle[label[n] as usize])).collect();
    for index in outer.into_iter().flatten() {
        let edge = back[index];
        chosen[edges[edge].child as usize] = Some(edge);
    }
    chosen
}

fn cheapest(nodes: usize, root: u32, edges: &[Edge]) -> Vec<Option<usize>> {
    let mut best: Vec<Option<usize>> = vec![None; nodes];
    for (index, edge) in edges.iter().enumerate().filter(|(_, e)| e.child != root && e.child != e.parent) {
        let slot = &mut best[edge.child as usize];
        if slot.is_none_or(|b| edge.cost < edges[b].cost) {
            *slot = Some(index);
        }
    }
    best
}

/// A label for each node, one for a whole cycle, and the number of labels; none where there is no cycle.
fn cycles(nodes: usize, edges: &[Edge], best: &[Option<usize>]) -> Option<(Vec<u32>, usize)> {
    const NEW: u32 = u32::MAX;
    let parent = |n: usize| best[n].map(|e| edges[e].parent as usize);
    let (mut visit, mut label) = (vec![NEW; nodes], vec![NEW; nodes]);
    let (mut labels, mut found) = (0u32, false);
    for start in 0..nodes {
        let mut at = Some(start);
        while let Some(node) = at.filter(|&n| visit[n] == NEW) {
            visit[node] = start as u32;
            at = parent(node);
        }
        if let Some(entry) = at.filter(|&n| visit[n] == start as u32 && label[n] == NEW) {
            found = true;
            let mut node = entry;
            while label[node] == NEW {
                label[node] = labels;
                node = parent(node)?;
            }
            labels += 1;
        }
    }
    for slot in label.iter_mut().filter(|l| **l == NEW) {
        *slot = labels;
        labels += 1;
    }
    found.then_some((label, labels as usize))
}

fn cycle_members(nodes: usize, label: &[u32], labels: usize) -> Vec<bool> {
    let mut members = vec![0u32; labels];
    (0..nodes).for_each(|n| members[label[n] as usize] += 1);
    members.into_iter().map(|m| m > 1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use foliar_numerics::radical_inverse;

    /// Least total over all choices of a parent each that reach the root.
    fn brute(nodes: usize, root: u32, edges: &[Edge]) -> Option<i64> {
        let mut choices: Vec<Vec<&Edge>> = vec![Vec::new(); nodes];
        edges.iter().for_each(|e| choices[e.child as usize].push(e));
        let others: Vec<usize> = (0..nodes).filter(|&n| n != root as usize).collect();
        let total: usize = others.iter().map(|&n| choices[n].len()).product();
        let pick = |mut code: usize| -> Option<i64> {
            let mut parent = vec![root; nodes];
            let mut cost = 0;
            for &n in &others {
                let edge = choices[n][code % choices[n].len()];
                code /= choices[n].len();
                parent[n] = edge.parent;
                cost += edge.cost;
            }
            let reaches = |mut n: u32| {
                (0..=nodes).any(|_| {
                    n = if n == root { return true } else { parent[n as usize] };
                    n == root
                })
            };
            others.iter().all(|&n| reaches(n as u32)).then_some(cost)
        };
        (0..total).filter_map(pick).min()
    }

    #[test]
    fn totals_are_those_of_trying_everything() {
        for case in 0..200u64 {
            let mut edges = Vec::new();
            for child in 1..6u32 {
                edges.push(Edge { parent: 0, child, cost: 50 });
                for k in 0..3u64 {
                    let chance = |base| radical_inverse(1 + case * 31 + u64::from(child) * 7 + k, base);
                    let parent = (chance(2) * 6.0) as u32;
                    if parent != child {
                        edges.push(Edge { parent, child, cost: (chance(3) * 20.0) as i64 });
                    }
                }
            }
            let chosen = solve(6, 0, &edges);
            let total: i64 = chosen.iter().flatten().map(|&e| edges[e].cost).sum();
            assert_eq!(chosen.iter().flatten().count(), 5);
            assert_eq!(Some(total), brute(6, 0, &edges), "case {case}: {edges:?}");
        }
    }
}
