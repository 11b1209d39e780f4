//! The mesh of a scan in millimeters: whether it is closed, and which way it faces.

use foliar_space::{Beam, RayError, Rays};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Why triangles are no scan of a leaf.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScanError {
    /// Nothing there.
    #[error("has no triangle with area")]
    Empty,
    /// A corner is not finite.
    #[error("triangle {triangle} has a corner at {corner}: every coordinate must be finite")]
    Corner {
        /// Which triangle.
        triangle: usize,
        /// Its corner.
        corner: DVec3,
    },
    /// Triangles hide inside each other by the thousand.
    #[error("{0}")]
    Nested(String),
    /// No texture coordinates where they are asked for.
    #[error("has no texture coordinates, or all of them on one line")]
    NoTexture,
}

/// What keeps a mesh from being the surface of a solid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Edges with a triangle on one side only: rims of holes.
    pub open_edges: usize,
    /// Edges that more than two triangles share.
    pub crowded_edges: usize,
    /// Edges whose two triangles face opposite ways.
    pub turned_edges: usize,
    /// Middle of the first open edge, mm, in the mesh's own frame.
    pub first_hole: Option<DVec3>,
    /// Middle of the first turned edge.
    pub first_turned: Option<DVec3>,
    /// Whether the whole mesh faces inward; it was turned over.
    pub inside_out: bool,
}

impl Faults {
    /// Whether the mesh is closed and faces one way.
    pub fn none(&self) -> bool {
        self.open_edges == 0 && self.crowded_edges == 0 && self.turned_edges == 0
    }
}

/// Triangles of a scan.
#[derive(Debug)]
pub struct Solid {
    /// Corners, mm, about the middle of the mesh's box.
    pub corners: Vec<[DVec3; 3]>,
    /// Texture coordinates of the corners; empty where the mesh has none.
    pub texture: Vec<[DVec2; 3]>,
    /// Where the middle is in the mesh's own frame, mm.
    pub origin: DVec3,
    /// Longest edge of the box, mm.
    pub size_mm: f64,
    /// What is wrong with it.
    pub faults: Faults,
    /// Whether every ray asks every triangle, in f64: the reference.
    pub direct: bool,
    rays: Rays,
}

/// A crossing of a ray with the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the ray, mm.
    pub distance: f64,
    /// Whether the ray goes into the solid there.
    pub enters: bool,
}

impl Solid {
    /// Takes triangles by their corners, mm. Points at the same place are one.
    ///
    /// # Errors
    /// [`ScanError`] for none, and for corners that are not finite.
    pub fn new(triangles: &[[DVec3; 3]], texture: Vec<[DVec2; 3]>) -> Result<Solid, ScanError> {
        let bad = |(triangle, corners): (usize, &[DVec3; 3])| {
            let corner = corners.iter().find(|corner| !corner.is_finite())?;
            Some(ScanError::Corner { triangle, corner: *corner })
        };
        if let Some(error) = triangles.iter().enumerate().find_map(bad) {
            return Err(error);
        }
        let all = || triangles.iter().flatten();
        let (low, high) = all().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), p| (a.min(*p), b.max(*p)));
        let origin = (low + high) / 2.0;
        let mut corners: Vec<[DVec3; 3]> = triangles.iter().map(|t| t.map(|p| p - origin)).collect();
        if !corners.iter().any(|t| area(t).length_squared() > 0.0) {
            return Err(ScanError::Empty);
        }
        let mut texture = texture;
        let volume: f64 = corners.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum();
        let mut faults = faults(&corners, origin);
        faults.inside_out = volume < 0.0;
        if faults.inside_out {
            corners.iter_mut().for_each(|t| t.swap(1, 2));
            texture.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let single: Vec<[glam::Vec3; 3]> = corners.iter().map(|t| t.map(|p| p.as_vec3())).collect();
        let rays = Rays::new(&single).map_err(|error: RayError| ScanError::Nested(error.to_string()))?;
        Ok(Solid { corners, texture, origin, size_mm: (high - low).max_element(), faults, direct: false, rays })
    }

    /// Crossings of a ray, nearest first. Where triangles meet a ray may cross both: that counts once.
    pub fn crossings(&self, origin: DVec3, direction: DVec3) -> Vec<Crossing> {
        /// Two crossings nearer than this share of the mesh are one: f32 holds 6e-8 of a coordinate.
        const SAME: f64 = 1e-6;
        let mut found = Vec::new();
        let mut cross = |triangle: usize| {
            let normal = area(&self.corners[triangle]);
            let along = normal.dot(direction);
            // In f64 by the triangle's plane: f32 finds the triangle, not the place.
            let distance = normal.dot(self.corners[triangle][0] - origin) / along;
            if distance.is_finite() {
                found.push(Crossing { distance, enters: along < 0.0 });
            }
        };
        if self.direct {
            (0..self.corners.len()).filter(|t| is_crossed(&self.corners[*t], origin, direction)).for_each(cross);
        } else {
            let reach = (4.0 * self.size_mm) as f32;
            let beam = Beam { origin: origin.as_vec3(), direction: direction.as_vec3(), reach };
            self.rays.each(&beam, |hit| cross(hit.triangle as usize));
        }
        found.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.enters.cmp(&b.enters)));
        found.dedup_by(|b, a| a.enters == b.enters && b.distance - a.distance < SAME * self.size_mm);
        found
    }
}

fn area([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a)
}

/// Whether a ray's line passes inside a triangle, edges counted; behind the origin nothing is.
fn is_crossed(corners: &[DVec3; 3], origin: DVec3, direction: DVec3) -> bool {
    let [a, b, c] = corners.map(|p| p - origin);
    let sides = [a.cross(b), b.cross(c), c.cross(a)].map(|n| n.dot(direction));
    let within = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
    let normal = area(corners);
    within && normal.dot(a) / normal.dot(direction) >= 0.0
}

/// Looks at every edge once, by its two points.
fn faults(corners: &[[DVec3; 3]], origin: DVec3) -> Faults {
    let key = |p: DVec3| p.to_array().map(|v| (v + 0.0).to_bits());
    let mut points = BTreeMap::new();
    let ids: Vec<[u32; 3]> = corners
        .iter()
        .map(|t| {
            t.map(|p| {
                let next = points.len() as u32;
                *points.entry(key(p)).or_insert(next)
            })
        })
        .collect();
    // Low and high point, and whether the triangle walks from low to high; sorted, edges stand together.
    let mut edges: Vec<(u32, u32, bool, u32)> = Vec::with_capacity(3 * ids.len());
    for (t, [a, b, c]) in ids.iter().enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a) {
        edges.extend([(a, b), (b, c), (c, a)].map(|(a, b)| (*a.min(b), *a.max(b), a < b, t as u32)));
    }
    edges.sort_unstable();
    let mut faults = Faults::default();
    for edge in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let middle = || {
            let corner = |id: u32| {
                let t = edge[0].3 as usize;
                corners[t].iter().zip(ids[t]).find(|(_, i)| *i == id).map_or(DVec3::ZERO, |(p, _)| *p)
            };
            (corner(edge[0].0) + corner(edge[0].1)) / 2.0 + origin
        };
        match edge {
            [_] => {
                faults.open_edges += 1;
                faults.first_hole.get_or_insert_with(middle);
            }
            [a, b] if a.2 == b.2 => {
                faults.turned_edges += 1;
                faults.first_turned.get_or_insert_with(middle);
            }
            [_, _] => {}
            _ => faults.crowded_edges += 1,
        }
    }
    faults
}
