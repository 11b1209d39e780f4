//! The truth that ambient terms and normals are judged by: light traced to every leaf, low-passed.
//! docs/tradeoff/density.md says what each term means.

use super::occluders::Occluders;
use anyhow::Result;
use foliar_numerics::{fibonacci_sphere, r2_point};
use foliar_plant::Plant;
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Directions of light.
pub const DIRECTIONS: usize = 230;
/// Origins of rays that a tree has at least.
const ORIGINS: usize = 40_000;
/// Reach of the low-pass in radii of gyration of the leaf area.
const LOW_PASS: f64 = 0.08;
/// Tries to find an opaque texel, for each origin asked for.
const TRIES: usize = 64;

/// A triangle of a leaf: its part, places and texture coordinates.
type Cut = (usize, [Vec3; 3], [Vec2; 3]);

/// Light at every leaf.
pub struct Light {
    /// Toward the light, unit.
    pub directions: Vec<DVec3>,
    /// Per leaf, per direction: low-passed visibility.
    pub low_passed: Vec<[f32; DIRECTIONS]>,
    /// Per leaf: share of the directions in which the leaf itself is seen.
    pub seen: Vec<f64>,
    /// Reach of the low-pass, meters.
    pub reach: f64,
}

impl Light {
    /// Traces a plant. No leaf may be without a triangle.
    pub fn trace(plant: &Plant) -> Result<Light> {
        let occluders = Occluders::new(plant)?;
        let directions: Vec<DVec3> = (0..DIRECTIONS).map(|i| fibonacci_sphere(i, DIRECTIONS)).collect();
        let origins = origins(plant, &occluders);
        let row = |(leaf, points): (usize, &Vec<Vec3>)| {
            let group = plant.leaves()[leaf].group;
            let lit = |toward: &DVec3| points.iter().filter(|p| occluders.is_lit(**p, *toward, group)).count();
            std::array::from_fn(|d| lit(&directions[d]) as f32 / points.len() as f32)
        };
        let visibility: Vec<[f32; DIRECTIONS]> = origins.par_iter().enumerate().map(row).collect();
        let reach = LOW_PASS * gyration(plant);
        let seen = visibility.iter().map(mean).collect();
        Ok(Light { directions, low_passed: low_pass(plant, &visibility, reach), seen, reach })
    }

    /// Low-passed visibility, averaged over the directions, per leaf.
    pub fn ambient(&self) -> Vec<f64> {
        self.low_passed.iter().map(mean).collect()
    }

    /// Mean direction of the light that reaches each leaf: the best that one normal can know.
    pub fn bent_normals(&self) -> Vec<DVec3> {
        let bent = |row: &[f32; DIRECTIONS]| {
            let sum: DVec3 = row.iter().zip(&self.directions).map(|(v, d)| *d * f64::from(*v)).sum();
            sum.normalize_or(DVec3::Y)
        };
        self.low_passed.iter().map(bent).collect()
    }
}

fn mean(row: &[f32; DIRECTIONS]) -> f64 {
    row.iter().map(|v| f64::from(*v)).sum::<f64>() / DIRECTIONS as f64
}

/// Root of the mean squared distance of the leaf area from its mean, meters.
fn gyration(plant: &Plant) -> f64 {
    let leaves = || plant.leaves().iter().map(|leaf| (f64::from(leaf.area), leaf.center.as_dvec3() - plant.center()));
    let total: f64 = leaves().map(|(area, _)| area).sum();
    let mean = leaves().map(|(area, center)| center * area).sum::<DVec3>() / total;
    (leaves().map(|(area, center)| area * (center - mean).length_squared()).sum::<f64>() / total).sqrt()
}

