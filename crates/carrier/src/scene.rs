//! Which nodes draw what, and where: the chosen scene walked once, without recursion, each node with
//! its transform to the rest frame in f64 (glTF 2.0 sections 3.5.2 and 3.5.3).

use crate::accessor::Source;
use crate::document::index_of;
use crate::{CarrierError, Selection, lod};
use foliar_schema::Finding;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use serde_json::Value;
use std::collections::BTreeSet;

/// What exporters leave in a matrix's last row by rounding, relative to its 1.
const LAST_ROW: f64 = 1e-6;
/// Most nodes above a node: far more than any skeleton has, few enough to list.
const DEEPEST: usize = 1024;

/// One node as the walk meets it.
pub(crate) struct Visit {
    /// Index of the node.
    pub node: usize,
    /// Index of its parent among the visits.
    pub parent: Option<usize>,
    depth: usize,
    transform: DAffine3,
}

/// One node that draws a mesh.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// Index of the node.
    pub node: usize,
    /// Its index among the visits.
    pub visit: usize,
    /// Index of its mesh.
    pub mesh: usize,
    /// From the mesh's frame to the rest frame.
    pub transform: DAffine3,
}

/// A scene as it was walked.
pub(crate) struct Walked {
    /// All nodes, parents before children.
    pub visits: Vec<Visit>,
    /// Those that draw and are baked, in the same order.
    pub drawn: Vec<Drawn>,
}

/// Walks the chosen scene.
pub(crate) fn walk_scene(
    source: Source,
    selection: &Selection,
    findings: &mut Vec<Finding>,
) -> Result<Walked, CarrierError> {
    let nodes = source.document.list("nodes");
    let meshes = source.document.list("meshes").len();
    let visits = walk(source, &roots(source, selection.scene)?)?;
    let chosen = match &selection.node {
        Some(name) => below(&visits, &BTreeSet::from([named(source, &visits, name)?])),
        None => vec![true; visits.len()],
    };
    let coarse = below(&visits, &lod::coarse_nodes(source, &visits, &chosen, findings));
    let mut drawn = Vec::new();
    for (index, visit) in visits.iter().enumerate().filter(|(i, _)| chosen[*i] && !coarse[*i]) {
        let Some(mesh) = nodes[visit.node].get("mesh") else { continue };
        let mesh = mesh.as_u64().and_then(|m| usize::try_from(m).ok()).filter(|m| *m < meshes);
        let mesh = mesh.ok_or_else(|| source.fail(format!("/nodes/{}/mesh", visit.node), "names no mesh"))?;
        drawn.push(Drawn { node: visit.node, visit: index, mesh, transform: visit.transform });
    }
    Ok(Walked { visits, drawn })
}

/// Per visit: whether it is one of `nodes` or below one.
fn below(visits: &[Visit], nodes: &BTreeSet<usize>) -> Vec<bool> {
    let mut flags: Vec<bool> = Vec::with_capacity(visits.len());
    for visit in visits {
        flags.push(nodes.contains(&visit.node) || visit.parent.is_some_and(|p| flags[p]));
    }
    flags
}

/// Root nodes of the chosen scene; of all nodes where the file has no scenes.
fn roots(source: Source, scene: Option<u32>) -> Result<Vec<usize>, CarrierError> {
    let scenes = source.document.list("scenes");
    let chosen = scene.map(|s| s as usize).or_else(|| index_of(&source.document.json, "scene"));
    if scenes.is_empty() && scene.is_none() {
        let children: BTreeSet<usize> = source.document.list("nodes").iter().flat_map(children).collect();
        return Ok((0..source.document.list("nodes").len()).filter(|n| !children.contains(n)).collect());
    }
    let index = chosen.unwrap_or(0);
    let Some(scene) = scenes.get(index) else {
        let problem = format!("scene {index} does not exist: there are {} scenes", scenes.len());
        return Err(CarrierError::input(source.file, "/scenes", problem, "choose one of them with --scene"));
    };
    Ok(list_of_indices(scene, "nodes"))
}

fn children(node: &Value) -> Vec<usize> {
    list_of_indices(node, "children")
}

fn list_of_indices(value: &Value, key: &str) -> Vec<usize> {
    let items = value.get(key).and_then(Value::as_array);
    // Anything that is no index becomes one that no list holds, and is refused where it is used.
    items.map_or(Vec::new(), |list| list.iter().map(|n| n.as_u64().map_or(usize::MAX, |n| n as usize)).collect())
}

