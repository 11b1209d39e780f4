//! A plant: base and structure, checked once.

use crate::{Base, Branches, Leaf, NO_LEAF, Part, branches};
use foliar_schema::Role;
use glam::{DVec3, Vec3};

/// What structure found.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Role of each part.
    pub roles: Vec<Role>,
    /// Leaves, row = leaf id.
    pub leaves: Vec<Leaf>,
    /// Per part, per vertex: leaf id or [`NO_LEAF`]; an empty list where a part has none at all.
    pub leaf_ids: Vec<Vec<u32>>,
}

/// Why a base and a structure make no plant.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlantError {
    /// A coordinate is NaN or infinite, or beyond what f32 arithmetic can square.
    #[error("part {part} ({name:?}), vertex {vertex}: position {position} must be finite and below 1e15 m")]
    Position {
        /// Index of the part.
        part: usize,
        /// Its name.
        name: String,
        /// Index of the vertex.
        vertex: usize,
        /// What it is.
        position: DVec3,
    },
    /// An index points past the vertices, or a list has another length than the positions.
    #[error("part {part} ({name:?}): {what} holds {found}, must be {expected}")]
    Shape {
        /// Index of the part.
        part: usize,
        /// Its name.
        name: String,
        /// Which list.
        what: &'static str,
        /// Offending length or index.
        found: usize,
        /// What it must be.
        expected: String,
    },
    /// A leaf's values are not finite, or its area is negative.
    #[error("leaf {leaf}: {what} = {value}: must be finite{rule}")]
    Leaf {
        /// Leaf id.
        leaf: usize,
        /// Which value.
        what: &'static str,
        /// What it is.
        value: String,
        /// What else it must be.
        rule: &'static str,
    },
    /// Branches do not fit the base, or break an invariant of their own.
    #[error("branches, {what} {at}: {value}, must be {expected}; find the branches of this base anew")]
    Branches {
        /// Which list or value.
        what: &'static str,
        /// Row in it.
        at: usize,
        /// What it is.
        value: String,
        /// What would be right.
        expected: String,
    },
}

/// Largest coordinate: its fourth power is still a finite f64 and its square a finite f32.
const LARGEST_COORDINATE: f64 = 1e15;

impl Base {
    /// Whether every position is finite and every index in range: what steps before [`Plant::new`] rely on.
    ///
    /// # Errors
    /// [`PlantError`] names the first part and vertex that break an invariant.
    pub fn check(&self) -> Result<(), PlantError> {
        self.parts.iter().enumerate().try_for_each(|(index, part)| check_part(index, part, self.position_count))
    }
}

/// A base with its structure. Every position is finite, every index in range, every area 0 or above.
#[derive(Clone, Debug, Default)]
pub struct Plant {
    base: Base,
    structure: Structure,
    branches: Option<Branches>,
    center: DVec3,
    size: DVec3,
}

impl Plant {
    /// Joins base and structure.
    ///
    /// # Errors
    /// [`PlantError`] names the first part, vertex or leaf that breaks an invariant.
    pub fn new(base: Base, structure: Structure) -> Result<Plant, PlantError> {
        base.check()?;
        check_structure(&base, &structure)?;
        let (center, size) = frame(&base, &structure);
        Ok(Plant { base, structure, branches: None, center, size })
    }

    /// The same plant with its branches.
    ///
    /// # Errors
    /// [`PlantError::Branches`] names the first list or row that breaks an invariant.
    pub fn with_branches(self, branches: Branches) -> Result<Plant, PlantError> {
        branches::check(&branches, &self.base, self.structure.leaves.len())?;
        Ok(Plant { branches: Some(branches), ..self })
    }

    /// Its branches, where somebody asked for them.
    pub fn branches(&self) -> Option<&Branches> {
        self.branches.as_ref()
    }

    /// The base as read.
    pub fn base(&self) -> &Base {
        &self.base
    }

    /// Primitives, in the order (mesh, primitive).
    pub fn parts(&self) -> &[Part] {
        &self.base.parts
    }

    /// What structure found.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Role of a part.
    pub fn role(&self, part: usize) -> Role {
        self.structure.roles[part]
    }

    /// Leaves, row = leaf id.
    pub fn leaves(&self) -> &[Leaf] {
        &self.structure.leaves
    }

    /// Leaf id of a vertex, or `None`.
    pub fn leaf_of(&self, part: usize, vertex: usize) -> Option<u32> {
        self.structure.leaf_ids[part].get(vertex).copied().filter(|&id| id != NO_LEAF)
    }

