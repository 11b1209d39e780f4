//! The light room's engines and parameters: time, error against the exact sum and against rays without end, and what
//! fewer bits would cost. Writes the tables and the chart of docs/tradeoff/light.md.

use super::room::cpu_seconds;
use crate::{repo, shared_trees};
use anyhow::{Context, Result};
use foliar_light::crown::{Crown, EXACT, order_of};
use foliar_light::leaves::{Foliage, Query};
use foliar_light::profile::Profile;
use foliar_light::rays_at;
use foliar_light::reference::transmittance;
use foliar_numerics::Isa;
use foliar_plant::{Plant, sample::Recipe};
use std::fmt::Write;

const DOCUMENT: &str = "docs/tradeoff/light.md";
const CHART: &str = "docs/tradeoff/light.svg";
/// Leaves that are judged, and rays per octant that stand for truth there.
const JUDGED: usize = 512;
const TRUTH: u32 = 1024;
/// Visible step of a transmittance.
const STEP: f64 = 1.0 / 255.0;

type Depths = Vec<[f32; 8]>;

/// How depths are found.
#[derive(Clone, Copy)]
enum Way {
    Sum(Profile, f64),
    Rays(u32),
}

impl Way {
    fn all() -> Vec<Way> {
        let openings = [EXACT, 0.17, 0.24, 0.33, 0.45, 0.6, 0.8];
        let sums = openings.map(|opening| Way::Sum(Profile::Cap, opening));
        let paper = [EXACT, 0.6].map(|opening| Way::Sum(Profile::Paper, opening));
        sums.into_iter().chain(paper).chain([4, 16, 64].map(Way::Rays)).collect()
    }

    fn name(self) -> String {
        let profile = |p: Profile| if p == Profile::Paper { ", profile paper" } else { "" };
        match self {
            Way::Sum(p, opening) if opening > EXACT => format!("tree, opening {opening}{}", profile(p)),
            Way::Sum(p, _) => format!("exact{}", profile(p)),
            Way::Rays(rays) => format!("rays, {rays} per octant"),
        }
    }
}

struct Score {
    way: Way,
    seconds: f64,
    /// Transmittance against the exact sum of the default profile, rms in visible steps; none for another model.
    exact_steps: Option<f64>,
    /// Depth against the same, over its sum.
    exact_share: Option<f64>,
    /// Transmittance against the truth: bias and mean absolute error.
    bias: f64,
    error: f64,
}

/// A plant judged.
struct Judged {
    name: &'static str,
    leaves: usize,
    scores: Vec<Score>,
    bits: Vec<(&'static str, usize, f64, f64)>,
}

/// Measures, and writes the document.
pub fn run() -> Result<()> {
    let mut judged = Vec::new();
    for (name, plant) in plants()? {
        eprintln!("{name}");
        let one = judge(name, &plant)?;
        println!("{}", table(&one));
        judged.push(one);
    }
    std::fs::write(repo::root().join(CHART), chart(&judged)).context(CHART)?;
    let mut text: String =
        judged.iter().map(|one| format!("### {}, {} leaves\n\n{}\n", one.name, one.leaves, table(one))).collect();
    let _ = write!(text, "### Bits of a depth, {}\n\n{}", judged[1].name, bits_table(&judged[1]));
    println!("{}", bits_table(&judged[1]));
    std::fs::write(repo::root().join(DOCUMENT), super::replaced(DOCUMENT, &repo::text(DOCUMENT)?, &text)?)
        .context(DOCUMENT)
}

fn plants() -> Result<Vec<(&'static str, Plant)>> {
    let shared = |name: &str| {
        let file = format!("{name}/tree.obj");
        let tree = shared_trees::all()?.into_iter().find(|tree| tree.name == file);
        Ok::<_, anyhow::Error>(tree.with_context(|| format!("expected.json does not list {file}"))?.read()?.plant)
    };
    Ok(vec![
        ("young linden", Recipe::linden().grow()),
        ("crown by rule (bench_40k)", Recipe::bench_40k().grow()),
        ("ez_ash_large_12k", shared("ez_ash_large_12k")?),
        ("sapling_birch_12k", shared("sapling_birch_12k")?),
    ])
}

fn judge(name: &'static str, plant: &Plant) -> Result<Judged> {
    let foliage = Foliage::new(plant);
    let queries = foliage.queries();
    let order = order_of(&queries);
    let at: Vec<usize> = (0..JUDGED).map(|i| order[i * order.len() / JUDGED] as usize).collect();
    let truth = rays_at(plant, &at, TRUTH)?;
    let some: Vec<Query> = at.iter().map(|at| queries[*at]).collect();
    let exact = Crown::new(&foliage.sources, Profile::Cap).depths(&some, EXACT, Isa::best());
    let all: Vec<usize> = (0..queries.len()).collect();
    let mut scores = Vec::new();
    for way in Way::all() {
        let (depths, seconds) = cpu_seconds(|| match way {
            Way::Sum(profile, opening) => {
                Ok(Crown::new(&foliage.sources, profile).depths(&queries, opening, Isa::best()))
            }
            Way::Rays(rays) => Ok(rays_at(plant, &all, rays)?),
        })?;
        let seen: Depths = at.iter().map(|at| depths[*at]).collect();
        let same_model = matches!(way, Way::Sum(Profile::Cap, _)).then_some(());
        let errors = differences(&seen, &truth);
        scores.push(Score {
            way,
            seconds,
            exact_steps: same_model.map(|()| rms(&differences(&seen, &exact)) / STEP),
            exact_share: same_model.map(|()| share(&seen, &exact)),
            bias: errors.iter().sum::<f64>() / errors.len() as f64,
            error: errors.iter().map(|e| e.abs()).sum::<f64>() / errors.len() as f64,
        });
    }
    Ok(Judged { name, leaves: queries.len(), scores, bits: bits(&exact) })
}

/// Differences of transmittances.
fn differences(a: &[[f32; 8]], b: &[[f32; 8]]) -> Vec<f64> {
    let seen = |depth: &f32| transmittance(f64::from(*depth));
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| seen(a) - seen(b)).collect()
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

fn share(a: &[[f32; 8]], b: &[[f32; 8]]) -> f64 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    let (off, all) = pairs.fold((0.0, 0.0), |(off, all), (a, b)| (off + f64::from((a - b).abs()), all + f64::from(*b)));
    if all > 0.0 { off / all } else { 0.0 }
}

