//! Run-time models of light against paths of light traced through six crowns: the paper's, ours, and what lies between.
//! Writes the table of docs/tradeoff/light-model.md and the picture of docs/light.md.

use crate::{repo, shared_trees};
use anyhow::{Context, Result};
use foliar_bake::{Baker, Inputs, Maps, Quiet, Request, run as bake};
use foliar_light::crown::{Crown, EXACT};
use foliar_light::leaves::Foliage;
use foliar_light::model::{self, Leaf, Light, Optics, Sides, Sky, Slant, Sun, Tree};
use foliar_light::profile::Profile;
use foliar_light::reference;
use foliar_light::truth::{Met, Scene, Stream, Surroundings, World};
use foliar_numerics::Isa;
use foliar_plant::Plant;
use foliar_plant::sample::{Quad, crowns, quads};
use foliar_schema::names;
use foliar_space::Beam;
use foliar_view::{Scale, ViewParams, light_sheet, png_bytes};
use glam::DVec3;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fmt::Write;

const DOCUMENT: &str = "docs/tradeoff/light-model.md";
const PICTURE: &str = "docs/pictures/linden_light.png";
/// Paths per side of a leaf.
const PATHS: u64 = 512;
/// Leaves of a mean.
const NEAREST: usize = 24;
/// Pixels along an edge of the picture whose error is taken.
const PIXELS: usize = 160;
/// Radiance of ground and sky; the sun brings twice the sky's light, both straight.
const SKY: [f64; 2] = [0.2, 1.0];
const SUN_TO_SKY: f64 = 2.0;
const TOWARD: DVec3 = DVec3::new(0.5, 0.7, 0.5);
const SEED: u64 = 1;

/// Names of the pipelines, in the order of [`Measured::models`].
pub const PIPELINES: [&str; 6] = [
    "Boulanger08 as it stands (leaf density of the hull)",
    "the same, leaf density 2 tau / area",
    "the same, transmittance interpolated for the sun",
    "default: eight depths",
    "default model, depths by rays",
    "default model, depths and nine numbers by rays",
];
/// Places in [`PIPELINES`].
pub const PAPER: usize = 0;
/// The default.
pub const DEFAULT: usize = 3;
/// With nine numbers for the sun.
pub const HARMONICS: usize = 5;

/// What a pipeline errs on a crown, shares of the mean radiance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Mean of the absolute error over sides of leaves.
    pub leaf: f64,
    /// The same of means over the nearest leaves.
    pub low: f64,
    /// The same over pixels of a picture from the side.
    pub picture: f64,
    /// Error of the mean.
    pub bias: f64,
}

/// Every pipeline on one crown.
pub struct Scored {
    name: String,
    errors: [Errors; 6],
}

/// Measures and writes the document.
pub fn run() -> Result<()> {
    let scored = measure()?;
    let text = table(&scored);
    println!("{text}");
    std::fs::write(repo::root().join(DOCUMENT), super::replaced(DOCUMENT, &repo::text(DOCUMENT)?, &text)?)
        .context(DOCUMENT)?;
    draw()
}

/// The linden by the model, by paths, and what differs, for two suns.
fn draw() -> Result<()> {
    let tree = shared_trees::linden().read()?;
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(&tree.plant), maps: &maps, neighbors: &[] };
    let (layer, _) = bake(&foliar_light::Light, &inputs, &Request::default(), &Quiet)?;
    let params = ViewParams { width_px: 360, height_px: 360, samples: 8, scale: Scale::None, ..ViewParams::default() };
    let sheet = light_sheet(&tree.plant, &[&tree.layer, &layer], &[], "linden, default bake", &params)?;
    std::fs::write(repo::root().join(PICTURE), png_bytes(&sheet)?).context(PICTURE)
}

