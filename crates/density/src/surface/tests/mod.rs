//! What every surface must be: closed, manifold, outward, on the threshold, the same on every machine.

mod extremes;
mod laws;
mod oracles;

use super::*;
use crate::reference;
use foliar_numerics::{r2_point, radical_inverse};

/// The density by its definition, in f64: what the surface is tested against.
struct Exact<'a>(Balls<'a>);

impl Exact<'_> {
    fn at(&self, position: DVec3) -> Probe {
        let query = Query { position, skip: NO_GROUP };
        let sample = reference::field(self.0.generators, self.0.radius_m, &query);
        Probe { density: sample.density, gradient: sample.gradient }
    }
}

impl DensityField for Exact<'_> {
    fn probe(&self, places: &[DVec3]) -> Vec<Probe> {
        places.par_iter().map(|&place| self.at(place)).collect()
    }
}

fn ball(position: DVec3, weight: f64) -> Generator {
    Generator { position, weight: weight as f32, group: 0 }
}

/// Balls spread through the unit ball, weights from .5 to 1.5.
fn cluster(count: u64) -> Vec<Generator> {
    let point = |i| DVec3::from((r2_point(i), radical_inverse(i, 5))) * 2.0 - 1.0;
    let inside = (0..4 * count).map(point).filter(|p| p.length() < 1.0).take(count as usize);
    (0..).zip(inside).map(|(i, position)| ball(position, 0.5 + radical_inverse(i, 7))).collect()
}

/// The surface by the exact field.
fn exact_surface(balls: Balls, params: &SurfaceParams) -> Surface {
    extract(&Exact(balls), &balls, params).unwrap()
}

fn cell(cell_m: f64) -> SurfaceParams {
    SurfaceParams { cell_m: Some(cell_m), ..SurfaceParams::default() }
}

fn assert_sound(surface: &Surface) {
    let faults = check_mesh(&surface.triangles, surface.positions.len());
    assert!(faults.is_empty(), "{faults:?}");
    assert!(surface.positions.iter().all(|p| p.is_finite()));
    // f32 rounds each coordinate to 2^-24.
    assert!(surface.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-6));
}

/// How often a closed mesh winds about a place: its solid angle over 4 pi (Van Oosterom and Strackee 1983).
fn winding(surface: &Surface, place: DVec3) -> f64 {
    let arm = |v: u32| surface.positions[v as usize].as_dvec3() + surface.origin - place;
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(arm);
        let [la, lb, lc] = [a.length(), b.length(), c.length()];
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * libm::atan2(a.dot(b.cross(c)), below)
    };
    surface.triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}
