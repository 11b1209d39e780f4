//! Several trees in one file. The rule, kept simple: where the scene first branches, each branch that
//! draws two primitives or more could be a tree (it can hold wood and leaves); two such branches whose
//! boxes on the ground (x, z) do not overlap are two trees.

use crate::Selection;
use crate::accessor::Source;
use crate::scene::Walked;
use foliar_plant::Part;
use foliar_schema::{Finding, code};
use glam::DVec2;
use serde_json::Value;
use std::collections::BTreeMap;

/// What one branch draws.
struct Candidate {
    primitives: usize,
    low: DVec2,
    high: DVec2,
}

/// Adds the finding IMPORT-TREES where there is more than one and nobody chose.
pub(crate) fn report(
    source: Source,
    walked: &Walked,
    parts: &[Part],
    selection: &Selection,
    findings: &mut Vec<Finding>,
) {
    if selection.node.is_some() {
        return;
    }
    let trees: Vec<(usize, Candidate)> =
        candidates(walked, parts).into_iter().filter(|(_, c)| c.primitives >= 2).collect();
    let apart = |a: &Candidate, b: &Candidate| a.high.cmplt(b.low).any() || b.high.cmplt(a.low).any();
    let alone: Vec<usize> = trees
        .iter()
        .filter(|(node, tree)| trees.iter().all(|(other, t)| other == node || apart(tree, t)))
        .map(|(node, _)| *node)
        .collect();
    if alone.len() < 2 {
        return;
    }
    let nodes = source.document.list("nodes");
    let name = |n: &usize| nodes[*n].get("name").and_then(Value::as_str).map_or(format!("/nodes/{n}"), str::to_string);
    let names: Vec<String> = alone.iter().map(name).collect();
    let message = format!("{} trees stand side by side ({}): choose one with --node", alone.len(), names.join(", "));
    findings.push(Finding::new(&code::IMPORT_TREES, message).at(format!("/nodes/{}", alone[0])).in_file(source.file));
}

fn candidates(walked: &Walked, parts: &[Part]) -> BTreeMap<usize, Candidate> {
    let mut boxes: BTreeMap<u32, Candidate> = BTreeMap::new();
    for part in parts {
        let entry = boxes.entry(part.place.mesh).or_insert(Candidate {
            primitives: 0,
            low: DVec2::INFINITY,
            high: DVec2::NEG_INFINITY,
        });
        entry.primitives += 1;
        for vertex in 0..part.positions.len() {
            let p = part.rest_position(vertex);
            let ground = DVec2::new(p.x, p.z);
            entry.low = entry.low.min(ground);
            entry.high = entry.high.max(ground);
        }
    }
    let mut out: BTreeMap<usize, Candidate> = BTreeMap::new();
    let chains: Vec<Vec<usize>> = walked.drawn.iter().map(|d| chain(walked, d.visit)).collect();
    let shared = shared_depth(&chains);
    for (drawn, chain) in walked.drawn.iter().zip(&chains) {
        // Each mesh counts once, where it is baked: at its first node.
        let Some(found) = boxes.remove(&(drawn.mesh as u32)) else { continue };
        let branch = chain.get(shared).or(chain.last()).copied().unwrap_or(drawn.node);
        match out.get_mut(&branch) {
            Some(all) => {
                all.primitives += found.primitives;
                all.low = all.low.min(found.low);
                all.high = all.high.max(found.high);
            }
            None => {
                out.insert(branch, found);
            }
        }
    }
    out
}

/// Nodes from the root to a visit.
fn chain(walked: &Walked, visit: usize) -> Vec<usize> {
    let mut up = vec![walked.visits[visit].node];
    let mut at = walked.visits[visit].parent;
    while let Some(parent) = at {
        up.push(walked.visits[parent].node);
        at = walked.visits[parent].parent;
    }
    up.reverse();
    up
}

/// How many nodes all chains share from the root.
fn shared_depth(chains: &[Vec<usize>]) -> usize {
    let Some(first) = chains.first() else { return 0 };
    (0..first.len()).take_while(|&depth| chains.iter().all(|c| c.get(depth) == first.get(depth))).count()
}
