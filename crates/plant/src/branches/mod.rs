//! Branches of a plant: who hangs on whom, axes as chains of capsules, and where vertices and leaves sit on
//! them (Kusternig07 section 5).

mod attach;
mod axis;
mod check;
mod grow;

pub use attach::Attachment;
pub use axis::{Axis, Spot};
pub(crate) use check::check;
pub use grow::Stalk;

use glam::{DAffine3, Vec3};

/// Branch id of what belongs to none: a root's parent, a vertex of no branch, a leaf where there is no wood.
pub const NO_BRANCH: u32 = u32::MAX;
/// Levels that a chain names (Kusternig07 section 5: "four levels").
pub const LEVELS: usize = 4;

/// One row of the table `foliarBranch`. Rest frame, meters, as the file stores it (f32).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Branch that it grows from; [`NO_BRANCH`] for a root.
    pub parent: u32,
    /// 0 for a stem, else its parent's level plus one; not cut at [`LEVELS`].
    pub level: u32,
    /// The branch itself or its ancestor at levels 0 to 3; [`NO_BRANCH`] where there is none. A branch at level
    /// 4 or deeper is not in its own chain: it moves as its ancestor at level 3 does.
    pub chain: [u32; LEVELS],
    /// Where its axis, drawn on backward, meets its parent's; a root's own foot.
    pub pivot: Vec3,
    /// From its root to the middle of its length, unit.
    pub direction: Vec3,
    /// Length of its axis, meters.
    pub length: f32,
    /// Radius at its root, meters.
    pub radius: f32,
    /// Cost of the second-best parent less that of the chosen one; at most [`LARGEST_MARGIN`].
    pub margin: f32,
}

/// Margin of a branch that has no second parent to choose.
pub const LARGEST_MARGIN: f32 = 100.0;

/// A place on a branch: a vertex's or a leaf's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnBranch {
    /// Branch id, or [`NO_BRANCH`].
    pub branch: u32,
    /// Arc length along its axis, from its root, meters; one value per ring of a tube.
    pub arc: f32,
}

impl OnBranch {
    /// On no branch.
    pub const NONE: OnBranch = OnBranch { branch: NO_BRANCH, arc: 0.0 };
}

/// All branches of a plant. Ids follow (level, first vertex): a parent's id is below its children's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branches {
    /// Rows of the table, row = branch id.
    pub rows: Vec<Branch>,
    /// Axis of each branch.
    pub axes: Vec<Axis>,
    /// How each branch hangs on its parent; a root's is [`Attachment::default`] with its own foot.
    pub attachments: Vec<Attachment>,
    /// Per part, per vertex: branch and arc length; an empty list where a part has none at all.
    pub vertices: Vec<Vec<OnBranch>>,
    /// Per leaf: branch and arc length of the place that its petiole is nearest to.
    pub leaves: Vec<OnBranch>,
}

impl Branches {
    /// Number of branches.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Branches without a parent: stems, and islands that no branch reaches.
    pub fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.rows.len()).filter(|&b| self.rows[b].parent == NO_BRANCH)
    }

    /// The same branches after a change of frame that keeps shape (uniform scale, rotation, move).
    pub fn transformed(&self, change: DAffine3) -> Branches {
        let scale = change.matrix3.x_axis.length();
        let mut out = self.clone();
        for row in &mut out.rows {
            row.pivot = change.transform_point3(row.pivot.as_dvec3()).as_vec3();
            row.direction = change.transform_vector3(row.direction.as_dvec3()).normalize_or(glam::DVec3::Y).as_vec3();
            row.length = (f64::from(row.length) * scale) as f32;
            row.radius = (f64::from(row.radius) * scale) as f32;
        }
        out.axes.iter_mut().for_each(|axis| axis.transform(change, scale));
        out.attachments.iter_mut().for_each(|attachment| attachment.transform(change, scale));
        let places = out.vertices.iter_mut().flatten().chain(&mut out.leaves);
        places.for_each(|place| place.arc = (f64::from(place.arc) * scale) as f32);
        out
    }
}
