//! The implicit surface beside splashsurf, the nearest peer (fluid surfaces by SPH kernels: not the same function,
//! the same kind of mesh from the same points and cells), and the normals that are realigned by it.

use super::{Figure, allocations, least_seconds, missing};
use crate::repo;
use anyhow::{Context, Result};
use foliar_bake::{Inputs, Maps, Quiet, Request, run};
use foliar_density::surface::{Balls, Surface, SurfaceParams, extract_fast};
use foliar_density::{Density, Field, Foliage, Generator, NO_GROUP, Params, Query};
use foliar_plant::sample::Recipe;
use glam::Vec3;
use serde_json::json;
use std::process::Command;

/// Leaves, and the radius of influence, meters.
const SMALL: (u32, f64) = (40_000, 0.4);
const LARGE: (u32, f64) = (1_000_000, 0.137);
/// Density at the surface in units of the median density, the room's default.
const THRESHOLD: f64 = 0.1;
/// Runs of ours whose CPU time is divided by their number: the clock ticks a hundred times a second.
const RUNS: u32 = 5;

/// CPU time of ours over the peer's: 40,000 leaves, cells of a quarter of the radius.
pub fn small_coarse() -> Result<Figure> {
    time_ratio(SMALL, 4)
}

/// The same at an eighth of the radius.
pub fn small_fine() -> Result<Figure> {
    time_ratio(SMALL, 8)
}

/// A million leaves, at a quarter.
pub fn large_coarse() -> Result<Figure> {
    time_ratio(LARGE, 4)
}

/// The same at an eighth.
pub fn large_fine() -> Result<Figure> {
    time_ratio(LARGE, 8)
}

/// Peak memory of ours over the peer's, resident both: a million leaves, an eighth of the radius.
pub fn large_memory() -> Result<Figure> {
    let (leaves, radius) = LARGE;
    let generators = crown(leaves, radius);
    let (tau, mut made) = (threshold(&generators, radius), Ok(Surface::default()));
    forget_peak()?;
    let allocated = allocations::peak_bytes(|| made = mesh(&generators, radius, tau, 8));
    let mega = peak_megabytes()?;
    made?;
    let allocated = (size_of_val(generators.as_slice()) + allocated) as f64 / 1e6;
    let ours = format!("{mega:.0} MB resident here, {allocated:.0} MB of them allocated for leaves and mesh");
    let Some(peer) = peer(&generators, radius, 8)? else {
        return Ok(Figure::absent(format!("{}; {ours}", missing("splashsurf"))));
    };
    Ok(Figure::new(mega / peer.megabytes, format!("splashsurf: {:.0} MB resident; {ours}", peer.megabytes)))
}

/// Seconds of a bake of nothing but normals of the surface, at an eighth of the radius, 40,000 leaves.
pub fn normals() -> Result<Figure> {
    let plant = Recipe::bench_40k().grow();
    let vertices: usize = plant.parts().iter().map(|part| part.positions.len()).sum();
    let given = json!({"normals": "surface", "channels": "normals", "radius_m": 0.4, "surface_cell_m": 0.05});
    let request = Request { given: given.as_object().cloned().unwrap_or_default(), ..Request::default() };
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let before = cpu_seconds()?;
    let seconds = least_seconds(RUNS as usize, || Ok(run(&Density, &inputs, &request, &Quiet).map(drop)?))?;
    let cpu = (cpu_seconds()? - before) / f64::from(RUNS);
    Ok(Figure::new(seconds, format!("none; {vertices} vertices, {cpu:.3} s of CPU")))
}

/// The balls of the benchmark tree, 8 m wide, with so many leaves.
fn crown(leaves: u32, radius: f64) -> Vec<Generator> {
    let plant = Recipe { leaves, ..Recipe::bench_40k() }.grow();
    Foliage::new(&plant, &[], &Params { radius_m: Some(radius), ..Params::default() }).generators
}

/// Density at the surface, from a sixteenth of the leaves.
fn threshold(generators: &[Generator], radius: f64) -> f64 {
    let own: Vec<Query> =
        generators.iter().step_by(16).map(|g| Query { position: g.position, skip: NO_GROUP }).collect();
    let mut densities = Field::new(generators, radius).densities(&own);
    densities.sort_unstable_by(f32::total_cmp);
    THRESHOLD * f64::from(densities[densities.len() / 2])
}

