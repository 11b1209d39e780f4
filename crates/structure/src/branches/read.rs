//! Layer `branches` -> branches, as every room gets them: what a master gives back is what a first bake was made from.

use super::{BranchReport, Found, RootKind};
use crate::StructureError;
use foliar_bake::{Array, Layer};
use foliar_plant::{Attachment, Axis, Base, Branch, Branches, LEVELS, NO_BRANCH, OnBranch, Part};
use foliar_schema::names;
use glam::Vec3;

/// The branches that a layer holds, of a plant of so many leaves. Attachments follow from the axes.
///
/// # Errors
/// [`StructureError::Layer`] where the layer does not fit the base.
pub fn from_layer(layer: &Layer, base: &Base, leaves: usize) -> Result<Found, StructureError> {
    let reader = Reader { layer };
    let rows = reader.rows()?;
    let axes = reader.axes(&rows)?;
    let attachment = |(axis, row): (&Axis, &Branch)| match axes.get(row.parent as usize) {
        Some(parent) => Attachment::of(axis, parent),
        None => Attachment::root(axis),
    };
    let attachments = axes.iter().zip(&rows).map(attachment).collect();
    let vertices = base.parts.iter().map(|part| reader.vertices(part, rows.len())).collect::<Result<_, _>>()?;
    let leaves = reader.leaves(leaves, !rows.is_empty())?;
    let reports = reader.reports(&rows)?;
    Ok(Found { branches: Branches { rows, axes, attachments, vertices, leaves }, reports })
}

struct Reader<'a> {
    layer: &'a Layer,
}

