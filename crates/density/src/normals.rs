//! Realigned normals on the vertices of leaves, mixed with the original ones (Luft07 section 4).

use crate::fast::Places;
use crate::params::Params;
use foliar_plant::Plant;
use foliar_schema::Role;
use glam::DVec3;

/// Realigned normals of leaf parts, rest frame, mixed with the original ones (Luft07 section 4).
pub(crate) fn realigned(
    plant: &Plant,
    places: &Places,
    of_place: &[u32],
    toward: &[DVec3],
    params: &Params,
) -> Vec<Option<DVec3>> {
    places
        .vertices()
        .map(|(part, vertex, place)| {
            if plant.role(part) != Role::Leaf {
                return None;
            }
            let found = toward.get(of_place[place] as usize).copied().unwrap_or(DVec3::Y);
            let original = original_normal(plant, part, vertex);
            Some(original.filter(|_| params.blend > 0.0).map_or(found, |own| mix(found, own, params.blend)))
        })
        .collect()
}

/// NORMAL in the rest frame, else the leaf's.
fn original_normal(plant: &Plant, part: usize, vertex: usize) -> Option<DVec3> {
    let own = plant.parts()[part].normals.get(vertex);
    let own = own.and_then(|n| plant.parts()[part].normal_to_rest(n.as_dvec3()).try_normalize());
    own.or_else(|| plant.leaves()[plant.leaf_of(part, vertex)? as usize].normal.as_dvec3().try_normalize())
}

/// The linear combination of two unit vectors; where it vanishes, the realigned one.
pub(crate) fn mix(realigned: DVec3, original: DVec3, share: f64) -> DVec3 {
    const VANISHING: f64 = 1e-6;
    let mixed = realigned * (1.0 - share) + original * share;
    if mixed.length() > VANISHING { mixed.normalize() } else { realigned }
}
