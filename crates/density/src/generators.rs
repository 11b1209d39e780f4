//! Leaves to balls (Luft07 section 3): one ball per leaf, weighted by area; several for a leaf that is
//! larger than the radius of influence.

use crate::field::Query;
use crate::params::{GeneratorKind, Params};
use crate::subsample::subsample;
use crate::tessellate::{Spread, primitives};
use foliar_bake::{Inputs, Placed};
use foliar_numerics::CompensatedSum;
use foliar_plant::Plant;
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Ordering;

/// The group of a query that leaves nothing out.
pub const NO_GROUP: u32 = u32::MAX;
/// The group of neighbors' balls: no query leaves it out.
const NEIGHBOR_GROUP: u32 = u32::MAX - 1;

/// One ball (a metaball's center of Luft07 eq. 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Generator {
    /// Meters, relative to the plant's center.
    pub position: DVec3,
    /// 0 or above; the mean over the plant's leaves with area is 1.
    pub weight: f32,
    /// The leaf's group.
    pub group: u32,
}

/// The balls of a plant and its neighbors.
#[derive(Clone, Debug)]
pub struct Foliage {
    /// The plant's own balls first, then the neighbors'.
    pub generators: Vec<Generator>,
    /// How many are the plant's own.
    pub own: usize,
    /// Number of balls of each neighbor.
    stands: Vec<usize>,
    /// Radius of influence, meters.
    pub radius: f64,
    /// Area that a weight of 1 stands for, m^2: of a mean leaf, or of a mean primitive.
    pub mean_area: f64,
    /// Per leaf: distance from its center to its farthest vertex, meters (0 without vertices).
    pub extents: Vec<f64>,
}

/// Bounds of the radius of influence relative to the plant's size: beyond them f32 coordinates tell
/// nothing apart, or all leaves are at one place.
const RADIUS_PER_SIZE: [f64; 2] = [1.0 / 65536.0, 65536.0];
/// Bounds of the radius of influence in meters: its cube and inverse stay finite.
const RADIUS_M: [f64; 2] = [1e-30, 1e30];
/// Automatic radius in radii of gyration of the crown: .5 m for a crown 8 m wide, which still tells boughs
/// apart.
const RADIUS_PER_GYRATION: f64 = 0.16;
/// For few leaves, in radii of gyration over the cube root of their number: the median leaf then has a
/// dozen neighbors or more on the shared trees (.13 alone leaves it 3 of 704, and 57 of 39,060).
const RADIUS_PER_SPACING: f64 = 2.2;
/// Most of the crown that the size of its leaves may make the radius, in radii of gyration.
const MOST_FOR_LEAF_SIZE: f64 = 0.4;
/// Edge of a square leaf whose farthest vertex is 1 from its center.
const EDGE_PER_EXTENT: f64 = std::f64::consts::SQRT_2;

impl Foliage {
    /// The balls that a plant and its neighbors make; the order of the neighbors does not matter.
    pub fn new(plant: &Plant, neighbors: &[Placed], params: &Params) -> Foliage {
        let extents = extents(plant);
        let radius = clamp_radius(params.radius_m.unwrap_or_else(|| automatic_radius(plant, &extents)), plant);
        let total: CompensatedSum = plant.leaves().iter().map(|leaf| f64::from(leaf.area)).collect();
        let count = match params.generators {
            GeneratorKind::Primitive => primitives(plant).len(),
            _ => plant.leaves().iter().filter(|leaf| leaf.area > 0.0).count(),
        };
        let mean_area = total.value() / count.max(1) as f64;
        let mut foliage = Foliage { generators: Vec::new(), own: 0, stands: Vec::new(), radius, mean_area, extents };
        foliage.generators = foliage.balls(plant, &foliage.extents, params, None);
        foliage.own = foliage.generators.len();
        let stand = |neighbor: &Placed| {
            let own_extents = self::extents(&neighbor.plant);
            foliage.balls(&neighbor.plant, &own_extents, params, Some((neighbor, plant.center())))
        };
        let mut stands: Vec<Vec<Generator>> = neighbors.iter().map(stand).collect();
        stands.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| before(a, b)));
        foliage.stands = stands.iter().map(Vec::len).collect();
        foliage.generators.extend(stands.into_iter().flatten());
        foliage
    }

    /// The plant's own balls.
    pub fn own(&self) -> &[Generator] {
        &self.generators[..self.own]
    }

    /// The balls of the plant, then of each neighbor.
    pub fn stands(&self) -> impl Iterator<Item = &[Generator]> {
        let mut rest = &self.generators[self.own..];
        let neighbors = self.stands.iter().map(move |&count| {
            let (stand, others) = rest.split_at(count);
            rest = others;
            stand
        });
        std::iter::once(self.own()).chain(neighbors)
    }

    /// The neighbors' balls that reach into the box around these places.
    pub fn neighbors_near(&self, places: &[Query]) -> Vec<Generator> {
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let grow = |(low, high): (DVec3, DVec3), query: &Query| (low.min(query.position), high.max(query.position));
        let (low, high) = places.iter().fold(none, grow);
        let reach = DVec3::splat(self.radius);
        let near =
            |ball: &&Generator| ball.position.cmpge(low - reach).all() && ball.position.cmple(high + reach).all();
        self.generators[self.own..].iter().filter(near).copied().collect()
    }

    /// Whether a leaf needs more than one ball, and values at its vertices rather than at its center.
    pub fn is_large(&self, leaf: u32) -> bool {
        EDGE_PER_EXTENT * self.extents[leaf as usize] > self.radius
    }

    /// The balls of one plant, and of a neighbor where it stands relative to the center of the plant.
    fn balls(
        &self,
        plant: &Plant,
        extents: &[f64],
        params: &Params,
        neighbor: Option<(&Placed, DVec3)>,
    ) -> Vec<Generator> {
        let scale = neighbor.map_or(1.0, |(n, _)| libm::cbrt(n.transform.matrix3.determinant().abs()));
        let mut balls = match params.generators {
            GeneratorKind::Primitive => {
                primitives(plant).into_iter().map(|(at, leaf)| ball(plant, leaf, at, 1.0)).collect()
            }
            kind => self.leaf_balls(plant, extents, kind, scale),
        };
        subsample(&mut balls, params.subsample);
        if let Some((n, center)) = neighbor {
            for ball in &mut balls {
                ball.position = n.transform.transform_point3(ball.position + plant.center()) - center;
                ball.group = NEIGHBOR_GROUP;
            }
        }
        balls
    }

    /// A ball per leaf of a plant that is scaled, several for a large leaf, relative to its own center.
    fn leaf_balls(&self, plant: &Plant, extents: &[f64], kind: GeneratorKind, scale: f64) -> Vec<Generator> {
        let is_large = |leaf: usize| EDGE_PER_EXTENT * extents[leaf] * scale > self.radius;
        let spread = Spread::new(plant, &is_large, self.radius / scale);
        let mut balls = Vec::with_capacity(plant.leaves().len());
        for (id, leaf) in (0u32..).zip(plant.leaves()).filter(|(_, leaf)| leaf.area > 0.0) {
            let weight = match kind {
                GeneratorKind::Leaf if self.mean_area > 0.0 => f64::from(leaf.area) * scale * scale / self.mean_area,
                _ => 1.0,
            };
            let alone = [(leaf.center.as_dvec3() - plant.center(), 1.0)];
            let places = spread.of(id).unwrap_or(&alone).iter();
            balls.extend(places.map(|&(at, share)| ball(plant, id, at, weight * share)));
        }
        balls
    }
}

