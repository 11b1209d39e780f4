//! xtask/gates.toml.

use crate::repo;
use anyhow::{Context, Result};
use serde::Deserialize;
use std::collections::BTreeMap;

/// One figure and what it must reach.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gate {
    /// What is measured.
    pub what: String,
    /// Its unit; "1" for a ratio.
    pub unit: String,
    /// Most that passes; no gate where neither this nor `at_least` is said.
    pub at_most: Option<f64>,
    /// Least that passes.
    pub at_least: Option<f64>,
}

impl Gate {
    /// Whether a measured value passes; not-a-number never does.
    pub fn passes(&self, value: f64) -> bool {
        !value.is_nan()
            && self.at_most.is_none_or(|most| value <= most)
            && self.at_least.is_none_or(|least| value >= least)
    }
}

/// All gates by name.
pub fn read() -> Result<BTreeMap<String, Gate>> {
    toml::from_str(&repo::text("xtask/gates.toml")?).context("xtask/gates.toml")
}
