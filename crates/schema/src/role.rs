//! What a part of a plant is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Role of a part (a primitive): decided by `structure`, read by every room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Trunk, branches, twigs.
    Wood,
    /// Leaves, needles, flowers, fruit, leaf cards and crown volumes.
    Leaf,
    /// Anything that is no part of the plant: pots, ground, glass.
    Other,
}

impl Role {
    /// The word that files and flags use.
    pub const fn name(self) -> &'static str {
        match self {
            Role::Wood => "wood",
            Role::Leaf => "leaf",
            Role::Other => "other",
        }
    }
}

impl std::fmt::Display for Role {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
