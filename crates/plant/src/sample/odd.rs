//! The odd plants that every law runs over.

use super::build::{Build, LeafTruth, Piece};
use super::textures;
use super::{Recipe, Sample};
use crate::{Axis, Leaf, OnBranch, Plant};
use foliar_numerics::{fibonacci_sphere, radical_inverse};
use foliar_schema::Role;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use std::f64::consts::TAU;

/// Odd plants, each with its true structure. What is odd about it is its name.
pub fn odd_plants() -> Vec<Sample> {
    let plain = |leaves: &[Vec3]| cards(leaves, 0.1, DAffine3::IDENTITY);
    let line: Vec<Vec3> = (0..24).map(|i| Vec3::new(0.2 * i as f32, 3.0, 0.0)).collect();
    let plane: Vec<Vec3> = (0..64).map(|i| Vec3::new(0.3 * (i % 8) as f32, 3.0, 0.3 * (i / 8) as f32)).collect();
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.5, 0.5)) * DMat3::from_rotation_z(0.4);
    let scaled = |s: f64| DAffine3::from_scale(DVec3::splat(s));
    [
        ("nothing", Plant::default()),
        ("one-leaf", plain(&[Vec3::new(0.3, 2.0, 0.0)])),
        ("two-coincident-leaves", coincident()),
        ("leaves-in-a-plane", plain(&plane)),
        ("leaves-on-a-line", plain(&line)),
        ("zero-area-piece", zero_area()),
        ("transparent-leaf", transparent()),
        ("wood-only", plain(&[])),
        ("leaves-only", leaves_only()),
        ("leaf-larger-than-crown", giant()),
        ("micrometer-tree", cards(&ball(40), 0.1, scaled(2.5e-7))),
        ("thousand-kilometer-tree", cards(&ball(40), 0.1, scaled(2.5e5))),
        ("far-from-origin", cards(&ball(40), 0.1, DAffine3::from_translation(DVec3::new(1e6, 0.0, -1e6)))),
        ("mirrored-and-uneven", cards(&ball(40), 0.1, DAffine3::from_mat3_translation(mirror, DVec3::Y))),
        ("many-pieces-in-a-part", pieces()),
        ("crown-volume", crown_volume()),
        ("small-tree", Recipe::small().grow()),
    ]
    .into_iter()
    .map(|(name, plant)| Sample { name, plant })
    .collect()
}

/// Places inside a ball of radius 1 m around (0, 3, 0).
fn ball(count: u64) -> Vec<Vec3> {
    let place = |i: u64| {
        let radius = libm::cbrt(radical_inverse(i + 1, 3));
        (fibonacci_sphere(i as usize, count as usize) * radius + DVec3::Y * 3.0).as_vec3()
    };
    (0..count).map(place).collect()
}

/// A flat card with its lower edge at `petiole`, `size` long, turned by `turn` about up.
fn card(petiole: Vec3, size: f32, turn: f64) -> Piece {
    let along = DVec3::new(libm::cos(turn), 0.5, libm::sin(turn)).normalize().as_vec3();
    let across = along.cross(Vec3::Y).normalize() * (size / 2.0);
    let tip = petiole + along * size;
    Piece {
        positions: vec![petiole - across, petiole + across, tip + across, tip - across],
        uvs: vec![Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::new(1.0, 0.0), Vec2::ZERO],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        twin_of: Vec::new(),
    }
}

fn truth(piece: &Piece, coverage: f64) -> LeafTruth {
    let petiole = piece.positions[0].midpoint(piece.positions[1]);
    LeafTruth { coverage, petiole, group: None, on: OnBranch::NONE }
}

/// An open tube of eight sides, the trunk of most odd plants.
fn trunk(height: f32, radius: f64) -> Piece {
    let ring = |y: f32| {
        (0..8).map(move |k| {
            let angle = TAU * f64::from(k) / 8.0;
            Vec3::new((radius * libm::cos(angle)) as f32, y, (-radius * libm::sin(angle)) as f32)
        })
    };
    let positions: Vec<Vec3> = (0..=4).flat_map(|i| ring(height * i as f32 / 4.0)).collect();
    let quad = |i: u32, k: u32| {
        let (a, b) = (8 * i + k, 8 * i + (k + 1) % 8);
        [[a, b, b + 8], [a, b + 8, a + 8]]
    };
    let triangles = (0..4).flat_map(|i| (0..8).flat_map(move |k| quad(i, k))).collect();
    Piece { positions, triangles, ..Piece::default() }
}

