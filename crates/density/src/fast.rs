//! The bake: places of a plant, density there, ambient coefficients and realigned normals (Luft07).

use crate::ambient::ambient_coefficient;
use crate::choose;
use crate::field::Query;
use crate::generators::{Foliage, NO_GROUP};
use crate::hull;
use crate::medium::SkySample;
use crate::normals::realigned;
use crate::params::{AmbientTerm, DensityUnit, NormalMode, Params, SelfLeaf};
use foliar_bake::BakeError;
use foliar_plant::Plant;
use foliar_schema::{MeasuredError, Role};
use glam::DVec3;
use rayon::prelude::*;

/// Every vertex of leaves and wood, and what its leaf is.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// Parts in order, each with its first vertex in `queries`.
    pub parts: Vec<(usize, usize)>,
    /// Where.
    pub queries: Vec<Query>,
}

impl Places {
    /// The vertices of all parts that are leaf or wood; those of leaves leave their group out if `params` says so.
    pub fn new(plant: &Plant, params: &Params) -> Places {
        let mut places = Places::default();
        for (index, part) in plant.parts().iter().enumerate().filter(|(i, _)| plant.role(*i) != Role::Other) {
            places.parts.push((index, places.queries.len()));
            places.queries.par_extend((0..part.positions.len()).into_par_iter().map(|vertex| Query {
                position: part.rest_position(vertex) - plant.center(),
                skip: plant.leaf_of(index, vertex).map_or(NO_GROUP, |leaf| skip(plant, leaf, params)),
            }));
        }
        places
    }

    /// Part, vertex and place of every vertex.
    pub fn vertices(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let ends = self.parts.iter().skip(1).map(|p| p.1).chain([self.queries.len()]);
        self.parts
            .iter()
            .zip(ends)
            .flat_map(|(&(part, start), end)| (start..end).map(move |place| (part, place - start, place)))
    }
}

fn skip(plant: &Plant, leaf: u32, params: &Params) -> u32 {
    match params.self_leaf {
        SelfLeaf::Exclude => plant.leaves()[leaf as usize].group,
        SelfLeaf::Include => NO_GROUP,
    }
}

/// Density in units of which threshold and darkest density are given: 1, or the median over the plant's own
/// balls (mean of the two middle ones), and never below the weight of one leaf, so that a leaf alone works.
/// `densities` knows the density of the plant's own balls.
pub(crate) fn density_unit(foliage: &Foliage, params: &Params, densities: impl Fn(&[Query]) -> Vec<f32>) -> f64 {
    if params.density_unit == DensityUnit::Absolute {
        return 1.0;
    }
    let densities = densities(&reference_queries(foliage, params));
    let mut densities: Vec<f64> = densities.into_iter().map(f64::from).collect();
    densities.par_sort_unstable_by(f64::total_cmp);
    median(&densities).max(1.0)
}

fn reference_queries(foliage: &Foliage, params: &Params) -> Vec<Query> {
    let skip = |group| if params.self_leaf == SelfLeaf::Exclude { group } else { NO_GROUP };
    foliage.own().iter().map(|ball| Query { position: ball.position, skip: skip(ball.group) }).collect()
}

/// Median of a sorted list, 0 of an empty one.
pub(crate) fn median(sorted: &[f64]) -> f64 {
    match sorted.len() {
        0 => 0.0,
        n => f64::midpoint(sorted[(n - 1) / 2], sorted[n / 2]),
    }
}

/// Where the sky is asked for: leaves at their centers, then every vertex that needs its own answer.
pub(crate) struct SkyPlan {
    pub queries: Vec<Query>,
    /// Per place of [`Places`]: index into `queries`; `NOWHERE` where nothing needs an answer.
    pub of_place: Vec<u32>,
}

/// A place without an answer from the sky.
pub(crate) const NOWHERE: u32 = u32::MAX;

