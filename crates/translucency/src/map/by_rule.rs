//! A leaf by rule, at any resolution: blade, veins of four orders, thin rim with teeth, blade that bulges between its veins.
//!
//! For tests, benchmarks and pictures: nobody's photograph, so nobody's license.

use super::LeafMap;
use super::normals_from_heights;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Width of the leaf's picture, mm.
pub const WIDTH_MM: f64 = 80.0;
/// Share of the thickness that stands out on the front; the rest stands out on the back.
const FRONT_SHARE: f64 = 0.3;

/// Both sides of a leaf: the front as lit, and the back as lit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafByRule {
    /// The front is lit.
    pub front: LeafMap,
    /// The back is lit, its maps on the front's texture coordinates.
    pub back: LeafMap,
    /// Edge of a texel, mm.
    pub texel_mm: f64,
}

/// A leaf on `size` x `size` texels.
pub fn leaf_by_rule(size: usize) -> LeafByRule {
    let texel_mm = WIDTH_MM / size as f64;
    let place = |at: usize| DVec2::new((at % size) as f64 + 0.5, (at / size) as f64 + 0.5) / size as f64;
    let forms: Vec<(f64, f64)> = (0..size * size).into_par_iter().map(|at| form(place(at))).collect();
    let thickness_mm: Vec<f32> = forms.iter().map(|form| form.0 as f32).collect();
    let side = |height: fn(&(f64, f64)) -> f64| LeafMap {
        width: size,
        height: size,
        thickness_mm: thickness_mm.clone(),
        normals: normals_from_heights(
            &forms.iter().map(|f| height(f) as f32).collect::<Vec<f32>>(),
            size,
            [texel_mm; 2],
        ),
    };
    LeafByRule { front: side(|form| form.1), back: side(|form| form.0 - form.1), texel_mm }
}

/// A hill of height 1.
fn hill(distance: f64, width: f64) -> f64 {
    libm::exp(-distance * distance / (width * width))
}

/// Distance of a phase from the middle of its period, in periods.
fn from_line(phase: f64) -> f64 {
    phase.rem_euclid(1.0) - 0.5
}

/// A place of the leaf as its parts see it.
struct Place {
    /// From -1 to 1 across; from stalk 0 to tip 1 along.
    across: f64,
    along: f64,
    /// 1 in the middle of the leaf to 0 at its outline.
    within: f64,
    /// 0 at the outline, soon 1.
    rim: f64,
    /// How far from the next side vein, in their distances.
    vein: f64,
    /// Where on the way up the side veins it is.
    rise: f64,
}

impl Place {
    /// `None` outside of the leaf.
    fn of((across, along): (f64, f64)) -> Option<Place> {
        let (stalk, tip) = (0.04, 0.96);
        let share = (along - stalk) / (tip - stalk);
        if !(0.0..=1.0).contains(&share) {
            return None;
        }
        // Widest below the middle; teeth that point to the tip.
        let round = libm::sin(PI * share);
        let teeth = 0.012 * (1.0 - (share * 26.0).rem_euclid(1.0)) * round;
        let outline = 0.62 * libm::sin(PI * libm::pow(share, 0.8)) + teeth;
        let aside = across.abs();
        if outline - aside <= 0.0 {
            return None;
        }
        // Side veins leave the midrib at an angle and bend toward the tip; those of the left stand between those of the right.
        let (wave, shift) = if across < 0.0 { (2.0, 0.028) } else { (0.0, 0.0) };
        let rise = along - 0.42 * aside - 0.3 * aside * aside + 0.008 * libm::sin(9.0 * aside + wave) + shift;
        Some(Place {
            across,
            along,
            within: (1.0 - aside / outline).clamp(0.0, 1.0),
            rim: 1.0 - libm::exp(-(outline - aside) / 0.03),
            vein: from_line(rise * 12.0),
            rise,
        })
    }

    /// Midrib, side veins that thin out, ladders between them, a net between those.
    fn thickness(&self) -> f64 {
        let (aside, along) = (self.across.abs(), self.along);
        let midrib = hill(self.across, 0.010 + 0.018 * (1.04 - along));
        let side = hill(self.vein, 0.05 + 0.07 * self.within) * (0.25 + 0.75 * self.within);
        let rung =
            30.0 * aside + 2.5 * self.vein * libm::sin(7.0 * self.rise + 5.0 * aside) + 0.6 * libm::sin(23.0 * along);
        let ladder = hill(from_line(rung), 0.1) * (1.0 - hill(self.vein, 0.12));
        let bent = [0.5 * libm::sin(31.0 * along), 0.5 * libm::sin(37.0 * self.across)];
        let net = hill(between_cells([38.0 * self.across + bent[0], 38.0 * along + bent[1]]), 0.12);
        let blade = 0.115 + 0.045 * self.rim + 0.022 * net + 0.045 * ladder + 0.1 * side + 0.22 * midrib;
        blade * (0.62 + 0.38 * self.rim)
    }