/// Points on the opaque part of each leaf, evenly spread by area; the leaf's center where none is opaque.
fn origins(plant: &Plant, occluders: &Occluders) -> Vec<Vec<Vec3>> {
    let wanted = ORIGINS.div_ceil(plant.leaves().len().max(1));
    let mut triangles = vec![Vec::new(); plant.leaves().len()];
    for (index, part) in plant.parts().iter().enumerate() {
        let places = plant.relative_positions(index);
        for corners in &part.triangles {
            if let Some(leaf) = plant.leaf_of(index, corners[0] as usize) {
                let uvs = corners.map(|c| part.uvs.get(c as usize).copied().unwrap_or_default());
                triangles[leaf as usize].push((index, corners.map(|c| places[c as usize]), uvs));
            }
        }
    }
    let points = |(leaf, triangles): (usize, &Vec<Cut>)| {
        let spread = Spread::new(triangles);
        // Every leaf starts elsewhere in the sequence, so that neighbors do not repeat its pattern.
        let tries = (0..TRIES * wanted).filter_map(|i| spread.point((leaf * TRIES * wanted + i) as u64, occluders));
        let points: Vec<Vec3> = tries.take(wanted).collect();
        if points.is_empty() { vec![plant.relative_center(leaf)] } else { points }
    };
    triangles.par_iter().enumerate().map(points).collect()
}

/// A leaf's triangles with the area up to each.
struct Spread<'a> {
    triangles: &'a [Cut],
    areas: Vec<f32>,
}

impl<'a> Spread<'a> {
    fn new(triangles: &'a [Cut]) -> Self {
        let mut sum = 0.0;
        let area = |(_, [a, b, c], _): &Cut| {
            sum += (*b - *a).cross(*c - *a).length();
            sum
        };
        Spread { triangles, areas: triangles.iter().map(area).collect() }
    }

    /// The place of a point of a sequence, where the leaf is opaque there.
    fn point(&self, index: u64, occluders: &Occluders) -> Option<Vec3> {
        let DVec2 { x, y } = r2_point(index);
        let chosen = x as f32 * self.areas.last().filter(|area| **area > 0.0)?;
        let at = self.areas.partition_point(|area| *area <= chosen).min(self.areas.len() - 1);
        let before = if at > 0 { self.areas[at - 1] } else { 0.0 };
        // What is left of the coordinate that chose the triangle is a coordinate inside it.
        let root = ((chosen - before) / (self.areas[at] - before)).clamp(0.0, 1.0).sqrt();
        let [wa, wb] = [1.0 - root, root * (1.0 - y as f32)];
        let (part, [a, b, c], [ua, ub, uc]) = &self.triangles[at];
        let wc = 1.0 - wa - wb;
        occluders.is_there(*part, *ua * wa + *ub * wb + *uc * wc).then(|| *a * wa + *b * wb + *c * wc)
    }
}

/// Means over all leaves whose centers are within reach.
fn low_pass(plant: &Plant, visibility: &[[f32; DIRECTIONS]], reach: f64) -> Vec<[f32; DIRECTIONS]> {
    let centers: Vec<DVec3> = plant.leaves().iter().map(|l| l.center.as_dvec3() - plant.center()).collect();
    let cell = |p: &DVec3| (*p / reach).floor().to_array().map(|v| v as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (leaf, center) in centers.iter().enumerate() {
        cells.entry(cell(center)).or_default().push(leaf);
    }
    let near = |center: &DVec3| {
        let [x, y, z] = cell(center);
        let around = (-1..=1).flat_map(move |i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        around.filter_map(move |[i, j, k]| Some((x.checked_add(i)?, y.checked_add(j)?, z.checked_add(k)?)))
    };
    let smooth = |center: &DVec3| {
        let (mut sum, mut count) = ([0.0f32; DIRECTIONS], 0.0);
        let leaves = near(center).filter_map(|(i, j, k)| cells.get(&[i, j, k])).flatten();
        for leaf in leaves.filter(|leaf| centers[**leaf].distance(*center) <= reach) {
            count += 1.0;
            sum.iter_mut().zip(&visibility[*leaf]).for_each(|(sum, v)| *sum += v);
        }
        sum.map(|sum| sum / count)
    };
    centers.par_iter().map(smooth).collect()
}
