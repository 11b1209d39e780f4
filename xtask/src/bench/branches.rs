//! The branch hierarchy: time and memory, accuracy on the shared trees.

use super::{Figure, allocations, least_seconds};
use crate::accuracy;
use anyhow::Result;
use foliar_plant::{Plant, sample::wood_for_speed};
use foliar_structure::branches::{BranchParams, find};

/// Rings and sides of each tube, and branches, of a tree of the size that Kusternig07 names.
fn paper() -> Plant {
    wood_for_speed(1500, 5, 5)
}

fn large() -> Plant {
    wood_for_speed(20_000, 8, 6)
}

fn seconds_of(plant: &Plant) -> Result<Figure> {
    let mut count = 0;
    let seconds = least_seconds(3, || {
        count = find(plant.base(), plant.structure(), &BranchParams::default())?.branches.count();
        Ok(())
    })?;
    let triangles = plant.parts()[0].triangles.len();
    let size = format!("none; {triangles} triangles, {count} branches, {} leaves", plant.leaves().len());
    Ok(Figure::new(seconds, size))
}

/// Seconds for a tree of the paper's size.
pub fn seconds() -> Result<Figure> {
    seconds_of(&paper())
}

/// Seconds for a tree of two million triangles.
pub fn large_seconds() -> Result<Figure> {
    seconds_of(&large())
}

/// Peak of allocations over the bytes of all vertices: position, normal, texture coordinates.
pub fn memory() -> Result<Figure> {
    const BYTES_PER_VERTEX: usize = 32;
    let plant = large();
    let vertices: usize = plant.parts().iter().map(|p| p.positions.len()).sum();
    let mut result = Ok(());
    let peak = allocations::peak_bytes(|| {
        result = find(plant.base(), plant.structure(), &BranchParams::default()).map(drop);
    });
    result?;
    let data = vertices * BYTES_PER_VERTEX;
    let megabytes = format!("none; {:.1} MB for {:.1} MB of vertices", peak as f64 / 1e6, data as f64 / 1e6);
    Ok(Figure::new(peak as f64 / data as f64, megabytes))
}

/// One less the mean parent accuracy over the shared trees whose truth is told.
pub fn wrong_parents() -> Result<Figure> {
    let (mean, files) = accuracy::shared_mean()?;
    Ok(Figure::new(1.0 - mean, format!("none; {files} files")))
}