/// Ways to store a depth: name, bytes of eight, rms and worst error of the transmittance in visible steps.
fn bits(exact: &[[f32; 8]]) -> Vec<(&'static str, usize, f64, f64)> {
    const MOST: f32 = 16.0;
    let stored =
        |store: &dyn Fn(f32) -> f32| exact.iter().map(|row| row.map(|d| store(d.min(MOST)))).collect::<Depths>();
    let steps = |v: f32, full: f32, count: f32| (v / full * count).round() / count * full;
    let seen = |d: f32| transmittance(f64::from(d)) as f32;
    let back = |t: f32| if t > 0.0 { -libm::logf(t) } else { MOST };
    let ways: [(&'static str, usize, Depths); 5] = [
        ("float (what is written)", 32, stored(&|d| d)),
        ("depth, 16 bits", 16, stored(&|d| steps(d, MOST, 65_535.0))),
        ("transmittance, 16 bits", 16, stored(&|d| back(steps(seen(d), 1.0, 65_535.0)))),
        ("depth, 8 bits", 8, stored(&|d| steps(d, MOST, 255.0))),
        ("transmittance, 8 bits", 8, stored(&|d| back(steps(seen(d), 1.0, 255.0)))),
    ];
    let score = |(name, bytes, depths): (&'static str, usize, Depths)| {
        let errors = differences(&depths, exact);
        (name, bytes, rms(&errors) / STEP, errors.iter().fold(0.0f64, |worst, e| worst.max(e.abs())) / STEP)
    };
    ways.into_iter().map(score).collect()
}

fn table(judged: &Judged) -> String {
    let mut text = String::from(
        "| engine | processor s | transmittance against exact, rms in steps of 1/255 | depth against exact, % | transmittance against rays: bias / mean error |\n\
         |---|---|---|---|---|\n",
    );
    for score in &judged.scores {
        let number = |v: Option<f64>, factor: f64| v.map_or("-".into(), |v| format!("{:.3}", v * factor));
        let _ = writeln!(
            text,
            "| {} | {:.3} | {} | {} | {:+.3} / {:.3} |",
            score.way.name(),
            score.seconds,
            number(score.exact_steps, 1.0),
            number(score.exact_share, 100.0),
            score.bias,
            score.error
        );
    }
    text
}

fn bits_table(judged: &Judged) -> String {
    let mut text = String::from(
        "| stored as | bytes of a leaf | rms, steps of 1/255 of transmittance | worst |\n|---|---|---|---|\n",
    );
    for (name, bytes, rms, worst) in &judged.bits {
        let _ = writeln!(text, "| {name} | {bytes} | {rms:.3} | {worst:.3} |");
    }
    text
}

/// Mean error against the truth over processor seconds of the first crown, both logarithmic.
fn chart(judged: &[Judged]) -> String {
    const COLORS: [&str; 4] = ["#2f6d3a", "#7fae5a", "#a8682c", "#4a7fb5"];
    let (width, height, left, top) = (820.0, 460.0, 70.0, 60.0);
    // Decades of seconds and of error that the chart spans.
    let (seconds, errors) = ([-4.0, 2.0], [-2.0, -0.5]);
    let x =
        |s: f64| left + (width - left - 150.0) * (libm::log10(s.max(1e-4)) - seconds[0]) / (seconds[1] - seconds[0]);
    let y = |e: f64| {
        height - 50.0 - (height - 50.0 - top) * (libm::log10(e.max(1e-2)) - errors[0]) / (errors[1] - errors[0])
    };
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for decade in -4..=2 {
        let (at, bottom) = (x(libm::exp10(f64::from(decade))), height - 34.0);
        let _ = writeln!(text, "<text x=\"{at:.0}\" y=\"{bottom}\" text-anchor=\"middle\">1e{decade} s</text>");
    }
    for error in [0.01, 0.03, 0.1, 0.3] {
        let _ =
            writeln!(text, "<text x=\"{}\" y=\"{:.0}\" text-anchor=\"end\">{error}</text>", left - 8.0, y(error) + 4.0);
    }
    for (index, one) in judged.iter().enumerate() {
        let (at, color) = (20.0 + 190.0 * index as f64, COLORS[index % COLORS.len()]);
        let _ = writeln!(
            text,
            "<rect x=\"{at}\" y=\"12\" width=\"12\" height=\"12\" fill=\"{color}\"/><text x=\"{}\" y=\"22\">{}</text>",
            at + 18.0,
            one.name
        );
        for score in &one.scores {
            let (at, up) = (x(score.seconds), y(score.error));
            let _ = writeln!(
                text,
                "<circle cx=\"{at:.1}\" cy=\"{up:.1}\" r=\"4\" fill=\"{color}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"8\">{}</text>",
                at + 6.0,
                up + 3.0,
                score.way.name()
            );
        }
    }
    let _ = writeln!(
        text,
        "<text x=\"{left}\" y=\"{}\">mean error of the transmittance of an octant against rays, over seconds of the processor</text>\n</svg>",
        height - 10.0
    );
    text
}
