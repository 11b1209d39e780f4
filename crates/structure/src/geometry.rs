//! Parts as structure sees them: positions in the rest frame, in f64 and relative to the plant's
//! center, with their pieces.

use crate::pieces::{Pieces, find_pieces};
use foliar_plant::{Base, Part};
use glam::DVec3;

/// A triangle counts as one without area where twice its area is below this share of its longest
/// edge's square: f32 coordinates of a triangle that far from the origin cannot tell it from a line.
const AREALESS: f64 = 1e-7;

/// One part, ready to be measured.
pub(crate) struct PartGeometry<'a> {
    pub part: &'a Part,
    /// Rest frame, meters, relative to the center of the base's box.
    pub positions: Vec<DVec3>,
    pub pieces: Pieces,
    /// Per triangle: has it area?
    pub has_area: Vec<bool>,
}

impl PartGeometry<'_> {
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.part.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }
}

/// The whole base, ready to be measured.
pub(crate) struct Geometry<'a> {
    pub base: &'a Base,
    pub parts: Vec<PartGeometry<'a>>,
    /// Center of the box around all vertices that a triangle uses.
    pub center: DVec3,
    /// Diagonal of that box.
    pub diagonal: f64,
}

impl<'a> Geometry<'a> {
    pub fn new(base: &'a Base) -> Self {
        Geometry::of(base, |_| true)
    }

    /// Only of the parts that `take` names; others stay empty.
    pub fn of(base: &'a Base, take: impl Fn(usize) -> bool) -> Self {
        let (low, high) = bounds(base, &take);
        let center = low.midpoint(high);
        let mut scratch = vec![u32::MAX; base.position_count as usize];
        let parts = base
            .parts
            .iter()
            .enumerate()
            .map(|(index, part)| {
                if !take(index) {
                    return PartGeometry {
                        part,
                        positions: Vec::new(),
                        pieces: Pieces::default(),
                        has_area: Vec::new(),
                    };
                }
                let positions: Vec<DVec3> = (0..part.positions.len()).map(|v| part.rest_position(v) - center).collect();
                let has_area = part.triangles.iter().map(|t| has_area(t.map(|v| positions[v as usize]))).collect();
                PartGeometry { part, positions, pieces: find_pieces(part, &mut scratch), has_area }
            })
            .collect();
        Geometry { base, parts, center, diagonal: (high - low).length() }
    }
}

/// Twice the area of a triangle, as a vector on its front side.
pub(crate) fn double_area([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

fn has_area(corners: [DVec3; 3]) -> bool {
    let [a, b, c] = corners;
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    double_area(corners).length() > AREALESS * longest
}

fn bounds(base: &Base, take: impl Fn(usize) -> bool) -> (DVec3, DVec3) {
    let parts = base.parts.iter().enumerate().filter(|(i, _)| take(*i)).map(|(_, p)| p);
    let used = parts.flat_map(|p| p.triangles.iter().flatten().map(|&v| p.rest_position(v as usize)));
    let box_around = used.fold(None, |bounds: Option<(DVec3, DVec3)>, p| {
        let (low, high) = bounds.unwrap_or((p, p));
        Some((low.min(p), high.max(p)))
    });
    box_around.unwrap_or_default()
}
