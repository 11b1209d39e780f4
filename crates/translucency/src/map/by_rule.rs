//! A leaf by rule, at any resolution: blade, veins of four orders, thin rim with teeth, blade that bulges between its veins.
//!
//! For tests, benchmarks and pictures: nobody's photograph, so nobody's license.

use super::LeafMap;
use super::normals_from_heights;
pub use foliar_plant::sample::{LEAF_WIDTH_MM as WIDTH_MM, leaf_form as form};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

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
