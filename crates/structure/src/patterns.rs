//! Patterns of the section [roles] over the names of parts.

use crate::StructureError;
use foliar_plant::Part;
use foliar_schema::{Role, Roles};
use globset::{GlobBuilder, GlobMatcher};

/// The patterns of `[roles]`, ready to match.
pub(crate) struct Patterns(Vec<(Role, String, GlobMatcher)>);

impl Patterns {
    pub fn new(roles: &Roles) -> Result<Self, StructureError> {
        let lists = [(Role::Leaf, &roles.leaf), (Role::Wood, &roles.wood), (Role::Other, &roles.other)];
        let mut patterns = Vec::new();
        for (role, list) in lists {
            for pattern in list {
                // globset ignores the case of ASCII only: both sides are put in lower case.
                let glob =
                    GlobBuilder::new(&pattern.to_lowercase()).build().map_err(|error| StructureError::Pattern {
                        role: role.name(),
                        pattern: pattern.clone(),
                        reason: error.kind().to_string(),
                    })?;
                patterns.push((role, pattern.clone(), glob.compile_matcher()));
            }
        }
        Ok(Patterns(patterns))
    }

    /// Patterns that match none of these parts, with their role.
    pub fn unmatched<'a>(&'a self, parts: &'a [Part]) -> impl Iterator<Item = (Role, &'a str)> {
        let is_used = |glob: &GlobMatcher| {
            parts.iter().any(|part| names(part).iter().any(|name| glob.is_match(name.to_lowercase())))
        };
        self.0.iter().filter(move |(_, _, glob)| !is_used(glob)).map(|(role, pattern, _)| (*role, pattern.as_str()))
    }

    /// Roles that a part's names match, with pattern and name. A part without any name matches as "".
    pub fn matches<'a>(&'a self, part: &'a Part) -> impl Iterator<Item = (Role, &'a str, &'a str)> {
        let names = names(part);
        self.0.iter().filter_map(move |(role, pattern, glob)| {
            let name = names.iter().find(|name| glob.is_match(name.to_lowercase()))?;
            Some((*role, pattern.as_str(), *name))
        })
    }
}

/// Names of a part, the one that reports use first; "" where it has none.
pub(crate) fn names(part: &Part) -> Vec<&str> {
    let mut names: Vec<&str> =
        [&part.material_name, &part.node_name, &part.object_name].into_iter().flatten().map(String::as_str).collect();
    if names.is_empty() {
        names.push("");
    }
    names
}

/// A pattern that matches this name: what a glob takes for special becomes `?`.
pub(crate) fn pattern_for(name: &str) -> String {
    if name.is_empty() { "*".into() } else { name.replace(['*', '[', ']', '{', '}', '\\', '!', '"'], "?") }
}
