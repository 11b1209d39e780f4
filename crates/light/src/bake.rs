//! The bake: places of a plant, depths there, extinction, harmonics.

use crate::choose;
use crate::crown::{Crown, EXACT, order_of};
use crate::leaves::{Foliage, NO_GROUP, Query};
use crate::octants::OCTANTS;
use crate::params::{DepthEngine, Params, SunModel};
use crate::rays::{HARMONICS, Scene};
use crate::{reference, ways};
use foliar_bake::BakeError;
use foliar_plant::Plant;
use foliar_schema::{MeasuredError, Role};

/// Everything that a bake computes, before it is written into arrays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values {
    /// Optical depths per leaf, not capped.
    pub leaves: Vec<[f32; OCTANTS]>,
    /// Part, and depths of its vertices; one for each part of wood.
    pub wood: Vec<(usize, Vec<[f32; OCTANTS]>)>,
    /// Coefficients of the transmittance per leaf; empty where nobody asks.
    pub harmonics: Vec<[f32; HARMONICS]>,
    pub engine: DepthEngine,
    /// Of the tree, where it was used.
    pub opening: Option<f64>,
    /// tau of Boulanger08.
    pub extinction_per_m: f64,
    /// rho, from tau and the mean area: number of leaves in a medium of that extinction.
    pub leaves_per_m3: f64,
    /// A, alpha coverage in.
    pub mean_area_m2: f64,
    pub errors: Vec<MeasuredError>,
}

/// Places that ask: leaves, then the vertices of wood, part by part.
pub(crate) struct Places {
    pub queries: Vec<Query>,
    /// Each part of wood, with its first place.
    wood: Vec<(usize, usize)>,
}

impl Places {
    /// All places of a plant.
    pub fn new(plant: &Plant, foliage: &Foliage) -> Places {
        let mut places = Places { queries: foliage.queries(), wood: Vec::new() };
        for (index, part) in plant.parts().iter().enumerate().filter(|(i, _)| plant.role(*i) == Role::Wood) {
            places.wood.push((index, places.queries.len()));
            let query = |vertex| Query { position: foliage.place(part.rest_position(vertex)), skip: NO_GROUP };
            places.queries.extend((0..part.positions.len()).map(query));
        }
        places
    }
}

/// How far leaves reach is looked up for at most so many of them, evenly spread in space: extinction is a mean.
const WAYS: usize = 4096;

/// Bakes all places.
///
/// # Errors
/// [`BakeError::Parameter`] where rays cannot be cast.
pub(crate) fn values(plant: &Plant, params: &Params) -> Result<Values, BakeError> {
    let foliage = Foliage::new(plant);
    let places = Places::new(plant, &foliage);
    let crown = Crown::new(&foliage.sources, params.profile);
    let leaves = &places.queries[..foliage.sources.len()];
    let mut values = Values { engine: params.engine, ..Values::default() };
    let casts = params.engine == DepthEngine::Rays || params.sun == SunModel::Harmonics;
    let scene = if casts { Some(Scene::new(plant, &foliage)?) } else { None };
    let depths = match scene.as_ref().filter(|_| params.engine == DepthEngine::Rays) {
        Some(scene) => scene.depths(&places.queries, &order_of(&places.queries), params.rays),
        None => {
            let chosen = choose::depths(&crown, &foliage.sources, &places.queries, params);
            values.engine = if chosen.opening > EXACT { DepthEngine::Tree } else { DepthEngine::Exact };
            values.opening = Some(chosen.opening);
            values.errors = chosen.errors;
            chosen.depths
        }
    };
    if let Some(scene) = scene.as_ref().filter(|_| params.sun == SunModel::Harmonics) {
        values.harmonics = scene.harmonics(leaves, &order_of(leaves), params.rays);
    }
    let order = order_of(leaves);
    let asked = choose::spread(leaves.len(), WAYS).into_iter().map(|at| order[at] as usize);
    let (asked, seen): (Vec<Query>, Vec<_>) = asked.map(|at| (leaves[at], depths[at])).unzip();
    let mean_area = reference::mean_area(&foliage.sources);
    values.set_medium(&foliage, mean_area, ways::extinction(&crown, &asked, &seen, mean_area));
    values.deal_out(&places, depths);
    Ok(values)
}

/// The same by the shortest program.
pub(crate) fn reference_values(plant: &Plant, params: &Params) -> Values {
    let foliage = Foliage::new(plant);
    let places = Places::new(plant, &foliage);
    let sums = reference::sums(&foliage.sources, &places.queries, params.profile);
    let mean_area = reference::mean_area(&foliage.sources);
    let mut values = Values { engine: DepthEngine::Exact, opening: Some(EXACT), ..Values::default() };
    values.set_medium(&foliage, mean_area, reference::extinction(&sums[..foliage.sources.len()], mean_area));
    values.deal_out(&places, sums.iter().map(|sum| sum.depth.map(|depth| depth as f32)).collect());
    values
}

impl Values {
    /// Extinction and mean area, in units of the foliage, back to meters.
    fn set_medium(&mut self, foliage: &Foliage, mean_area: f64, extinction: f64) {
        self.mean_area_m2 = mean_area * foliage.unit_m * foliage.unit_m;
        self.extinction_per_m = extinction / foliage.unit_m;
        // Never from a hull: in clumped crowns that leaves out half of the light that bounces and more.
        self.leaves_per_m3 = if mean_area > 0.0 { 2.0 * self.extinction_per_m / self.mean_area_m2 } else { 0.0 };
    }

    /// Depths of all places to leaves and parts.
    fn deal_out(&mut self, places: &Places, mut depths: Vec<[f32; OCTANTS]>) {
        for &(part, start) in places.wood.iter().rev() {
            self.wood.push((part, depths.split_off(start)));
        }
        self.wood.reverse();
        self.leaves = depths;
    }
}
