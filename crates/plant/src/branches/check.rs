//! What holds of branches once a plant has them.

use super::{Axis, Branch, Branches, LEVELS, NO_BRANCH, OnBranch};
use crate::plant::PlantError;
use crate::{Base, Part};

/// Whether branches belong to a base of so many leaves and keep their invariants.
pub(crate) fn check(branches: &Branches, base: &Base, leaves: usize) -> Result<(), PlantError> {
    let count = branches.rows.len();
    for (what, found, expected) in [
        ("axes", branches.axes.len(), count),
        ("attachments", branches.attachments.len(), count),
        ("vertex lists", branches.vertices.len(), base.parts.len()),
        ("leaves", branches.leaves.len(), leaves),
    ] {
        if found != expected {
            return Err(PlantError::Branches { what, at: 0, value: found.to_string(), expected: expected.to_string() });
        }
    }
    for (id, row) in branches.rows.iter().enumerate() {
        check_row(id, row, &branches.rows)?;
        check_axis(id, &branches.axes[id])?;
    }
    for (list, part) in branches.vertices.iter().zip(&base.parts) {
        check_vertices(list, part, count)?;
    }
    check_places(&branches.leaves, count, "branch of a leaf")
}

fn error(what: &'static str, at: usize, value: impl ToString, expected: impl ToString) -> Result<(), PlantError> {
    Err(PlantError::Branches { what, at, value: value.to_string(), expected: expected.to_string() })
}

fn check_row(id: usize, row: &Branch, rows: &[Branch]) -> Result<(), PlantError> {
    let (mut chain, mut level) = ([NO_BRANCH; LEVELS], 0);
    if row.parent != NO_BRANCH {
        if row.parent as usize >= id {
            return error("parent", id, row.parent, "below its own id");
        }
        let parent = &rows[row.parent as usize];
        (chain, level) = (parent.chain, parent.level + 1);
    }
    if let Some(own) = chain.get_mut(level as usize) {
        *own = id as u32;
    }
    if row.level != level || row.chain != chain {
        return error("level and chain", id, format!("{} {:?}", row.level, row.chain), format!("{level} {chain:?}"));
    }
    let numbers = [row.length, row.radius, row.margin];
    if !(row.pivot.is_finite() && row.direction.is_finite() && numbers.iter().all(|x| x.is_finite() && *x >= 0.0)) {
        return error("row", id, format!("{row:?}"), "finite, lengths and margin 0 or above");
    }
    Ok(())
}

fn check_axis(id: usize, axis: &Axis) -> Result<(), PlantError> {
    let count = axis.points.len();
    if count == 0 || axis.radii.len() != count || axis.arcs.len() != count {
        let lengths = format!("{count}, {}, {}", axis.radii.len(), axis.arcs.len());
        return error("points, radii, arcs", id, lengths, "as many of each, at least one");
    }
    let ordered = axis.arcs[0].abs() <= 0.0 && axis.arcs.windows(2).all(|w| w[0] <= w[1]);
    let finite = axis.points.iter().all(|p| p.is_finite())
        && axis.radii.iter().all(|r| r.is_finite() && *r >= 0.0)
        && axis.length().is_finite();
    if !(ordered && finite) {
        return error("axis", id, format!("{axis:?}"), "finite, arcs from 0 upward, radii 0 or above");
    }
    Ok(())
}

fn check_vertices(list: &[OnBranch], part: &Part, count: usize) -> Result<(), PlantError> {
    if !list.is_empty() && list.len() != part.positions.len() {
        return error("vertices of a part", 0, list.len(), part.positions.len());
    }
    check_places(list, count, "branch of a vertex")
}

fn check_places(list: &[OnBranch], count: usize, what: &'static str) -> Result<(), PlantError> {
    let bad = |place: &OnBranch| {
        (place.branch != NO_BRANCH && place.branch as usize >= count) || !(place.arc.is_finite() && place.arc >= 0.0)
    };
    match list.iter().position(bad) {
        Some(at) => error(what, at, format!("{:?}", list[at]), format!("a branch below {count}, arc 0 or above")),
        None => Ok(()),
    }
}
