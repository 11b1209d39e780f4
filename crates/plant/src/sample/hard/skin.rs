//! Triangles around the limbs of hard trees, and leaves on their twigs.

use super::fused;
use super::limbs::Limb;
use crate::sample::build::{Build, LeafTruth, Piece};
use crate::sample::noise::signed;
use crate::{OnBranch, Plant};
use foliar_schema::Role;
use glam::{DAffine3, DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

/// Where a tube's texture starts and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seam {
    /// No seam: sides go round.
    None,
    /// The file's own positions tell that both columns are one (OBJ).
    SharedIds,
    /// Nothing tells it but equal positions (glTF).
    Doubled,
}

/// Ends of tubes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Caps {
    /// Open.
    None,
    /// A fan over the root, a cone at the tip.
    Joined,
    /// Fans that share no vertex with their tube (flat-shaded caps).
    Apart,
}

/// Limbs that are one surface.
#[derive(Clone, Copy, Debug)]
pub struct Fused {
    /// So many levels are; the others are tubes.
    pub levels: usize,
    /// Edge of a grid cell, meters.
    pub cell: f64,
}

/// How limbs are skinned.
#[derive(Clone, Debug)]
pub struct Skin {
    /// Sides by level.
    pub sides: [u32; 4],
    pub seam: Seam,
    pub caps: Caps,
    /// Every triangle has vertices of its own.
    pub soup: bool,
    /// Each coordinate is moved by up to so many diagonals of the wood.
    pub jitter: f64,
    /// So many tubes share one vertex with their parents.
    pub shared_vertices: usize,
    /// Parts that the tubes are dealt to in turn.
    pub parts: usize,
    pub leaves_per_twig: u32,
    pub fused: Option<Fused>,
}

impl Default for Skin {
    fn default() -> Self {
        Skin {
            sides: [10, 8, 6, 5],
            seam: Seam::None,
            caps: Caps::None,
            soup: false,
            jitter: 0.0,
            shared_vertices: 0,
            parts: 1,
            leaves_per_twig: 2,
            fused: None,
        }
    }
}

/// The plant of these limbs.
pub fn plant(limbs: &[Limb], skin: &Skin, seed: u64) -> Plant {
    let mut build = Build::default();
    let (bark, green) = (build.material("bark", None), build.material("leaf", None));
    let wood: Vec<usize> = ["wood", "more wood"][..skin.parts]
        .iter()
        .map(|name| build.part(name, Role::Wood, bark, DAffine3::IDENTITY))
        .collect();
    let points = limbs.iter().flat_map(|l| &l.axis.points);
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
    let jitter = skin.jitter * low.distance(high);
    let fused: Vec<usize> =
        (0..limbs.len()).filter(|&l| skin.fused.is_some_and(|fused| limbs[l].level < fused.levels)).collect();
    let cell = skin.fused.map_or(0.0, |fused| fused.cell);
    let surface = fused::surface(&fused.iter().map(|&l| limbs[l].clone()).collect::<Vec<_>>(), cell);
    let mut of_limb: Vec<_> = limbs.iter().map(|_| None).collect();
    surface.pieces.into_iter().zip(&fused).for_each(|(piece, &limb)| of_limb[limb] = Some(piece));
    for (index, limb) in limbs.iter().enumerate() {
        let (mut piece, mut rings) = of_limb[index].take().unwrap_or_else(|| tube(limb, skin));
        if skin.soup {
            (piece, rings) = torn(&piece, &rings, jitter, seed + index as u64);
        }
        build.branch(wood[index % wood.len()], &piece, &rings, &limb.axis, limb.parent);
    }
    let starts = build.hierarchy.starts();
    let corner = |(limb, vertex): (usize, u32)| starts[fused[limb]] as u32 + vertex;
    build.base.parts[wood[0]].triangles.extend(surface.faces.iter().map(|face| face.map(corner)));
    share_vertices(&mut build, wood[0], limbs, skin.shared_vertices);
    let deepest = limbs.iter().map(|l| l.level).max().unwrap_or(0);
    let leaves = build.part("leaves", Role::Leaf, green, DAffine3::IDENTITY);
    for (index, limb) in limbs.iter().enumerate().filter(|(_, l)| l.level == deepest) {
        add_leaves(&mut build, leaves, index as u32, limb, skin.leaves_per_twig);
    }
    build.finish()
}

fn tube(limb: &Limb, skin: &Skin) -> (Piece, Vec<u32>) {
    let axis = &limb.axis;
    let sides = skin.sides[limb.level.min(3)];
    let columns = if skin.seam == Seam::None { sides } else { sides + 1 };
    let (mut piece, mut rings) = (Piece::default(), Vec::new());
    for ring in 0..axis.points.len() {
        for side in 0..columns {
            let place = around(limb, ring, f64::from(side % sides) / f64::from(sides));
            add(&mut piece, &mut rings, place, ring as u32);
            let twin = ring as u32 * columns + side % sides;
            piece.twin_of.push(if skin.seam == Seam::SharedIds { twin } else { piece.twin_of.len() as u32 });
            piece.uvs.push(Vec2::new(side as f32 / sides as f32, ring as f32));
        }
        if ring > 0 {
            let low = (ring as u32 - 1) * columns;
            piece.triangles.extend((0..sides).flat_map(|k| {
                let (a, b) = (low + k, low + (k + 1) % columns);
                [[a, b, b + columns], [a, b + columns, a + columns]]
            }));
        }
    }
    if skin.caps != Caps::None {
        cap(&mut piece, &mut rings, limb, columns, skin.caps);
    }
    (piece, rings)
}

