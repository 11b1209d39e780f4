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
    /// Most that passes; no gate where nothing is said.
    pub at_most: Option<f64>,
}

/// All gates by name.
pub fn read() -> Result<BTreeMap<String, Gate>> {
    toml::from_str(&repo::text("xtask/gates.toml")?).context("xtask/gates.toml")
}
