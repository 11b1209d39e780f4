//! Density judged by traced light: which default, and why. Writes the tables of docs/tradeoff/density.md, its
//! chart and its pictures.

pub mod judged;
mod light;
mod normals;
mod occluders;
mod pictures;
mod plot;
mod room;
mod rungs;
mod scores;
mod subsets;
mod tables;
pub mod trees;

use crate::repo;
use anyhow::{Context, Result, bail};

const DOCUMENT: &str = "docs/tradeoff/density.md";
const CHART: &str = "docs/tradeoff/density.svg";
/// Between these lines stands what is generated.
const MARKERS: [&str; 2] = ["<!-- cargo xtask tradeoff density -->\n", "<!-- end -->\n"];

/// Measures a room.
pub fn run(name: Option<&str>) -> Result<()> {
    if name != Some("density") {
        bail!("there is a comparison of density only: cargo xtask tradeoff density");
    }
    let trees = trees::all()?;
    let mut judged = Vec::new();
    for tree in &trees {
        eprintln!("{}", tree.name);
        let tree_judged = judged::judge(tree)?;
        println!("{}", tables::ambient(std::slice::from_ref(&tree_judged)));
        println!("{}", tables::normals(std::slice::from_ref(&tree_judged)));
        judged.push(tree_judged);
        pictures::draw(tree)?;
    }
    let first = &trees[0].plant;
    std::fs::write(repo::root().join(CHART), plot::svg(&judged)).context(CHART)?;
    let text = [
        format!("### Trees\n\n{}", tables::trees(&judged)),
        format!("### Ambient terms\n\n{}", tables::ambient(&judged)),
        format!("### Normals\n\n{}", tables::normals(&judged)),
        format!("### Accuracy and time, {}\n\n{}", trees::FIRST, tables::rungs(&rungs::climb(first)?)),
        format!("### Fewer generators, {}\n\n{}", trees::FIRST, tables::subsets(&subsets::compare(first)?)),
    ]
    .join("\n");
    println!("{text}");
    std::fs::write(repo::root().join(DOCUMENT), replaced(&repo::text(DOCUMENT)?, &text)?).context(DOCUMENT)
}

/// The document with other tables between its markers.
fn replaced(document: &str, tables: &str) -> Result<String> {
    let [start, end] = MARKERS;
    let (before, rest) = document.split_once(start).with_context(|| format!("{DOCUMENT}: no line {start}"))?;
    let (_, after) = rest.split_once(end).with_context(|| format!("{DOCUMENT}: no line {end}"))?;
    Ok(format!("{before}{start}\n{tables}\n{end}{after}"))
}

#[cfg(test)]
mod tests {
    #[test]
    fn only_what_stands_between_the_markers_is_replaced() {
        let document = format!("a\n{}old\n{}b\n", super::MARKERS[0], super::MARKERS[1]);
        let replaced = super::replaced(&document, "new").unwrap();
        assert!(replaced.starts_with("a\n") && replaced.ends_with("b\n"), "{replaced}");
        assert!(replaced.contains("new") && !replaced.contains("old"));
        assert!(super::replaced("no markers", "new").is_err());
    }
}