/// Two crowns of the oracle and four made by rule.
pub fn measure() -> Result<Vec<Scored>> {
    let mut all = given()?;
    all.extend(crowns().into_iter().map(|crown| (crown.name.to_owned(), crown.plant)));
    all.into_iter()
        .map(|(name, plant)| {
            eprintln!("{name}");
            Ok(Scored { errors: score(&plant).with_context(|| name.clone())?, name })
        })
        .collect()
}

/// Mean over crowns of what a pipeline errs; of the bias its size.
pub fn mean(scored: &[Scored], pipeline: usize) -> Errors {
    let over =
        |of: &dyn Fn(&Errors) -> f64| scored.iter().map(|s| of(&s.errors[pipeline])).sum::<f64>() / scored.len() as f64;
    Errors {
        leaf: over(&|e| e.leaf),
        low: over(&|e| e.low),
        picture: over(&|e| e.picture),
        bias: over(&|e| e.bias.abs()),
    }
}

/// The crowns of the oracle's Monte Carlo values.
fn given() -> Result<Vec<(String, Plant)>> {
    let path = repo::shared().join("oracles/light.json");
    let text = std::fs::read_to_string(&path).with_context(|| format!("{}: no shared data", path.display()))?;
    let oracle: Value = serde_json::from_str(&text)?;
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let leaf = |record: &Value| {
        let v = |first: usize| DVec3::from_array([0, 1, 2].map(|k| number(&record[first + k])));
        Quad { center: v(0), across: v(3), along: v(6) }
    };
    let scene = |scene: &Value| {
        let leaves: Vec<Quad> = scene["leaves"].as_array().into_iter().flatten().map(leaf).collect();
        (scene["name"].as_str().unwrap_or("given").replace("public_", "").replace('_', "-"), quads(&leaves))
    };
    Ok(oracle["monte_carlo"].as_array().context("no scenes")?.iter().map(scene).collect())
}

fn optics() -> Result<Optics> {
    Ok(Optics::new(Sides { front: 0.3, back: 0.35 }, Sides::both(0.3))?)
}

fn score(plant: &Plant) -> Result<[Errors; 6]> {
    let optics = optics()?;
    let scene = Scene::new(&Scene::shapes(plant), &optics)?;
    let (truth, sun) = truth(&scene, plant.leaves().len() as u32, &optics)?;
    let seen = seen(&scene, plant.leaves().len());
    let near = nearest(plant);
    let errors = models(plant, &optics, &sun)?.map(|model| {
        let mean = truth.iter().sum::<f64>() / truth.len() as f64;
        let over =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>() / b.iter().sum::<f64>();
        let pixels = |values: &[f64]| seen.iter().map(|side| values[*side]).collect::<Vec<f64>>();
        Errors {
            leaf: over(&model, &truth),
            low: over(&low_passed(&model, &near), &low_passed(&truth, &near)),
            picture: over(&pixels(&model), &pixels(&truth)),
            bias: model.iter().sum::<f64>() / model.len() as f64 / mean - 1.0,
        }
    });
    Ok(errors)
}

/// Radiance of front and back of every leaf, one after the other, all bounces; and the sun that brings twice the sky's light.
fn truth(scene: &Scene, leaves: u32, optics: &Optics) -> Result<(Vec<f64>, Sun)> {
    let [ground, sky] = SKY.map(DVec3::splat);
    let around = Surroundings { toward_sun: TOWARD.normalize(), sun: DVec3::ONE, sky, ground };
    let all: Vec<u32> = (0..leaves).collect();
    let ways = scene.irradiance(&all, &around, PATHS, SEED);
    let sides = |of: &dyn Fn(&foliar_light::truth::Ways) -> f64| -> Vec<f64> {
        let radiance = |[front, back]: &[foliar_light::truth::Ways; 2]| {
            let sides = optics.radiance(Sides { front: of(front), back: of(back) });
            [sides.front, sides.back]
        };
        ways.iter().flat_map(radiance).collect()
    };
    let direct = |values: Vec<f64>| values.iter().sum::<f64>();
    let sun = SUN_TO_SKY * direct(sides(&|w| w.sky[0].x)) / direct(sides(&|w| w.sun[0].x));
    let total = sides(&|w| sun * w.sun.iter().sum::<DVec3>().x + w.sky.iter().sum::<DVec3>().x);
    Ok((total, Sun::new(TOWARD, sun)?))
}

