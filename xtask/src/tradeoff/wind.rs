//! The wind room's ladder: levels, bits, leaf binding, the bark rule: time, bytes and error of places against the full
//! model. Writes the tables and the chart of docs/tradeoff/wind.md.

use super::room::cpu_seconds;
use crate::bench::wind::{bake, branched, gusts, noise, rounded};
use crate::{repo, shared_trees};
use anyhow::{Context, Result};
use foliar_plant::sample::Recipe;
use foliar_plant::{Branches, LEVELS, NO_BRANCH, OnBranch, Plant};
use foliar_schema::{Role, Strength};
use foliar_wind::noise::Field;
use foliar_wind::quality::{joints, percentile};
use foliar_wind::{Exit, Params, Player, Rule, amplitude, fast};
use glam::DVec3;
use rayon::prelude::*;
use std::fmt::Write;

const DOCUMENT: &str = "docs/tradeoff/wind.md";
const CHART: &str = "docs/tradeoff/wind.svg";
/// A shared tree of 12,000 leaves.
const SHARED: &str = "sapling_birch_12k";

/// One way to do with less.
struct Way {
    name: &'static str,
    rule: Rule,
    /// Steps of a weight; none for floats.
    steps: Option<f32>,
    /// Bytes of a vertex's weights.
    bytes: usize,
    nearest_vertex: bool,
}

fn ways() -> Vec<Way> {
    let rule = Rule::from(&Params::default());
    let way = |name, rule, bytes| Way { name, rule, steps: None, bytes, nearest_vertex: false };
    let fewer = |levels: usize| {
        let mut rule = rule;
        rule.levels = levels;
        rule
    };
    let mut from_root = rule;
    from_root.exit = Exit::Root;
    let mut ways = vec![
        way("full: 4 levels, float", rule, 16),
        way("3 levels", fewer(3), 12),
        way("2 levels", fewer(2), 8),
        way("1 level", fewer(1), 4),
        way("16 bits", rule, 8),
        way("8 bits", rule, 4),
        way("leaves on the nearest vertex", rule, 16),
        way("weights from the root (the paper)", from_root, 16),
    ];
    ways[4].steps = Some(65_535.0);
    ways[5].steps = Some(255.0);
    ways[6].nearest_vertex = true;
    ways
}

/// What a way costs and errs.
struct Score {
    name: &'static str,
    bytes: usize,
    seconds: f64,
    rms_mm: f64,
    most_mm: f64,
    slip: [f64; 2],
}

/// Measures every way on both trees.
pub fn run() -> Result<()> {
    let noise = noise()?.0;
    let tree = shared_trees::all()?.into_iter().find(|tree| tree.name.contains(SHARED)).context(SHARED)?;
    let trees = [("by rule, 40,000 leaves", Recipe::bench_40k().grow()), (SHARED, tree.read()?.plant)];
    let (mut text, mut charts) = (String::new(), Vec::new());
    for (name, plant) in trees {
        eprintln!("{name}");
        let plant = branched(plant)?;
        let scores = scores(&plant, &noise)?;
        let _ = writeln!(text, "### {name}\n\n{}\n{}", table(&scores), dropped(&plant)?);
        charts.push((name, scores));
    }
    println!("{text}");
    std::fs::write(repo::root().join(CHART), chart(&charts)).context(CHART)?;
    std::fs::write(repo::root().join(DOCUMENT), super::replaced(DOCUMENT, &repo::text(DOCUMENT)?, &text)?)
        .context(DOCUMENT)
}

fn scores(plant: &Plant, noise: &Field) -> Result<Vec<Score>> {
    let layer = bake(plant)?;
    let player = Player::new(plant, &layer).context("the layer is not the plant's")?;
    let (gusts, rest, joints) = (gusts(&player), player.rest(), joints(plant)?);
    let mut scores = Vec::new();
    for way in ways() {
        let plant = if way.nearest_vertex { nearest_vertices(plant)? } else { plant.clone() };
        let branches = plant.branches().context("no branches")?;
        let (values, seconds) = cpu_seconds(|| Ok(fast::values(&plant, branches, way.rule)))?;
        let mut other = Player::new(&plant, &layer).context("the layer is not the plant's")?;
        let step = |w: f32| way.steps.map_or(w, |steps| rounded(w, steps));
        other.weights = values.weights.iter().map(|list| list.iter().map(|w| w.map(step)).collect()).collect();
        let (mut square, mut all, mut slips) = (0.0, Vec::new(), vec![0.0f64; joints.len()]);
        for gust in &gusts {
            let (exact, moved) = (player.moved_from(&rest, gust, noise), other.moved_from(&rest, gust, noise));
            let pairs = exact.iter().flatten().zip(moved.iter().flatten());
            let errors: Vec<f64> = pairs.map(|(a, b)| a.position.distance(b.position)).collect();
            square += errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
            all.extend(errors.into_iter().step_by(7));
            slips.iter_mut().zip(&joints).for_each(|(slip, joint)| *slip = slip.max(joint.slip(&rest, &moved)));
        }
        scores.push(Score {
            name: way.name,
            bytes: way.bytes,
            seconds,
            rms_mm: 1e3 * (square / gusts.len() as f64).sqrt(),
            most_mm: 1e3 * percentile(all, 0.999),
            slip: [percentile(slips.clone(), 0.99), percentile(slips, 1.0)],
        });
    }
    Ok(scores)
}

