//! The tables of docs/tradeoff/density.md.

use super::judged::Judged;
use super::rungs::RungScore;
use super::subsets::Subset;
use std::fmt::Write;

/// A Markdown table.
fn table(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// Seconds to two digits: they vary more than that from run to run.
fn seconds(value: f64) -> String {
    if value < 0.1 { format!("{value:.3}") } else { format!("{value:.2}") }
}

/// Which tree is which.
pub fn trees(judged: &[Judged]) -> String {
    let row = |tree: &Judged| {
        let [radius, reach] = tree.lengths.map(|length| format!("{length:.3}"));
        vec![tree.name.into(), tree.what.into(), tree.leaves.to_string(), radius, reach]
    };
    table(&["tree", "what", "leaves", "radius of influence, m", "low-pass, m"], judged.iter().map(row))
}

/// Ambient terms: variance explained, and rms.
pub fn ambient(judged: &[Judged]) -> String {
    let mut head = vec!["share of variance explained / rms with no fit"];
    head.extend(judged.iter().map(|tree| tree.name));
    let row = |term: usize| {
        let cell = |tree: &Judged| format!("{:.3} / {:.3}", tree.ambient[term].explained, tree.ambient[term].rms);
        let mut row = vec![judged[0].ambient[term].name.to_string()];
        row.extend(judged.iter().map(cell));
        row
    };
    table(&head, (0..judged[0].ambient.len()).map(row))
}

/// Normals: correlation on every tree; jumps and seconds on the first.
pub fn normals(judged: &[Judged]) -> String {
    let mut head = vec!["r as seen from outside / over all leaves"];
    head.extend(judged.iter().map(|tree| tree.name));
    head.extend(["jumps above 30 / 90 degrees, %, first tree", "processor s, first tree"]);
    let row = |method: usize| {
        let first = &judged[0].normals[method];
        let cell = |tree: &Judged| {
            let [seen, all] = tree.normals[method].correlation;
            format!("{seen:.3} / {all:.3}")
        };
        let mut row = vec![first.name.to_string()];
        row.extend(judged.iter().map(cell));
        row.push(format!("{:.1} / {:.1}", first.jumps[0], first.jumps[1]));
        row.push(first.seconds.map_or("-".into(), seconds));
        row
    };
    table(&head, (0..judged[0].normals.len()).map(row))
}

/// The accuracy ladder.
pub fn rungs(rungs: &[RungScore]) -> String {
    let row = |rung: &RungScore| {
        let error = |steps: Option<f64>| steps.map_or("-".into(), |steps| format!("{steps:.3}"));
        vec![
            rung.name.into(),
            format!("{}", rung.promise),
            error(rung.ambient),
            error(rung.normal),
            seconds(rung.seconds),
        ]
    };
    let head =
        ["rung", "promised, steps", "error of the ambient term, 1/255", "of the normals, degrees", "processor s"];
    table(&head, rungs.iter().map(row))
}

/// Time against error: tree, leaves, rung.
pub fn times(rows: &[(&str, usize, RungScore)]) -> String {
    let error = |steps: Option<f64>| steps.map_or("-".into(), |steps| format!("{steps:.2}"));
    let row = |(tree, leaves, rung): &(&str, usize, RungScore)| {
        let promise = format!("{}", rung.promise);
        vec![
            (*tree).into(),
            leaves.to_string(),
            promise,
            error(rung.ambient),
            error(rung.normal),
            seconds(rung.seconds),
        ]
    };
    let head = [
        "tree",
        "leaves",
        "promised (`quality`)",
        "ambient term is off by, 1/255",
        "normals by, degrees",
        "processor s",
    ];
    table(&head, rows.iter().map(row))
}

/// Fewer generators.
pub fn subsets(subsets: &[Subset]) -> String {
    let row = |subset: &Subset| {
        let Subset { name, share, ambient, angle, seconds: time } = subset;
        vec![name.clone(), format!("{share:.0}"), format!("{ambient:.4}"), format!("{angle:.1}"), seconds(*time)]
    };
    let head = ["generators", "left, %", "error of k_a, rms", "of the gradient, mean degrees", "processor s"];
    table(&head, subsets.iter().map(row))
}
