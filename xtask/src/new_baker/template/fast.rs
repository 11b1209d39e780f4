//! The same by a grid: leaves in cells as wide as the radius, so that only those of 27 cells are asked.

use crate::reference::weight;
use foliar_plant::Plant;
use foliar_schema::Role;
use glam::{DVec3, I64Vec3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Leaves by cell, in the order of their ids: sums run in a fixed order, whatever the number of threads.
struct Grid {
    cells: BTreeMap<[i64; 3], Vec<(DVec3, f64)>>,
    radius: f64,
    total: f64,
}

impl Grid {
    fn new(plant: &Plant, radius: f64) -> Grid {
        let mut grid = Grid { cells: BTreeMap::new(), radius, total: 0.0 };
        for leaf in plant.leaves() {
            // f32 coordinates far from the origin are exact in f64, and so is what is left after the center goes.
            let (place, area) = (leaf.center.as_dvec3() - plant.center(), f64::from(leaf.area));
            grid.total += area;
            grid.cells.entry(grid.cell(place).to_array()).or_default().push((place, area));
        }
        grid
    }

    fn cell(&self, place: DVec3) -> I64Vec3 {
        if self.radius > 0.0 { (place / self.radius).floor().as_i64vec3() } else { I64Vec3::ZERO }
    }

    /// Share at a place relative to the plant's center.
    fn share(&self, place: DVec3) -> f32 {
        let cell = self.cell(place);
        let around = (-1..=1).flat_map(|z| (-1..=1).flat_map(move |y| (-1..=1).map(move |x| I64Vec3::new(x, y, z))));
        let near = around.filter_map(|step| self.cells.get(&(cell + step).to_array())).flatten();
        let sum: f64 = near.map(|(center, area)| area * weight(place - center, self.radius)).sum();
        if self.total > 0.0 { (sum / self.total) as f32 } else { 0.0 }
    }
}

/// Per part, per vertex: the share; empty where a part is no part of the plant.
pub fn shares(plant: &Plant, radius: f64) -> Vec<Vec<f32>> {
    let grid = Grid::new(plant, radius);
    let shares = |(index, part): (usize, &foliar_plant::Part)| match plant.role(index) {
        Role::Other => Vec::new(),
        _ => {
            let share = |vertex| grid.share(part.rest_position(vertex) - plant.center());
            (0..part.positions.len()).into_par_iter().map(share).collect()
        }
    };
    plant.parts().iter().enumerate().map(shares).collect()
}
