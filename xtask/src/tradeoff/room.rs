//! What the room itself writes, read back per leaf, with the processor's seconds that it took.

use super::scores::{LeafNormals, by_leaf};
use anyhow::{Context, Result};
use foliar_bake::{Inputs, Layer, Maps, Quiet, Request, run};
use foliar_density::Density;
use foliar_plant::Plant;
use foliar_schema::names;
use glam::{DVec3, Vec3};
use serde_json::{Map, Value};

/// Bakes a plant by the parameters of a JSON object.
pub fn bake(plant: &Plant, given: &Value) -> Result<Layer> {
    let given: Map<String, Value> = given.as_object().cloned().unwrap_or_default();
    let maps = Maps::new();
    let inputs = Inputs { plant: Some(plant), maps: &maps, neighbors: &[] };
    Ok(run(&Density, &inputs, &Request { given, ..Request::default() }, &Quiet)?.0)
}

/// `_AMBIENT` of each leaf, the mean over its vertices.
pub fn ambient(plant: &Plant, layer: &Layer) -> Result<Vec<f64>> {
    let arrays = arrays(plant, layer, names::AMBIENT)?;
    let leaves = by_leaf(plant, |part, vertex| f64::from(arrays[part][vertex]));
    Ok(leaves.into_iter().map(|leaf| leaf.iter().sum::<f64>() / leaf.len() as f64).collect())
}

/// `_SOFT_NORMAL` of each leaf's vertices, rest frame.
pub fn normals(plant: &Plant, layer: &Layer) -> Result<LeafNormals> {
    let arrays = arrays(plant, layer, names::SOFT_NORMAL)?;
    Ok(by_leaf(plant, |part, vertex| -> DVec3 {
        let normal = Vec3::from_slice(&arrays[part][3 * vertex..]).as_dvec3();
        plant.parts()[part].normal_to_rest(normal)
    }))
}

/// The arrays of a channel by part; empty for parts without leaves.
fn arrays<'a>(plant: &Plant, layer: &'a Layer, name: &str) -> Result<Vec<&'a [f32]>> {
    let array = |(index, part): (usize, &foliar_plant::Part)| {
        let has_leaves = (0..part.positions.len()).any(|v| plant.leaf_of(index, v).is_some());
        let found = layer.attribute(part.place, name).and_then(|array| array.as_f32());
        if has_leaves { found.with_context(|| format!("no {name} on part {index}")) } else { Ok(&[][..]) }
    };
    plant.parts().iter().enumerate().map(array).collect()
}

/// Seconds of the processor, all threads together, that `work` takes: the lesser of two runs.
pub fn cpu_seconds<T>(mut work: impl FnMut() -> Result<T>) -> Result<(T, f64)> {
    let mut timed = || {
        let start = now();
        Ok::<_, anyhow::Error>((work()?, now() - start))
    };
    let ((_, first), (result, second)) = (timed()?, timed()?);
    Ok((result, first.min(second)))
}

fn now() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
