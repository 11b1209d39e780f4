//! Reference values as JSON records (made by independent programs: adding-doubling, counted photons, inverted leaves), and by
//! how much this crate misses them. Tests and `cargo xtask bench translucency-oracle` ask here.

mod bumps;
mod golden;
mod slabs;

pub use bumps::{Bumps, bumps_error};
pub use golden::Golden;
pub use slabs::{layers_error, leaf_error, measured_leaf_error, slab_error, slab_totals, spread_error};

use crate::transport::Medium;
use serde_json::Value;

/// A number of a record; not-a-number where there is none, which no gate passes.
pub fn number(record: &Value, name: &str) -> f64 {
    record[name].as_f64().unwrap_or(f64::NAN)
}

/// A list of numbers; rows of rows are one list.
pub fn numbers(list: &Value) -> Vec<f64> {
    let rows = list.as_array().map_or(&[][..], Vec::as_slice);
    rows.iter().flat_map(|v| v.as_f64().map_or_else(|| numbers(v), |number| vec![number])).collect()
}

/// The tissue of a record.
pub fn medium(record: &Value) -> Medium {
    Medium {
        absorption: number(record, "sigma_a"),
        scattering: number(record, "sigma_s"),
        anisotropy: number(record, "g"),
        index: number(record, "eta"),
    }
}

/// The largest of some errors; not-a-number is larger than all.
pub fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b.abs()) })
}
