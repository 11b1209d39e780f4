//! Realigned normals to compare: the room's own, and what else was proposed for the job. All but the room's
//! are written for the comparison: as short as they can be, sharing the room's field.

use super::light::Light;
use super::scores::{LeafNormals, by_leaf};
use anyhow::{Context, Result};
use foliar_density::surface::{Balls, SurfaceParams, extract_fast, nearest};
use foliar_density::{Field, Foliage, Generator, NO_GROUP, Query};
use foliar_plant::Plant;
use glam::DVec3;

/// Density of the surface in units of the plant's median density: the room's default threshold.
const THRESHOLD: f64 = 0.1;
/// Cells of the surface per radius.
const CELLS_PER_RADIUS: f64 = 4.0;

/// Median density at the plant's own balls, each without its group: what thresholds are given in.
pub fn unit(foliage: &Foliage) -> f64 {
    let query = |ball: &Generator| Query { position: ball.position, skip: ball.group };
    let queries: Vec<Query> = foliage.own().iter().map(query).collect();
    let mut densities = Field::new(foliage.own(), foliage.radius).densities(&queries);
    densities.sort_unstable_by(f32::total_cmp);
    densities.get(densities.len() / 2).map_or(1.0, |median| f64::from(*median).max(1.0))
}

/// A plant with its balls.
pub struct Subject<'a> {
    /// The plant.
    pub plant: &'a Plant,
    /// Its balls at the room's defaults.
    pub foliage: &'a Foliage,
}

impl Subject<'_> {
    /// Original normals of the file, rest frame.
    pub fn plain(&self) -> LeafNormals {
        by_leaf(self.plant, |part, vertex| {
            let part = &self.plant.parts()[part];
            part.normals.get(vertex).map_or(DVec3::Y, |n| part.normal_to_rest(n.as_dvec3()))
        })
    }

    /// Of the ellipsoid with the spread of the leaves along each axis, at each leaf's center.
    pub fn ellipsoid(&self) -> LeafNormals {
        let centers = self.centers();
        let count = centers.len() as f64;
        let mean = centers.iter().sum::<DVec3>() / count;
        let spread = centers.iter().map(|c| (*c - mean) * (*c - mean)).sum::<DVec3>() / count;
        centers.iter().map(|c| vec![((*c - mean) / spread).normalize_or(DVec3::Y)]).collect()
    }

    /// Against the gradient of the density at each vertex, the balls `widen` times as wide.
    pub fn gradient(&self, widen: f64) -> LeafNormals {
        let field = Field::new(self.foliage.own(), widen * self.foliage.radius);
        let places = self.places();
        let queries: Vec<Query> = places.iter().flatten().copied().collect();
        let mut samples = field.samples(&queries).into_iter();
        let normal = |_: &Query| samples.next().map_or(DVec3::Y, |s| (-s.gradient.as_dvec3()).normalize_or(DVec3::Y));
        let mut normal = normal;
        places.iter().map(|leaf| leaf.iter().map(&mut normal).collect()).collect()
    }

    /// Sum over balls 1, 2 and 4 times as wide of -k radius grad S / (S + 1), at each leaf's center.
    pub fn multi(&self) -> LeafNormals {
        let group = |leaf: usize| self.plant.leaves()[leaf].group;
        let queries = self.centers().into_iter().enumerate();
        let queries: Vec<Query> = queries.map(|(leaf, position)| Query { position, skip: group(leaf) }).collect();
        let mut sums = vec![DVec3::ZERO; queries.len()];
        for widen in [1.0, 2.0, 4.0] {
            let radius = widen * self.foliage.radius;
            let samples = Field::new(self.foliage.own(), radius).samples(&queries);
            for (sum, sample) in sums.iter_mut().zip(samples) {
                *sum -= sample.gradient.as_dvec3() * (radius / (f64::from(sample.density) + 1.0));
            }
        }
        sums.into_iter().map(|sum| vec![sum.normalize_or(DVec3::Y)]).collect()
    }

    /// The paper's, at each vertex as the paper has it: of the closest point of the implicit surface.
    pub fn surface(&self) -> Result<LeafNormals> {
        let reference = unit(self.foliage);
        let radius_m = self.foliage.radius;
        let balls = Balls { generators: self.foliage.own(), radius_m, threshold: THRESHOLD * reference };
        let params = SurfaceParams { cell_m: Some(radius_m / CELLS_PER_RADIUS), ..SurfaceParams::default() };
        let surface = extract_fast(&balls, &params)?.without_cavities();
        let places = self.places();
        let flat: Vec<DVec3> = places.iter().flatten().map(|q| q.position).collect();
        let feet = nearest(&surface, &Field::new(self.foliage.own(), radius_m), &flat);
        let mut feet = feet.context("the surface is empty")?.into_iter();
        let mut normal = |_: &Query| feet.next().map_or(DVec3::Y, |foot| foot.normal.as_dvec3());
        Ok(places.iter().map(|leaf| leaf.iter().map(&mut normal).collect()).collect())
    }

    /// Mean direction of the traced light: what rays would give.
    pub fn bent(&self, light: &Light) -> LeafNormals {
        light.bent_normals().into_iter().map(|normal| vec![normal]).collect()
    }

    fn centers(&self) -> Vec<DVec3> {
        self.plant.leaves().iter().map(|leaf| leaf.center.as_dvec3() - self.plant.center()).collect()
    }

    fn places(&self) -> Vec<Vec<Query>> {
        by_leaf(self.plant, |part, vertex| Query {
            position: self.plant.parts()[part].rest_position(vertex) - self.plant.center(),
            skip: NO_GROUP,
        })
    }
}
