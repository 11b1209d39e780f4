//! What cannot be done is refused before it is tried.

use crate::StructureError;
use crate::geometry::Geometry;
use foliar_schema::Role;

/// Branches that a float attribute can number.
const MOST_BRANCHES: usize = 1 << 24;
/// Step between neighboring coordinates, over the wood's diagonal, at which tubes are no tubes any more.
const COARSEST: f64 = 3e-4;

/// Refuses wood whose coordinates are too coarse for its size: a plant far from the origin of its mesh.
pub(super) fn check_precision(geometry: &Geometry, roles: &[Role]) -> Result<(), StructureError> {
    for (part, _) in geometry.parts.iter().zip(roles).filter(|(_, role)| **role == Role::Wood) {
        let far = part.part.positions.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
        let scale = part.part.transform.matrix3.determinant().abs();
        let step = f64::from(far) * f64::from(f32::EPSILON) * libm::cbrt(scale);
        if geometry.diagonal > 0.0 && step > COARSEST * geometry.diagonal {
            return Err(StructureError::Coarse { part: part.part.name().into(), step, diagonal: geometry.diagonal });
        }
    }
    Ok(())
}

/// Refuses more branches than a float id can number.
pub(super) fn check_count(count: usize) -> Result<(), StructureError> {
    if count > MOST_BRANCHES { Err(StructureError::TooManyBranches { count }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_as_many_as_a_float_counts() {
        assert_eq!(check_count(1 << 24), Ok(()));
        let said = check_count((1 << 24) + 1).map_err(|error| error.to_string());
        assert!(said.is_err_and(|said| said.contains("16777217 branches") && said.contains("merge its wood")));
    }
}
