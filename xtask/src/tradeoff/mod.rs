//! Rooms judged: density by traced light, wind against its full model, light against rays. Writes tables, charts and pictures of
//! docs/tradeoff.

mod engines;
pub mod judged;
mod leaf_pictures;
pub mod light;
pub mod light_model;
mod normals;
mod occluders;
mod pictures;
mod plot;
mod room;
mod rungs;
mod scores;
mod subsets;
mod tables;
mod time;
mod translucency;
pub mod trees;
mod wind;

use crate::repo;
use anyhow::{Context, Result, bail};

const DOCUMENT: &str = "docs/tradeoff/density.md";
const CHART: &str = "docs/tradeoff/density.svg";
/// What is generated ends here; it begins at a line that names its command.
const MARKER_END: &str = "<!-- end -->\n";

/// Measures a room.
pub fn run(name: Option<&str>) -> Result<()> {
    match name {
        Some("density") => density(),
        Some("wind") => wind::run(),
        Some("light") => engines::run().and_then(|()| light_model::run()),
        Some("light-model") => light_model::run(),
        Some("translucency") => translucency::run(),
        Some("time") => time::run(),
        _ => bail!(
            "there are comparisons of density, wind, light, light-model and translucency, and time: cargo xtask tradeoff density"
        ),
    }
}

fn density() -> Result<()> {
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
        format!("### Accuracy and time, {}\n\n{}", trees::FIRST, tables::rungs(&rungs::climb(first, |_| true)?)),
        format!("### Fewer generators, {}\n\n{}", trees::FIRST, tables::subsets(&subsets::compare(first)?)),
    ]
    .join("\n");
    println!("{text}");
    std::fs::write(repo::root().join(DOCUMENT), replaced(DOCUMENT, &repo::text(DOCUMENT)?, &text)?).context(DOCUMENT)
}

/// A document of a room with other tables between its markers.
fn replaced(name: &str, document: &str, tables: &str) -> Result<String> {
    let room = name.trim_start_matches("docs/tradeoff/").trim_end_matches(".md");
    let [start, end] = [&format!("<!-- cargo xtask tradeoff {room} -->\n"), MARKER_END];
    let (before, rest) = document.split_once(start).with_context(|| format!("{name}: no line {start}"))?;
    let (_, after) = rest.split_once(end).with_context(|| format!("{name}: no line {end}"))?;
    Ok(format!("{before}{start}\n{tables}\n{end}{after}"))
}

#[cfg(test)]
mod tests {
    #[test]
    fn only_what_stands_between_the_markers_is_replaced() {
        let document = "a\n<!-- cargo xtask tradeoff density -->\nold\n<!-- end -->\nb\n";
        let replaced = super::replaced(super::DOCUMENT, document, "new").unwrap();
        assert!(replaced.starts_with("a\n") && replaced.ends_with("b\n"), "{replaced}");
        assert!(replaced.contains("new") && !replaced.contains("old"));
        assert!(super::replaced(super::DOCUMENT, "no markers", "new").is_err());
    }
}
