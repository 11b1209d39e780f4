//! From a scan to maps (Kusternig07 section 3.5): a closed mesh of a leaf, or heights of its two sides, gives thickness,
//! relief and normals of both sides, in millimeters.
//!
//! What is not closed or faces the wrong way is said, never filled.

mod cast;
mod frame;
mod heights;
mod room;
mod solid;
mod unwrap;

pub use cast::project;
pub use frame::Frame;
pub use heights::{between_heights, normals_within};
pub use room::{Leafscan, ScanParams, Unwrap};
pub use solid::{Faults, ScanError, Solid};
pub use unwrap::in_texture;

/// Both sides of a leaf, texel by texel, rows from the top. The back's maps lie on the front's picture: what is right on
/// the front is right on the back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scan {
    /// Texels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Edges of a texel, mm: across and down.
    pub texel_mm: [f64; 2],
    /// Thickness, mm; 0 where there is no leaf.
    pub thickness_mm: Vec<f32>,
    /// How far front and back stand out of the leaf's middle plane, each outward, mm.
    pub heights_mm: [Vec<f32>; 2],
    /// Unit normals of front and back: x image right, y image up, z outward.
    pub normals: [Vec<[f32; 3]>; 2],
    /// Texels whose ray did not go in and out in turn: left empty.
    pub broken: Vec<usize>,
    /// Texels where the leaf lies over itself: the layer next to the front is taken.
    pub folded: usize,
    /// Texels of the picture that two places of the front claim: the first is taken.
    pub overlapping: usize,
}

impl Scan {
    fn empty(width: usize, height: usize, texel_mm: [f64; 2]) -> Scan {
        let texels = width * height;
        let heights_mm = [vec![0.0; texels], vec![0.0; texels]];
        Scan { width, height, texel_mm, thickness_mm: vec![0.0; texels], heights_mm, ..Scan::default() }
    }

    /// Normals of both sides from their heights.
    fn with_normals(mut self) -> Scan {
        let leaf = |at: usize| self.thickness_mm[at] > 0.0;
        self.normals = [0, 1].map(|side| normals_within(&self.heights_mm[side], self.width, self.texel_mm, &leaf));
        self
    }

    /// Texels of the leaf.
    pub fn covered(&self) -> usize {
        self.thickness_mm.iter().filter(|d| **d > 0.0).count()
    }

    /// Mean slope of the leaf's middle: what a thickness along the axis is too large for. 0 for a leaf that lies flat.
    pub fn bend(&self) -> f64 {
        let leaf = |at: usize| self.thickness_mm[at] > 0.0;
        let middle: Vec<f32> =
            self.heights_mm[0].iter().zip(&self.heights_mm[1]).map(|(front, back)| (front - back) / 2.0).collect();
        let normals = normals_within(&middle, self.width, self.texel_mm, &leaf);
        let slopes = normals.iter().enumerate().filter(|(at, _)| leaf(*at));
        let sum: f64 = slopes.map(|(_, n)| f64::from(libm::hypotf(n[0], n[1]) / n[2])).sum();
        sum / self.covered().max(1) as f64
    }
}
