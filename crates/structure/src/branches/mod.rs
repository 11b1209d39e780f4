//! The branch hierarchy of an unrigged tree (Kusternig07 section 5, made robust): found when a room asks for it.
//!
//! Connected pieces of wood become chains of capsules; each hangs by one of its ends on another, or stands on
//! the ground, such that the whole costs least; what goes on where its parent ends is one branch with it.

mod accuracy;
mod arborescence;
mod bands;
mod bind;
mod caps;
mod contact;
mod find;
mod fused;
mod hang;
mod layer;
mod limits;
mod literal;
mod mesh;
mod params;
mod read;
mod report;
mod tube;

pub use accuracy::{Accuracy, Truth, Wrong};
pub use find::find;
pub use hang::continues;
pub use layer::to_layer;
pub use params::{BranchParams, Continuation, Method};
pub use read::from_layer;
pub use report::{findings, report};

use foliar_plant::Branches;

/// Version of the step: it changes when results change.
pub const VERSION: u32 = 2;

/// What was found, and how sure it is.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// The branches.
    pub branches: Branches,
    /// One per branch, in the order of ids.
    pub reports: Vec<BranchReport>,
}

/// How a branch came to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BranchReport {
    /// What it is.
    pub kind: RootKind,
    /// Cost of its parent.
    pub cost: f64,
    /// Cost of the second-best parent less that; low means that it might as well hang there; infinite where there
    /// is no second (from a layer: [`foliar_plant::LARGEST_MARGIN`]).
    pub margin: f64,
    /// Distance between its bark and its parent's, in its own radii.
    pub gap: f64,
    /// Mean deviation of its rings from circles, over their radius.
    pub roughness: f64,
    /// Share of its level sets that fall into several parts: above a few percent it is a fused piece.
    pub split: f64,
    /// Tubes that it was joined from.
    pub tubes: u32,
}

/// What a branch is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RootKind {
    /// Hangs on another.
    #[default]
    Branch,
    /// Stands on the ground.
    Stem,
    /// Neither: nothing is near it.
    Island,
}

impl RootKind {
    /// What the column `kind` says.
    fn of(number: i32) -> RootKind {
        match number {
            1 => RootKind::Stem,
            2 => RootKind::Island,
            _ => RootKind::Branch,
        }
    }

    /// One word for reports.
    pub const fn name(self) -> &'static str {
        match self {
            RootKind::Branch => "branch",
            RootKind::Stem => "stem",
            RootKind::Island => "island",
        }
    }
}