/// The same by every pipeline.
fn models(plant: &Plant, optics: &Optics, sun: &Sun) -> Result<[Vec<f64>; 6]> {
    let sky = Sky::even(SKY[1], SKY[0])?;
    let foliage = Foliage::new(plant);
    let queries = foliage.queries();
    let exact = |profile| Crown::new(&foliage.sources, profile).depths(&queries, EXACT, Isa::best());
    let (paper, cap) = (exact(Profile::Paper), exact(Profile::Cap));
    let area = reference::mean_area(&foliage.sources);
    let tau = reference::extinction(&reference::sums(&foliage.sources, &queries, Profile::Paper), area);
    let centers: Vec<DVec3> = foliage.sources.iter().map(|s| s.center).collect();
    let hull = Tree::new(tau, centers.len() as f64 / hull_volume(&centers), area)?;
    let (by_rays, harmonics) = rays(plant)?;
    let each = |depths: &[[f32; 8]], light: &(dyn Fn(usize, &Leaf) -> Light + Sync)| -> Result<Vec<f64>> {
        let of = |(index, (depths, leaf)): (usize, (&[f32; 8], &foliar_plant::Leaf))| {
            let leaf = Leaf::new(depths.map(f64::from), leaf.normal.as_dvec3())?;
            let sides = optics.radiance(light(index, &leaf).total());
            Ok([sides.front, sides.back])
        };
        let rows = depths.iter().zip(plant.leaves()).enumerate().map(of).collect::<Result<Vec<_>>>()?;
        Ok(rows.into_flattened())
    };
    let consistent = Tree::CONSISTENT;
    let slant = Slant::new(sun.toward());
    Ok([
        each(&paper, &|_, leaf| model::boulanger08(leaf, optics, &hull, sun, &sky))?,
        each(&paper, &|_, leaf| model::boulanger08(leaf, optics, &consistent, sun, &sky))?,
        each(&paper, &|_, leaf| {
            model::boulanger08_by(leaf, optics, &consistent, sun, &sky, slant.mean(&leaf.transmittances()))
        })?,
        each(&cap, &|_, leaf| model::light(leaf, optics, sun, &sky))?,
        each(&by_rays, &|_, leaf| model::light(leaf, optics, sun, &sky))?,
        each(&by_rays, &|index, leaf| model::light_sh(leaf, &harmonics[index], optics, sun, &sky))?,
    ])
}

/// Optical depths and nine numbers of each leaf.
type OfRays = (Vec<[f32; 8]>, Vec<[f64; 9]>);

/// Depths and nine numbers of the room's ray engine.
fn rays(plant: &Plant) -> Result<OfRays> {
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    let given = json!({ "engine": "rays", "sun": "harmonics" }).as_object().cloned().unwrap_or_default();
    let baker: &dyn Baker = &foliar_light::Light;
    let (layer, _) = bake(baker, &inputs, &Request { given, ..Request::default() }, &Quiet)?;
    let column = |name: &str| {
        let found = layer.columns.iter().find(|(key, _)| key.property == name);
        found.and_then(|(_, array)| array.as_f32()).with_context(|| format!("no column {name}"))
    };
    let harmonics = column(names::SUN_HARMONICS)?.as_chunks::<9>().0.iter().map(|row| row.map(f64::from));
    Ok((column(names::OPTICAL_DEPTH)?.as_chunks::<8>().0.to_vec(), harmonics.collect()))
}

