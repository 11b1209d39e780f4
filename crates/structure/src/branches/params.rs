//! Parameters of the step: the section [branches].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How branches are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BranchParams {
    /// How parents are chosen.
    pub method: Method,
    /// Whether a branch that goes on where its parent ends is one with it.
    pub continuation: Continuation,
}

/// How parents are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Contact at ends against capsules, minimum arborescence with the ground as root; wood in one piece that
    /// clearly forks is taken apart by the shape of its surface.
    #[default]
    Robust,
    /// The same, and every piece whose rings fall into parts is taken apart.
    Fused,
    /// The paper's own words: by diameter, whoever intersects (Kusternig07 section 5). To show the difference.
    Kusternig07,
}

/// Whether a branch that goes on where its parent ends is one with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Continuation {
    /// One branch; arc lengths go on.
    #[default]
    Merge,
    /// Two.
    Split,
}