    /// How far the blade stands up between its side veins, mm: front and back alike.
    fn bulge(&self) -> f64 {
        let between = libm::cos(PI * self.vein);
        let free = 1.0 - hill(self.across, 0.06);
        0.35 * between * between * free * self.rim * self.rim * self.rim * (3.0 * self.within).min(1.0)
    }
}

/// How much farther the second nearest of scattered points is than the nearest: 0 on the walls between their cells
/// (Worley 1996).
fn between_cells([u, v]: [f64; 2]) -> f64 {
    let (column, row) = (u.floor(), v.floor());
    let mut nearest = [f64::INFINITY; 2];
    for (dy, dx) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (f64::from(dy), f64::from(dx)))) {
        let (x, y) = (column + dx, row + dy);
        let place = |k: u32| 0.5 + 0.8 * (scattered(x as i32, y as i32, k) - 0.5);
        let d = ((u - x - place(1)).powi(2) + (v - y - place(2)).powi(2)).sqrt();
        nearest = if d < nearest[0] { [d, nearest[0]] } else { [nearest[0], nearest[1].min(d)] };
    }
    nearest[1] - nearest[0]
}

/// A number in [0, 1) without pattern from cell to cell.
fn scattered(x: i32, y: i32, k: u32) -> f64 {
    let mut h =
        (x as u32).wrapping_mul(0x9E37_79B1) ^ (y as u32).wrapping_mul(0x85EB_CA77) ^ k.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    f64::from(h ^ (h >> 15)) / 4_294_967_296.0
}

/// Thickness and height of the front, mm, at a place of the picture (u right, v down, 0 to 1): the closed form. Zero where
/// there is no leaf.
pub fn form(place: DVec2) -> (f64, f64) {
    Place::of((2.0 * place.x - 1.0, 1.0 - place.y)).map_or((0.0, 0.0), |place| {
        let d = place.thickness();
        (d, FRONT_SHARE * d + place.bulge())
    })
}

/// The leaf as a closed mesh: corners of triangles in mm (x right, y up, z out of the front) and their places in the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeafMesh {
    /// Triangles, counter-clockwise from outside.
    pub triangles: Vec<[DVec3; 3]>,
    /// Places in the picture, v down; the back's are those of the front above it.
    pub texture: Vec<[DVec2; 3]>,
}

/// The leaf by rule as a closed mesh whose points stand on a grid of `cells` x `cells` over the picture: front, back, and
/// a wall along the rim.
pub fn leaf_mesh(cells: usize) -> LeafMesh {
    let share = |i: usize| i as f64 / cells as f64;
    let points = cells + 1;
    let place = |i: usize| DVec2::new(share(i % points), share(i / points));
    let forms: Vec<(f64, f64)> = (0..points * points).into_par_iter().map(|i| form(place(i))).collect();
    let at = |[x, y]: [usize; 2]| forms[y * points + x];
    let point = |[x, y]: [usize; 2], z: f64| DVec3::new((share(x) - 0.5) * WIDTH_MM, (0.5 - share(y)) * WIDTH_MM, z);
    let (front, back) = (|p| point(p, at(p).1), |p| point(p, at(p).1 - at(p).0));
    let leaf = |x: usize, y: usize| {
        x < cells && y < cells && [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]].into_iter().all(|p| at(p).0 > 0.0)
    };
    let mut mesh = LeafMesh::default();
    let mut add = |places: [[usize; 2]; 3], corners: [DVec3; 3]| {
        mesh.triangles.push(corners);
        mesh.texture.push(places.map(|[x, y]| DVec2::new(share(x), share(y))));
    };
    for (x, y) in (0..cells * cells).map(|i| (i % cells, i / cells)).filter(|(x, y)| leaf(*x, *y)) {
        let [a, b, c, e] = [[x, y], [x, y + 1], [x + 1, y + 1], [x + 1, y]];
        for [p, q, r] in [[a, b, c], [a, c, e]] {
            add([p, q, r], [front(p), front(q), front(r)]);
            add([p, r, q], [back(p), back(r), back(q)]);
        }
        let beside = [(x.wrapping_sub(1), y), (x, y + 1), (x + 1, y), (x, y.wrapping_sub(1))];
        for ((p, q), (nx, ny)) in [(a, b), (b, c), (c, e), (e, a)].into_iter().zip(beside) {
            if !leaf(nx, ny) {
                add([p, p, q], [front(p), back(p), back(q)]);
                add([p, q, q], [front(p), back(q), front(q)]);
            }
        }
    }
    mesh
}