fn walk(source: Source, roots: &[usize]) -> Result<Vec<Visit>, CarrierError> {
    let nodes = source.document.list("nodes");
    let mut seen = vec![false; nodes.len()];
    let mut visits: Vec<Visit> = Vec::new();
    let mut open: Vec<(usize, Option<usize>)> = roots.iter().rev().map(|root| (*root, None)).collect();
    while let Some((index, parent)) = open.pop() {
        let place = format!("/nodes/{index}");
        let Some(node) = nodes.get(index) else {
            return Err(source.fail(place, format!("does not exist: there are {} nodes", nodes.len())));
        };
        if std::mem::replace(&mut seen[index], true) {
            return Err(source.fail(place, "is reached twice: nodes must form a tree without cycles"));
        }
        let (above, depth) = parent.map_or((DAffine3::IDENTITY, 0), |p| (visits[p].transform, visits[p].depth + 1));
        if depth > DEEPEST {
            return Err(source.fail(place, format!("has more than {DEEPEST} nodes above it")));
        }
        let transform = above * local(source, node, &place)?;
        open.extend(children(node).into_iter().rev().map(|child| (child, Some(visits.len()))));
        visits.push(Visit { node: index, parent, depth, transform });
    }
    Ok(visits)
}

/// The one node of this name.
fn named(source: Source, visits: &[Visit], name: &str) -> Result<usize, CarrierError> {
    let nodes = source.document.list("nodes");
    let name_of = |n: usize| nodes[n].get("name").and_then(Value::as_str);
    let all = visits.iter().map(|v| v.node);
    let found: Vec<usize> = all.clone().filter(|n| name_of(*n) == Some(name)).collect();
    match found.as_slice() {
        [one] => Ok(*one),
        [] => {
            let names: Vec<&str> = all.filter_map(name_of).take(20).collect();
            let problem = format!("no node of the scene is named {name:?}");
            let remedy = match names.as_slice() {
                [] => "its nodes have no names: name one in the modeller, or leave --node out".into(),
                _ => format!("there are {}", names.join(", ")),
            };
            Err(CarrierError::input(source.file, "/nodes", problem, remedy))
        }
        several => {
            let places: Vec<String> = several.iter().map(|n| format!("/nodes/{n}")).collect();
            let problem = format!("{} nodes are named {name:?}", several.len());
            Err(CarrierError::input(source.file, places.join(" "), problem, "rename one in the modeller"))
        }
    }
}

fn local(source: Source, node: &Value, place: &str) -> Result<DAffine3, CarrierError> {
    if let Some(matrix) = node.get("matrix") {
        let m: [f64; 16] = numbers(source, matrix, &format!("{place}/matrix"))?;
        let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
        let is_affine =
            [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)].iter().all(|(i, want)| (m[*i] - want).abs() < LAST_ROW);
        if !is_affine {
            return Err(source.fail(format!("{place}/matrix"), "has another last row than 0 0 0 1"));
        }
        return Ok(DAffine3::from_mat3_translation(DMat3::from_cols(column(0), column(1), column(2)), column(3)));
    }
    let translation = match node.get("translation") {
        Some(v) => numbers(source, v, &format!("{place}/translation"))?,
        None => [0.0; 3],
    };
    let rotation = match node.get("rotation") {
        Some(v) => numbers(source, v, &format!("{place}/rotation"))?,
        None => [0.0, 0.0, 0.0, 1.0],
    };
    let scale = match node.get("scale") {
        Some(v) => numbers(source, v, &format!("{place}/scale"))?,
        None => [1.0; 3],
    };
    let rotation = DQuat::from_array(rotation);
    if rotation.length_squared() < f64::MIN_POSITIVE {
        return Err(source.fail(format!("{place}/rotation"), "is a quaternion of length 0"));
    }
    let rotation = rotation.normalize();
    Ok(DAffine3::from_scale_rotation_translation(scale.into(), rotation, translation.into()))
}

fn numbers<const N: usize>(source: Source, value: &Value, place: &str) -> Result<[f64; N], CarrierError> {
    let list: Option<Vec<f64>> = value.as_array().and_then(|a| a.iter().map(Value::as_f64).collect());
    let array = list.and_then(|l| <[f64; N]>::try_from(l).ok());
    array.ok_or_else(|| source.fail(place, format!("must be {N} numbers")))
}
