//! The shortest correct programs for everything this room bakes: f64, all pairs, no grid (Luft07 eqs. 2
//! to 4; the sky by the chords of all balls). Tests and measured errors compare with them.

use crate::directions::{DIRECTIONS, sky_directions};
use crate::fast::{Places, SkyPlan, Values, luft_ambient, median, realigned, sky_ambients};
use crate::field::Query;
use crate::generators::{Foliage, Generator, NO_GROUP};
use crate::medium::{SkySample, chord, extinction, see};
use crate::params::{AmbientTerm, Channels, Params, SelfLeaf};
use crate::sky::Sky;
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

/// Everything that a bake computes, by the functions above.
pub(crate) fn values(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> Values {
    let skip = |group| if params.self_leaf == SelfLeaf::Exclude { group } else { NO_GROUP };
    let query = |ball: &Generator| Query { position: ball.position, skip: skip(ball.group) };
    let queries: Vec<Query> = foliage.own().iter().map(query).collect();
    let mut own: Vec<f64> = queries.par_iter().map(|q| field(foliage.own(), foliage.radius, q).density).collect();
    own.sort_unstable_by(f64::total_cmp);
    let reference = median(&own).max(1.0);
    let plan = SkyPlan::new(plant, foliage, places, params);
    let radius = Sky::new(foliage, params.sky_points()).radius();
    let samples: Vec<SkySample> =
        plan.queries.par_iter().map(|q| sky(&foliage.generators, radius, foliage.mean_area, q)).collect();
    let luft =
        |q: &Query| luft_ambient(field(&foliage.generators, foliage.radius, q).density, reference, params) as f32;
    let ambient = match params.ambient {
        _ if params.channels == Channels::Normals => Vec::new(),
        AmbientTerm::Luft => places.queries.par_iter().map(luft).collect(),
        AmbientTerm::Sky => sky_ambients(&plan.of_place, &samples, params),
    };
    let normals = match params.channels {
        Channels::Ambient => Vec::new(),
        _ => realigned(plant, places, &plan.of_place, &samples, params),
    };
    let asked = params.ambient == AmbientTerm::Sky || params.channels != Channels::Ambient;
    let luft = params.ambient == AmbientTerm::Luft && params.channels != Channels::Normals;
    Values {
        reference: luft.then_some(reference),
        ambient,
        normals,
        sky_radius: asked.then_some(radius),
        errors: Vec::new(),
    }
}
