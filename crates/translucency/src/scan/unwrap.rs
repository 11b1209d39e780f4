//! A leaf in its own texture coordinates: every texel is a place on the surface, one ray goes straight in from there.
//!
//! Straight is the leaf's own plane at that place: positions and normals of the surface averaged over a few millimeters,
//! so that a leaf may bend while its veins stand out.

use super::solid::{ScanError, Solid};
use super::{Scan, heights::normals_within};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Leaf thickness cannot be told from further away than this share of the mesh: what is hit there is another leaf.
const DEEPEST: f64 = 0.5;
/// Boxes of even weights that stand for a Gaussian.
const BOXES: usize = 3;

/// Where on the surface a texel is.
#[derive(Clone, Copy)]
struct Place {
    position: DVec3,
    normal: DVec3,
    /// From the position to the middle of its triangle.
    inside: DVec3,
}

/// Maps of `resolution` texels a side in the texture coordinates of the mesh. Where front and back share a place of the
/// picture, the side whose picture is not mirrored is the front. `smooth_mm`: over how much the leaf's plane is averaged.
///
/// # Errors
/// [`ScanError::NoTexture`].
pub fn in_texture(solid: &Solid, resolution: usize, smooth_mm: f64) -> Result<Scan, ScanError> {
    let side = resolution.max(1);
    let (places, overlapping) = places(solid, side);
    if !places.iter().any(Option::is_some) {
        return Err(ScanError::NoTexture);
    }
    let texel_mm = texel_mm(&places, side);
    let middle = middle(&places, side, texel_mm, smooth_mm);
    let found: Vec<Option<Result<(f64, f64), ()>>> = (0..side * side)
        .into_par_iter()
        .map(|at| Some(measured(solid, places[at].as_ref()?, middle[at].as_ref()?)))
        .collect();
    let mut scan = Scan { overlapping, ..Scan::empty(side, side, texel_mm) };
    for (at, found) in found.into_iter().enumerate() {
        match found {
            None => {}
            // A closed mesh has no holes: what is missed there is the last hair of its rim.
            Some(Err(())) if solid.faults.none() => {}
            Some(Err(())) => scan.broken.push(at),
            Some(Ok((thickness, height))) => {
                scan.thickness_mm[at] = thickness as f32;
                (scan.heights_mm[0][at], scan.heights_mm[1][at]) = (height as f32, (thickness - height) as f32);
            }
        }
    }
    let leaf = |at: usize| scan.thickness_mm[at] > 0.0;
    let normals = [0, 1].map(|i| normals_within(&scan.heights_mm[i], side, texel_mm, &leaf));
    Ok(Scan { normals, ..scan })
}

/// A ray on an edge of the mesh may slip between its triangles or run along its rim: moved inward by this share of its
/// triangle it does not.
const NUDGE: [f64; 4] = [0.0, 1e-3, 0.03, 0.2];
/// Share of the thickness a hair further in below which a ray ran out through the rim.
const RAN_OUT: f64 = 0.5;
/// What is thinner than this share of the mesh is an edge that a ray crossed both faces of.
const THINNEST: f64 = 1e-7;

/// Thickness, and height above the leaf's own plane there.
fn measured(solid: &Solid, place: &Place, middle: &Place) -> Result<(f64, f64), ()> {
    let cast =
        |share: &f64| straight(solid, &Place { position: place.position + place.inside * *share, ..*place }, middle);
    let found = NUDGE.iter().map(cast).find(Result::is_ok).unwrap_or(Err(()))?;
    // At the rim a ray may leave through the wall: what is much thicker a hair further in is as thick here.
    let further = NUDGE.last().and_then(|share| cast(share).ok()).filter(|further| found.0 < RAN_OUT * further.0);
    Ok(further.unwrap_or(found))
}

fn straight(solid: &Solid, place: &Place, middle: &Place) -> Result<(f64, f64), ()> {
    let inward = -middle.normal;
    // From a hair outside: the way in is the first crossing.
    let hair = 1e-4 * solid.size_mm;
    let crossings = solid.crossings(place.position - inward * hair, inward);
    let leaves = crossings.iter().find(|c| c.distance > 0.0 && !c.enters);
    let mut entered = crossings.iter().filter(|c| c.enters && c.distance <= leaves.map_or(0.0, |l| l.distance));
    match (leaves, entered.next_back()) {
        (Some(leaves), Some(enters))
            if leaves.distance < DEEPEST * solid.size_mm
                && leaves.distance - enters.distance > THINNEST * solid.size_mm =>
        {
            let front = place.position + inward * (enters.distance - hair);
            Ok((leaves.distance - enters.distance, (front - middle.position).dot(middle.normal)))
        }
        _ => Err(()),
    }
}

