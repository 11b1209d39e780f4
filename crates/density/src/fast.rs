//! The bake: places of a plant, density there, ambient coefficients and realigned normals (Luft07).

use crate::ambient::ambient_coefficient;
use crate::field::{Field, Query};
use crate::generators::{Foliage, NO_GROUP};
use crate::measure;
use crate::medium::SkySample;
use crate::params::{AmbientTerm, Channels, Params, SelfLeaf};
use crate::sky::Sky;
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
            places.queries.extend((0..part.positions.len()).map(|vertex| Query {
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

/// Density in units of which threshold and darkest density are: the median over the plant's own balls
/// (mean of the two middle ones), and never below the weight of one leaf, so that a leaf alone works.
pub fn reference_density(foliage: &Foliage, params: &Params) -> f64 {
    let queries = reference_queries(foliage, params);
    let densities = Field::new(foliage.own(), foliage.radius).densities(&queries);
    let mut densities: Vec<f64> = densities.into_iter().map(f64::from).collect();
    densities.sort_unstable_by(f64::total_cmp);
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
    /// Leaves that are large, or sampled from a crown volume, are asked at each vertex; so is wood, where
    /// the ambient term is the sky's.
    pub fn new(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> SkyPlan {
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
                None if plant.role(part) == Role::Wood && params.ambient != AmbientTerm::Sky => NOWHERE,
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
    /// Radius of the sky's balls, where the sky was asked.
    pub sky_radius: Option<f64>,
    /// Errors against the reference, where they were measured.
    pub errors: Vec<MeasuredError>,
}

/// Bakes all places.
pub(crate) fn values(plant: &Plant, foliage: &Foliage, places: &Places, params: &Params) -> Values {
    let wants_ambient = params.channels != Channels::Normals;
    let wants_normals = params.channels != Channels::Ambient;
    let mut values = Values::default();
    if wants_normals || params.ambient == AmbientTerm::Sky {
        let plan = SkyPlan::new(plant, foliage, places, params);
        let sky = Sky::new(foliage, params.sky_points());
        values.sky_radius = Some(sky.radius());
        let samples = sky.samples(&plan.queries);
        values.errors = measure::sky(&sky, foliage, &plan.queries, &samples, params);
        if wants_ambient && params.ambient == AmbientTerm::Sky {
            values.ambient = sky_ambients(&plan.of_place, &samples, params);
        }
        if wants_normals {
            values.normals = realigned(plant, places, &plan.of_place, &samples, params);
        }
    }
    if wants_ambient && params.ambient == AmbientTerm::Luft {
        let reference = reference_density(foliage, params);
        let field = Field::new(foliage.own(), foliage.radius);
        let mut densities = field.densities(&places.queries);
        let around = Field::new(&foliage.neighbors_near(&places.queries), foliage.radius);
        around.add_to(&mut densities, &places.queries);
        values.ambient = densities.par_iter().map(|&s| luft_ambient(f64::from(s), reference, params) as f32).collect();
        values.reference = Some(reference);
        values.errors.push(measure::luft(&[&field, &around], &places.queries, &values.ambient, reference, params));
    }
    values
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

/// Realigned normals of leaf parts, rest frame, mixed with the original ones (Luft07 section 4).
pub(crate) fn realigned(
    plant: &Plant,
    places: &Places,
    of_place: &[u32],
    samples: &[SkySample],
    params: &Params,
) -> Vec<Option<DVec3>> {
    places
        .vertices()
        .map(|(part, vertex, place)| {
            if plant.role(part) != Role::Leaf {
                return None;
            }
            let sky = samples.get(of_place[place] as usize).map_or(DVec3::Y, |s| s.direction);
            let original = original_normal(plant, part, vertex);
            Some(original.filter(|_| params.blend > 0.0).map_or(sky, |own| mix(sky, own, params.blend)))
        })
        .collect()
}

/// NORMAL in the rest frame, else the leaf's.
fn original_normal(plant: &Plant, part: usize, vertex: usize) -> Option<DVec3> {
    let own = plant.parts()[part].normals.get(vertex);
    let own = own.and_then(|n| plant.parts()[part].normal_to_rest(n.as_dvec3()).try_normalize());
    own.or_else(|| plant.leaves()[plant.leaf_of(part, vertex)? as usize].normal.as_dvec3().try_normalize())
}

/// The linear combination of two unit vectors; where it vanishes, the realigned one.
pub(crate) fn mix(realigned: DVec3, original: DVec3, share: f64) -> DVec3 {
    const VANISHING: f64 = 1e-6;
    let mixed = realigned * (1.0 - share) + original * share;
    if mixed.length() > VANISHING { mixed.normalize() } else { realigned }
}