/// A trunk 2 m high and 0.2 m thick, the only branch.
fn add_trunk(build: &mut Build, wood: usize) {
    let piece = trunk(2.0, 0.1);
    let points = (0..=4).map(|ring| DVec3::Y * (0.5 * f64::from(ring))).collect();
    let rings: Vec<u32> = (0..piece.positions.len() as u32).map(|vertex| vertex / 8).collect();
    build.branch(wood, &piece, &rings, &Axis::new(points, vec![0.1; 5]), None);
}

/// A trunk and a leaf part, with opaque or disc-shaped leaves.
fn start(transform: DAffine3, alpha: bool) -> (Build, usize) {
    let mut build = Build::default();
    let bark = build.material("bark", None);
    let leaf = build.material("leaf", alpha.then(|| textures::disc(64)));
    let wood = build.part("trunk", Role::Wood, bark, transform);
    add_trunk(&mut build, wood);
    let leaves = build.part("leaves", Role::Leaf, leaf, transform);
    (build, leaves)
}

/// One card per place over a trunk.
fn cards(places: &[Vec3], size: f32, transform: DAffine3) -> Plant {
    if places.is_empty() {
        let mut build = Build::default();
        let bark = build.material("bark", None);
        let wood = build.part("trunk", Role::Wood, bark, transform);
        add_trunk(&mut build, wood);
        return build.finish();
    }
    let (mut build, part) = start(transform, false);
    for (index, &place) in places.iter().enumerate() {
        let piece = card(place, size, 2.4 * index as f64);
        build.leaf(part, &piece, &truth(&piece, 1.0));
    }
    build.finish()
}

/// The same card twice, each with vertices of its own: one object.
fn coincident() -> Plant {
    let (mut build, part) = start(DAffine3::IDENTITY, false);
    let piece = card(Vec3::new(0.2, 2.0, 0.0), 0.1, 0.0);
    for _ in 0..2 {
        build.leaf(part, &piece, &LeafTruth { group: Some(0), ..truth(&piece, 1.0) });
    }
    build.finish()
}

/// A piece that has collapsed to a line among others: its vertices belong to no leaf.
fn zero_area() -> Plant {
    let (mut build, part) = start(DAffine3::IDENTITY, false);
    for (index, &place) in ball(12).iter().enumerate() {
        let mut piece = card(place, 0.1, index as f64);
        if index == 5 {
            piece.positions = vec![place; 4];
            build.piece(part, &piece);
        } else {
            build.leaf(part, &piece, &truth(&piece, 1.0));
        }
    }
    build.finish()
}

/// Leaves cut out by alpha, one of them entirely: a row whose area is 0.
fn transparent() -> Plant {
    let (mut build, part) = start(DAffine3::IDENTITY, true);
    for (index, &place) in ball(12).iter().enumerate() {
        let mut piece = card(place, 0.1, index as f64);
        let mut coverage = textures::DISC_COVERAGE;
        if index == 5 {
            // A corner of the picture that the disc does not reach.
            piece.uvs.iter_mut().for_each(|uv| *uv *= 0.1);
            coverage = 0.0;
        }
        build.leaf(part, &piece, &truth(&piece, coverage));
    }
    build.finish()
}

fn leaves_only() -> Plant {
    let mut build = Build::default();
    let leaf = build.material("leaf", Some(textures::disc(64)));
    let part = build.part("leaves", Role::Leaf, leaf, DAffine3::IDENTITY);
    for (index, &place) in ball(60).iter().enumerate() {
        let piece = card(place, 0.15, 2.4 * index as f64);
        build.leaf(part, &piece, &truth(&piece, textures::DISC_COVERAGE));
    }
    build.finish()
}

/// Small leaves in a crown of 2 m, and one of 10 m.
fn giant() -> Plant {
    let (mut build, part) = start(DAffine3::IDENTITY, false);
    for (index, &place) in ball(30).iter().enumerate() {
        let piece = card(place, if index == 7 { 10.0 } else { 0.1 }, 2.4 * index as f64);
        build.leaf(part, &piece, &truth(&piece, 1.0));
    }
    build.finish()
}