impl SkyPlan {
    /// The plan of the sky: wood counts where the ambient term is the sky's.
    pub fn new(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> SkyPlan {
        SkyPlan::with_wood(plant, foliage, places, params, params.ambient == AmbientTerm::Sky && params.wants_ambient())
    }

    /// The plan of what is asked for leaves only.
    pub fn of_leaves(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> SkyPlan {
        SkyPlan::with_wood(plant, foliage, places, params, false)
    }

    /// Leaves that are large, or sampled from a crown volume, are asked at each vertex; so is wood, if at all.
    fn with_wood(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params, wood: bool) -> SkyPlan {
        let mut queries: Vec<Query> = (0..plant.leaves().len() as u32)
            .map(|leaf| Query {
                position: plant.leaves()[leaf as usize].center.as_dvec3() - plant.center(),
                skip: skip(plant, leaf, params),
            })
            .collect();
        let of_place = places
            .vertices()
            .map(|(part, vertex, place)| match plant.leaf_of(part, vertex) {
                Some(leaf) if !foliage.is_large(leaf) && !plant.leaves()[leaf as usize].crown_volume => leaf,
                None if plant.role(part) == Role::Wood && !wood => NOWHERE,
                _ => {
                    queries.push(places.queries[place]);
                    queries.len() as u32 - 1
                }
            })
            .collect();
        SkyPlan { queries, of_place }
    }
}

/// Everything that a bake computes, before it is written into arrays.
#[derive(Default)]
pub(crate) struct Values {
    /// S_ref, where k_a needs it.
    pub reference: Option<f64>,
    /// Per place; empty where it is not asked for.
    pub ambient: Vec<f32>,
    /// Per place, rest frame; `None` for wood; empty where it is not asked for.
    pub normals: Vec<Option<DVec3>>,
    /// Lattice points per radius that the sky, where it was asked, and the density were read from; 0 where every
    /// ball was summed.
    pub sky_points: Option<f64>,
    pub field_points: Option<f64>,
    /// Error of the density relative to itself, rms.
    pub field_error: Option<f64>,
    /// Errors against the reference, where they were measured.
    pub errors: Vec<MeasuredError>,
}

/// Bakes all places.
///
/// # Errors
/// [`BakeError::Parameter`] where normals come from a surface that cannot be meshed.
pub(crate) fn values(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> Result<Values, BakeError> {
    let most = choose::most_points(places.queries.len());
    let mut values = Values::default();
    if params.asks_sky() {
        let plan = SkyPlan::new(plant, foliage, places, params);
        let sky = choose::sky(foliage, &plan.queries, params, most);
        values.sky_points = Some(sky.points);
        values.errors = sky.errors;
        let samples = sky.samples;
        if params.wants_ambient() && params.ambient == AmbientTerm::Sky {
            values.ambient = sky_ambients(&plan.of_place, &samples, params);
        }
        if params.wants_normals() && params.normals == NormalMode::Sky {
            let toward: Vec<DVec3> = samples.iter().map(|sample| sample.direction).collect();
            values.normals = realigned(plant, places, &plan.of_place, &toward, params);
        }
    }
    if params.wants_normals() && params.normals == NormalMode::Surface {
        let (plan, field) = (SkyPlan::of_leaves(plant, foliage, places, params), hull::field(foliage));
        let unit = density_unit(foliage, params, |queries| field.densities(queries));
        let surface = hull::surface(foliage, unit, params)?;
        let toward = hull::directions(surface, &field, &plan.queries);
        values.normals = realigned(plant, places, &plan.of_place, &toward, params);
        values.reference = Some(unit);
    }
    if params.wants_ambient() && params.ambient == AmbientTerm::Luft {
        let field = choose::field(foliage, &places.queries, params, most);
        let ambient = |&density: &f32| luft_ambient(f64::from(density), field.unit, params) as f32;
        values.ambient = field.densities.par_iter().map(ambient).collect();
        values.reference = Some(field.unit);
        values.field_points = Some(field.points);
        values.field_error = Some(field.relative);
        values.errors.push(field.error);
    }
    Ok(values)
}

/// k_a of a density (Luft07 eqs. 3 and 4), with threshold and darkest density in units of `reference`.
pub(crate) fn luft_ambient(density: f64, reference: f64, params: &Params) -> f64 {
    ambient_coefficient(
        density - params.threshold * reference,
        params.darkest_density * reference,
        params.darkest_ambient,
        params.exponent,
    )
}

/// The sky's transmittance, lifted to the same range as k_a.
pub(crate) fn sky_ambients(of_place: &[u32], samples: &[SkySample], params: &Params) -> Vec<f32> {
    let seen = |at: &u32| samples.get(*at as usize).map_or(1.0, |sample| sample.transmittance);
    let lift = |seen: f64| (params.darkest_ambient + (1.0 - params.darkest_ambient) * seen) as f32;
    of_place.iter().map(|at| lift(seen(at))).collect()
}
