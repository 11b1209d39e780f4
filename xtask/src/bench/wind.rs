//! Wind: time and memory of branch step and room together, how well moving trees hold together, the noise.

use super::{Figure, allocations, least_seconds};
use crate::shared_trees;
use anyhow::{Context, Result, anyhow};
use foliar_bake::{Inputs, Layer, Maps, Quiet, Request, run};
use foliar_plant::sample::{Recipe, hard_tree, wood_for_speed};
use foliar_plant::{LEVELS, Plant};
use foliar_structure::branches::{BranchParams, find};
use foliar_wind::noise::{Field, NoiseParams, measure as measure_noise};
use foliar_wind::quality::{self, Quality};
use foliar_wind::{Gust, Noise, Player, Wind};
use glam::{DQuat, DVec2, DVec3};
use std::sync::OnceLock;

/// Tip of the longest branch of each level, as a share of its length: a storm.
const SHARE: f64 = 0.15;
/// Times at which a tree is measured, and seconds between them: no whole part of any level's period.
const TIMES: u32 = 24;
const BETWEEN_S: f64 = 1.7;
/// Trees made by rule: their branches are found, not told. Those whose tubes touch, cross or stand apart by less than
/// their radius; what else is hard to take apart is in the room's own tests.
const MADE: [&str; 9] =
    ["clean", "seam-doubled", "soup", "caps-and-cones", "touching", "very-dense", "palm", "shrub-7-stems", "whorls"];

/// The plant with its branches found.
pub fn branched(plant: Plant) -> Result<Plant> {
    let branches = find(plant.base(), plant.structure(), &BranchParams::default())?.branches;
    Ok(plant.with_branches(branches)?)
}

/// Bakes the room by default parameters.
pub fn bake(plant: &Plant) -> Result<Layer> {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    Ok(run(&Wind, &inputs, &Request::default(), &Quiet)?.0)
}

/// The default texture and what was measured on it.
pub fn noise() -> Result<(Field, foliar_wind::noise::Measured)> {
    let maps = Maps::new();
    let inputs = Inputs { plant: None, maps: &maps, neighbors: &[] };
    let layer = run(&Noise, &inputs, &Request::default(), &Quiet)?.0;
    let raster = layer.rasters.values().next().context("no noise")?;
    Ok((Field::new(raster).context("no field")?, measure_noise(raster, &NoiseParams::default())))
}

/// Wind at the times that are measured.
pub fn gusts(player: &Player) -> Vec<Gust> {
    (0..TIMES).map(|time| player.gust(SHARE, f64::from(time) * BETWEEN_S, DVec2::X, 0.0)).collect()
}

/// What was measured of one tree.
struct Row {
    name: String,
    quality: Quality,
    /// Greatest slip that rounding weights to 16 bits adds.
    rounding: f64,
    /// How far frames are from orthonormal.
    frames: f64,
}

/// Trees that are measured: made by rule, and every shared tree whose wood has branches on branches.
pub fn trees() -> Result<Vec<(String, Plant)>> {
    let mut trees = Vec::new();
    for name in MADE {
        let plant = hard_tree(name, 1).context("no such tree")?.plant;
        trees.push((name.to_string(), branched(plant)?));
    }
    trees.push(("bench-40k".into(), branched(Recipe::bench_40k().grow())?));
    for tree in shared_trees::all()? {
        let plant = branched(tree.read()?.plant)?;
        if plant.branches().is_some_and(|branches| branches.roots().count() < branches.count()) {
            trees.push((tree.name, plant));
        }
    }
    Ok(trees)
}

fn rows() -> Result<&'static [Row]> {
    static ROWS: OnceLock<Result<Vec<Row>, String>> = OnceLock::new();
    let all = || -> Result<Vec<Row>> {
        let noise = noise()?.0;
        trees()?.iter().map(|(name, plant)| row(name, plant, &noise)).collect()
    };
    let rows = ROWS.get_or_init(|| all().map_err(|error| format!("{error:#}")));
    rows.as_deref().map_err(|error| anyhow!("{error}"))
}

fn row(name: &str, plant: &Plant, noise: &Field) -> Result<Row> {
    let layer = bake(plant)?;
    let mut player = Player::new(plant, &layer).context("the layer is not the plant's")?;
    let gusts = gusts(&player);
    let quality = quality::measure(plant, &player, &gusts, noise)?;
    let frames = player.branches().iter().map(|branch| off_orthonormal(branch.frame)).fold(0.0, f64::max);
    let weights = player.weights.clone();
    player.weights =
        weights.iter().map(|list| list.iter().map(|w| w.map(|w| rounded(w, 65_535.0))).collect()).collect();
    let rounding = added_slip(plant, &player, &weights, &gusts, noise)?;
    Ok(Row { name: name.into(), quality, rounding, frames })
}

/// A weight as an unsigned integer of so many steps gives it back.
pub fn rounded(weight: f32, steps: f32) -> f32 {
    (weight * steps).round_ties_even() / steps
}