/// Single cards, crossed pairs, doubled sheets and fans of many triangles in one part.
fn pieces() -> Plant {
    let (mut build, part) = start(DAffine3::IDENTITY, true);
    for (index, &place) in ball(48).iter().enumerate() {
        let turn = 2.4 * index as f64;
        let first = build.structure.leaves.len() as u32;
        let piece = if index % 4 == 3 { fan(place, 0.1, 6 + index as u32 % 7) } else { card(place, 0.12, turn) };
        let coverage = if index % 4 == 3 { 1.0 } else { textures::DISC_COVERAGE };
        let leaf = LeafTruth { group: Some(first), ..truth(&piece, coverage) };
        build.leaf(part, &piece, &leaf);
        let second = match index % 4 {
            1 => Some(crossed(&piece)),
            2 => Some(Piece { triangles: piece.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(), ..piece }),
            _ => None,
        };
        if let Some(piece) = second {
            build.leaf(part, &piece, &leaf);
        }
    }
    build.finish()
}

/// A card turned by a right angle about its own long axis.
fn crossed(piece: &Piece) -> Piece {
    let p = &piece.positions;
    let (low, high) = (p[0].midpoint(p[1]), p[3].midpoint(p[2]));
    let across = (high - low).normalize().cross(p[1] - p[0]) / 2.0;
    Piece { positions: vec![low - across, low + across, high + across, high - across], ..piece.clone() }
}

/// A polygon of `corners` around a center vertex, its texture coordinates inside the disc.
fn fan(place: Vec3, radius: f32, corners: u32) -> Piece {
    let corner = |k: u32| {
        let angle = TAU * f64::from(k) / f64::from(corners);
        Vec2::new(libm::cos(angle) as f32, libm::sin(angle) as f32)
    };
    let rim = (0..corners).map(corner);
    let positions = rim.clone().map(|c| place + Vec3::new(c.x, 0.3 * c.x, -c.y) * radius).chain([place]).collect();
    let uvs = rim.map(|c| Vec2::splat(0.5) + c * 0.3).chain([Vec2::splat(0.5)]).collect();
    let triangles = (0..corners).map(|k| [k, (k + 1) % corners, corners]).collect();
    Piece { positions, uvs, triangles, twin_of: Vec::new() }
}

/// A trunk under a closed ball that stands for a crown: leaves are sampled from its surface.
fn crown_volume() -> Plant {
    const ROWS: usize = 64;
    let (mut build, part) = start(DAffine3::IDENTITY, false);
    let center = DVec3::Y * 3.0;
    let piece = globe(center.as_vec3(), 1.2, 24, 12);
    build.piece(part, &piece);
    let area = piece_area(&piece) / ROWS as f64;
    for index in 0..ROWS {
        let normal = fibonacci_sphere(index, ROWS);
        let place = (center + normal * 1.2).as_vec3();
        build.structure.leaves.push(Leaf {
            center: place,
            normal: normal.as_vec3(),
            area: area as f32,
            group: index as u32,
            petiole: place,
            crown_volume: true,
        });
    }
    let nearest = |p: &Vec3| {
        let distance = |row: &usize| build.structure.leaves[*row].center.distance_squared(*p);
        (0..ROWS).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0) as u32
    };
    let ids = piece.positions.iter().map(nearest).collect();
    build.structure.leaf_ids[part] = ids;
    build.finish()
}

fn piece_area(piece: &Piece) -> f64 {
    let area = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|v| piece.positions[v as usize].as_dvec3());
        (b - a).cross(c - a).length() / 2.0
    };
    piece.triangles.iter().map(area).sum()
}

/// A closed ball of `sides` by `rows` faces, one vertex at each pole, outward.
fn globe(center: Vec3, radius: f64, sides: u32, rows: u32) -> Piece {
    let place = |row: u32, side: u32| {
        let (tilt, turn) = (TAU / 2.0 * f64::from(row) / f64::from(rows), TAU * f64::from(side) / f64::from(sides));
        let (ring, y) = (radius * libm::sin(tilt), radius * libm::cos(tilt));
        center + DVec3::new(ring * libm::cos(turn), y, -ring * libm::sin(turn)).as_vec3()
    };
    let mut positions = vec![place(0, 0)];
    positions.extend((1..rows).flat_map(|row| (0..sides).map(move |side| (row, side))).map(|(r, s)| place(r, s)));
    positions.push(place(rows, 0));
    let last = positions.len() as u32 - 1;
    let at = |row: u32, side: u32| match row {
        0 => 0,
        r if r == rows => last,
        r => 1 + (r - 1) * sides + side % sides,
    };
    let mut triangles = Vec::new();
    for (row, side) in (0..rows).flat_map(|r| (0..sides).map(move |s| (r, s))) {
        let [a, b, c, d] = [at(row + 1, side), at(row + 1, side + 1), at(row, side + 1), at(row, side)];
        triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[0] != t[2]));
    }
    Piece { positions, triangles, ..Piece::default() }
}
