//! Unit normals: the file's own where they are usable, angle-weighted ones where they are missing.
//! Weights by corner angle: Thürmer and Wüthrich 1998, "Computing vertex normals from polygonal facets".

use super::file::ObjFile;
use super::frame::Frame;
use super::scan::NONE;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// A `vn` shorter than this says no direction: f32 holds numbers of this size to their last digits.
const SHORTEST_NORMAL: f64 = 1e-30;

/// A weighted sum shorter than this share of its weights has canceled out (two sheets back to back).
const CANCELED: f64 = 1e-6;

/// The file's `vn` as unit vectors of the new frame; zero where one cannot be used.
pub(crate) fn own(file: &ObjFile, frame: Frame) -> Vec<Vec3> {
    let unit = |n: &[f32; 3]| {
        let normal = Vec3::from(*n).as_dvec3();
        let length = normal.length();
        if length > SHORTEST_NORMAL { frame.direction(normal / length).as_vec3() } else { Vec3::ZERO }
    };
    file.normals.par_iter().map(unit).collect()
}

/// Whether a corner has no normal of its own: one must be computed at its position.
pub(crate) fn is_missing(own: &[Vec3], vn: u32) -> bool {
    vn == NONE || own[vn as usize] == Vec3::ZERO
}

/// One triangle's unit normal and the angles at its corners; all zero for one without area.
#[derive(Clone, Copy, Default)]
struct Share {
    normal: DVec3,
    angles: [f64; 3],
}

fn share(corners: [DVec3; 3]) -> Share {
    let [a, b, c] = corners;
    // Unit edges first, so that tiny and huge triangles neither vanish nor overflow.
    let edges = [b - a, c - b, a - c].map(DVec3::try_normalize);
    let [Some(ab), Some(bc), Some(ca)] = edges else { return Share::default() };
    let Some(normal) = ab.cross(-ca).try_normalize() else { return Share::default() };
    let angle = |to: DVec3, from: DVec3| libm::atan2(to.cross(from).length(), to.dot(from));
    Share { normal, angles: [angle(ab, -ca), angle(bc, -ab), angle(ca, -bc)] }
}

/// Angle-weighted unit normals, one per position of the file: triangles that share a position are
/// smoothed, whatever their material. Where they cancel out, the first triangle's; up where there is none.
pub(crate) fn smooth(file: &ObjFile, frame: Frame) -> Vec<Vec3> {
    let corner = |v: u32| frame.position(file.positions[v as usize]);
    let shares: Vec<Share> = file.triangles.par_iter().map(|t| share(t.map(|c| corner(c.v)))).collect();
    let mut sums = vec![(DVec3::ZERO, 0.0, DVec3::ZERO); file.positions.len()];
    for (triangle, share) in file.triangles.iter().zip(&shares) {
        for (corner, angle) in triangle.iter().zip(share.angles) {
            let (sum, weight, first) = &mut sums[corner.v as usize];
            *sum += share.normal * angle;
            *weight += angle;
            if *first == DVec3::ZERO {
                *first = share.normal;
            }
        }
    }
    let unit = |(sum, weight, first): &(DVec3, f64, DVec3)| {
        let canceled = sum.length() <= CANCELED * weight;
        let normal = if canceled { *first } else { *sum };
        normal.normalize_or(DVec3::Y).as_vec3()
    };
    sums.iter().map(unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj::parse;
    use foliar_schema::Import;

    fn smoothed(text: &str) -> Vec<Vec3> {
        let file = parse(text.as_bytes(), "a.obj").unwrap();
        let frame = Frame::choose(&file, &Import::default(), "a.obj").unwrap();
        smooth(&file, frame)
    }

    #[test]
    fn a_cube_corner_leans_equally_whatever_the_triangulation() {
        // Three squares at the origin; angle weights make the corner's normal the exact diagonal,
        // though one square gives it one triangle and the others two of 45 degrees.
        let normals = smoothed(
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nv 0 1 1\nv 1 0 1\n\
                                f 1 2 5\nf 1 5 3\nf 3 6 4 1\nf 1 4 7 2\n",
        );
        let expected = Vec3::ONE.normalize();
        assert!((normals[0] - expected).length() < 1e-6, "{}", normals[0]);
    }

    #[test]
    fn sheets_back_to_back_take_the_first_side() {
        let normals = smoothed("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
        assert!(normals.iter().all(|n| *n == Vec3::Z), "{normals:?}");
    }

    #[test]
    fn triangles_without_area_have_no_say_and_normals_are_unit_all_the_same() {
        let normals = smoothed("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 1\nf 1 2 3\nf 1 1 2\nf 1 4 2\nf 3 3 3\n");
        assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-6), "{normals:?}");
        assert_eq!(normals[0], Vec3::Y);
    }

    #[test]
    fn size_does_not_matter() {
        for scale in ["1e-12", "1e12"] {
            let normals = smoothed(&format!("v 0 0 0\nv {scale} 0 0\nv 0 {scale} 0\nf 1 2 3\n"));
            assert_eq!(normals[0], Vec3::Z, "{scale}");
        }
    }
}