/// Volume of the convex hull, by points in the box around it that lie inside of it in each of many directions.
fn hull_volume(points: &[DVec3]) -> f64 {
    const DIRECTIONS: usize = 600;
    const TRIED: u64 = 40_000;
    let reach = |direction: DVec3| points.iter().map(|p| p.dot(direction)).fold(f64::NEG_INFINITY, f64::max);
    let sides: Vec<(DVec3, f64)> = (0..DIRECTIONS)
        .map(|i| foliar_numerics::fibonacci_sphere(i, DIRECTIONS))
        .map(|direction| (direction, reach(direction)))
        .collect();
    let (low, high) = (
        DVec3::new(-reach(DVec3::NEG_X), -reach(DVec3::NEG_Y), -reach(DVec3::NEG_Z)),
        DVec3::new(reach(DVec3::X), reach(DVec3::Y), reach(DVec3::Z)),
    );
    let inside = (0..TRIED).into_par_iter().filter(|&i| {
        let share = DVec3::from_array([2, 3, 5].map(|base| foliar_numerics::radical_inverse(i, base)));
        let point = low + (high - low) * share;
        sides.iter().all(|(direction, reach)| point.dot(*direction) <= *reach)
    });
    (high - low).element_product() * inside.count() as f64 / TRIED as f64
}

/// For each leaf the nearest ones, itself the first.
fn nearest(plant: &Plant) -> Vec<Vec<usize>> {
    let centers: Vec<DVec3> = plant.leaves().iter().map(|leaf| leaf.center.as_dvec3()).collect();
    let of = |center: &DVec3| {
        let mut order: Vec<usize> = (0..centers.len()).collect();
        let distance = |i: &usize| centers[*i].distance_squared(*center);
        order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        order.truncate(NEAREST);
        order
    };
    centers.par_iter().map(of).collect()
}

/// Means over the nearest leaves, front with front and back with back.
fn low_passed(values: &[f64], near: &[Vec<usize>]) -> Vec<f64> {
    let mean = |leaves: &Vec<usize>, side: usize| {
        leaves.iter().map(|leaf| values[2 * leaf + side]).sum::<f64>() / leaves.len() as f64
    };
    near.iter().flat_map(|leaves| [mean(leaves, 0), mean(leaves, 1)]).collect()
}

/// Which side of which leaf each pixel of an orthographic picture shows, seen along -Z.
fn seen(scene: &Scene, leaves: usize) -> Vec<usize> {
    let mut sides = Vec::new();
    for pixel in 0..PIXELS * PIXELS {
        // The scene's frame: its longest edge is 1, its middle the origin.
        let place = |k: usize| (k as f32 + 0.5) / PIXELS as f32 * 1.2 - 0.6;
        let origin = glam::Vec3::new(place(pixel % PIXELS), place(pixel / PIXELS), 2.0);
        let beam = Beam { origin, direction: glam::Vec3::NEG_Z, reach: f32::INFINITY };
        let met: Option<Met<u32>> = scene.meet(&beam, None, &mut Stream::new(&[]));
        sides.extend(met.map(|met| 2 * met.mark as usize + usize::from(met.front.z < 0.0)));
    }
    debug_assert!(sides.iter().all(|side| *side < 2 * leaves));
    sides
}

fn table(scored: &[Scored]) -> String {
    let percent = |value: f64| format!("{:.1}", 100.0 * value);
    let mut text = String::from("### Mean of all crowns, per cent of the mean radiance\n\n");
    text += "| pipeline | leaf | low | picture | bias, size |\n|---|---|---|---|---|\n";
    for (index, name) in PIPELINES.iter().enumerate() {
        let Errors { leaf, low, picture, bias } = mean(scored, index);
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {} | {} |",
            percent(leaf),
            percent(low),
            percent(picture),
            percent(bias)
        );
    }
    for crown in scored {
        let _ =
            write!(text, "\n### {}\n\n| pipeline | leaf | low | picture | bias |\n|---|---|---|---|---|\n", crown.name);
        for (name, e) in PIPELINES.iter().zip(&crown.errors) {
            let _ = writeln!(
                text,
                "| {name} | {} | {} | {} | {:+.1} |",
                percent(e.leaf),
                percent(e.low),
                percent(e.picture),
                100.0 * e.bias
            );
        }
    }
    text
}
