//! Content hashes of what a bake reads.

use foliar_plant::Base;
use std::collections::BTreeSet;

/// blake3 of everything in a base that a result can depend on: transforms, positions, normals,
/// texture coordinates, triangles, alpha settings and rasters. Names do not count, and neither do
/// position ids, which a glTF cannot give back.
pub fn base_hash(base: &Base) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut section = |bytes: &[u8]| {
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    };
    for part in &base.parts {
        section(bytemuck::bytes_of(&[part.place.mesh, part.place.primitive, part.material.unwrap_or(u32::MAX)]));
        section(bytemuck::cast_slice(&part.transform.to_cols_array()));
        section(bytemuck::cast_slice(&part.positions));
        section(bytemuck::cast_slice(&part.normals));
        section(bytemuck::cast_slice(&part.uvs));
        section(bytemuck::cast_slice(&part.triangles));
    }
    for material in &base.materials {
        section(bytemuck::cast_slice(&material.base_color));
        section(format!("{:?} {:?}", material.alpha_mode, material.base_color_raster).as_bytes());
    }
    let used: BTreeSet<u32> = base.materials.iter().filter_map(|m| m.base_color_raster).collect();
    for raster in used.into_iter().filter_map(|index| base.rasters.get(index as usize)) {
        section(&raster.rgba);
    }
    hasher.finalize().to_hex().to_string()
}
