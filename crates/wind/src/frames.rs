//! Frame and phase of each branch: the table `foliarWind`.

use foliar_numerics::{MORTON_BITS, morton3, r2_point};
use foliar_plant::{Branches, Plant};
use glam::{DMat3, DQuat, DVec2, DVec3};

/// Branches steeper than this have no direction sideways: their right is X.
const STEEP: f64 = 1e-6;

/// Frame of a branch: x right, y up, z along it; right-handed. World up and the branch span the plane of its
/// up, so gusts swing it sideways and up alike.
pub fn frame(direction: DVec3) -> DQuat {
    let along = direction.normalize_or(DVec3::Y);
    let aside = DVec3::Y.cross(along);
    let aside = if aside.length() > STEEP { aside } else { DVec3::X.reject_from_normalized(along) };
    let right = aside.normalize_or(DVec3::X);
    let quaternion = DQuat::from_mat3(&DMat3::from_cols(right, along.cross(right), along)).normalize();
    // Both signs are one rotation: one is written.
    if quaternion.w < 0.0 { -quaternion } else { quaternion }
}

/// Phases of all branches, in [0, 1) each: neighbors in the sequence lie far apart, for any number of branches. The
/// order is that of level and place, so that renumbering a file changes nothing.
pub fn phases(plant: &Plant, branches: &Branches) -> Vec<DVec2> {
    let size = plant.size().max_element().max(f64::MIN_POSITIVE);
    let low = plant.center() - DVec3::splat(size / 2.0);
    let cells = f64::from(1u32 << MORTON_BITS);
    let place = |branch: usize| {
        let cell =
            ((branches.axes[branch].points[0] - low) / size * cells).clamp(DVec3::ZERO, DVec3::splat(cells - 1.0));
        let [x, y, z] = cell.to_array().map(|c| c as u32);
        morton3(x, y, z)
    };
    let mut order: Vec<usize> = (0..branches.count()).collect();
    order.sort_by_cached_key(|&branch| (branches.rows[branch].level, place(branch), branch));
    let mut phases = vec![DVec2::ZERO; branches.count()];
    order.iter().enumerate().for_each(|(rank, &branch)| phases[branch] = r2_point(rank as u64));
    phases
}
