//! Tests against oracles and laws.

mod fits;
mod heard;
mod lights;
mod maps;
mod photos;
mod room;
mod said;
mod scans;
mod shaders;
mod slabs;

use serde_json::Value;
use std::path::PathBuf;

/// A file of the shared data as text; `None` where there is none.
fn shared(path: &str) -> Option<String> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let root = std::env::var_os("FOLIAR_SHARED").map_or_else(|| beside.into(), PathBuf::from);
    let text = std::fs::read_to_string(root.join(path)).ok();
    if text.is_none() {
        eprintln!("skipped: no shared data ({path})");
    }
    text
}

/// A file of the shared reference values.
fn oracle(name: &str) -> Option<Value> {
    shared(&format!("oracles/translucency/{name}")).map(|text| serde_json::from_str(&text).unwrap())
}

/// A number of a record.
fn number(record: &Value, name: &str) -> f64 {
    record[name].as_f64().unwrap_or_else(|| panic!("{name} in {record}"))
}
