//! The density beside what a numpy user has today: leaves on the nearest cells of a grid, convolution by FFT, linear
//! lookup. Same leaves and vertices, same error, same run.

use super::{Figure, density, least_seconds, missing};
use crate::repo;
use anyhow::{Context, Result, bail};
use foliar_density::{Coarse, Field, Foliage, GeneratorKind, Params, Query};
use foliar_numerics::ErrorStats;
use foliar_plant::sample::Recipe;
use glam::Vec3;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// Points per radius that are tried, coarsest first.
const POINTS: [f64; 7] = [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
const RUNS: usize = 5;

/// Our time over the peer's, 40,000 leaves, its grid of a quarter of the radius.
pub fn small_coarse() -> Result<Figure> {
    ratio(&Recipe::bench_40k(), 4)
}

/// The same at an eighth.
pub fn small_fine() -> Result<Figure> {
    ratio(&Recipe::bench_40k(), 8)
}

/// A million leaves, a quarter.
pub fn large_coarse() -> Result<Figure> {
    ratio(&Recipe::bench_1m(), 4)
}

/// The same at an eighth.
pub fn large_fine() -> Result<Figure> {
    ratio(&Recipe::bench_1m(), 8)
}

/// The coarsest lattice of ours that errs no more than the peer, timed: making it and reading it at every vertex.
fn ratio(recipe: &Recipe, cells: u32) -> Result<Figure> {
    let plant = recipe.grow();
    // The peer knows no weights.
    let params = Params { generators: GeneratorKind::LeafCount, ..Params::default() };
    let foliage = Foliage::new(&plant, &[], &params);
    let queries = density::queries(&plant);
    let exact = Field::new(foliage.own(), foliage.radius).densities(&queries);
    let Some(peer) = peer(&foliage, &queries, &exact, cells)? else {
        return Ok(Figure::absent(missing("numpy and scipy")));
    };
    let most = queries.len().max(1 << 20);
    let run = |points: f64| Coarse::new(foliage.own(), foliage.radius, points, most).densities(&queries);
    let mut tried = POINTS.iter().map(|&points| (points, relative(&run(points), &exact)));
    let found = tried.find(|(_, error)| *error <= peer.error);
    let Some((points, error)) = found else { bail!("no lattice errs as little as {:.2} %", 100.0 * peer.error) };
    let seconds = least_seconds(RUNS, || {
        std::hint::black_box(run(points));
        Ok(())
    })?;
    let ours = format!("{seconds:.3} s and {:.2} % of the density rms here, {points} points per radius", 100.0 * error);
    let theirs = format!("numpy FFT at radius/{cells}: {:.3} s and {:.2} %", peer.seconds, 100.0 * peer.error);
    Ok(Figure::new(seconds / peer.seconds, format!("{theirs}; {ours}")))
}

/// Error as the peer counts it: relative to the density, rms over the vertices where it is above a fifth of its median.
pub(super) fn relative(fast: &[f32], exact: &[f32]) -> f64 {
    let mut sorted = exact.to_vec();
    sorted.sort_unstable_by(f32::total_cmp);
    let least = 0.2 * sorted[sorted.len() / 2];
    let pairs = fast.iter().zip(exact).filter(|(_, exact)| **exact > least);
    ErrorStats::of(pairs.map(|(fast, exact)| f64::from(*fast) / f64::from(*exact) - 1.0)).rms
}

/// What the peer took, and its error.
struct Peer {
    seconds: f64,
    error: f64,
}

/// Runs the peer; `None` where Python, numpy or scipy is missing.
fn peer(foliage: &Foliage, queries: &[Query], exact: &[f32], cells: u32) -> Result<Option<Peer>> {
    let folder = repo::root().join("target/bench");
    std::fs::create_dir_all(&folder)?;
    let [leaves, vertices, densities] = ["leaves.f32", "vertices.f32", "densities.f32"].map(|name| folder.join(name));
    write(&leaves, foliage.own().iter().flat_map(|ball| ball.position.as_vec3().to_array()))?;
    write(&vertices, queries.iter().flat_map(|query| Vec3::to_array(&query.position.as_vec3())))?;
    write(&densities, exact.iter().copied())?;
    let mut python = Command::new("python3");
    python.arg(repo::shared().join("peers/density_fft.py")).args([leaves, vertices]);
    python.args([foliage.radius.to_string(), cells.to_string()]).arg(densities);
    let Ok(printed) = repo::output(&mut python) else { return Ok(None) };
    let report: Value = serde_json::from_str(&printed).context("density_fft.py printed no JSON")?;
    let number = |name: &str| report[name].as_f64().with_context(|| format!("density_fft.py printed no {name}"));
    Ok(Some(Peer { seconds: number("seconds")?, error: number("relative_rms")? }))
}

fn write(path: &Path, numbers: impl Iterator<Item = f32>) -> Result<()> {
    Ok(std::fs::write(path, numbers.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())?)
}
