//! What is found in files of which the truth is known: expected.json, and the linden.

use super::Figure;
use crate::expected_parts::wrong_parts;
use crate::shared_trees;
use anyhow::Result;
use foliar_schema::Roles;
use foliar_structure::{StructureParams, analyze};

/// Files of expected.json that do not come out exactly.
pub fn files() -> Result<Figure> {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for tree in shared_trees::all()? {
        let base = foliar_carrier::read(&tree.path, &tree.import)?.base;
        let parts = analyze(&base, &Roles::default(), &StructureParams::default())?.parts;
        count += 1;
        if !wrong_parts(&tree.expected, &parts).is_empty() {
            wrong.push(tree.name);
        }
    }
    let peer = format!("none; {} of {count} exactly {}", count - wrong.len(), wrong.join(", "));
    Ok(Figure::new(wrong.len() as f64, peer.trim_end()))
}

/// Leaves that structure finds in the linden.
pub fn linden_leaves() -> Result<Figure> {
    Ok(Figure::new(shared_trees::linden().read()?.plant.leaves().len() as f64, "none"))
}
