//! Does the wood lie on its side? Looks for the thick, compact end of a trunk in six directions.

use crate::geometry::{Geometry, double_area};
use foliar_schema::Role;
use glam::DVec3;

/// Thickness of the slab at each end, as a share of the wood's extent.
const SLAB: f64 = 0.08;
/// A trunk's end is compact: its spread is below this share of the wood's diagonal.
const COMPACT: f64 = 0.08;
/// A trunk is thick: at the girth of its end, the whole extent would have this share of the wood's area.
const THICK: f64 = 0.1;
/// Another direction wins where its end has this many times the girth of the lower end.
const CLEARLY: f64 = 3.0;
/// Places per triangle edge: long trunk triangles reach beyond the slab.
const PLACES: u32 = 3;
/// A tree lies only along an axis in which it reaches at least this share of its height.
const LONG: f64 = 0.5;

/// The end of the wood in one direction.
struct End {
    /// Surface per length.
    girth: f64,
    /// Whether it may be a trunk's end.
    trunk: bool,
}

/// Name of the axis along which a trunk clearly lies, if there is wood and it does.
pub(crate) fn lying_axis(geometry: &Geometry, roles: &[Role]) -> Option<&'static str> {
    let places = wood_places(geometry, roles);
    let (low, high) =
        places.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p.0), high.max(p.0)));
    let area: f64 = places.iter().map(|p| p.1).sum();
    let end = |axis: DVec3| end_of(&places, axis, low, high, area);
    let below = end(DVec3::NEG_Y);
    let others = [("+X", DVec3::X), ("-X", DVec3::NEG_X), ("+Z", DVec3::Z), ("-Z", DVec3::NEG_Z)];
    let height = (high - low).y;
    let long = others.into_iter().filter(|(_, axis)| (high - low).dot(axis.abs()) >= LONG * height);
    let found: Vec<_> = long.map(|(name, axis)| (name, end(axis))).collect();
    let best = found.iter().filter(|(_, end)| end.trunk).max_by(|a, b| a.1.girth.total_cmp(&b.1.girth))?;
    let upright = below.trunk && CLEARLY * below.girth >= best.1.girth;
    (!upright).then_some(best.0)
}

/// Places spread over the wood, with the area that each stands for.
fn wood_places(geometry: &Geometry, roles: &[Role]) -> Vec<(DVec3, f64)> {
    let wood = geometry.parts.iter().zip(roles).filter(|(_, role)| **role == Role::Wood);
    let triangles = wood.flat_map(|(part, _)| (0..part.part.triangles.len() as u32).map(|t| part.corners(t)));
    let share = 2.0 / f64::from(PLACES * (PLACES + 1));
    let mut places = Vec::new();
    for [a, b, c] in triangles {
        let area = 0.5 * double_area([a, b, c]).length();
        for i in 0..PLACES {
            for j in 0..PLACES - i {
                let at = |n: u32| (f64::from(n) + 1.0 / 3.0) / f64::from(PLACES);
                places.push((a + (b - a) * at(i) + (c - a) * at(j), area * share));
            }
        }
    }
    places
}

fn end_of(places: &[(DVec3, f64)], axis: DVec3, low: DVec3, high: DVec3, area: f64) -> End {
    let extent = (high - low).dot(axis.abs());
    let thickness = SLAB * extent;
    let limit = high.dot(axis).max(low.dot(axis)) - thickness;
    let inside = || places.iter().filter(|p| p.0.dot(axis) >= limit);
    let weight: f64 = inside().map(|p| p.1).sum();
    if weight <= 0.0 || thickness <= 0.0 {
        return End { girth: 0.0, trunk: false };
    }
    let middle = inside().map(|p| p.0 * p.1).sum::<DVec3>() / weight;
    let across = |p: DVec3| (p - middle).reject_from_normalized(axis);
    let spread = (inside().map(|p| p.1 * across(p.0).length_squared()).sum::<f64>() / weight).sqrt();
    let girth = weight / thickness;
    End { girth, trunk: spread <= COMPACT * (high - low).length() && girth * extent >= THICK * area }
}