/// Greatest way between a joint's slip by these weights and by others, in radii.
pub fn added_slip(
    plant: &Plant,
    player: &Player,
    exact: &[Vec<[f32; LEVELS]>],
    gusts: &[Gust],
    noise: &Field,
) -> Result<f64> {
    let joints = quality::joints(plant)?;
    let mut other = player.clone();
    other.weights = exact.to_vec();
    let rest = player.rest();
    let mut worst = 0.0f64;
    for gust in gusts {
        let (a, b) = (player.moved_from(&rest, gust, noise), other.moved_from(&rest, gust, noise));
        let added = joints.iter().map(|joint| joint.slip(&rest, &a) - joint.slip(&rest, &b));
        worst = worst.max(added.fold(0.0, f64::max));
    }
    Ok(worst)
}

fn off_orthonormal(frame: DQuat) -> f64 {
    let [right, up, along] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| frame * axis);
    let off = [right.dot(up), up.dot(along), right.length() - 1.0, up.length() - 1.0, right.cross(up).dot(along) - 1.0];
    off.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// The worst of a figure over all trees, and each tree's.
fn worst(figure: fn(&Row) -> f64) -> Result<Figure> {
    let rows = rows()?;
    let each: Vec<String> = rows.iter().map(|row| format!("{} {:.3}", row.name, figure(row))).collect();
    Ok(Figure::new(rows.iter().map(figure).fold(f64::NAN, f64::max), format!("none; {}", each.join(", "))))
}

/// 99th percentile of the slip at the bark.
pub fn slip() -> Result<Figure> {
    worst(|row| row.quality.slip_p99)
}

/// Greatest slip at the bark.
pub fn slip_most() -> Result<Figure> {
    worst(|row| row.quality.slip_max)
}

/// Slip that 16 bits add.
pub fn slip_of_rounding() -> Result<Figure> {
    worst(|row| row.rounding)
}

/// Difference of weights where bark meets bark.
pub fn steps() -> Result<Figure> {
    worst(|row| row.quality.step_max)
}

/// Slip of petioles.
pub fn leaf_slip() -> Result<Figure> {
    worst(|row| row.quality.leaf_p99)
}

/// Normals in closed form.
pub fn normals() -> Result<Figure> {
    worst(|row| row.quality.normals_p99_deg)
}

/// Frames.
pub fn frames() -> Result<Figure> {
    let rows = rows()?;
    Ok(Figure::new(rows.iter().map(|row| row.frames).fold(f64::NAN, f64::max), "none"))
}

fn seconds_of(plant: &Plant) -> Result<Figure> {
    let mut parts = [f64::INFINITY; 2];
    let seconds = least_seconds(3, || {
        let start = std::time::Instant::now();
        let with = branched(plant.clone())?;
        let found = start.elapsed().as_secs_f64();
        bake(&with)?;
        parts = [parts[0].min(found), parts[1].min(start.elapsed().as_secs_f64() - found)];
        Ok(())
    })?;
    Ok(Figure::new(seconds, format!("none; branches {:.3} s, room {:.3} s", parts[0], parts[1])))
}

/// Branch step and room on a tree of the paper's size.
pub fn seconds() -> Result<Figure> {
    seconds_of(&wood_for_speed(1500, 5, 5))
}

/// The same on a tree of two million triangles.
pub fn large_seconds() -> Result<Figure> {
    seconds_of(&wood_for_speed(20_000, 8, 6))
}

/// Peak of the room's allocations over the bytes of all vertices: position, normal, texture coordinates.
pub fn memory() -> Result<Figure> {
    const BYTES_PER_VERTEX: usize = 32;
    let plant = branched(wood_for_speed(20_000, 8, 6))?;
    let vertices: usize = plant.parts().iter().map(|p| p.positions.len()).sum();
    let mut result = Ok(());
    let peak = allocations::peak_bytes(|| result = bake(&plant).map(drop));
    result?;
    let data = vertices * BYTES_PER_VERTEX;
    let megabytes = format!("none; {:.1} MB for {:.1} MB of vertices", peak as f64 / 1e6, data as f64 / 1e6);
    Ok(Figure::new(peak as f64 / data as f64, megabytes))
}

/// How far the texture's slope is from what was asked for.
pub fn noise_slope() -> Result<Figure> {
    let (beta, slope) = (NoiseParams::default().beta, noise()?.1.slope.context("the band is too narrow")?);
    Ok(Figure::new((slope - beta).abs(), format!("none; slope {slope:.3} of beta {beta}")))
}

/// How far the step across the tile's edge is from those inside.
pub fn noise_seam() -> Result<Figure> {
    Ok(Figure::new((noise()?.1.seam_ratio - 1.0).abs(), "none"))
}

/// Correlation of the channels.
pub fn noise_correlation() -> Result<Figure> {
    Ok(Figure::new(noise()?.1.correlation.abs(), "none"))
}

/// Mean of the channels.
pub fn noise_mean() -> Result<Figure> {
    Ok(Figure::new(noise()?.1.mean.abs(), "none"))
}
