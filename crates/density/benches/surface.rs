//! How long a surface and normals from it take: `cargo bench -p foliar-density --bench surface`. Prints
//! seconds of wall clock (two numbers: best and median of the runs), vertices, and the worst residual.
#![expect(clippy::print_stdout, reason = "a benchmark's result")]

use foliar_density::surface::{Balls, SurfaceParams, extract_fast, nearest};
use foliar_density::{Field, Generator, NO_GROUP, Query};
use foliar_numerics::{fibonacci_sphere, r2_point, radical_inverse};
use glam::DVec3;
use std::time::Instant;

const RUNS: usize = 5;
const TWIGS: u64 = 400;
/// Threshold in units of the median density, the room's default.
const THRESHOLD: f64 = 0.1;

/// A crown about 8 m wide: 400 boughs of up to 1 m, each a ball of leaves.
fn crown(leaves: u64) -> Vec<Generator> {
    let leaf = |index: u64| {
        let (bough, rank) = (index % TWIGS, index / TWIGS);
        let out = 3.2 * libm::pow(radical_inverse(bough, 2), 0.4);
        let arm = libm::cbrt(radical_inverse(rank + 1, 3)) * (0.5 + 0.5 * r2_point(index).x);
        let position = fibonacci_sphere(bough as usize, TWIGS as usize) * out
            + fibonacci_sphere(index as usize * 7919 % 100_003, 100_003) * arm;
        Generator { position, weight: (0.5 + r2_point(index).y) as f32, group: index as u32 }
    };
    (0..leaves).map(leaf).collect()
}

fn median_density(field: &Field, generators: &[Generator]) -> f64 {
    let own: Vec<Query> = generators.iter().map(|g| Query { position: g.position, skip: NO_GROUP }).collect();
    let mut densities = field.densities(&own);
    densities.sort_unstable_by(f32::total_cmp);
    f64::from(densities[densities.len() / 2])
}

/// Best and median seconds.
fn time<T>(mut work: impl FnMut() -> T) -> (T, [f64; 2]) {
    let mut run = || {
        let start = Instant::now();
        (work(), start.elapsed().as_secs_f64())
    };
    let (result, first) = run();
    let mut seconds: Vec<f64> = (1..RUNS).map(|_| run().1).chain([first]).collect();
    seconds.sort_unstable_by(f64::total_cmp);
    (result, [seconds[0], seconds[RUNS / 2]])
}

fn main() {
    for (leaves, radius_m) in [(40_000, 0.4), (1_000_000, 0.137)] {
        let generators = crown(leaves);
        let field = Field::new(&generators, radius_m);
        let balls =
            Balls { generators: &generators, radius_m, threshold: THRESHOLD * median_density(&field, &generators) };
        for cells in [4.0, 8.0] {
            let params = SurfaceParams { cell_m: Some(radius_m / cells), ..SurfaceParams::default() };
            let (made, seconds) = time(|| extract_fast(&balls, &params));
            let surface = match made {
                Ok(surface) => surface,
                Err(error) => {
                    println!("{leaves} leaves, rho/{cells}: {error}");
                    continue;
                }
            };
            let (vertices, residual) = (surface.positions.len(), surface.residual);
            println!("{leaves} leaves, rho/{cells}: {seconds:.3?} s, {vertices} vertices, residual {residual:.1e}");
            if leaves == 40_000 {
                let outer = surface.without_cavities();
                let places: Vec<DVec3> = (0..225_000)
                    .map(|i| generators[i * 40_000 / 225_000].position + fibonacci_sphere(i % 7, 7) * 0.05)
                    .collect();
                let seconds = time(|| nearest(&outer, &field, &places)).1;
                println!("225000 normals from it: {seconds:.3?} s");
            }
        }
    }
}
