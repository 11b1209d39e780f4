//! Rows of the table of leaves, in the order of the leaves' first vertices.

use crate::coverage::CoverageTables;
use crate::crown::{self, Sample};
use crate::geometry::{Geometry, PartGeometry, double_area};
use crate::groups::{Groups, group};
use crate::petiole::Wood;
use crate::shape::{Form, PieceShape};
use crate::{StructureError, StructureParams};
use foliar_plant::{Leaf, NO_LEAF, Structure};
use foliar_schema::Role;
use glam::DVec3;
use rayon::prelude::*;

/// Virtual leaves of a plant where nobody says how far apart.
const CROWN_LEAVES: f64 = 1000.0;
/// Largest number of leaves: ids are floats.
const MOST_LEAVES: usize = 1 << 24;
/// A mean normal shorter than this says nothing: both sides of a sheet are there, or it is a ball.
const NORMAL_SAYS: f64 = 0.1;
/// Edge of a square in units of its spread, sqrt(6).
const SIZE_PER_SPREAD: f64 = 2.449_489_742_783_178;

/// What was found, with what was left out.
pub(crate) struct Found {
    pub structure: Structure,
    /// Pieces of leaf parts without area.
    pub zero_area: usize,
    /// Distance between virtual leaves, where there are any.
    pub crown_spacing: Option<f64>,
}

/// A piece that becomes one leaf, or many.
struct Candidate {
    part: usize,
    piece: usize,
    shape: PieceShape,
    blob: bool,
    /// Alpha coverage, area-weighted.
    coverage: f64,
}

/// Finds all leaves.
pub(crate) fn find(
    geometry: &Geometry,
    shapes: &[Vec<PieceShape>],
    roles: Vec<Role>,
    params: &StructureParams,
) -> Result<Found, StructureError> {
    let coverage = coverage_of_parts(geometry, &roles);
    let (candidates, zero_area) = candidates(geometry, shapes, &roles, &coverage);
    let crown_area: f64 = candidates.iter().filter(|c| c.blob).map(|c| c.shape.area).sum();
    let spacing = params.crown_spacing_m.unwrap_or((crown_area / CROWN_LEAVES).sqrt());
    let counts: Vec<usize> =
        candidates.iter().map(|c| if c.blob { crown::sample_count(c.shape.area, spacing) } else { 1 }).collect();
    let count = counts.iter().fold(0usize, |sum, &n| sum.saturating_add(n));
    if count > MOST_LEAVES {
        return Err(StructureError::TooMany { count });
    }
    let singles: Vec<PieceShape> = candidates.iter().filter(|c| !c.blob).map(|c| c.shape).collect();
    let groups = group(&singles);
    let wood = Wood::new(geometry, &roles);
    let petioles: Vec<DVec3> = candidates
        .par_iter()
        .map(|c| {
            let size = c.shape.spread * SIZE_PER_SPREAD;
            if c.blob { c.shape.center } else { wood.petiole(&geometry.parts[c.part], c.piece, c.shape.center, size) }
        })
        .collect();
    let mut rows = Rows::new(geometry, &roles);
    let mut single = 0;
    for ((candidate, &count), petiole) in candidates.iter().zip(&counts).zip(petioles) {
        if candidate.blob {
            let part = &geometry.parts[candidate.part];
            let alpha = &coverage[candidate.part];
            rows.add_crown(candidate, crown::sample(part, candidate.piece, &candidate.shape, alpha, count));
        } else {
            rows.add_leaf(candidate, petiole, &groups, single);
            single += 1;
        }
    }
    let crown_spacing = (crown_area > 0.0).then_some(spacing);
    Ok(Found { structure: rows.finish(roles), zero_area, crown_spacing })
}

fn coverage_of_parts(geometry: &Geometry, roles: &[Role]) -> Vec<Vec<f64>> {
    let mut tables = CoverageTables::new(geometry.base);
    let parts = geometry.parts.iter().zip(roles);
    parts.map(|(p, role)| if *role == Role::Leaf { tables.of_part(p.part) } else { Vec::new() }).collect()
}

fn candidates(
    geometry: &Geometry,
    shapes: &[Vec<PieceShape>],
    roles: &[Role],
    coverage: &[Vec<f64>],
) -> (Vec<Candidate>, usize) {
    let (mut found, mut zero_area) = (Vec::new(), 0);
    for (part, _) in roles.iter().enumerate().filter(|(_, role)| **role == Role::Leaf) {
        for (piece, shape) in shapes[part].iter().enumerate() {
            let form = shape.form(geometry.diagonal);
            if form == Form::Nothing {
                zero_area += 1;
                continue;
            }
            let coverage = mean_coverage(&geometry.parts[part], piece, &coverage[part]);
            found.push(Candidate { part, piece, shape: *shape, blob: form == Form::Blob, coverage });
        }
    }
    (found, zero_area)
}