impl Reader<'_> {
    fn rows(&self) -> Result<Vec<Branch>, StructureError> {
        let class = names::CLASS_BRANCH;
        let Some(count) = self.layer.column(class, "parent").map(Array::rows) else { return Ok(Vec::new()) };
        let [parent, level, chain] = [("parent", 1), ("level", 1), ("chain", LEVELS)]
            .map(|(name, width)| self.integers(class, name, width, count));
        let (parent, level, chain) = (parent?, level?, chain?);
        let [pivot, direction] = ["pivot", "direction"].map(|name| self.floats(class, name, 3, count));
        let (pivot, direction) = (pivot?, direction?);
        let [length, radius, margin] = ["length", "radius", "margin"].map(|name| self.floats(class, name, 1, count));
        let (length, radius, margin) = (length?, radius?, margin?);
        let row = |b: usize| Branch {
            parent: unsigned(parent[b]),
            level: unsigned(level[b]),
            chain: std::array::from_fn(|k| unsigned(chain[LEVELS * b + k])),
            pivot: vector(pivot, b),
            direction: vector(direction, b),
            length: length[b],
            radius: radius[b],
            margin: margin[b],
        };
        Ok((0..count).map(row).collect())
    }

    fn reports(&self, rows: &[Branch]) -> Result<Vec<BranchReport>, StructureError> {
        if rows.is_empty() {
            return Ok(Vec::new());
        }
        let (class, count) = (names::CLASS_BRANCH, rows.len());
        let [cost, gap, roughness, split] =
            ["cost", "gap", "roughness", "split"].map(|name| self.floats(class, name, 1, count));
        let (cost, gap, roughness, split) = (cost?, gap?, roughness?, split?);
        let (kind, tubes) = (self.integers(class, "kind", 1, count)?, self.integers(class, "tubes", 1, count)?);
        let report = |b: usize| BranchReport {
            kind: RootKind::of(kind[b]),
            cost: cost[b].into(),
            margin: rows[b].margin.into(),
            gap: gap[b].into(),
            roughness: roughness[b].into(),
            split: split[b].into(),
            tubes: tubes[b].try_into().unwrap_or(0),
        };
        Ok((0..count).map(report).collect())
    }

    fn axes(&self, rows: &[Branch]) -> Result<Vec<Axis>, StructureError> {
        let class = names::CLASS_AXIS;
        let rings = self.layer.column(class, "branch").map_or(0, Array::rows);
        if rows.is_empty() {
            return Ok(Vec::new());
        }
        let owners = self.integers(class, "branch", 1, rings)?;
        let (offsets, radii) = (self.floats(class, "offset", 3, rings)?, self.floats(class, "radius", 1, rings)?);
        let mut lists = vec![(Vec::new(), Vec::new()); rows.len()];
        for (ring, &owner) in owners.iter().enumerate() {
            let row =
                rows.get(owner as usize).ok_or_else(|| misfit(class, "branch", owner, "a row of the branches"))?;
            let (points, list) = &mut lists[owner as usize];
            points.push(row.pivot.as_dvec3() + vector(offsets, ring).as_dvec3());
            list.push(f64::from(radii[ring]));
        }
        if let Some(bare) = lists.iter().position(|(points, _)| points.is_empty()) {
            return Err(misfit(class, "branch", format!("no ring of branch {bare}"), "at least one ring of each"));
        }
        Ok(lists.into_iter().map(|(points, radii)| Axis::new(points, radii)).collect())
    }

    /// Places of a part's vertices; an empty list where it has none.
    fn vertices(&self, part: &Part, branches: usize) -> Result<Vec<OnBranch>, StructureError> {
        let place = part.place;
        let of = |name: &str| self.layer.attribute(place, name).and_then(Array::as_f32);
        let Some(ids) = of(names::BRANCH_ID) else { return Ok(Vec::new()) };
        let (count, arcs) = (part.positions.len(), of(names::BRANCH_ARC).unwrap_or_default());
        if ids.len() != count || arcs.len() != count {
            let what = format!("ids and arcs of mesh {}, primitive {}", place.mesh, place.primitive);
            return Err(error(what, format!("{} and {}", ids.len(), arcs.len()), format!("{count} each")));
        }
        let on_branch = |(&id, &arc): (&f32, &f32)| {
            if id as usize == branches { OnBranch::NONE } else { OnBranch { branch: id as u32, arc } }
        };
        Ok(ids.iter().zip(arcs).map(on_branch).collect())
    }

    fn leaves(&self, count: usize, any: bool) -> Result<Vec<OnBranch>, StructureError> {
        if !any || count == 0 {
            return Ok(vec![OnBranch::NONE; count]);
        }
        let class = names::CLASS_LEAF;
        let branches = self.integers(class, "branch", 1, count)?;
        let arcs = self.floats(class, "branchArc", 1, count)?;
        Ok(branches.iter().zip(arcs).map(|(&id, &arc)| OnBranch { branch: unsigned(id), arc }).collect())
    }

    fn floats(&self, class: &str, name: &str, width: usize, rows: usize) -> Result<&[f32], StructureError> {
        let array = self.layer.column(class, name).filter(|a| a.width() == width && a.rows() == rows);
        array.and_then(Array::as_f32).ok_or_else(|| self.wrong(class, name, rows))
    }

    fn integers(&self, class: &str, name: &str, width: usize, rows: usize) -> Result<&[i32], StructureError> {
        let array = self.layer.column(class, name).filter(|a| a.width() == width && a.rows() == rows);
        array.and_then(Array::as_i32).ok_or_else(|| self.wrong(class, name, rows))
    }

    fn wrong(&self, class: &str, name: &str, rows: usize) -> StructureError {
        let found = self.layer.column(class, name);
        let found = found.map_or("missing".into(), |a| format!("{} rows of {}", a.rows(), a.width()));
        misfit(class, name, found, &format!("{rows} rows of the contract's type"))
    }
}

fn misfit(class: &str, name: &str, found: impl ToString, expected: &str) -> StructureError {
    error(format!("column {class}/{name}"), found.to_string(), expected.to_string())
}

fn error(what: String, found: String, expected: String) -> StructureError {
    StructureError::Layer { layer: names::ROOM_BRANCHES, what, found, expected }
}

/// -1 is none; what else is out of range, the plant refuses.
fn unsigned(id: i32) -> u32 {
    u32::try_from(id).unwrap_or(NO_BRANCH)
}

fn vector(data: &[f32], row: usize) -> Vec3 {
    Vec3::new(data[3 * row], data[3 * row + 1], data[3 * row + 2])
}
