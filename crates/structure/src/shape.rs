//! What a piece looks like, in numbers that no rotation, shift or scale changes.

use crate::geometry::{PartGeometry, double_area};
use crate::pieces::position_bits;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// Shape of one piece. The center is area-weighted; `spread` is the root mean square distance of
/// the surface from it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PieceShape {
    pub area: f64,
    pub center: DVec3,
    /// Sum of area times normal.
    pub normal_sum: DVec3,
    /// Second central moments of the surface over its area.
    pub moments: DMat3,
    pub spread: f64,
    /// Squared Frobenius norm of the mean of n nᵀ: 1 flat, 1/2 a tube, 1/3 a ball.
    pub alignment: f64,
    /// Signed volume, the center joined to every triangle.
    pub volume: f64,
    /// Where the texture's v falls (its picture's top), area-weighted; zero without texture coordinates.
    pub up: DVec3,
    /// Triangles with area.
    pub triangles: usize,
    /// Every edge meets its opposite: a solid, or a sheet with both its sides.
    pub closed: bool,
}

/// What a piece is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// No area.
    Nothing,
    /// Flat or gently curved: leaf, card, petal.
    Sheet,
    /// As a sheet, but about as large as the plant: a silhouette.
    LargeSheet,
    /// A closed and full solid: a crown, or a ball of foliage.
    Blob,
    /// Tube, or branching body: neither flat nor full.
    Body,
}

/// A sheet's normals agree: the mean normal is at least this long (a half-cylinder has .64) ...
const SHEET_MEAN_NORMAL: f64 = 0.6;
/// ... or, both sides being there, n nᵀ agrees (a tube has .5, two planes at right angles .5).
const SHEET_ALIGNMENT: f64 = 0.65;
/// A blob fills at least this share of the ball with its spread (a cube has .87, a cone of height
/// three radii .75; trunks and branching bodies stay below .05, stubs of twigs reach .27).
const BLOB_FULLNESS: f64 = 0.4;
/// A blob stands for foliage only where its spread is at least this share of the plant's diagonal: berries do not.
const BLOB_SPREAD: f64 = 0.03;
/// A sheet is large from this share of the plant's diagonal on (a square as wide as a cube-shaped plant has .24).
const LARGE_SPREAD: f64 = 0.14;

impl PieceShape {
    /// Volume over that of the ball with the same spread.
    pub fn fullness(&self) -> f64 {
        let ball = 4.0 / 3.0 * std::f64::consts::PI * self.spread.powi(3);
        if ball > 0.0 { self.volume.abs() / ball } else { 0.0 }
    }

    pub fn form(&self, diagonal: f64) -> Form {
        if self.area <= 0.0 {
            Form::Nothing
        } else if self.normal_sum.length() >= SHEET_MEAN_NORMAL * self.area || self.alignment >= SHEET_ALIGNMENT {
            if self.spread >= LARGE_SPREAD * diagonal { Form::LargeSheet } else { Form::Sheet }
        } else if self.closed && self.fullness() >= BLOB_FULLNESS && self.spread >= BLOB_SPREAD * diagonal {
            Form::Blob
        } else {
            Form::Body
        }
    }
}

/// Shapes of all pieces of a part.
pub(crate) fn measure(part: &PartGeometry) -> Vec<PieceShape> {
    (0..part.pieces.count()).into_par_iter().map(|piece| measure_piece(part, part.pieces.triangles(piece))).collect()
}

fn measure_piece(part: &PartGeometry, triangles: &[u32]) -> PieceShape {
    let with_area = || triangles.iter().copied().filter(|&t| part.has_area[t as usize]);
    let Some(first) = with_area().next() else { return PieceShape::default() };
    // Relative to a point of the piece: nothing cancels.
    let origin = part.corners(first)[0];
    let (mut area, mut volume) = (0.0, 0.0);
    let (mut first_moment, mut normal_sum) = (DVec3::ZERO, DVec3::ZERO);
    let (mut second, mut normals) = (DMat3::ZERO, DMat3::ZERO);
    for triangle in with_area() {
        let [a, b, c] = part.corners(triangle).map(|p| p - origin);
        let vector = double_area([a, b, c]) * 0.5;
        let size = vector.length();
        let sum = a + b + c;
        area += size;
        normal_sum += vector;
        first_moment += sum * (size / 3.0);
        second += (outer(a) + outer(b) + outer(c) + outer(sum)) * (size / 12.0);
        normals += outer(vector) * (1.0 / size);
        volume += a.dot(b.cross(c)) / 6.0;
    }
    let mean = first_moment / area;
    let moments = second * (1.0 / area) - outer(mean);
    let closed = is_closed(part, triangles);
    let up = with_area().map(|t| picture_up(part, t)).sum();
    PieceShape {
        area,
        center: origin + mean,
        normal_sum,
        moments,
        spread: (moments.x_axis.x + moments.y_axis.y + moments.z_axis.z).max(0.0).sqrt(),
        alignment: square_norm(normals) / (area * area),
        // Moving the apex from the origin to the center changes the volume of an open piece only.
        volume: volume - mean.dot(normal_sum) / 3.0,
        up,
        triangles: with_area().count(),
        closed,
    }
}

/// The direction in which a triangle's picture rises (glTF: v falls), as long as the triangle's area.
fn picture_up(part: &PartGeometry, triangle: u32) -> DVec3 {
    let [a, b, c] = part.part.triangles[triangle as usize].map(|v| v as usize);
    let Some(&[v_a, v_b, v_c]) = part
        .part
        .uvs
        .get(a)
        .zip(part.part.uvs.get(b))
        .zip(part.part.uvs.get(c))
        .map(|((a, b), c)| [a, b, c].map(|uv| f64::from(uv.y)))
        .as_ref()
    else {
        return DVec3::ZERO;
    };
    let corners = part.corners(triangle);
    let (e, f) = (corners[1] - corners[0], corners[2] - corners[0]);
    let (ee, ff, ef) = (e.dot(e), f.dot(f), e.dot(f));
    let (rise_e, rise_f) = (v_a - v_b, v_a - v_c);
    let gradient = e * (rise_e * ff - rise_f * ef) + f * (rise_f * ee - rise_e * ef);
    gradient.normalize_or_zero() * (0.5 * double_area(corners).length())
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// Sum of the squares of all elements.
pub(crate) fn square_norm(m: DMat3) -> f64 {
    m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()
}

/// Whether each directed edge of the piece is met by its opposite, seams closed: positions that are
/// equal to the bit are one. Triangles without area do not count.
fn is_closed(part: &PartGeometry, triangles: &[u32]) -> bool {
    let mut edges: Vec<(EdgeEnd, EdgeEnd, i8)> = Vec::with_capacity(3 * triangles.len());
    for &triangle in triangles.iter().filter(|&&t| part.has_area[t as usize]) {
        let ends = part.part.triangles[triangle as usize].map(|v| position_bits(part.part, v));
        for (from, to) in [(ends[0], ends[1]), (ends[1], ends[2]), (ends[2], ends[0])] {
            if from != to {
                edges.push(if from < to { (from, to, 1) } else { (to, from, -1) });
            }
        }
    }
    edges.sort_unstable();
    let same_edge = |a: &(EdgeEnd, EdgeEnd, i8), b: &(EdgeEnd, EdgeEnd, i8)| a.0 == b.0 && a.1 == b.1;
    !edges.is_empty() && edges.chunk_by(same_edge).all(|uses| uses.iter().map(|e| i32::from(e.2)).sum::<i32>() == 0)
}

type EdgeEnd = [u32; 3];