fn ball(plant: &Plant, leaf: u32, position: DVec3, weight: f64) -> Generator {
    Generator { position, weight: weight as f32, group: plant.leaves()[leaf as usize].group }
}

/// An order of two lists of as many balls that depends on where they are only.
fn before(a: &[Generator], b: &[Generator]) -> Ordering {
    let order = |(a, b): (&Generator, &Generator)| {
        let (p, q) = (a.position, b.position);
        let along = p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z));
        along.then(a.weight.total_cmp(&b.weight))
    };
    a.iter().zip(b).map(order).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

/// The balls that `inputs` make; `None` without a plant or without leaves.
pub(crate) fn foliage(inputs: &Inputs, params: &Params) -> Option<Foliage> {
    let plant = inputs.plant.filter(|plant| !plant.leaves().is_empty())?;
    Some(Foliage::new(plant, inputs.neighbors, params))
}

fn extents(plant: &Plant) -> Vec<f64> {
    let mut squares = vec![0.0f64; plant.leaves().len()];
    for (index, part) in plant.parts().iter().enumerate() {
        let square = |vertex: usize| {
            let leaf = plant.leaf_of(index, vertex).map(|leaf| &plant.leaves()[leaf as usize])?;
            let arm = part.rest_position(vertex) - leaf.center.as_dvec3();
            (!leaf.crown_volume).then_some(arm.length_squared())
        };
        let of_vertices: Vec<Option<f64>> = (0..part.positions.len()).into_par_iter().map(square).collect();
        for (vertex, square) in of_vertices.into_iter().enumerate() {
            if let (Some(leaf), Some(square)) = (plant.leaf_of(index, vertex), square) {
                squares[leaf as usize] = squares[leaf as usize].max(square);
            }
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

fn clamp_radius(radius: f64, plant: &Plant) -> f64 {
    let size = plant.size().max_element();
    let [low, high] = if size > 0.0 { RADIUS_PER_SIZE.map(|r| r * size) } else { RADIUS_M };
    radius.clamp(low, high).clamp(RADIUS_M[0], RADIUS_M[1])
}

/// A share of the crown's radius of gyration (which no single outlying twig moves, and no rotation);
/// more where leaves are few, so that the median leaf sees neighbors at all, or large: below the size of
/// a leaf, density tells of leaves and not of the crown.
fn automatic_radius(plant: &Plant, extents: &[f64]) -> f64 {
    let sum = |term: &dyn Fn(usize) -> f64| (0..plant.leaves().len()).map(term).collect::<CompensatedSum>().value();
    let area = |leaf: usize| f64::from(plant.leaves()[leaf].area);
    let arm = |leaf: usize| plant.leaves()[leaf].center.as_dvec3() - plant.center();
    let total = sum(&area);
    if total <= 0.0 {
        return plant.size().max_element();
    }
    let mean = DVec3::from_array([0, 1, 2].map(|axis| sum(&|leaf| area(leaf) * arm(leaf)[axis]) / total));
    // A disk's own second moment about its center: half its radius squared.
    let square = |leaf: usize| (arm(leaf) - mean).length_squared() + extents[leaf] * extents[leaf] / 2.0;
    let gyration = (sum(&|leaf| area(leaf) * square(leaf)) / total).sqrt();
    let effective = total * total / sum(&|leaf| area(leaf) * area(leaf));
    let mut sizes = extents.to_vec();
    sizes.par_sort_unstable_by(f64::total_cmp);
    let leaf_size = EDGE_PER_EXTENT * crate::fast::median(&sizes);
    let spacing = (RADIUS_PER_SPACING / libm::cbrt(effective)).min(1.0);
    (gyration * RADIUS_PER_GYRATION.max(spacing)).max(leaf_size.min(gyration * MOST_FOR_LEAF_SIZE))
}