fn add(piece: &mut Piece, rings: &mut Vec<u32>, place: DVec3, ring: u32) {
    piece.positions.push(place.as_vec3());
    rings.push(ring);
}

fn around(limb: &Limb, ring: usize, share: f64) -> DVec3 {
    let points = &limb.axis.points;
    let (low, high) = (ring.saturating_sub(1), (ring + 1).min(points.len() - 1));
    // Where tubes lie end to end, the ring at the joint must not depend on which of them it is drawn for.
    let tangent = if ring == 0 || ring + 1 == points.len() {
        limb.axis.heading(false)
    } else {
        (points[high] - points[low]).normalize_or(DVec3::Y)
    };
    let first = limb.axis.heading(false).any_orthonormal_vector();
    let normal = (first - tangent * first.dot(tangent)).normalize_or(tangent.any_orthonormal_vector());
    let turn = TAU * share;
    points[ring] + (normal * libm::cos(turn) + tangent.cross(normal) * libm::sin(turn)) * limb.axis.radii[ring]
}

/// A fan over the root and one over the tip.
fn cap(piece: &mut Piece, rings: &mut Vec<u32>, limb: &Limb, columns: u32, caps: Caps) {
    let last = limb.axis.points.len() - 1;
    for (ring, beyond) in [(0usize, 0.0), (last, if caps == Caps::Joined { 1.5 } else { 0.0 })] {
        let out = -limb.axis.heading(ring > 0) * (beyond * limb.axis.radii[ring]);
        let mut rim: Vec<u32> = (0..columns).map(|k| ring as u32 * columns + k).collect();
        let mut vertex = |piece: &mut Piece, place: DVec3| {
            piece.twin_of.push(piece.twin_of.len() as u32);
            piece.uvs.push(Vec2::ZERO);
            add(piece, rings, place, ring as u32);
            piece.positions.len() as u32 - 1
        };
        if caps == Caps::Apart {
            rim = rim
                .iter()
                .map(|&v| piece.positions[v as usize].as_dvec3())
                .collect::<Vec<_>>()
                .into_iter()
                .map(|p| vertex(piece, p))
                .collect();
        }
        let middle = vertex(piece, limb.axis.points[ring] + out);
        let pairs = rim.iter().zip(rim.iter().cycle().skip(1)).take(rim.len());
        let fan = pairs.map(|(&a, &b)| if ring == 0 { [middle, b, a] } else { [middle, a, b] });
        let fan: Vec<[u32; 3]> = fan.collect();
        piece.triangles.extend(fan);
    }
}

/// Every triangle with vertices of its own, each moved a little.
fn torn(piece: &Piece, rings: &[u32], jitter: f64, seed: u64) -> (Piece, Vec<u32>) {
    let (mut out, mut of_vertex) = (Piece::default(), Vec::new());
    for triangle in &piece.triangles {
        let first = out.positions.len() as u32;
        for &vertex in triangle {
            let index = out.positions.len() as u64;
            let chance = [0, 1, 2].map(|k| signed(seed + 5, 3 * index + k) * jitter);
            out.positions.push((piece.positions[vertex as usize].as_dvec3() + DVec3::from(chance)).as_vec3());
            out.uvs.push(piece.uvs[vertex as usize]);
            of_vertex.push(rings[vertex as usize]);
        }
        out.triangles.push([first, first + 1, first + 2]);
    }
    (out, of_vertex)
}

/// Lets the last tubes share a position with their parents: their first vertex and the parent's nearest are one.
fn share_vertices(build: &mut Build, part: usize, limbs: &[Limb], pairs: usize) {
    let starts = build.hierarchy.starts();
    let part = &mut build.base.parts[part];
    for child in limbs.len() - pairs.min(limbs.len())..limbs.len() {
        let Some(parent) = limbs[child].parent.map(|p| p as usize) else { continue };
        let (own, place) = (starts[child], part.positions[starts[child]]);
        let distance = |vertex: &usize| part.positions[*vertex].distance(place);
        let others = starts[parent]..starts[parent + 1];
        if let Some(other) = others.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            part.positions[own] = part.positions[other];
            part.position_ids[own] = part.position_ids[other];
        }
    }
}

/// Square cards that start at the bark of a twig and stand off it.
fn add_leaves(build: &mut Build, part: usize, branch: u32, limb: &Limb, count: u32) {
    for leaf in 0..count {
        let arc = limb.axis.length() * (f64::from(leaf) + 1.0) / (f64::from(count) + 0.5);
        let spot = limb.axis.at(arc);
        let along = limb.axis.heading(false);
        let side = along.any_orthonormal_vector();
        let turn = 2.4 * f64::from(leaf);
        let out = side * libm::cos(turn) + along.cross(side) * libm::sin(turn);
        let petiole = (spot.point + out * spot.radius).as_vec3();
        let size = 0.3 * limb.axis.length();
        let (out, across) = (out.as_vec3(), (along.cross(out) * (size / 2.0)).as_vec3());
        let tip: Vec3 = petiole + out * size as f32;
        let piece = Piece {
            positions: vec![petiole - across, petiole + across, tip + across, tip - across],
            uvs: vec![Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::new(1.0, 0.0), Vec2::ZERO],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            twin_of: Vec::new(),
        };
        let on = OnBranch { branch, arc: arc as f32 };
        build.leaf(part, &piece, &LeafTruth { coverage: 1.0, petiole, group: None, on });
    }
}