fn mean_coverage(part: &PartGeometry, piece: usize, coverage: &[f64]) -> f64 {
    let (mut covered, mut area) = (0.0, 0.0);
    for &triangle in part.pieces.triangles(piece).iter().filter(|&&t| part.has_area[t as usize]) {
        let size = double_area(part.corners(triangle)).length();
        covered += size * coverage[triangle as usize];
        area += size;
    }
    covered / area
}

/// Rows as they are added.
struct Rows<'a> {
    geometry: &'a Geometry<'a>,
    leaves: Vec<Leaf>,
    leaf_ids: Vec<Vec<u32>>,
    /// Per part, per piece: id of its (first) leaf.
    piece_ids: Vec<Vec<u32>>,
    /// Group of a single leaf's group, numbered among virtual leaves too.
    group_of: Vec<u32>,
    groups: u32,
}

impl<'a> Rows<'a> {
    fn new(geometry: &'a Geometry<'a>, roles: &[Role]) -> Self {
        let lists = |empty: fn(&PartGeometry) -> usize| {
            let parts = geometry.parts.iter().zip(roles);
            parts.map(|(p, role)| if *role == Role::Leaf { vec![NO_LEAF; empty(p)] } else { Vec::new() }).collect()
        };
        Rows {
            geometry,
            leaves: Vec::new(),
            leaf_ids: lists(|p| p.positions.len()),
            piece_ids: lists(|p| p.pieces.count()),
            group_of: Vec::new(),
            groups: 0,
        }
    }

    /// One-sided area: half of what has both its sides (closed), and sheets that lie on one another
    /// share the area of one. Sums over a group are the one-sided area of the object.
    fn add_leaf(&mut self, candidate: &Candidate, petiole: DVec3, groups: &Groups, single: usize) {
        let shape = &candidate.shape;
        let sides = if shape.closed { 2.0 } else { 1.0 };
        let area = shape.area * candidate.coverage / (sides * f64::from(groups.doubles[single]));
        let part = &self.geometry.parts[candidate.part];
        let group = groups.of_leaf[single] as usize;
        if group == self.group_of.len() {
            self.group_of.push(self.groups);
            self.groups += 1;
        }
        self.piece_ids[candidate.part][candidate.piece] = self.leaves.len() as u32;
        self.leaves.push(Leaf {
            center: (self.geometry.center + shape.center).as_vec3(),
            normal: leaf_normal(part, candidate.piece, shape).as_vec3(),
            area: area as f32,
            group: self.group_of[group],
            petiole: (self.geometry.center + petiole).as_vec3(),
            crown_volume: false,
        });
    }

    /// Each virtual leaf stands for an equal part of the blob's surface and is a group of its own.
    fn add_crown(&mut self, candidate: &Candidate, samples: Vec<Sample>) {
        let first = self.leaves.len() as u32;
        let share = candidate.shape.area / samples.len() as f64;
        for sample in &samples {
            let center = (self.geometry.center + sample.center).as_vec3();
            self.leaves.push(Leaf {
                center,
                normal: sample.normal.as_vec3(),
                area: (share * sample.coverage) as f32,
                group: self.groups,
                petiole: center,
                crown_volume: true,
            });
            self.groups += 1;
        }
        let part = &self.geometry.parts[candidate.part];
        let triangles = part.pieces.triangles(candidate.piece);
        let mut of_piece: Vec<usize> =
            triangles.iter().flat_map(|&t| part.part.triangles[t as usize]).map(|v| v as usize).collect();
        of_piece.sort_unstable();
        of_piece.dedup();
        let places = of_piece.iter().map(|&v| part.positions[v]);
        let nearest = crown::nearest_samples(&samples, places, &candidate.shape);
        of_piece.iter().zip(nearest).for_each(|(&v, sample)| self.leaf_ids[candidate.part][v] = first + sample);
    }

    fn finish(mut self, roles: Vec<Role>) -> Structure {
        for ((part, ids), of_piece) in self.geometry.parts.iter().zip(&mut self.leaf_ids).zip(&self.piece_ids) {
            for (id, &piece) in ids.iter_mut().zip(&part.pieces.of_vertex) {
                if *id == NO_LEAF && piece != u32::MAX {
                    *id = of_piece[piece as usize];
                }
            }
        }
        Structure { roles, leaves: self.leaves, leaf_ids: self.leaf_ids }
    }
}

/// Unit normal on the side of the first face: the mean, or, where the sides cancel, the mean with each
/// face turned to the side of the first.
fn leaf_normal(part: &PartGeometry, piece: usize, shape: &PieceShape) -> DVec3 {
    let faces = part.pieces.triangles(piece).iter().filter(|&&t| part.has_area[t as usize]);
    let vectors: Vec<DVec3> = faces.map(|&t| double_area(part.corners(t))).collect();
    let first = vectors[0];
    let turned = |v: DVec3| if v.dot(first) < 0.0 { -v } else { v };
    if shape.normal_sum.length() >= NORMAL_SAYS * shape.area {
        turned(shape.normal_sum).normalize_or(DVec3::Y)
    } else {
        vectors.into_iter().map(turned).sum::<DVec3>().normalize_or(DVec3::Y)
    }
}