/// The plant with each leaf on the branch of the vertex of wood nearest to its petiole (Kusternig07).
fn nearest_vertices(plant: &Plant) -> Result<Plant> {
    let branches = plant.branches().context("no branches")?;
    let mut wood: Vec<(DVec3, OnBranch)> = Vec::new();
    for (part, list) in branches.vertices.iter().enumerate().filter(|(part, _)| plant.role(*part) == Role::Wood) {
        let places = list.iter().enumerate().filter(|(_, place)| place.branch != NO_BRANCH);
        wood.extend(places.map(|(v, place)| (plant.parts()[part].rest_position(v), *place)));
    }
    let nearest = |leaf: &foliar_plant::Leaf| {
        let distance = |v: &&(DVec3, OnBranch)| v.0.distance_squared(leaf.petiole.as_dvec3());
        let best = wood.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        best.map_or(OnBranch::NONE, |best| best.1)
    };
    let leaves = plant.leaves().par_iter().map(nearest).collect();
    Ok(plant.clone().with_branches(Branches { leaves, ..branches.clone() })?)
}

fn table(scores: &[Score]) -> String {
    let mut text = String::from(
        "| way | bytes per vertex | processor s | error, rms mm | 99.9 % mm | slip at the bark: 99 % / most, radii |\n|---|---|---|---|---|---|\n",
    );
    for s in scores {
        let [p99, most] = s.slip;
        let _ = writeln!(
            text,
            "| {} | {} | {:.3} | {:.2} | {:.1} | {p99:.3} / {most:.3} |",
            s.name, s.bytes, s.seconds, s.rms_mm, s.most_mm
        );
    }
    text
}

/// What a scene drops: levels left over by distance and strength.
fn dropped(plant: &Plant) -> Result<String> {
    let facts = foliar_bake::Facts::of(plant);
    let longest = facts.branches.context("no branches")?.longest_m;
    let mut text = String::from(
        "Levels that a scene keeps (1080 lines, 60 degrees):\n\n| nearest, m | breeze | strong | storm |\n|---|---|---|---|\n",
    );
    for nearest in [1.0, 3.0, 10.0, 30.0, 100.0, 300.0] {
        let cell = |strength| {
            let camera = foliar_schema::Camera { nearest_m: nearest, ..Default::default() };
            let half = 0.5 * foliar_bake::pixel_m(&camera);
            (0..LEVELS).rfind(|l| amplitude(strength) * longest[*l] > half).map_or(0, |l| l + 1)
        };
        let [a, b, c] = [Strength::Breeze, Strength::Strong, Strength::Storm].map(cell);
        let _ = writeln!(text, "| {nearest} | {a} | {b} | {c} |");
    }
    Ok(text)
}

/// Bars of the error on a scale of powers of ten, from 0.001 mm.
fn chart(charts: &[(&str, Vec<Score>)]) -> String {
    const LEFT: f64 = 240.0;
    const DECADE: f64 = 70.0;
    const COLORS: [&str; 2] = ["#2f6d3a", "#4a7fb5"];
    let rows = charts[0].1.len();
    let (width, height) = (LEFT + 7.0 * DECADE + 60.0, 50.0 + 30.0 * rows as f64 + 40.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for (index, (name, scores)) in charts.iter().enumerate() {
        let (x, color) = (20.0 + 220.0 * index as f64, COLORS[index % 2]);
        let _ = writeln!(
            text,
            "<rect x=\"{x}\" y=\"12\" width=\"12\" height=\"12\" fill=\"{color}\"/><text x=\"{}\" y=\"22\">{name}</text>",
            x + 18.0
        );
        for (row, score) in scores.iter().enumerate() {
            let y = 50.0 + 30.0 * row as f64;
            if index == 0 {
                let _ = writeln!(
                    text,
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
                    LEFT - 10.0,
                    y + 14.0,
                    score.name
                );
            }
            let length = DECADE * (libm::log10(score.rms_mm.max(1e-3)) + 3.0);
            let y = y + 12.0 * index as f64;
            let _ = writeln!(
                text,
                "<rect x=\"{LEFT}\" y=\"{y}\" width=\"{length:.1}\" height=\"10\" fill=\"{color}\"/><text x=\"{:.1}\" y=\"{}\" font-size=\"9\">{:.3} mm</text>",
                LEFT + length + 4.0,
                y + 9.0,
                score.rms_mm
            );
        }
    }
    let _ = writeln!(
        text,
        "<text x=\"{LEFT}\" y=\"{}\">error of places against the full model, rms, powers of ten from 0.001 mm</text>\n</svg>",
        height - 12.0
    );
    text
}
