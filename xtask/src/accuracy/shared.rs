//! The shared trees with `tree_truth.json`: what their generators said, brought to our vertices and leaves.

use super::row;
use crate::shared_trees;
use anyhow::{Context, Result, bail};
use foliar_plant::{NO_BRANCH, Part, Plant};
use foliar_schema::Role;
use foliar_structure::branches::{BranchParams, Continuation, Truth, find};
use serde_json::Value;
use std::collections::BTreeMap;

/// Mean parent accuracy that they must reach.
const MEAN: f64 = 0.995;

/// Prints a row each and their mean; how many gates are missed.
pub fn run(wanted: impl Fn(&str) -> bool) -> Result<usize> {
    let (mean, files) = mean(wanted)?;
    if files == 0 {
        return Ok(0);
    }
    println!("shared trees: mean parent accuracy {mean:.4} of {files} files, at least {MEAN}");
    Ok(usize::from(mean < MEAN))
}

/// Prints a row each; mean parent accuracy and number of files.
pub fn mean(wanted: impl Fn(&str) -> bool) -> Result<(f64, usize)> {
    let mut parents = Vec::new();
    for tree in shared_trees::all()?.iter().filter(|t| wanted(&t.name)) {
        let truth = tree.path.with_file_name("tree_truth.json");
        if !truth.is_file() {
            continue;
        }
        let told: Value = serde_json::from_str(&std::fs::read_to_string(&truth)?)?;
        let plant = tree.read()?.plant;
        let truth = truth_of(&told, &plant).with_context(|| tree.name.clone())?;
        let robust = row(&tree.name, &plant, &truth)?;
        list_wrong(&plant, &truth)?;
        parents.push(robust.parent);
    }
    Ok((parents.iter().sum::<f64>() / parents.len() as f64, parents.len()))
}

/// The truth of a file, continuations merged by the rule that the step uses.
fn truth_of(told: &Value, plant: &Plant) -> Result<Truth> {
    let wood = (0..plant.parts().len()).find(|&p| plant.role(p) == Role::Wood).context("no wood")?;
    let part = &plant.parts()[wood];
    let pieces = pieces(part);
    let (parents, of_piece, leaves) = match told["branches"].as_array() {
        Some(branches) => by_triangles(branches, part, &pieces, plant.leaves().len())?,
        None => by_splines(told, &pieces, plant.leaves().len())?,
    };
    let mut vertices: Vec<Vec<u32>> = plant.parts().iter().map(|_| Vec::new()).collect();
    vertices[wood] = pieces.iter().map(|p| of_piece.get(p).copied().unwrap_or(NO_BRANCH)).collect();
    let split = BranchParams { continuation: Continuation::Split, ..BranchParams::default() };
    let found = find(plant.base(), plant.structure(), &split)?.branches;
    // The axis of a true branch is that of the piece that it is.
    let mut axes = vec![foliar_plant::Axis::default(); parents.len()];
    for (truth, own) in vertices[wood].iter().zip(&found.vertices[wood]) {
        if *truth != NO_BRANCH && own.branch != NO_BRANCH {
            axes[*truth as usize] = found.axes[own.branch as usize].clone();
        }
    }
    Ok(Truth { parents, vertices, leaves }.merged(&axes))
}

type Told = (Vec<Option<u32>>, BTreeMap<u32, u32>, Vec<u32>);

/// Connected pieces of a part over its position ids, numbered by their lowest position id.
fn pieces(part: &Part) -> Vec<u32> {
    let mut least: BTreeMap<u32, u32> = part.position_ids.iter().map(|&id| (id, id)).collect();
    let root = |least: &BTreeMap<u32, u32>, mut id: u32| {
        while least[&id] != id {
            id = least[&id];
        }
        id
    };
    for triangle in &part.triangles {
        for pair in triangle.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|v| root(&least, part.position_ids[v as usize]));
            least.insert(a.max(b), a.min(b));
        }
    }
    let roots: Vec<u32> = part.position_ids.iter().map(|&id| root(&least, id)).collect();
    let mut order = roots.clone();
    order.sort_unstable();
    order.dedup();
    roots.iter().map(|r| order.partition_point(|o| o < r) as u32).collect()
}

/// Branches that own runs of triangles and leaf quads.
fn by_triangles(branches: &[Value], part: &Part, pieces: &[u32], leaves: usize) -> Result<Told> {
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let parents = branches.iter().map(|b| b["parent"].as_i64().and_then(|p| u32::try_from(p).ok())).collect();
    let (mut of_piece, mut of_leaf) = (BTreeMap::new(), vec![NO_BRANCH; leaves]);
    for (index, branch) in branches.iter().enumerate() {
        let first = number(&branch["tri0"]);
        let run = part.triangles.get(first..first + number(&branch["ntri"])).context("fewer triangles than told")?;
        run.iter().flatten().for_each(|&v| {
            of_piece.insert(pieces[v as usize], index as u32);
        });
        let first = number(&branch["leaf0"]);
        if let Some(run) = of_leaf.get_mut(first..first + number(&branch["nleaf"])) {
            run.fill(index as u32);
        }
    }
    Ok((parents, of_piece, of_leaf))
}

/// Splines, one piece each in the order of their first vertices, named as `boneSSS.PPP`.
fn by_splines(told: &Value, pieces: &[u32], leaves: usize) -> Result<Told> {
    let names = |key: &str| told[key].as_array().map_or(&[][..], Vec::as_slice);
    let spline = |name: &Value| {
        let digits = name.as_str()?.strip_prefix("bone")?.split('.').next()?;
        digits.parse::<u32>().ok()
    };
    let parents: Vec<Option<u32>> = names("spline_parent").iter().map(spline).collect();
    let count = pieces.iter().max().map_or(0, |p| *p as usize + 1);
    if count != parents.len() {
        bail!("{count} pieces, {} splines", parents.len());
    }
    let mut of_leaf: Vec<u32> = names("leaf_parent").iter().map(|n| spline(n).unwrap_or(NO_BRANCH)).collect();
    if of_leaf.len() != leaves {
        of_leaf = vec![NO_BRANCH; leaves];
    }
    Ok((parents, (0..count as u32).map(|p| (p, p)).collect(), of_leaf))
}

/// Names the branches that hang elsewhere than told, with the margin of what was chosen.
fn list_wrong(plant: &Plant, truth: &Truth) -> Result<()> {
    let found = find(plant.base(), plant.structure(), &BranchParams::default())?;
    for wrong in truth.wrong(&found.branches) {
        let at = wrong.found.map_or("lost".into(), |id| {
            let (row, report) = (&found.branches.rows[id as usize], &found.reports[id as usize]);
            format!("branch {id}, margin {:.3}, gap {:.2}, level {}", row.margin, report.gap, row.level)
        });
        println!("    told parent {:?}, found {:?}: {at}", wrong.right, wrong.parent);
    }
    Ok(())
}
