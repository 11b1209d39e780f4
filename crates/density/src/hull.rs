//! The implicit surface of a plant's own foliage (Luft07 eq. 3), and realigned normals from it.

use crate::ROOM;
use crate::fast::density_unit;
use crate::field::{Field, Query};
use crate::generators::Foliage;
use crate::params::Params;
use crate::surface::{Balls, DensityField, Surface, SurfaceError, SurfaceParams, extract_fast, nearest};
use foliar_bake::{BakeError, Hull};
use foliar_plant::Plant;
use glam::DVec3;

/// The density of the plant's own balls: a neighbor darkens a plant, and does not grow into its surface.
pub(crate) fn field(foliage: &Foliage) -> Field {
    Field::new(foliage.own(), foliage.radius)
}

/// The surface on which the density is the threshold, given in units of `unit`.
///
/// # Errors
/// [`BakeError::Parameter`] for a threshold of 0, and for cells larger than the radius or too small for the
/// memory allowed.
pub(crate) fn surface(foliage: &Foliage, unit: f64, params: &Params) -> Result<Surface, BakeError> {
    surface_by(extract_fast, foliage, unit, params)
}

/// [`surface`], meshed by `extract`.
///
/// # Errors
/// As [`surface`].
pub(crate) fn surface_by(
    extract: impl FnOnce(&Balls, &SurfaceParams) -> Result<Surface, SurfaceError>,
    foliage: &Foliage,
    unit: f64,
    params: &Params,
) -> Result<Surface, BakeError> {
    let balls = Balls { generators: foliage.own(), radius_m: foliage.radius, threshold: params.threshold * unit };
    let meshing = SurfaceParams {
        cell_m: params.surface_cell_m,
        memory_mb: params.surface_memory_mb,
        ..SurfaceParams::default()
    };
    extract(&balls, &meshing).map_err(refusal)
}

/// The outside of the surface as a mesh in the scene's rest frame, without the walls of its cavities.
///
/// # Errors
/// As [`surface`].
pub(crate) fn around(plant: &Plant, foliage: &Foliage, params: &Params) -> Result<Hull, BakeError> {
    let field = field(foliage);
    let unit = density_unit(foliage, params, |queries| field.densities(queries));
    let found = surface(foliage, unit, params)?;
    let Surface { origin, positions, normals, triangles, .. } = found.without_cavities();
    Ok(Hull { origin: plant.center() + origin, positions, normals, triangles })
}

/// In the names of the room's own parameters.
fn refusal(error: SurfaceError) -> BakeError {
    let (place, reason) = match error {
        SurfaceError::Parameter { name, value, rule } => {
            (own_name(name), format!("is {value}: must be finite and {rule}"))
        }
        SurfaceError::Memory { cell_m, memory_mb, fits } => {
            let remedy = match fits {
                Some(cell) => format!("{cell} would"),
                None => "no cell up to the radius would: allow more, or a larger radius_m".into(),
            };
            let reason = format!("is {cell_m}: the mesh would not fit into surface_memory_mb = {memory_mb}; {remedy}");
            ("surface_cell_m", reason)
        }
        other => ("generators", other.to_string()),
    };
    BakeError::Parameter { room: ROOM.into(), place: place.into(), reason }
}

fn own_name(name: &'static str) -> &'static str {
    match name {
        "cell_m" => "surface_cell_m",
        "memory_mb" => "surface_memory_mb",
        other => other,
    }
}

/// Normal of the closest point of the surface for each query; away from the plant's center where there is no
/// surface, and up in the center itself. Walls of cavities do not count: their normals point into the crown.
pub(crate) fn directions(surface: Surface, field: &impl DensityField, queries: &[Query]) -> Vec<DVec3> {
    let places: Vec<DVec3> = queries.iter().map(|query| query.position).collect();
    match nearest(&surface.without_cavities(), field, &places) {
        Some(feet) => feet.iter().map(|foot| foot.normal.as_dvec3()).collect(),
        None => places.iter().map(|place| place.try_normalize().unwrap_or(DVec3::Y)).collect(),
    }
}