fn mesh(generators: &[Generator], radius: f64, threshold: f64, cells: u32) -> Result<Surface> {
    let balls = Balls { generators, radius_m: radius, threshold };
    let params = SurfaceParams { cell_m: Some(radius / f64::from(cells)), ..SurfaceParams::default() };
    Ok(extract_fast(&balls, &params)?)
}

fn time_ratio((leaves, radius): (u32, f64), cells: u32) -> Result<Figure> {
    let generators = crown(leaves, radius);
    let (peer, tau) = (peer(&generators, radius, cells)?, threshold(&generators, radius));
    let before = cpu_seconds()?;
    let mut surface = Surface::default();
    for _ in 0..RUNS {
        surface = mesh(&generators, radius, tau, cells)?;
    }
    let own = (cpu_seconds()? - before) / f64::from(RUNS);
    let ours = format!("{own:.3} s of CPU here, {} vertices", surface.positions.len());
    let Some(peer) = peer else { return Ok(Figure::absent(format!("{}; {ours}", missing("splashsurf")))) };
    Ok(Figure::new(
        own / peer.seconds,
        format!("splashsurf: {:.2} s of CPU, its reading and writing counted; {ours}", peer.seconds),
    ))
}

/// CPU time of all threads of this process, seconds, in ticks of a hundredth.
pub(super) fn cpu_seconds() -> Result<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").context("/proc/self/stat: CPU times need Linux")?;
    // The name in brackets may hold anything; after it, fields 12 and 13 are user and system time.
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |field: usize| fields.get(field).and_then(|text| text.parse::<f64>().ok());
    let ticks = ticks(11).zip(ticks(12)).context("/proc/self/stat: no CPU times in it")?;
    Ok((ticks.0 + ticks.1) / 100.0)
}

/// Has the system forget the most that was resident so far.
fn forget_peak() -> Result<()> {
    std::fs::write("/proc/self/clear_refs", "5").context("/proc/self/clear_refs: resident peaks need Linux")
}

/// Most memory that was resident since.
fn peak_megabytes() -> Result<f64> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    Ok(kilobytes.context("/proc/self/status: no VmHWM in it")? * 1024.0 / 1e6)
}

/// What the peer took.
struct Peer {
    seconds: f64,
    megabytes: f64,
}

/// Runs splashsurf on the same points and cells; `None` where it is not installed.
fn peer(generators: &[Generator], radius: f64, cells: u32) -> Result<Option<Peer>> {
    let folder = repo::root().join("target/bench");
    std::fs::create_dir_all(&folder)?;
    let (points, output) = (folder.join("leaves.xyz"), folder.join("splashsurf.ply"));
    let places: Vec<Vec3> = generators.iter().map(|g| g.position.as_vec3()).collect();
    let bytes: Vec<u8> = places.iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect();
    std::fs::write(&points, bytes)?;
    let program = std::env::var("SPLASHSURF").unwrap_or_else(|_| "splashsurf".into());
    // Its particles are a quarter of the radius, its kernel reaches four of them: the same influence.
    let particle = (radius / 4.0).to_string();
    let cell = (4.0 / f64::from(cells)).to_string();
    let mut timed = Command::new("/usr/bin/time");
    timed.args(["-f", "%U %S %M", &program, "reconstruct"]).arg(&points);
    timed.args(["-q", "-r", &particle, "-l", "2.0", "-c", &cell, "-t", "0.6", "-n", "2"]);
    timed.args(["--normals=on", "--sph-normals=on", "-o"]).arg(&output);
    let Ok(run) = timed.output() else { return Ok(None) };
    if !run.status.success() {
        return Ok(None);
    }
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    let numbers: Vec<f64> = said.lines().last().unwrap_or_default().split(' ').filter_map(|n| n.parse().ok()).collect();
    let [user, system, kilobytes] = numbers[..] else { return Ok(None) };
    Ok(Some(Peer { seconds: user + system, megabytes: kilobytes * 1024.0 / 1e6 }))
}
