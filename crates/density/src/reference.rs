//! The shortest correct programs for everything this room bakes: f64, all pairs, no grid (Luft07 eqs. 2
//! to 4; the sky by the chords of all balls). Tests and measured errors compare with them.

use crate::directions::{DIRECTIONS, sky_directions};
use crate::fast::{Places, SkyPlan, Values, luft_ambient, median, sky_ambients};
use crate::field::Query;
use crate::generators::{Foliage, Generator, NO_GROUP};
use crate::hull;
use crate::medium::{SkySample, chord, extinction, see};
use crate::normals::realigned;
use crate::params::{AmbientTerm, DensityUnit, NormalMode, Params, SelfLeaf};
use crate::surface::{DensityField, Probe, extract};
use foliar_bake::BakeError;
use foliar_plant::Plant;
use glam::DVec3;
use rayon::prelude::*;

/// A density summed in f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExactSample {
    /// S of Luft07 eq. 2 with weights.
    pub density: f64,
    /// Its gradient, 1/m.
    pub gradient: DVec3,
    /// Sum of the weights of the balls in reach: what errors are relative to.
    pub weight: f64,
}

/// Density and gradient at one place.
pub fn field(generators: &[Generator], radius: f64, query: &Query) -> ExactSample {
    let mut sample = ExactSample::default();
    for ball in generators.iter().filter(|ball| ball.group != query.skip) {
        let arm = query.position - ball.position;
        let inside = 1.0 - arm.length_squared() / (radius * radius);
        if inside > 0.0 {
            let weight = f64::from(ball.weight);
            sample.density += weight * inside * inside;
            sample.gradient -= arm * (4.0 * weight * inside / (radius * radius));
            sample.weight += weight;
        }
    }
    sample
}

/// The sky at one place, through every ball on the way.
pub fn sky(generators: &[Generator], radius: f64, mean_area: f64, query: &Query) -> SkySample {
    let directions = sky_directions();
    let scale = extinction(mean_area, radius);
    let depths: [f64; DIRECTIONS] = directions.map(|toward| {
        let others = generators.iter().filter(|ball| ball.group != query.skip);
        let chords = others.map(|b| f64::from(b.weight) * chord((query.position - b.position) / radius, toward));
        scale * chords.sum::<f64>()
    });
    see(&depths, &directions, query.position)
}

/// The density by its definition, for the surface.
pub(crate) struct Exact<'a> {
    /// The balls.
    pub generators: &'a [Generator],
    /// Their radius, meters.
    pub radius: f64,
}

impl DensityField for Exact<'_> {
    fn probe(&self, places: &[DVec3]) -> Vec<Probe> {
        let at = |&position: &DVec3| {
            let sample = field(self.generators, self.radius, &Query { position, skip: NO_GROUP });
            Probe { density: sample.density, gradient: sample.gradient }
        };
        places.par_iter().map(at).collect()
    }
}

/// Everything that a bake computes, by the functions above. The surface is meshed as in the bake, from the exact
/// field: `tests/oracle.rs` knows the closest points of the true one.
///
/// # Errors
/// As the bake's.
pub(crate) fn values(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> Result<Values, BakeError> {
    let mut values = Values::default();
    if params.asks_sky() {
        let plan = SkyPlan::new(plant, foliage, places, params);
        let sky = |query: &Query| sky(&foliage.generators, foliage.radius, foliage.mean_area, query);
        let samples: Vec<SkySample> = plan.queries.par_iter().map(sky).collect();
        if params.wants_ambient() && params.ambient == AmbientTerm::Sky {
            values.ambient = sky_ambients(&plan.of_place, &samples, params);
        }
        if params.wants_normals() && params.normals == NormalMode::Sky {
            let toward: Vec<DVec3> = samples.iter().map(|sample| sample.direction).collect();
            values.normals = realigned(plant, places, &plan.of_place, &toward, params);
        }
    }
    if params.asks_density() {
        let unit = density_unit(foliage, params);
        let luft = |q: &Query| luft_ambient(field(&foliage.generators, foliage.radius, q).density, unit, params) as f32;
        if params.wants_ambient() && params.ambient == AmbientTerm::Luft {
            values.ambient = places.queries.par_iter().map(luft).collect();
        }
        if params.wants_normals() && params.normals == NormalMode::Surface {
            let exact = Exact { generators: foliage.own(), radius: foliage.radius };
            let plan = SkyPlan::of_leaves(plant, foliage, places, params);
            let surface = hull::surface_by(|balls, meshing| extract(&exact, balls, meshing), foliage, unit, params)?;
            let toward = hull::directions(surface, &exact, &plan.queries);
            values.normals = realigned(plant, places, &plan.of_place, &toward, params);
        }
        values.reference = Some(unit);
    }
    Ok(values)
}

/// Median density by the definition, or 1.
fn density_unit(foliage: &Foliage, params: &Params) -> f64 {
    if params.density_unit == DensityUnit::Absolute {
        return 1.0;
    }
    let skip = |group| if params.self_leaf == SelfLeaf::Exclude { group } else { NO_GROUP };
    let query = |ball: &Generator| Query { position: ball.position, skip: skip(ball.group) };
    let queries: Vec<Query> = foliage.own().iter().map(query).collect();
    let mut own: Vec<f64> = queries.par_iter().map(|q| field(foliage.own(), foliage.radius, q).density).collect();
    own.sort_unstable_by(f64::total_cmp);
    median(&own).max(1.0)
}
