//! A crate depends on lower floors only, never sideways.

use crate::repo;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// Complaints about all manifests.
pub fn check(files: &[String]) -> Result<Vec<String>> {
    let mut manifests = BTreeMap::new();
    for file in files.iter().filter(|f| f.ends_with("/Cargo.toml") && !f.starts_with("tests/")) {
        let manifest: Table = repo::text(file)?.parse().with_context(|| format!("{file} is no TOML"))?;
        manifests.insert(file.clone(), manifest);
    }
    Ok(complaints(&manifests))
}

fn complaints(manifests: &BTreeMap<String, Table>) -> Vec<String> {
    let floors: BTreeMap<&str, i64> = manifests.values().filter_map(|m| Some((name(m)?, floor(m)?))).collect();
    let mut complaints = Vec::new();
    for (file, manifest) in manifests {
        let Some(own) = floor(manifest) else {
            complaints.push(format!("{file}: says no floor ([package.metadata.house] floor = N)"));
            continue;
        };
        for (kind, dependency) in dependencies(manifest) {
            if let Some(&other) = floors.get(dependency)
                && other >= own
            {
                complaints.push(format!(
                    "{file}: [{kind}] {dependency} is on floor {other}, must be below {own}: a crate depends on lower floors only"
                ));
            }
        }
    }
    complaints
}

fn name(manifest: &Table) -> Option<&str> {
    manifest.get("package")?.get("name")?.as_str()
}

fn floor(manifest: &Table) -> Option<i64> {
    manifest.get("package")?.get("metadata")?.get("house")?.get("floor")?.as_integer()
}

fn dependencies(manifest: &Table) -> impl Iterator<Item = (&'static str, &str)> {
    ["dependencies", "dev-dependencies", "build-dependencies"].into_iter().flat_map(move |kind| {
        let table = manifest.get(kind).and_then(Value::as_table);
        table.into_iter().flat_map(Table::keys).map(move |name| (kind, name.as_str()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(name: &str, floor: i64, dependency: &str) -> Table {
        format!(
            "[package]\nname = \"{name}\"\nmetadata.house.floor = {floor}\n[dev-dependencies]\n{dependency} = \"1\""
        )
        .parse()
        .unwrap()
    }

    #[test]
    fn sideways_and_upward_are_refused_even_for_tests() {
        let manifests = [manifest("a", 3, "b"), manifest("b", 3, "c"), manifest("c", 2, "serde")];
        let manifests = manifests.into_iter().enumerate().map(|(i, m)| (format!("{i}"), m)).collect();
        let complaints = complaints(&manifests);
        assert_eq!(complaints.len(), 1, "{complaints:?}");
        assert!(complaints[0].contains("b is on floor 3"));
    }
}