    /// Center of the box around wood and leaves, rest frame, meters: arithmetic is relative to it.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Edges of the box around wood and leaves, meters.
    pub fn size(&self) -> DVec3 {
        self.size
    }

    /// Positions of a part in the rest frame relative to [`Plant::center`].
    pub fn relative_positions(&self, part: usize) -> Vec<Vec3> {
        let part = &self.base.parts[part];
        (0..part.positions.len()).map(|v| (part.rest_position(v) - self.center).as_vec3()).collect()
    }

    /// Center of a leaf relative to [`Plant::center`].
    pub fn relative_center(&self, leaf: usize) -> Vec3 {
        (self.structure.leaves[leaf].center.as_dvec3() - self.center).as_vec3()
    }
}

fn check_part(index: usize, part: &Part, position_count: u32) -> Result<(), PlantError> {
    let count = part.positions.len();
    let shape = |what, found, expected: String| PlantError::Shape {
        part: index,
        name: part.name().into(),
        what,
        found,
        expected,
    };
    for (what, length, may_be_empty) in [
        ("normals", part.normals.len(), true),
        ("uvs", part.uvs.len(), true),
        ("colors", part.colors.len(), true),
        ("position_ids", part.position_ids.len(), false),
    ] {
        if length != count && !(may_be_empty && length == 0) {
            return Err(shape(what, length, format!("{count}, one per vertex")));
        }
    }
    if let Some(&bad) = part.triangles.iter().flatten().find(|&&i| i as usize >= count) {
        return Err(shape("triangles", bad as usize, format!("below {count}, the number of vertices")));
    }
    if let Some(&bad) = part.position_ids.iter().find(|&&i| i >= position_count) {
        return Err(shape("position_ids", bad as usize, format!("below {position_count}")));
    }
    for vertex in 0..count {
        let position = part.rest_position(vertex);
        if !(position.is_finite() && position.abs().max_element() < LARGEST_COORDINATE) {
            return Err(PlantError::Position { part: index, name: part.name().into(), vertex, position });
        }
    }
    Ok(())
}

fn check_structure(base: &Base, structure: &Structure) -> Result<(), PlantError> {
    let parts = base.parts.len();
    let shape = |part: usize, what, found, expected| PlantError::Shape {
        part,
        name: base.parts.get(part).map_or(String::new(), |p| p.name().into()),
        what,
        found,
        expected,
    };
    if structure.roles.len() != parts {
        return Err(shape(parts, "roles", structure.roles.len(), format!("{parts}, one per part")));
    }
    if structure.leaf_ids.len() != parts {
        return Err(shape(parts, "leaf_ids", structure.leaf_ids.len(), format!("{parts}, one list per part")));
    }
    for (index, (ids, part)) in structure.leaf_ids.iter().zip(&base.parts).enumerate() {
        if !ids.is_empty() && ids.len() != part.positions.len() {
            return Err(shape(index, "leaf_ids", ids.len(), format!("{}, one per vertex", part.positions.len())));
        }
        if let Some(&bad) = ids.iter().find(|&&id| id != NO_LEAF && id as usize >= structure.leaves.len()) {
            return Err(shape(index, "leaf_ids", bad as usize, format!("below {}", structure.leaves.len())));
        }
    }
    structure.leaves.iter().enumerate().try_for_each(|(id, leaf)| check_leaf(id, leaf))
}

fn check_leaf(leaf: usize, values: &Leaf) -> Result<(), PlantError> {
    let error = |what, value: String, rule| Err(PlantError::Leaf { leaf, what, value, rule });
    for (what, vector) in [("center", values.center), ("normal", values.normal), ("petiole", values.petiole)] {
        if !vector.is_finite() {
            return error(what, vector.to_string(), "");
        }
    }
    if !(values.area.is_finite() && values.area >= 0.0) {
        return error("area", values.area.to_string(), " and 0 or above");
    }
    Ok(())
}

/// Center and edges of the box around everything that is wood or leaf; around all where nothing is.
fn frame(base: &Base, structure: &Structure) -> (DVec3, DVec3) {
    let bounds = |with_other: bool| {
        let mut bounds: Option<(DVec3, DVec3)> = None;
        for (part, role) in base.parts.iter().zip(&structure.roles) {
            if with_other || *role != Role::Other {
                for vertex in 0..part.positions.len() {
                    let p = part.rest_position(vertex);
                    let (low, high) = bounds.unwrap_or((p, p));
                    bounds = Some((low.min(p), high.max(p)));
                }
            }
        }
        bounds
    };
    let (low, high) = bounds(false).or_else(|| bounds(true)).unwrap_or_default();
    (low.midpoint(high), high - low)
}