/// Fills texels whose middles lie in a triangle's picture; triangles whose picture is mirrored come last.
fn places(solid: &Solid, side: usize) -> (Vec<Option<Place>>, usize) {
    let mut places: Vec<Option<Place>> = vec![None; side * side];
    let mut overlapping = 0;
    // v runs down the picture: a picture that is not mirrored has a negative area in (u, v).
    let turned = |t: &[DVec2; 3]| (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0;
    for mirrored in [false, true] {
        let mut own = vec![false; if mirrored { 0 } else { side * side }];
        for (corners, texture) in solid.corners.iter().zip(&solid.texture).filter(|(_, t)| turned(t) == mirrored) {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
            inside(texture, side, |at, [a, b, c]| {
                if places[at].is_none() {
                    let position = corners[0] * a + corners[1] * b + corners[2] * c;
                    let inside = (corners[0] + corners[1] + corners[2]) / 3.0 - position;
                    places[at] = Some(Place { position, normal, inside });
                    own.get_mut(at).into_iter().for_each(|own| *own = true);
                } else if own.get(at).is_some_and(|own| *own) {
                    overlapping += 1;
                }
            });
        }
    }
    (places, overlapping)
}

/// Calls for every texel whose middle is inside a triangle of the picture, with the weights of its corners. A middle on an
/// edge belongs to the triangle on one side of it (the edges' smaller end decides), so that neighbors do not overlap.
fn inside(texture: &[DVec2; 3], side: usize, mut visit: impl FnMut(usize, [f64; 3])) {
    let [a, b, c] = texture.map(|t| t * side as f64);
    let area = (b - a).perp_dot(c - a);
    if area.abs() <= f64::EPSILON {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let range = |low: f64, high: f64| {
        let clamp = |v: f64| v.clamp(0.0, side as f64) as usize;
        clamp((low - 0.5).ceil())..clamp((high - 0.5).floor() + 1.0)
    };
    let edge = |p: DVec2, from: DVec2, to: DVec2| {
        let share = (to - from).perp_dot(p - from) / area;
        let owned = (from.x, from.y) < (to.x, to.y);
        (share > 0.0 || (share >= 0.0 && owned)).then_some(share)
    };
    for y in range(low.y, high.y) {
        for x in range(low.x, high.x) {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            if let (Some(wa), Some(wb), Some(wc)) = (edge(p, b, c), edge(p, c, a), edge(p, a, b)) {
                visit(y * side + x, [wa, wb, wc]);
            }
        }
    }
}

/// Mean way on the surface from texel to texel, across and down, mm.
fn texel_mm(places: &[Option<Place>], side: usize) -> [f64; 2] {
    let mean = |step: usize, last: usize| {
        let pairs = (0..places.len() - step.min(places.len())).filter(|at| at % side < side - last);
        let (sum, count) = pairs
            .filter_map(|at| Some(places[at]?.position.distance(places[at + step]?.position)))
            .fold((0.0, 0usize), |(sum, count), way| (sum + way, count + 1));
        (count > 0).then(|| sum / count as f64)
    };
    let (across, down) = (mean(1, 1), mean(side, 0));
    let one = across.or(down).unwrap_or(1.0);
    [across.unwrap_or(one), down.unwrap_or(one)]
}

/// The leaf's plane at every texel: means of positions and normals over its surroundings, leaf only.
fn middle(places: &[Option<Place>], side: usize, texel_mm: [f64; 2], smooth_mm: f64) -> Vec<Option<Place>> {
    let mut sums: Vec<[f64; 7]> = places
        .iter()
        .map(|place| {
            place.map_or([0.0; 7], |p| {
                let (a, n) = (p.position.to_array(), p.normal.to_array());
                [a[0], a[1], a[2], n[0], n[1], n[2], 1.0]
            })
        })
        .collect();
    // Three boxes of half width w have the variance w (w + 1) of a Gaussian.
    let half = |texel: f64| ((smooth_mm / texel).powi(2) + 0.25).sqrt() - 0.5;
    let half = texel_mm.map(|texel| (half(texel).round() as usize).min(side));
    for _ in 0..BOXES {
        sums = boxed(&sums, side, half[0]);
        sums = turned(&boxed(&turned(&sums, side), side, half[1]), side);
    }
    let mean = |(place, sum): (&Option<Place>, &[f64; 7])| {
        place.as_ref()?;
        let normal = DVec3::new(sum[3], sum[4], sum[5]).normalize_or_zero();
        let known = sum[6] > 0.0 && normal.length_squared() > 0.0;
        let position = DVec3::new(sum[0], sum[1], sum[2]) / sum[6];
        known.then_some(Place { position, normal, inside: DVec3::ZERO })
    };
    places.iter().zip(&sums).map(mean).collect()
}

/// Sums over `half` texels to either side of each, row by row.
fn boxed(texels: &[[f64; 7]], side: usize, half: usize) -> Vec<[f64; 7]> {
    let mut out = vec![[0.0; 7]; texels.len()];
    out.par_chunks_mut(side).zip(texels.par_chunks(side)).for_each(|(out, row)| {
        // Prefix sums: their rounding is 1e-13 of a row's sum, which no map shows.
        let mut before = vec![[0.0; 7]; side + 1];
        for (x, texel) in row.iter().enumerate() {
            before[x + 1] = std::array::from_fn(|k| before[x][k] + texel[k]);
        }
        for (x, sum) in out.iter_mut().enumerate() {
            let (low, high) = (x.saturating_sub(half), (x + half + 1).min(side));
            *sum = std::array::from_fn(|k| before[high][k] - before[low][k]);
        }
    });
    out
}

fn turned(texels: &[[f64; 7]], side: usize) -> Vec<[f64; 7]> {
    (0..texels.len()).into_par_iter().map(|at| texels[at % side * side + at / side]).collect()
}
